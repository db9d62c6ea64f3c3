#pragma once
/// The room in each cell and through each face that rigid bodies leave for water and grains.
#include "grid/field.hpp"

namespace mudlark {

/// A cell with solid fraction phi of grains holds theta = volume (1 - phi) of fluid per cell
/// volume; through a face with velocity v passes aperture (1 - phi) v. Valid in the ghost layers
/// too.
template <int D>
struct Space {
  explicit Space(const Grid<D>& grid)
      : volume(grid, "open volume", "1", 1.0), aperture(grid, "aperture", "1", 1.0) {}

  CellField<D> volume;     ///< open share of each cell [-]; 0: all of it is body
  FaceVector<D> aperture;  ///< open share of each face [-]; 0 where a cell beside it is all body
};

}  // namespace mudlark

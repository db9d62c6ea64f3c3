#pragma once
/// The room in each cell and through each face for water and grains: what the sizes of cells on
/// stretched axes make of it, and what rigid bodies leave of it.
#include "grid/field.hpp"

namespace mudlark {

/// A cell with solid fraction phi of grains holds theta = volume (1 - phi) of fluid per volume of a
/// mean cell (Grid::cell_volume); through a face with velocity v passes aperture (1 - phi) v per
/// face of a mean cell. So transport and pressure see a uniform grid of cells of unequal capacity,
/// and only distances (Grid::width, Grid::gap) tell a stretched axis from a uniform one. Without
/// stretching and bodies both are 1. Valid in the ghost layers too.
template <int D>
struct Space {
  /// Open space: cells and faces have the sizes of the grid's.
  explicit Space(const Grid<D>& grid);

  CellField<D> volume;     ///< [-]; 0: all of the cell is body
  FaceVector<D> aperture;  ///< [-]; 0 where nothing passes
};

extern template struct Space<2>;
extern template struct Space<3>;

}  // namespace mudlark

#pragma once
/// What the water feels of soil between its cells: how much room it leaves and how it resists.
#include <algorithm>

#include "flow/porous_medium.hpp"
#include "numerics/ghosts.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {

template <int D>
class SoilInWater {
 public:
  /// Porosity that the water never goes below, so that squeezed cells keep an equation.
  static constexpr double least_porosity = 0.05;

  /// Room in reach that cells inside bodies count with at least.
  static constexpr double least_reach = 0.02;

  explicit SoilInWater(const Grid<D>& grid)
      : grid_(&grid),
        ghosts_(grid),
        fraction_(grid, "solid fraction", "1"),
        resistance_(grid, "resistance", "Pa s/m2"),
        reach_(grid, "room within reach", "1", 1.0),
        spread_(grid, "room within reach", "1") {}

  /// Room that rigid bodies leave within the reach of the kernel, where they are now: points beside
  /// a body leave a part of their grains on cells inside it, and what cells beside it hold is
  /// counted per volume that grains could have filled. Collective.
  void find_reach(const Space<D>& space) {
    reach_.copy_values_from(space.volume);
    for (int axis = 0; axis < D; ++axis) {
      spread_.copy_values_from(reach_);
      const std::ptrdiff_t s = grid_->stride(axis);
      const double* from = spread_.data();
      double* to = reach_.data();
      for_each(grid_->owned(), [&](const Index<D>& cell) {
        const std::ptrdiff_t at = grid_->offset(cell);
        to[at] = (from[at - s] + 4.0 * from[at] + from[at + s]) / 6.0;
      });
      ghosts_.update(reach_);
    }
    for_each(grid_->local(),
             [&](const Index<D>& cell) { reach_[cell] = std::max(reach_[cell], least_reach); });
  }

  /// Grains and resistance of the points on the cells, and what porosity they leave of that of the
  /// fixed ground; ghosts included. Collective.
  void find(SoilSolver<D>& soil, const PorousMedium<D>& fixed, PorousMedium<D>& medium) {
    soil.solid_fraction(fraction_, resistance_);
    medium.moves = true;
    for_each(grid_->local(), [&](const Index<D>& cell) {
      fraction_[cell] /= reach_[cell], resistance_[cell] /= reach_[cell];
      medium.porosity[cell] = std::max(least_porosity, fixed.porosity[cell] - fraction_[cell]);
    });
  }

  /// Room within the kernel's reach of a cell that bodies leave [-].
  double reach_at(const Index<D>& cell) const { return reach_[cell]; }
  const CellField<D>& fraction() const { return fraction_; }  ///< grains per cell volume [-]
  double resistance_in(const Index<D>& cell) const { return resistance_[cell]; }  ///< [Pa s/m2]
  /// Means of the two cells beside a face: grains [-], and mu/kappa that fades with them [Pa s/m2].
  double fraction_at(int axis, const Index<D>& face) const {
    return 0.5 * (fraction_[face.shifted(axis, -1)] + fraction_[face]);
  }
  double resistance_at(int axis, const Index<D>& face) const {
    return 0.5 * (resistance_[face.shifted(axis, -1)] + resistance_[face]);
  }
  /// Faces of an axis with a cell on either side in this rank's arrays.
  template <class Body>
  void for_each_inner_face(int axis, Body&& body) const {
    IndexBox<D> faces = grid_->local();
    ++faces.lower[axis];
    for_each(faces, body);
  }

 private:
  const Grid<D>* grid_;
  Ghosts<D> ghosts_;
  CellField<D> fraction_, resistance_;
  CellField<D> reach_;   ///< mean room around a cell [-], weighted as the kernel does
  CellField<D> spread_;  ///< room that has been spread along some of the axes [-]
};

}  // namespace mudlark

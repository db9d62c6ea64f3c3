#pragma once
/// What the water feels of soil between its cells: how much room it leaves and how it resists.
#include <algorithm>

#include "flow/porous_medium.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {

template <int D>
class SoilInWater {
 public:
  /// Porosity that the water never goes below, so that squeezed cells keep an equation.
  static constexpr double least_porosity = 0.05;

  explicit SoilInWater(const Grid<D>& grid)
      : grid_(&grid),
        fraction_(grid, "solid fraction", "1"),
        resistance_(grid, "resistance", "Pa s/m2") {}

  /// Grains and resistance of the points on the cells, and what porosity they leave of that of the
  /// fixed ground; ghosts included. Collective.
  void find(SoilSolver<D>& soil, const PorousMedium<D>& fixed, PorousMedium<D>& medium) {
    soil.solid_fraction(fraction_, resistance_);
    for_each(grid_->local(), [&](const Index<D>& cell) {
      medium.porosity[cell] = std::max(least_porosity, fixed.porosity[cell] - fraction_[cell]);
    });
  }

  const CellField<D>& fraction() const { return fraction_; }  ///< grains per cell volume [-]
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
  CellField<D> fraction_, resistance_;
};

}  // namespace mudlark

#pragma once
/// What sides of the domain give to an implicit step.
#include "soil/side_water.hpp"
#include "soil/sides.hpp"
#include "soil/walls.hpp"

namespace mudlark {

/// Displacement of grains and way of the water relative to them (flux times step) have images
/// behind closed sides as the velocities of explicit steps have (fold_into_domain, mirror_motion).
/// The rise of pore pressure is odd about what the pressure of a side rises by, and even elsewhere.
template <int D>
class ImplicitSides {
 public:
  /// `sums` of the points at the start of the step, folded. All must live as long as this.
  ImplicitSides(const SoilSides<D>& sides, const SideWater<D>& water,
                const NodeField<NodeSums, D>& sums, double dt)
      : sides_(&sides), water_(&water), sums_(&sums), dt_(dt) {}

  const SoilSides<D>& sides() const { return *sides_; }

  /// Sets what sides hold and the places behind them; ghosts must be valid.
  void complete(FaceVector<D>& grains, FaceVector<D>& water, CellField<D>& pressure) const;
  /// Adds the images of unbalanced forces, and what the sides' pressures do, to the places before
  /// them; ghosts belong to their owners already.
  void fold(FaceVector<D>& grains, FaceVector<D>& water, CellField<D>& pressure) const;

 private:
  const SoilSides<D>* sides_;
  const SideWater<D>* water_;
  const NodeField<NodeSums, D>* sums_;
  double dt_;
};

/// Sign of the pressure behind a side where the component along its normal is `node`.
inline double pressure_sign(const SideNode& node) {
  return node.water == WaterSide::pressure ? -1.0 : 1.0;
}

/// Calls f(side, node of the component along the axis, behind, before) for mirrored pairs of cells
/// at both sides of an axis.
template <int D, class F>
void for_each_image_of_cells(const SoilSides<D>& sides, const IndexBox<D>& box, int axis, F&& f) {
  const Grid<D>& grid = sides.grid();
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(axis, side)) continue;
    for_each_mirror_pair(grid, box, axis, side, false,
                         [&](const Index<D>& behind, const Index<D>& before) {
                           const SideNode node = sides.node(axis, side, axis, before);
                           if (node.mirrored) f(side, node, behind, before);
                         });
  }
}

extern template class ImplicitSides<2>;
extern template class ImplicitSides<3>;

}  // namespace mudlark

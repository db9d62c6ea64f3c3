#include "flow/drained_ground.hpp"

#include <algorithm>

#include "flow/fixed_ground.hpp"
#include "flow/partly_filled.hpp"
#include "numerics/loops.hpp"

namespace mudlark {

template <int D>
DrainedGround<D>::DrainedGround(const Grid<D>& grid, const FlowOptions& options)
    : grid_(&grid), density_(options.density), number_(grid, "number of the ground", "1") {
  for (const PorousGround& ground : options.porous) {
    grounds_.push_back(ground.filling);
    slows_ = slows_ || !same_curve(ground.filling, PorousGround{}.filling);
  }
  if (slows_) number_grounds(grid, options, number_);
}

/// In the mobility m = dt / (inertia + dt R) the drag R becomes R S / k_r; the grains are at rest,
/// so the velocity falls with it.
template <int D>
void DrainedGround<D>::slow(const CellField<D>& water, const CellField<D>& porosity,
                            const CellField<D>& unknown, const FaceVector<D>& added_mass, double dt,
                            FaceVector<D>& velocity, FaceVector<D>& mobility) const {
  if (!slows_) return;
  const double *w = water.data(), *room = porosity.data(), *governed = unknown.data();
  const double slow = undirected_speed(norm(grid_->gravity()), dt);
  const auto share = [&](std::ptrdiff_t at) { return room[at] > 0.0 ? w[at] / room[at] : 0.0; };
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid_->stride(axis);
    const double *number = number_[axis].data(), *added = added_mass[axis].data();
    double *v = velocity[axis].data(), *m = mobility[axis].data();
    for_each_offset(*grid_, bounding_faces(*grid_, axis), [&](std::ptrdiff_t at) {
      if (number[at] == 0.0 || governed[at] + governed[at - s] > 0.0) return;
      const PoreFilling& ground = grounds_[static_cast<std::size_t>(number[at]) - 1];
      const double filled = std::max(1e-3, filled_upstream(share(at - s), share(at), v[at] / slow));
      const double growth = filled / ground.relative_permeability(filled);
      const double drag = std::max(0.0, 1.0 / m[at] - (density_ + added[at]) / dt);
      const double slower = 1.0 / (1.0 + m[at] * drag * (growth - 1.0));
      m[at] *= slower;
      v[at] *= slower;
    });
  }
}

template class DrainedGround<2>;
template class DrainedGround<3>;

}  // namespace mudlark

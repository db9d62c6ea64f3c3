#pragma once
/// Points that have been drawn out too far are split in two.
#include <span>

#include "grid/grid.hpp"
#include "soil/particles.hpp"
#include "soil/sides.hpp"

namespace mudlark {

/// When points are split.
struct Splitting {
  double longest = 0.0;  ///< extent along a principal direction [cells]
  int most = 0;          ///< no point of a cell that holds more points of its body than these
};

/// Gives point `p` the extent of the lattice that it stands on, `per_axis` points along each axis
/// of a cell.
template <int D>
void set_extent(const Grid<D>& grid, int per_axis, std::size_t p, SoilParticles<D>& points);

/// The extents of the points of `range` follow the motion of a step: A <- f A f^T, f = I + dt grad
/// v. `gradient` holds D*D arrays of as many values, dt * dv_i/dx_j row by row.
template <int D>
void follow_extent(std::span<const double> gradient, PointRange range, SoilParticles<D>& points);

/// Splits points that are too long into halves side by side along their longest direction, until
/// none is left, and sends all points home. Halves share mass and volumes and copy all else: mass,
/// momentum, angular momentum, kinetic energy, centre of mass and the integral of stress stay what
/// they were, and so does the affine motion of APIC. Which points are split does not depend on
/// their order or on the ranks. Returns the grain mass removed through open sides [kg]. Collective.
template <int D>
double split_stretched(const SoilSides<D>& sides, const Splitting& splitting,
                       SoilParticles<D>& points);
template <int D>
double split_stretched(const Grid<D>& grid, const Splitting& splitting, SoilParticles<D>& points) {
  return split_stretched(SoilSides<D>(grid), splitting, points);
}

}  // namespace mudlark

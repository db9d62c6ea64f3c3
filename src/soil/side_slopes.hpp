#pragma once
/// Sums over the points near a side, for the nodes on it and behind it.
#include <functional>
#include <vector>

#include "grid/halo.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/sides.hpp"

namespace mudlark {

/// Which sum: of V weight dW/dx_direction, W the splines of a component, near both sides of an
/// axis.
struct SideSum {
  int axis, component, direction;
  /// Images at the sides of axes below this one are folded in, as for the forces of points.
  int folded;
};

/// Value at a point that goes into a sum.
template <int D>
using SideWeight = std::function<double(int side, const Vec<D>& position)>;

/// With direction = axis and weight 1 the integral of dW/dx_axis over the soil: the side's area
/// that belongs to a node, with the sign of the inward normal. Summed over points as forces are, so
/// that uniform pressures and stresses are in balance to round-off. Collective.
template <int D>
void measure_side_slopes(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                         const std::vector<SoilParticles<D>>& bodies, const SideSum& which,
                         const SideWeight<D>& weight, FaceField<D>& slopes);

}  // namespace mudlark

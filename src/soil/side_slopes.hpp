#pragma once
/// How much of a side of the domain belongs to the nodes on it and behind it.
#include <vector>

#include "grid/halo.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/sides.hpp"

namespace mudlark {

/// Whether the nodes behind a side will be folded onto those before it.
enum class Behind { folded, kept };

/// Sums V dW/dx_axis over the points near both sides of an axis, for the nodes of a component on
/// those sides and behind them [m^(D-1)]: the integral of dW/dx_axis over the soil, which is the
/// side's area that belongs to the node, with the sign of the inward normal. Summed over points as
/// forces are, so a uniform pressure is in balance to round-off. Images at the sides of other axes
/// are folded in as far as fold_into_domain has come when it needs them (Behind::folded), or all of
/// them. Collective.
template <int D>
void measure_side_slopes(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                         const std::vector<SoilParticles<D>>& bodies, int axis, int component,
                         Behind behind, FaceField<D>& slopes);

}  // namespace mudlark

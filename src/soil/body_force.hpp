#pragma once
/// A given acceleration of all soil, beside gravity.
#include "soil/nodes.hpp"
#include "soil/options.hpp"

namespace mudlark {

/// Adds mass times `options.body_acceleration` [m/s2] at a time [s] to the forces on the faces of
/// `box`, grains and pore water alike; nothing when the case gives none.
template <int D>
void add_body_force(const Grid<D>& grid, const SoilOptions& options, double time,
                    const IndexBox<D>& box, NodeField<NodeSums, D>& nodes);

}  // namespace mudlark

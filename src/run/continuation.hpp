#pragma once
/// What a saved state has to share with the case that goes on from it.
#include <string>

namespace mudlark {

/// The resolved input without what may change between a run and its continuation: `title`, [time]
/// (a later end, another step), the gauges, and the numbers that only say how carefully the solvers
/// work (courant, max_step, damping, pressure_tolerance), which a user changes after a divergence.
std::string lasting_part(const std::string& resolved_toml);

}  // namespace mudlark

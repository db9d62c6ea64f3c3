#pragma once
/// Which water the pores hold, for readers of what comes after the soil.
#include "soil/options.hpp"

namespace mudlark {

/// Is the pore water that of the flow?
inline bool is_unified(const SoilOptions& soil) {
  return !soil.bodies.empty() && soil.bodies.front().pore_water == PoreWater::unified;
}

}  // namespace mudlark

#pragma once
/// Which of two partly filled cells gives the water that passes the face between them.
#include <algorithm>
#include <cmath>

namespace mudlark {

/// Water slower against the grains than a tenth of what gravity [m/s2] gives it in a step has no
/// clear direction [m/s].
inline double undirected_speed(double gravity, double dt) {
  return std::max(0.1 * dt * gravity, 1e-12);
}

/// Saturation of the cell that water comes from [-]; where it hardly moves (`direction`, its speed
/// over the undirected one, is small), of both: a switch would turn round-off into a difference.
inline double filled_upstream(double below, double above, double direction) {
  const double from_below = 0.5 * (1.0 + std::tanh(direction));
  return std::clamp(above + from_below * (below - above), 0.0, 1.0);
}

}  // namespace mudlark

#pragma once
/// Water in pores that are not full: how grains hold it, and which of two cells gives what passes
/// the face between them.
#include <algorithm>
#include <cmath>

#include "base/pore_filling.hpp"

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

/// S^2 / k_r: drag of water in partly filled pores over that in full ones. Less than a thousandth
/// of them hardly moves.
inline double drag_of_part(const PoreFilling& filling, double saturation) {
  const double s = std::max(saturation, 1e-3);
  return saturation * saturation / filling.relative_permeability(s);
}

}  // namespace mudlark

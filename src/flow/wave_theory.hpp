#pragma once
/// Waves that are known in closed form or by a small computation: elevation and velocity at any
/// place and time. Vertical positions count from the still water level.
#include <array>
#include <cstdint>
#include <functional>
#include <variant>

#include "base/varying.hpp"
#include "base/vec.hpp"

namespace mudlark {

/// Steady periodic wave. Without the stream function: linear (Airy 1845).
struct RegularWave {
  double height = 0.0;          ///< crest to trough [m]
  double period = 0.0;          ///< [s]
  bool stream_function = true;  ///< the full nonlinear wave (Fenton 1988), else linear
};
/// One hump, third order (Grimshaw 1971) with the velocities of Serre (1953).
struct SolitaryWave {
  double height = 0.0;  ///< [m]
  double crest = 0.0;   ///< where its crest is at time zero along the wave's way [m]
};
/// Long-crested irregular sea: linear waves of random phase.
struct IrregularSea {
  double significant_height = 0.0;  ///< H_m0 [m]
  double peak_period = 0.0;         ///< T_p [s]
  double peak_enhancement = 3.3;    ///< gamma of JONSWAP [-]; 1: Pierson-Moskowitz
  int components = 200;
  std::uint64_t seed = 1;
};
/// A long wave given as level and velocity over time where it comes in.
struct GivenWave {
  Varying level;     ///< above still water [m], function of t
  Varying velocity;  ///< [m/s]; used when `has_velocity`, else level * sqrt(g/d) / (1 + level/d)
  bool has_velocity = false;
};
struct StillWater {};

using WaveKind = std::variant<StillWater, RegularWave, SolitaryWave, IrregularSea, GivenWave>;

/// Elevation [m] and velocity [m/s] along the wave's way `s` [m] from its origin, at height z above
/// still water and time t; velocity is {along the way, upwards}.
struct WaveMotion {
  std::function<double(double s, double t)> elevation;
  std::function<std::array<double, 2>(double s, double z, double t)> velocity;
  double length = 0.0;    ///< of the (peak) wave [m]
  double celerity = 0.0;  ///< [m/s]
};

/// Throws InputError when no such wave exists (too high for its depth and period).
WaveMotion make_wave(const WaveKind& kind, double depth, double gravity);

/// k of w^2 = g k tanh(k d) [1/m].
double wave_number(double period, double depth, double gravity);

}  // namespace mudlark

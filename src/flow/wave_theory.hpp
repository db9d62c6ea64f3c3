#pragma once
/// Waves that are known in closed form or by a small computation: elevation and velocity at any
/// place and time. Vertical positions count from the still water level.
#include <array>
#include <memory>
#include <span>

#include "flow/wave_options.hpp"

namespace mudlark {

/// The water that waves come in with.
struct WaveSetting {
  double depth = 0.0, gravity = 9.81;  ///< [m], [m/s2]
  double direction = 0.0;              ///< of the waves against the inward axis of their zone [rad]
  double current = 0.0;                ///< uniform, along the inward axis [m/s]
};

/// A horizontal place: along the inward axis of the zone from its outer end, and across it [m].
struct WavePlace {
  double along = 0.0, across = 0.0;
};
/// Along, across, upwards [m/s].
using WaveVelocity = std::array<double, 3>;

/// A known motion of water. Evaluated over one vertical at a time: what belongs to the place alone
/// is computed once for all heights.
class WaveMotion {
 public:
  virtual ~WaveMotion() = default;
  /// Level above still water [m].
  virtual double elevation(const WavePlace& place, double time) const = 0;
  /// Velocities at heights z above still water, none of them above the surface; without current.
  virtual void velocities(const WavePlace& place, double time, std::span<const double> heights,
                          std::span<WaveVelocity> out) const = 0;
  /// Water beyond still water that the wave carries through a section, along [m2/s]: of a wave that
  /// keeps its form, speed times elevation.
  virtual double carried(const WavePlace& place, double time) const {
    return celerity_ * elevation(place, time);
  }
  /// Displacement of a piston, along, that makes this wave from its place at rest on [m]; first
  /// order. Only of regular waves of linear theory, seas and solitary waves.
  virtual double piston(double /*time*/) const { return 0.0; }
  WaveVelocity velocity(const WavePlace& place, double z, double time) const {
    WaveVelocity value{};
    velocities(place, time, {&z, 1}, {&value, 1});
    return value;
  }
  double length() const { return length_; }      ///< of the (peak) wave [m]; 0: none
  double celerity() const { return celerity_; }  ///< [m/s], over ground; 0: none

 protected:
  double length_ = 0.0, celerity_ = 0.0;
};

/// Throws InputError when no such wave exists (too high for its depth and period, held back by the
/// current).
std::unique_ptr<const WaveMotion> make_wave(const WaveKind& kind, const WaveSetting& setting);

/// k of (w - k U)^2 = g k tanh(k d), the shortest one that goes with the wave's way [1/m]; U: the
/// current along that way [m/s]. NaN when U holds such waves back.
double wave_number(double period, double depth, double gravity, double current = 0.0);

}  // namespace mudlark

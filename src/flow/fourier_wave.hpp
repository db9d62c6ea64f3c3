#pragma once
/// Waves that are a sum of cosines in space and time: linear ones, seas, Stokes waves, the Fourier
/// approximation of steady waves.
#include <vector>

#include "flow/wave_theory.hpp"

namespace mudlark {

/// eta = elevation cos(phi), u = speed cosh(k(z+d))/cosh(kd) cos(phi) along its way and w = speed
/// sinh(k(z+d))/cosh(kd) sin(phi), phi = k s - w t + phase.
struct WaveComponent {
  double elevation = 0.0, speed = 0.0;                     ///< [m], [m/s]
  double wave_number = 0.0, frequency = 0.0, phase = 0.0;  ///< [1/m], [rad/s] over ground, [rad]
  std::array<double, 2> way{1.0, 0.0};                     ///< unit vector: along, across
};

/// How the velocities of the column below still water are carried to the surface. as_they_are: the
/// sums hold up to the crest (steady waves, and linear ones up to their amplitude); stretched: the
/// column is stretched to the surface, because the short waves of a sea grow without bound above
/// still water (Wheeler 1970).
enum class Column { as_they_are, stretched };

class FourierWave final : public WaveMotion {
 public:
  /// `top`: highest place above still water at which velocities are asked for [m]; 0 if stretched.
  FourierWave(std::vector<WaveComponent> components, double depth, double top, Column column,
              double length, double celerity);

  double elevation(const WavePlace& place, double time) const override;
  void velocities(const WavePlace& place, double time, std::span<const double> heights,
                  std::span<WaveVelocity> out) const override;
  double carried(const WavePlace& place, double time) const override;
  /// Transfer function of Biesel (1951): stroke over height = (sinh 2kd + 2kd)/(2 (cosh 2kd - 1)).
  double piston(double time) const override;

 private:
  /// Heights at which the depth functions of all components are known; they lie closer towards the
  /// surface, where short waves vary most. Between them cubic interpolation.
  static constexpr int nodes = 49;

  double phase(const WaveComponent& c, const WavePlace& place, double time) const {
    return c.wave_number * (c.way[0] * place.along + c.way[1] * place.across) - c.frequency * time +
           c.phase;
  }

  std::vector<WaveComponent> components_;
  double depth_, top_;
  Column column_;
  std::vector<std::array<double, nodes>> along_, up_;  ///< speed times depth function [m/s]
};

}  // namespace mudlark

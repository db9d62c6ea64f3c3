#pragma once
/// Steady periodic waves of finite height by the stream function.
#include <array>
#include <vector>

namespace mudlark {

/// The Fourier approximation of Fenton (1988), Computers & Geosciences 14, 357-368: in the frame
/// that moves with the wave the stream function is
///   psi = -c (d + z) + sqrt(g/k^3) sum_j B_j sinh(j k (d + z)) / cosh(j k d) cos(j k x);
/// it is constant on the surface, where Bernoulli's sum is constant too. No mean current at a fixed
/// point. Lengths [m], times [s].
class SteadyWave {
 public:
  /// Throws InputError when the wave cannot be computed (higher than waves get).
  SteadyWave(double height, double period, double depth, double gravity);

  double wave_number() const { return wave_number_; }  ///< [1/m]
  /// Above still water, at a phase kx - wt; crest at 0 [m].
  double elevation(double phase) const;
  /// Along the wave's way and upwards [m/s], at height z above still water.
  std::array<double, 2> velocity(double phase, double z) const;

 private:
  double depth_, gravity_, wave_number_ = 0.0;
  std::vector<double> harmonics_;  ///< cosine series of the elevation [m]
  std::vector<double> stream_;     ///< B_j [-]
};

}  // namespace mudlark

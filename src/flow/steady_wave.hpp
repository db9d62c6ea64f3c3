#pragma once
/// Steady periodic waves of finite height: harmonics of their elevation and velocity.
#include <vector>

#include "flow/wave_options.hpp"

namespace mudlark {

/// eta = sum_j elevation[j] cos(j phi), u = sum_j speed[j] cosh(jk(z+d))/cosh(jkd) cos(j phi), w
/// the same with sinh and sin, phi = k s - w t; j counts from 1 and the entries from 0.
struct SteadyWave {
  double wave_number = 0.0;       ///< [1/m]
  std::vector<double> elevation;  ///< [m]
  std::vector<double> speed;      ///< [m/s], beside the current
  double crest() const;           ///< above still water [m]
};

/// The Fourier approximation of Fenton (1988), Computers & Geosciences 14, 357-368: in the frame
/// that moves with the wave the stream function is
///   psi = -c (d + z) + sqrt(g/k^3) sum_j B_j sinh(j k (d + z)) / cosh(j k d) cos(j k x);
/// it is constant on the surface, where Bernoulli's sum is constant too. `current` is the mean one
/// at a fixed point, along the wave's way [m/s]; the period is over ground. Lengths [m], times [s].
/// Throws InputError when the wave cannot be computed (higher than waves get).
SteadyWave stream_function_wave(double height, double period, double depth, double gravity,
                                double current = 0.0, int modes = 18);

/// The same with as many modes as the crest of a wave much longer than the depth needs: the exact
/// wave that cnoidal theory approximates.
SteadyWave cnoidal_wave(double height, double period, double depth, double gravity,
                        double current = 0.0);

/// Fifth order in steepness: Fenton (1985), J. Waterw. Port Coast. Ocean Eng. 111, 216-234. For
/// waves that are not much longer than the depth; throws InputError where the series is of no use.
SteadyWave stokes_5_wave(double height, double period, double depth, double gravity,
                         double current = 0.0);

/// Airy (1845).
SteadyWave linear_wave(double height, double period, double depth, double gravity,
                       double current = 0.0);

}  // namespace mudlark

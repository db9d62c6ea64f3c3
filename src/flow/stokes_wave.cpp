#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "flow/steady_wave.hpp"
#include "flow/wave_theory.hpp"

namespace mudlark {
namespace {

/// Beyond this k d nothing changes to the last bit, and cosh(5 k d) would overflow in the end.
constexpr double deep = 30.0;

/// Coefficients of Fenton (1985), table 1, at one k d; S = sech(2 k d). a(i)(j) belong to the
/// potential without 1/sinh(kd) for odd i, b to the elevation, c to the mean speed.
struct Coefficients {
  double a11, a22, a31, a33, a42, a44, a51, a53, a55;
  double b22, b31, b42, b44, b53, b55;
  double c0, c2, c4;

  explicit Coefficients(double kd) {
    const double s = 1.0 / std::cosh(2.0 * kd), t = 1.0 - s, coth = 1.0 / std::tanh(kd),
                 sinh = std::sinh(kd);
    const double t2 = t * t, t3 = t2 * t, t4 = t3 * t, t5 = t4 * t, t6 = t5 * t;
    const double p = 3.0 + 2.0 * s, q = 4.0 + s;
    const auto sum = [s](std::initializer_list<double> series) {  // lowest power first
      double value = 0.0;
      for (auto c = series.end(); c != series.begin();) value = value * s + *--c;
      return value;
    };
    a11 = 1.0 / sinh;
    a22 = 3.0 * s * s / (2.0 * t2);
    a31 = sum({-4, -20, 10, -13}) / (8.0 * sinh * t3);
    a33 = sum({0, 0, -2, 11}) / (8.0 * sinh * t3);
    a42 = sum({0, 12, -14, -264, -45, -13}) / (24.0 * t5);
    a44 = sum({0, 0, 0, 10, -174, 291, 278}) / (48.0 * p * t5);
    a51 =
        sum({-1184, 32, 13232, 21712, 20940, 12554, 500, -3341, -670}) / (64.0 * sinh * p * q * t6);
    a53 = sum({0, 4, 105, 198, -1376, -1302, -117, 58}) / (32.0 * sinh * p * t6);
    a55 = sum({0, 0, 0, -6, 272, -1552, 852, 2029, 430}) / (64.0 * sinh * p * q * t6);
    b22 = coth * (1.0 + 2.0 * s) / (2.0 * t);
    b31 = -3.0 * sum({1, 3, 3, 2}) / (8.0 * t3);
    b42 = coth * sum({6, -26, -182, -204, -25, 26}) / (6.0 * p * t4);
    b44 = coth * sum({24, 92, 122, 66, 67, 34}) / (24.0 * p * t4);
    b53 = 9.0 * sum({132, 17, -2216, -5897, -6292, -2687, 194, 467, 82}) / (128.0 * p * q * t6);
    b55 = 5.0 * sum({300, 1579, 3176, 2949, 1188, 675, 1326, 827, 130}) / (384.0 * p * q * t6);
    c0 = std::sqrt(std::tanh(kd));
    c2 = c0 * sum({2, 0, 7}) / (4.0 * t2);
    c4 = c0 * sum({4, 32, -116, -400, -71, 146}) / (32.0 * t5);
  }
};

/// (speed of the wave through the water) sqrt(k/g).
double speed_of(double kd, double steepness) {
  const Coefficients c(std::min(kd, deep));
  const double e2 = steepness * steepness;
  return c.c0 + e2 * c.c2 + e2 * e2 * c.c4;
}

/// k from k (c + U) = w; secant method from the linear wave. NaN when there is none.
double wave_number_of(double height, double period, double depth, double gravity, double current) {
  const double w = 2.0 * std::numbers::pi / period;
  const auto misfit = [&](double k) {
    return std::sqrt(gravity * k) * speed_of(k * depth, 0.5 * k * height) + k * current - w;
  };
  double one = wave_number(period, depth, gravity, current), two = 0.98 * one;
  double at_one = misfit(one), at_two = misfit(two);
  for (int i = 0; i < 60 && std::abs(two - one) > 1e-14 * one && at_two != at_one; ++i) {
    const double next = two - at_two * (two - one) / (at_two - at_one);
    one = two, at_one = at_two;
    two = next, at_two = misfit(next);
  }
  return two > 0.0 && std::abs(at_two) < 1e-9 * w ? two : std::nan("");
}

}  // namespace

SteadyWave stokes_5_wave(double height, double period, double depth, double gravity,
                         double current) {
  const double k = wave_number_of(height, period, depth, gravity, current);
  const double kd = k * depth, e = 0.5 * k * height;
  // Ursell's number H L^2/d^3 above which the series loses to cnoidal theory (Hedges 1995).
  const double ursell = 4.0 * std::numbers::pi * std::numbers::pi * height / depth / (kd * kd);
  if (!(ursell <= 40.0))
    throw InputError(fmt::format(
        "Stokes' series does not hold for a wave of height {:g} m and period {:g} s on {:g} m: it "
        "is too long for its depth (H L^2/d^3 = {:.3g}, at most 40). Write theory = "
        "\"stream-function\" or \"cnoidal\".",
        height, period, depth, ursell));
  const double bounded = std::min(kd, deep);
  const Coefficients c(bounded);
  const double e2 = e * e, e3 = e2 * e, e4 = e3 * e, e5 = e4 * e;
  SteadyWave wave;
  wave.wave_number = k;
  wave.elevation = {e + e3 * c.b31 - e5 * (c.b53 + c.b55), e2 * c.b22 + e4 * c.b42,
                    -e3 * c.b31 + e5 * c.b53, e4 * c.b44, e5 * c.b55};
  for (double& harmonic : wave.elevation) harmonic /= k;
  const std::array<double, 5> potential{e * c.a11 + e3 * c.a31 + e5 * c.a51,
                                        e2 * c.a22 + e4 * c.a42, e3 * c.a33 + e5 * c.a53,
                                        e4 * c.a44, e5 * c.a55};
  for (std::size_t i = 0; i < potential.size(); ++i) {
    const double j = static_cast<double>(i + 1);
    wave.speed.push_back(c.c0 * std::sqrt(gravity / k) * j * potential[i] * std::cosh(j * bounded));
  }
  return wave;
}

}  // namespace mudlark

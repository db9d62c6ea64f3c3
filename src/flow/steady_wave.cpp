#include "flow/steady_wave.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "flow/wave_theory.hpp"

namespace mudlark {
namespace {

constexpr int modes = 18;
constexpr int unknowns = 2 * modes + 5;
using Vector = Eigen::Matrix<double, unknowns, 1>;
using Jacobian = Eigen::Matrix<double, unknowns, unknowns>;

/// Without dimensions by k and g: {k d, c, q, r, k eta_0 .. k eta_N (crest to trough), B_1 .. B_N}.
struct Problem {
  double height_by_depth, period_by_depth;  ///< H/d, T sqrt(g/d)

  Vector residual(const Vector& x) const {
    const double depth = x[0], speed = x[1];
    Vector r;
    double mean = 0.0;
    for (int m = 0; m <= modes; ++m) {
      const double eta = x[4 + m], phase = m * std::numbers::pi / modes;
      double stream = -speed * (depth + eta), along = -speed, up = 0.0;
      for (int j = 1; j <= modes; ++j) {
        const double b = x[4 + modes + j], scale = 1.0 / std::cosh(j * depth);
        const double cosine = std::cosh(j * (depth + eta)) * scale * b;
        const double sine = std::sinh(j * (depth + eta)) * scale * b;
        stream += sine * std::cos(j * phase);
        along += j * cosine * std::cos(j * phase);
        up += j * sine * std::sin(j * phase);
      }
      r[m] = stream + x[2];
      r[modes + 1 + m] = 0.5 * (along * along + up * up) + eta - x[3];
      mean += (m == 0 || m == modes ? 0.5 : 1.0) * eta;
    }
    r[2 * modes + 2] = mean / modes;
    r[2 * modes + 3] = x[4] - x[4 + modes] - depth * height_by_depth;
    r[2 * modes + 4] = speed * period_by_depth * std::sqrt(depth) - 2.0 * std::numbers::pi;
    return r;
  }

  /// Newton's method with a differenced Jacobian; false when it does not converge.
  bool solve(Vector& x) const {
    for (int i = 0; i < 40; ++i) {
      const Vector r = residual(x);
      if (!r.allFinite()) return false;
      if (r.norm() < 1e-12) return true;
      Jacobian jacobian;
      for (int column = 0; column < unknowns; ++column) {
        const double step = 1e-7 * std::max(1e-2, std::abs(x[column]));
        Vector ahead = x, behind = x;
        ahead[column] += step;
        behind[column] -= step;
        jacobian.col(column) = (residual(ahead) - residual(behind)) / (2.0 * step);
      }
      x -= jacobian.partialPivLu().solve(r);
    }
    return residual(x).norm() < 1e-9;
  }
};

}  // namespace

SteadyWave::SteadyWave(double height, double period, double depth, double gravity)
    : depth_(depth), gravity_(gravity) {
  constexpr int steps = 10;
  const double linear = mudlark::wave_number(period, depth, gravity) * depth;
  const double amplitude = 0.5 * height / depth * linear / steps;
  Vector x = Vector::Zero(), before = Vector::Zero();
  x[0] = linear;
  x[1] = std::sqrt(std::tanh(linear));
  x[2] = linear * x[1];
  x[3] = 0.5 * x[1] * x[1];
  for (int m = 0; m <= modes; ++m) x[4 + m] = amplitude * std::cos(m * std::numbers::pi / modes);
  x[5 + modes] = amplitude / x[1];
  for (int step = 1; step <= steps; ++step) {
    Vector guess = step <= 2 ? x : Vector(2.0 * x - before);
    before = x;
    const Problem problem{height / depth * step / steps, period * std::sqrt(gravity / depth)};
    if (!problem.solve(guess))
      throw InputError(fmt::format(
          "no steady wave of height {:g} m and period {:g} s was found on a depth of {:g} m: the "
          "highest has about {:.3g} m. Write a lower wave, or theory = \"linear\".",
          height, period, depth, height * (step - 1) / steps));
    x = guess;
  }
  wave_number_ = x[0] / depth;
  for (int j = 0; j <= modes; ++j) {
    double sum = 0.0;
    for (int m = 0; m <= modes; ++m)
      sum += (m == 0 || m == modes ? 0.5 : 1.0) * x[4 + m] *
             std::cos(j * m * std::numbers::pi / modes);
    harmonics_.push_back(sum * (j == 0 || j == modes ? 1.0 : 2.0) / modes / wave_number_);
  }
  for (int j = 1; j <= modes; ++j) stream_.push_back(x[4 + modes + j]);
}

double SteadyWave::elevation(double phase) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < harmonics_.size(); ++j)
    sum += harmonics_[j] * std::cos(static_cast<double>(j) * phase);
  return sum;
}

std::array<double, 2> SteadyWave::velocity(double phase, double z) const {
  const double scale = std::sqrt(gravity_ / wave_number_), kd = wave_number_ * depth_;
  std::array<double, 2> sum{};
  for (std::size_t i = 0; i < stream_.size(); ++i) {
    const double j = static_cast<double>(i + 1), up = j * wave_number_ * (depth_ + z);
    // cosh and sinh over cosh(j k d), without overflow
    const double grow = std::exp(up - j * kd), decay = std::exp(-up - j * kd);
    const double below = 1.0 / (1.0 + std::exp(-2.0 * j * kd));
    sum[0] += scale * j * stream_[i] * (grow + decay) * below * std::cos(j * phase);
    sum[1] += scale * j * stream_[i] * (grow - decay) * below * std::sin(j * phase);
  }
  return sum;
}

}  // namespace mudlark

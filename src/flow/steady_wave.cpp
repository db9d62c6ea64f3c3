#include "flow/steady_wave.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "flow/wave_theory.hpp"

namespace mudlark {
namespace {

constexpr double pi = std::numbers::pi;

/// Without dimensions by k and g; unknowns {k d, c, q, r, k eta_0 .. k eta_N (crest to trough), B_1
/// .. B_N}, c relative to the current.
struct Problem {
  double height_by_depth, period_by_depth, froude;  ///< H/d, T sqrt(g/d), U/sqrt(g d)
  int modes;

  int unknowns() const { return 2 * modes + 5; }

  /// The equations' misfit and its derivatives.
  void assemble(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd& jacobian) const {
    const double depth = x[0], speed = x[1];
    r.setZero();
    jacobian.setZero();
    for (int m = 0; m <= modes; ++m) add_surface_point(m, x, r, jacobian);
    const int mean = 2 * modes + 2, height = mean + 1, period = mean + 2;
    for (int m = 0; m <= modes; ++m) {
      const double weight = (m == 0 || m == modes ? 0.5 : 1.0) / modes;
      r[mean] += weight * x[4 + m];
      jacobian(mean, 4 + m) = weight;
    }
    r[height] = x[4] - x[4 + modes] - depth * height_by_depth;
    jacobian(height, 4) = 1.0;
    jacobian(height, 4 + modes) = -1.0;
    jacobian(height, 0) = -height_by_depth;
    const double root = std::sqrt(depth);
    r[period] = (speed + froude * root) * period_by_depth * root - 2.0 * pi;
    jacobian(period, 0) = period_by_depth * (0.5 * speed / root + froude);
    jacobian(period, 1) = period_by_depth * root;
  }

  /// Stream function and Bernoulli's sum at one point of the surface.
  void add_surface_point(int m, const Eigen::VectorXd& x, Eigen::VectorXd& r,
                         Eigen::MatrixXd& jacobian) const {
    const double depth = x[0], speed = x[1], eta = x[4 + m], phase = m * pi / modes;
    const int bernoulli = modes + 1 + m;
    double stream = -speed * (depth + eta), along = -speed, up = 0.0;
    double along_up = 0.0, up_up = 0.0;                               // by z
    double stream_depth = -speed, along_depth = 0.0, up_depth = 0.0;  // by k d at constant eta
    for (int j = 1; j <= modes; ++j) {
      const double b = x[4 + modes + j], jd = j * depth, jy = j * (depth + eta);
      const double below = 1.0 / (1.0 + std::exp(-2.0 * jd)), grow = std::exp(jy - jd) * below,
                   decay = std::exp(-jy - jd) * below;  // halves of cosh(jy) / cosh(jd)
      const double c = grow + decay, s = grow - decay, t = std::tanh(jd);
      const double cosine = std::cos(j * phase), sine = std::sin(j * phase);
      stream += b * s * cosine;
      along += j * b * c * cosine;
      up += j * b * s * sine;
      along_up += j * j * b * s * cosine;
      up_up += j * j * b * c * sine;
      stream_depth += j * b * (c - s * t) * cosine;
      along_depth += j * j * b * (s - c * t) * cosine;
      up_depth += j * j * b * (c - s * t) * sine;
      jacobian(m, 4 + modes + j) = s * cosine;
      jacobian(bernoulli, 4 + modes + j) = c * cosine * j;  // times `along`, below
    }
    for (int j = 1; j <= modes; ++j) {
      const double jy = j * (depth + eta), jd = j * depth;
      const double s = (std::exp(jy - jd) - std::exp(-jy - jd)) / (1.0 + std::exp(-2.0 * jd));
      double& by_b = jacobian(bernoulli, 4 + modes + j);
      by_b = along * by_b + up * j * s * std::sin(j * phase);
    }
    r[m] = stream + x[2];
    jacobian(m, 0) = stream_depth;
    jacobian(m, 1) = -(depth + eta);
    jacobian(m, 2) = 1.0;
    jacobian(m, 4 + m) = along;
    r[bernoulli] = 0.5 * (along * along + up * up) + eta - x[3];
    jacobian(bernoulli, 0) = along * along_depth + up * up_depth;
    jacobian(bernoulli, 1) = -along;
    jacobian(bernoulli, 3) = -1.0;
    jacobian(bernoulli, 4 + m) = along * along_up + up * up_up + 1.0;
  }

  /// Newton's method; false when it does not converge.
  bool solve(Eigen::VectorXd& x) const {
    Eigen::VectorXd r(unknowns());
    Eigen::MatrixXd jacobian(unknowns(), unknowns());
    for (int i = 0; i < 30; ++i) {
      assemble(x, r, jacobian);
      if (!r.allFinite()) return false;
      if (r.norm() < 1e-12) return true;
      x -= jacobian.partialPivLu().solve(r);
      if (!(x[0] > 0.0)) return false;
    }
    assemble(x, r, jacobian);
    return r.allFinite() && r.norm() < 1e-9;
  }
};

void require_steep_enough(double k, double height, double period, double depth) {
  if (!std::isnan(k)) return;
  throw InputError(
      fmt::format("a wave of height {:g} m and period {:g} s on a depth of {:g} m cannot run "
                  "against this current. Write a weaker current or a longer period.",
                  height, period, depth));
}

/// A sine of this height.
Eigen::VectorXd first_guess(const Problem& problem, double kd, double height_by_depth) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.unknowns());
  const double amplitude = 0.5 * height_by_depth * kd;
  x[0] = kd;
  x[1] = std::sqrt(std::tanh(kd));
  x[2] = kd * x[1];
  x[3] = 0.5 * x[1] * x[1];
  for (int m = 0; m <= problem.modes; ++m) x[4 + m] = amplitude * std::cos(m * pi / problem.modes);
  x[5 + problem.modes] = amplitude / x[1];
  return x;
}

}  // namespace

double SteadyWave::crest() const {
  double sum = 0.0;
  for (const double harmonic : elevation) sum += harmonic;
  return sum;
}

SteadyWave stream_function_wave(double height, double period, double depth, double gravity,
                                double current, int modes) {
  const double linear = wave_number(period, depth, gravity, current) * depth;
  require_steep_enough(linear, height, period, depth);
  Problem problem{0.0, period * std::sqrt(gravity / depth), current / std::sqrt(gravity * depth),
                  modes};
  // The height grows in steps, the first one so small that even a long wave is near a sine.
  const double ursell = height / depth * std::pow(2.0 * pi / linear, 2.0);
  double share = 0.0, step = std::min(0.1, 4.0 / ursell), last_step = 0.0;
  Eigen::VectorXd x = first_guess(problem, linear, step * height / depth), before = x;
  while (share < 1.0) {
    const double next = std::min(1.0, share + step);
    Eigen::VectorXd guess = x;
    if (last_step > 0.0) guess += (next - share) / last_step * (x - before);
    problem.height_by_depth = next * height / depth;
    // The highest waves are a third longer than sines; what is far longer is no wave of this
    // period.
    if (!problem.solve(guess) || guess[0] < 0.5 * linear) {
      step *= 0.5;
      if (step > 2e-3) continue;
      throw InputError(fmt::format(
          "no steady wave of height {:g} m and period {:g} s was found on a depth of {:g} m: the "
          "highest has about {:.3g} m. Write a lower wave.",
          height, period, depth, height * share));
    }
    before = share > 0.0 ? x : before;
    last_step = share > 0.0 ? next - share : 0.0;
    x = guess;
    step = std::max(step, 1.5 * (next - share));
    share = next;
    step = std::min(step, 0.2);
  }
  SteadyWave wave;
  wave.wave_number = x[0] / depth;
  const double scale = std::sqrt(gravity / wave.wave_number);
  for (int j = 1; j <= modes; ++j) {
    double sum = 0.0;
    for (int m = 0; m <= modes; ++m)
      sum += (m == 0 || m == modes ? 0.5 : 1.0) * x[4 + m] * std::cos(j * m * pi / modes);
    wave.elevation.push_back(sum * (j == modes ? 1.0 : 2.0) / modes / wave.wave_number);
    wave.speed.push_back(scale * j * x[4 + modes + j]);
  }
  return wave;
}

SteadyWave cnoidal_wave(double height, double period, double depth, double gravity,
                        double current) {
  // The harmonics of a crest sech^2(a s), a d = sqrt(3 H / 4 d), fall as exp(-pi j k / 2 a).
  const double k = wave_number(period, depth, gravity, current);
  require_steep_enough(k, height, period, depth);
  const double crest = std::sqrt(0.75 * height / depth) / depth;
  const int modes = static_cast<int>(std::clamp(std::ceil(14.0 * crest / k), 18.0, 90.0));
  return stream_function_wave(height, period, depth, gravity, current, modes);
}

SteadyWave linear_wave(double height, double period, double depth, double gravity, double current) {
  const double k = wave_number(period, depth, gravity, current);
  require_steep_enough(k, height, period, depth);
  const double frequency = 2.0 * pi / period - k * current;  // as the water sees it
  return {k, {0.5 * height}, {0.5 * height * frequency / std::tanh(k * depth)}};
}

}  // namespace mudlark

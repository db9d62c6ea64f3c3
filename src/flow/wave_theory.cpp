#include "flow/wave_theory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "base/errors.hpp"
#include "flow/steady_wave.hpp"

namespace mudlark {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// cosh(k (z + d)) / sinh(k d) and sinh(..) / sinh(k d) without overflow; z at most the surface.
std::array<double, 2> depth_functions(double k, double z, double depth) {
  const double up = std::exp(k * z), down = std::exp(-k * (z + 2.0 * depth));
  const double scale = 1.0 / (1.0 - std::exp(-2.0 * k * depth));
  return {scale * (up + down), scale * (up - down)};
}

WaveMotion still_water() {
  WaveMotion motion;
  motion.elevation = [](double, double) { return 0.0; };
  motion.velocity = [](double, double, double) { return std::array<double, 2>{0.0, 0.0}; };
  return motion;
}

WaveMotion linear_wave(const RegularWave& wave, double depth, double gravity) {
  const double k = wave_number(wave.period, depth, gravity), w = two_pi / wave.period;
  const double amplitude = 0.5 * wave.height;
  WaveMotion motion;
  motion.length = two_pi / k;
  motion.celerity = w / k;
  motion.elevation = [=](double s, double t) { return amplitude * std::cos(k * s - w * t); };
  motion.velocity = [=](double s, double z, double t) {
    const auto [c, h] = depth_functions(k, std::min(z, amplitude), depth);
    const double phase = k * s - w * t;
    return std::array<double, 2>{amplitude * w * c * std::cos(phase),
                                 amplitude * w * h * std::sin(phase)};
  };
  return motion;
}

WaveMotion nonlinear_wave(const RegularWave& wave, double depth, double gravity) {
  const auto steady = std::make_shared<SteadyWave>(wave.height, wave.period, depth, gravity);
  const double k = steady->wave_number(), w = two_pi / wave.period;
  WaveMotion motion;
  motion.length = two_pi / k;
  motion.celerity = w / k;
  motion.elevation = [=](double s, double t) { return steady->elevation(k * s - w * t); };
  motion.velocity = [=](double s, double z, double t) {
    return steady->velocity(k * s - w * t, std::min(z, wave.height));
  };
  return motion;
}

/// Grimshaw (1971), J. Fluid Mech. 46, eqs. for elevation and speed to third order in H/d;
/// velocities from the mean one, c eta/(d + eta), which is exact for a wave that keeps its form,
/// and its curvature (Serre 1953).
WaveMotion solitary_wave(const SolitaryWave& wave, double depth, double gravity) {
  const double a = wave.height / depth, d = depth;
  const double decay = std::sqrt(0.75 * a) * (1.0 - 0.625 * a + 71.0 / 128.0 * a * a) / d;
  const double froude2 = 1.0 + a - a * a / 20.0 - 3.0 / 70.0 * a * a * a;
  const double speed = std::sqrt(gravity * d * froude2);
  const auto profile = [=](double x) {
    const double s = 1.0 / std::cosh(std::min(std::abs(decay * x), 300.0)),
                 t = std::tanh(decay * x);
    const double s2 = s * s, t2 = t * t;
    return d * (a * s2 - 0.75 * a * a * s2 * t2 +
                a * a * a * (0.625 * s2 * t2 - 101.0 / 80.0 * s2 * s2 * t2));
  };
  WaveMotion motion;
  motion.length = two_pi / decay;
  motion.celerity = speed;
  const double crest = wave.crest;
  motion.elevation = [=](double s, double t) { return profile(s - crest - speed * t); };
  motion.velocity = [=](double s, double z, double t) {
    const double x = s - crest - speed * t, step = 1e-3 * d;
    const auto mean = [&](double at) { return speed * profile(at) / (d + profile(at)); };
    const double here = mean(x), before = mean(x - step), after = mean(x + step);
    const double slope = (after - before) / (2.0 * step);
    const double curvature = (after - 2.0 * here + before) / (step * step);
    const double up = z + d, depth_now = d + profile(x);
    return std::array<double, 2>{here - (0.5 * up * up - depth_now * depth_now / 6.0) * curvature,
                                 -up * slope};
  };
  return motion;
}

struct Component {
  double amplitude, frequency, wave_number, phase;
};

/// JONSWAP (Hasselmann et al. 1973) between half and four times the peak frequency, scaled to H_m0;
/// frequencies at random in equal bands, so that the record does not repeat.
std::vector<Component> components_of(const IrregularSea& sea, double depth, double gravity) {
  std::mt19937_64 generator(sea.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double peak = 1.0 / sea.peak_period, lowest = 0.5 * peak, highest = 4.0 * peak;
  const double band = (highest - lowest) / sea.components;
  std::vector<Component> all;
  double energy = 0.0;
  for (int i = 0; i < sea.components; ++i) {
    const double f = lowest + (i + uniform(generator)) * band, ratio = peak / f;
    const double width = f <= peak ? 0.07 : 0.09;
    const double off = (f / peak - 1.0) / width;
    const double density = std::pow(ratio, 5.0) * std::exp(-1.25 * std::pow(ratio, 4.0)) *
                           std::pow(sea.peak_enhancement, std::exp(-0.5 * off * off));
    all.push_back({std::sqrt(2.0 * density * band), two_pi * f,
                   wave_number(1.0 / f, depth, gravity), two_pi * uniform(generator)});
    energy += density * band;
  }
  const double scale = sea.significant_height / (4.0 * std::sqrt(energy));
  for (Component& component : all) component.amplitude *= scale;
  return all;
}

/// Linear superposition; below a crest the velocities are those of the stretched column (Wheeler
/// 1970).
WaveMotion irregular_sea(const IrregularSea& sea, double depth, double gravity) {
  const auto all = std::make_shared<std::vector<Component>>(components_of(sea, depth, gravity));
  WaveMotion motion;
  motion.length = two_pi / wave_number(sea.peak_period, depth, gravity);
  motion.celerity = motion.length / sea.peak_period;
  motion.elevation = [all](double s, double t) {
    double sum = 0.0;
    for (const Component& c : *all)
      sum += c.amplitude * std::cos(c.wave_number * s - c.frequency * t + c.phase);
    return sum;
  };
  motion.velocity = [all, depth, elevation = motion.elevation](double s, double z, double t) {
    const double level = elevation(s, t);
    const double stretched = std::min(0.0, depth * (z + depth) / (depth + level) - depth);
    std::array<double, 2> sum{};
    for (const Component& c : *all) {
      const auto [along, up] = depth_functions(c.wave_number, stretched, depth);
      const double phase = c.wave_number * s - c.frequency * t + c.phase;
      sum[0] += c.amplitude * c.frequency * along * std::cos(phase);
      sum[1] += c.amplitude * c.frequency * up * std::sin(phase);
    }
    return sum;
  };
  return motion;
}

/// A long wave: what is given at the origin arrives at s after s / sqrt(g d).
WaveMotion given_wave(const GivenWave& wave, double depth, double gravity) {
  const double celerity = std::sqrt(gravity * depth);
  WaveMotion motion;
  motion.celerity = celerity;
  const auto late = [celerity](double s, double t) { return std::max(0.0, t - s / celerity); };
  motion.elevation = [=](double s, double t) { return wave.level({}, late(s, t)); };
  motion.velocity = [=](double s, double z, double t) {
    const auto level = [&](double at) { return wave.level({}, late(at, t)); };
    const auto along = [&](double at) {
      if (wave.has_velocity) return wave.velocity({}, late(at, t));
      return celerity * level(at) / (depth + level(at));
    };
    const double step = 0.01 * depth;
    const double slope = (along(s + step) - along(s - step)) / (2.0 * step);
    return std::array<double, 2>{along(s), -(z + depth) * slope};
  };
  return motion;
}

struct Maker {
  double depth, gravity;
  WaveMotion operator()(const StillWater&) const { return still_water(); }
  WaveMotion operator()(const RegularWave& wave) const {
    return wave.stream_function ? nonlinear_wave(wave, depth, gravity)
                                : linear_wave(wave, depth, gravity);
  }
  WaveMotion operator()(const SolitaryWave& wave) const {
    return solitary_wave(wave, depth, gravity);
  }
  WaveMotion operator()(const IrregularSea& sea) const {
    return irregular_sea(sea, depth, gravity);
  }
  WaveMotion operator()(const GivenWave& wave) const { return given_wave(wave, depth, gravity); }
};

}  // namespace

double wave_number(double period, double depth, double gravity) {
  const double w = two_pi / period, deep = w * w / gravity;
  double k = deep / std::sqrt(std::tanh(std::max(deep * depth, 1e-12)));
  for (int i = 0; i < 50; ++i) {
    const double t = std::tanh(k * depth);
    const double change = (gravity * k * t - w * w) / (gravity * (t + k * depth * (1.0 - t * t)));
    k -= change;
    if (std::abs(change) < 1e-15 * k) break;
  }
  return k;
}

WaveMotion make_wave(const WaveKind& kind, double depth, double gravity) {
  return std::visit(Maker{depth, gravity}, kind);
}

}  // namespace mudlark

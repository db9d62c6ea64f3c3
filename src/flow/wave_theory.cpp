#include "flow/wave_theory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flow/sea_components.hpp"
#include "flow/steady_wave.hpp"

namespace mudlark {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

using Way = std::array<double, 2>;

Way way_of(const WaveSetting& setting) {
  return {std::cos(setting.direction), std::sin(setting.direction)};
}

std::unique_ptr<const WaveMotion> regular_wave(const RegularWave& wave,
                                               const WaveSetting& setting) {
  const Way way = way_of(setting);
  const auto compute = [&](auto theory) {
    return theory(wave.height, wave.period, setting.depth, setting.gravity,
                  setting.current * way[0]);
  };
  const auto stream_function = [](double height, double period, double depth, double gravity,
                                  double current) {
    return stream_function_wave(height, period, depth, gravity, current);
  };
  const SteadyWave steady = wave.theory == RegularTheory::linear     ? compute(linear_wave)
                            : wave.theory == RegularTheory::stokes_5 ? compute(stokes_5_wave)
                            : wave.theory == RegularTheory::cnoidal  ? compute(cnoidal_wave)
                                                                     : compute(stream_function);
  std::vector<WaveComponent> harmonics;
  for (std::size_t i = 0; i < steady.elevation.size(); ++i) {
    const double j = static_cast<double>(i + 1);
    harmonics.push_back({steady.elevation[i], steady.speed[i], j * steady.wave_number,
                         j * two_pi / wave.period, 0.0, way});
  }
  const double length = two_pi / steady.wave_number;
  return std::make_unique<FourierWave>(std::move(harmonics), setting.depth, steady.crest(),
                                       Column::as_they_are, length, length / wave.period);
}

std::unique_ptr<const WaveMotion> sea(std::vector<WaveComponent> components, double peak_period,
                                      const WaveSetting& setting) {
  double k = wave_number(peak_period, setting.depth, setting.gravity,
                         setting.current * std::cos(setting.direction));
  if (std::isnan(k)) k = wave_number(peak_period, setting.depth, setting.gravity);
  const double length = two_pi / k;
  return std::make_unique<FourierWave>(std::move(components), setting.depth, 0.0, Column::stretched,
                                       length, length / peak_period);
}

/// Grimshaw (1971), J. Fluid Mech. 46, 611-622: elevation, speed and velocities to third order in
/// H/d. A uniform current carries it along.
class Solitary final : public WaveMotion {
 public:
  Solitary(const SolitaryWave& wave, const WaveSetting& setting)
      : depth_(setting.depth),
        share_(wave.height / setting.depth),
        speed_(std::sqrt(setting.gravity * setting.depth)),
        crest_(wave.crest),
        way_(way_of(setting)) {
    const double a = share_;
    decay_ = std::sqrt(0.75 * a) * (1.0 - 0.625 * a + 71.0 / 128.0 * a * a) / depth_;
    celerity_ = speed_ * std::sqrt(1.0 + a - a * a / 20.0 - 3.0 / 70.0 * a * a * a) +
                setting.current * way_[0];
    length_ = two_pi / decay_;
  }

  double elevation(const WavePlace& place, double time) const override {
    const double a = share_, x = phase(place, time), s2 = sech2(x), t2 = 1.0 - s2;
    return depth_ * (a * s2 - 0.75 * a * a * s2 * t2 +
                     a * a * a * (0.625 * s2 * t2 - 101.0 / 80.0 * s2 * s2 * t2));
  }

  void velocities(const WavePlace& place, double time, std::span<const double> heights,
                  std::span<WaveVelocity> out) const override {
    const double a = share_, a2 = a * a, a3 = a2 * a;
    const double x = phase(place, time), s2 = sech2(x), s4 = s2 * s2, s6 = s4 * s2;
    const double tangent = std::tanh(std::clamp(x, -300.0, 300.0));
    for (std::size_t n = 0; n < heights.size(); ++n) {
      const double y = heights[n] / depth_ + 1.0, y2 = y * y, y4 = y2 * y2;
      const double along =
          a * s2 - a2 * (-0.25 * s2 + s4 + y2 * (1.5 * s2 - 2.25 * s4)) -
          a3 * (19.0 / 40.0 * s2 + 0.2 * s4 - 1.2 * s6 + y2 * (-1.5 * s2 - 3.75 * s4 + 7.5 * s6) +
                y4 * (-0.375 * s2 + 45.0 / 16.0 * (s4 - s6)));
      const double up = a * s2 - a2 * (0.375 * s2 + 2.0 * s4 + y2 * (0.5 * s2 - 1.5 * s4)) -
                        a3 * (49.0 / 640.0 * s2 - 0.85 * s4 - 3.6 * s6 +
                              y2 * (-13.0 / 16.0 * s2 - 25.0 / 16.0 * s4 + 7.5 * s6) +
                              y4 * (-3.0 / 40.0 * s2 + 1.125 * s4 - 27.0 / 16.0 * s6));
      out[n] = {speed_ * along * way_[0], speed_ * along * way_[1],
                speed_ * std::sqrt(3.0 * a) * y * tangent * up};
    }
  }

  /// Goring (1978), Caltech report KH-R-38: the board moves with the mean velocity of the wave of
  /// first order, X' = c eta/(d + eta) at X, which gives X = H/(K d) tanh K(c t + crest - X).
  double piston(double time) const override {
    const double k = std::sqrt(0.75 * share_) / depth_, c = speed_ * std::sqrt(1.0 + share_);
    const double longest = share_ / k;
    double x = 0.0;
    for (int pass = 0; pass < 100; ++pass) {  // Newton's method on X - H/(K d) tanh(...)
      const double tangent = std::tanh(k * (c * time + crest_ - x));
      const double miss = x - longest * tangent;
      x -= miss / (1.0 + share_ * (1.0 - tangent * tangent));
      if (std::abs(miss) < 1e-14 * longest) break;
    }
    return x;
  }

 private:
  double phase(const WavePlace& place, double time) const {
    return decay_ * (way_[0] * place.along + way_[1] * place.across - crest_ - celerity_ * time);
  }
  static double sech2(double x) {
    const double s = 1.0 / std::cosh(std::min(std::abs(x), 300.0));
    return s * s;
  }

  double depth_, share_, speed_, crest_, decay_ = 0.0;  // share: H/d; speed: sqrt(g d)
  Way way_;
};

/// A long wave: what is given at the origin arrives at s after s / sqrt(g d).
class Given final : public WaveMotion {
 public:
  Given(const GivenWave& wave, const WaveSetting& setting)
      : wave_(wave), depth_(setting.depth), way_(way_of(setting)) {
    celerity_ = std::sqrt(setting.gravity * setting.depth);
  }

  double elevation(const WavePlace& place, double time) const override {
    return level(way_[0] * place.along + way_[1] * place.across, time);
  }
  void velocities(const WavePlace& place, double time, std::span<const double> heights,
                  std::span<WaveVelocity> out) const override {
    const double s = way_[0] * place.along + way_[1] * place.across, step = 0.01 * depth_;
    const double here = along(s, time);
    const double slope = (along(s + step, time) - along(s - step, time)) / (2.0 * step);
    for (std::size_t n = 0; n < heights.size(); ++n)
      out[n] = {here * way_[0], here * way_[1], -(heights[n] + depth_) * slope};
  }

 private:
  double late(double s, double time) const { return std::max(0.0, time - s / celerity_); }
  double level(double s, double time) const { return wave_.level({}, late(s, time)); }
  double along(double s, double time) const {
    if (wave_.has_velocity) return wave_.velocity({}, late(s, time));
    return celerity_ * level(s, time) / (depth_ + level(s, time));
  }

  GivenWave wave_;
  double depth_;
  Way way_;
};

struct Maker {
  const WaveSetting& setting;
  std::unique_ptr<const WaveMotion> operator()(const StillWater&) const {
    return std::make_unique<FourierWave>(std::vector<WaveComponent>{}, setting.depth, 0.0,
                                         Column::as_they_are, 0.0, 0.0);
  }
  std::unique_ptr<const WaveMotion> operator()(const RegularWave& wave) const {
    return regular_wave(wave, setting);
  }
  std::unique_ptr<const WaveMotion> operator()(const SolitaryWave& wave) const {
    return std::make_unique<Solitary>(wave, setting);
  }
  std::unique_ptr<const WaveMotion> operator()(const IrregularSea& wave) const {
    return sea(random_sea(wave, setting), peak_period(wave.sea.spectrum), setting);
  }
  std::unique_ptr<const WaveMotion> operator()(const FocusedWave& wave) const {
    return sea(focused_sea(wave, setting), peak_period(wave.sea.spectrum), setting);
  }
  std::unique_ptr<const WaveMotion> operator()(const GivenWave& wave) const {
    return std::make_unique<Given>(wave, setting);
  }
};

}  // namespace

double wave_number(double period, double depth, double gravity, double current) {
  const double w = two_pi / period, deep = w * w / gravity;
  double k = deep / std::sqrt(std::tanh(std::max(deep * depth, 1e-12)));
  // Newton's method on sqrt(g k tanh(k d)) + k U - w, which is concave in k: from the wave without
  // current on, it comes from below (after one step, if U > 0) and never passes the shortest root.
  for (int i = 0; i < 100; ++i) {
    const double t = std::tanh(k * depth), own = std::sqrt(gravity * k * t);
    const double slope = 0.5 * gravity * (t + k * depth * (1.0 - t * t)) / own + current;
    if (!(slope > 0.0)) return std::nan("");
    const double change = (own + k * current - w) / slope;
    if (change >= k) {
      k *= 0.5;
      continue;
    }
    k -= change;
    if (std::abs(change) < 1e-15 * k) return k;
  }
  return std::abs(std::sqrt(gravity * k * std::tanh(k * depth)) + k * current - w) < 1e-9 * w
             ? k
             : std::nan("");
}

std::unique_ptr<const WaveMotion> make_wave(const WaveKind& kind, const WaveSetting& setting) {
  return std::visit(Maker{setting}, kind);
}

}  // namespace mudlark

#include "flow/sea_components.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/errors.hpp"

namespace mudlark {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
/// Directions that are this close to the zone's end are left out: such waves hardly come in [rad].
constexpr double widest = 85.0 / 180.0 * std::numbers::pi;

double jonswap(double frequency, double peak, double enhancement) {
  const double ratio = peak / frequency, width = frequency <= peak ? 0.07 : 0.09;
  const double off = (frequency / peak - 1.0) / width;
  return std::pow(ratio, 5.0) * std::exp(-1.25 * std::pow(ratio, 4.0)) *
         std::pow(enhancement, std::exp(-0.5 * off * off));
}

/// tanh^2(kd) / (1 + 2kd/sinh(2kd)): what finite depth leaves of a deep-water spectrum.
double depth_function(double frequency, double depth, double gravity) {
  const double kd = wave_number(1.0 / frequency, depth, gravity) * depth, t = std::tanh(kd);
  return t * t / (1.0 + (kd < 300.0 ? 2.0 * kd / std::sinh(2.0 * kd) : 0.0));
}

double density_in_table(const std::vector<std::array<double, 2>>& table, double frequency) {
  const auto after = std::lower_bound(
      table.begin(), table.end(), frequency,
      [](const std::array<double, 2>& row, double value) { return row[0] < value; });
  if (after == table.end()) return 0.0;
  if (after == table.begin()) return (*after)[0] == frequency ? (*after)[1] : 0.0;
  const auto& [f1, s1] = *(after - 1);
  const auto& [f2, s2] = *after;
  return s1 + (s2 - s1) * (frequency - f1) / (f2 - f1);
}

/// Lowest and highest frequency [Hz].
std::array<double, 2> range_of(const Spectrum& spectrum) {
  if (spectrum.form == SpectrumForm::given)
    return {std::max(spectrum.table.front()[0], 1e-3 * spectrum.table.back()[0]),
            spectrum.table.back()[0]};
  return {0.5 / spectrum.peak_period, 4.0 / spectrum.peak_period};
}

/// Draws directions from cos^2s((theta - mean)/2) (Mitsuyasu et al. 1975).
class Spreading {
 public:
  Spreading(const SeaComponents& sea, double mean) : mean_(mean) {
    if (!sea.spreading) return;
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
      const double theta = angle(i);
      if (i > 0)
        sum += std::pow(std::max(0.0, std::cos(0.5 * (theta - mean))), 2.0 * *sea.spreading);
      below_.push_back(sum);
    }
  }
  template <class Generator>
  double draw(Generator& generator) const {
    if (below_.empty()) return mean_;
    std::uniform_real_distribution<double> uniform(0.0, below_.back());
    const double share = uniform(generator);
    const auto after = std::upper_bound(below_.begin(), below_.end(), share);
    const auto i = std::clamp<std::ptrdiff_t>(after - below_.begin(), 1, steps);
    const double rest =
        below_[static_cast<std::size_t>(i)] - below_[static_cast<std::size_t>(i - 1)];
    const double part = rest > 0.0 ? (share - below_[static_cast<std::size_t>(i - 1)]) / rest : 0.5;
    return angle(static_cast<int>(i - 1)) + part * (angle(1) - angle(0));
  }

 private:
  static constexpr int steps = 720;
  static double angle(int i) { return widest * (2.0 * i / steps - 1.0); }
  double mean_;
  std::vector<double> below_;  ///< cumulative
};

/// A linear wave of amplitude 1; the phase is not set yet. Amplitude 0 where the current holds it
/// back.
WaveComponent unit_wave(double frequency, double direction, const WaveSetting& setting) {
  const double along = setting.current * std::cos(direction);
  const double k = wave_number(1.0 / frequency, setting.depth, setting.gravity, along);
  WaveComponent wave;
  if (std::isnan(k)) return wave;
  wave.elevation = 1.0;
  wave.frequency = two_pi * frequency;
  wave.wave_number = k;
  wave.speed = (wave.frequency - k * along) / std::tanh(k * setting.depth);
  wave.way = {std::cos(direction), std::sin(direction)};
  return wave;
}

void scale(WaveComponent& wave, double factor) {
  wave.elevation *= factor;
  wave.speed *= factor;
}

}  // namespace

double spectral_density(const Spectrum& spectrum, double frequency, const WaveSetting& setting) {
  const double peak = 1.0 / spectrum.peak_period;
  switch (spectrum.form) {
    case SpectrumForm::jonswap:
      return jonswap(frequency, peak, spectrum.peak_enhancement);
    case SpectrumForm::pierson_moskowitz:
      return jonswap(frequency, peak, 1.0);
    case SpectrumForm::tma:
      return jonswap(frequency, peak, spectrum.peak_enhancement) *
             depth_function(frequency, setting.depth, setting.gravity);
    case SpectrumForm::given:
      return density_in_table(spectrum.table, frequency);
  }
  return 0.0;
}

double peak_period(const Spectrum& spectrum) {
  if (spectrum.form != SpectrumForm::given) return spectrum.peak_period;
  const auto highest =
      std::max_element(spectrum.table.begin(), spectrum.table.end(),
                       [](const auto& one, const auto& other) { return one[1] < other[1]; });
  return 1.0 / std::max((*highest)[0], range_of(spectrum)[0]);
}

double significant_height(const Spectrum& spectrum) {
  double area = 0.0;
  for (std::size_t i = 1; i < spectrum.table.size(); ++i)
    area += 0.5 * (spectrum.table[i][1] + spectrum.table[i - 1][1]) *
            (spectrum.table[i][0] - spectrum.table[i - 1][0]);
  return 4.0 * std::sqrt(area);
}

std::vector<WaveComponent> random_sea(const IrregularSea& wave, const WaveSetting& setting) {
  const SeaComponents& sea = wave.sea;
  std::mt19937_64 generator(sea.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto [lowest, highest] = range_of(sea.spectrum);
  const double band = (highest - lowest) / sea.count;
  const Spreading spreading(sea, setting.direction);
  std::vector<WaveComponent> all;
  double energy = 0.0;
  for (int i = 0; i < sea.count; ++i) {
    const double f = lowest + (i + uniform(generator)) * band;
    const double density = spectral_density(sea.spectrum, f, setting);
    const double phase = two_pi * uniform(generator);
    WaveComponent one = unit_wave(f, spreading.draw(generator), setting);
    one.phase = phase;
    energy += density * band * one.elevation;
    scale(one, std::sqrt(2.0 * density * band));
    all.push_back(one);
  }
  if (!(energy > 0.0)) throw InputError("no wave of this spectrum runs against the current");
  for (WaveComponent& one : all) scale(one, wave.significant_height / (4.0 * std::sqrt(energy)));
  return all;
}

std::vector<WaveComponent> focused_sea(const FocusedWave& wave, const WaveSetting& setting) {
  const SeaComponents& sea = wave.sea;
  std::mt19937_64 generator(sea.seed);
  const auto [lowest, highest] = range_of(sea.spectrum);
  const Spreading spreading(sea, setting.direction);
  std::vector<WaveComponent> all;
  double sum = 0.0;
  for (int i = 0; i < sea.count; ++i) {
    const double f = lowest + (i + 0.5) * (highest - lowest) / sea.count;
    WaveComponent one = unit_wave(f, spreading.draw(generator), setting);
    const double along = one.way[0] * wave.focus[0] + one.way[1] * wave.focus[1];
    one.phase = one.frequency * wave.time - one.wave_number * along;
    scale(one, spectral_density(sea.spectrum, f, setting));
    sum += one.elevation;
    all.push_back(one);
  }
  if (!(sum > 0.0)) throw InputError("no wave of this spectrum runs against the current");
  for (WaveComponent& one : all) scale(one, wave.crest_height / sum);
  return all;
}

}  // namespace mudlark

#include "flow/fourier_wave.hpp"

#include <algorithm>
#include <cmath>

namespace mudlark {
namespace {

/// cosh(k(z+d))/cosh(kd) and sinh(k(z+d))/cosh(kd) without overflow.
std::array<double, 2> depth_functions(double k, double z, double depth) {
  const double up = std::exp(k * z), down = std::exp(-k * (z + 2.0 * depth));
  const double scale = 1.0 / (1.0 + std::exp(-2.0 * k * depth));
  return {scale * (up + down), scale * (up - down)};
}

}  // namespace

FourierWave::FourierWave(std::vector<WaveComponent> components, double depth, double top,
                         Column column, double length, double celerity)
    : components_(std::move(components)), depth_(depth), top_(top), column_(column) {
  length_ = length;
  celerity_ = celerity;
  along_.resize(components_.size());
  up_.resize(components_.size());
  for (std::size_t i = 0; i < components_.size(); ++i)
    for (std::size_t m = 0; m < nodes; ++m) {
      const double down = static_cast<double>(m) / (nodes - 1);
      const double z = top_ - (depth_ + top_) * down * down;
      const auto [cosine, sine] = depth_functions(components_[i].wave_number, z, depth_);
      along_[i][m] = components_[i].speed * cosine;
      up_[i][m] = components_[i].speed * sine;
    }
}

double FourierWave::elevation(const WavePlace& place, double time) const {
  double sum = 0.0;
  for (const WaveComponent& c : components_) sum += c.elevation * std::cos(phase(c, place, time));
  return sum;
}

double FourierWave::carried(const WavePlace& place, double time) const {
  double sum = 0.0;
  for (const WaveComponent& c : components_)
    sum += c.frequency / c.wave_number * c.way[0] * c.elevation * std::cos(phase(c, place, time));
  return sum;
}

double FourierWave::piston(double time) const {
  double sum = 0.0;
  for (const WaveComponent& c : components_) {
    const double kd = std::min(c.wave_number * depth_, 300.0);
    const double stroke = (std::sinh(2.0 * kd) + 2.0 * kd) / (2.0 * (std::cosh(2.0 * kd) - 1.0));
    sum -= stroke * c.elevation * std::sin(phase(c, {}, time));
  }
  return sum;
}

void FourierWave::velocities(const WavePlace& place, double time, std::span<const double> heights,
                             std::span<WaveVelocity> out) const {
  std::array<std::array<double, nodes>, 3> column{};
  double level = 0.0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const WaveComponent& c = components_[i];
    const double angle = phase(c, place, time);
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double along = cosine * c.way[0], across = cosine * c.way[1];
    level += c.elevation * cosine;
    for (std::size_t m = 0; m < nodes; ++m) {
      column[0][m] += along * along_[i][m];
      column[1][m] += across * along_[i][m];
      column[2][m] += sine * up_[i][m];
    }
  }
  for (std::size_t n = 0; n < heights.size(); ++n) {
    double z = heights[n];
    if (column_ == Column::stretched) z = depth_ * (z + depth_) / (depth_ + level) - depth_;
    const double down = std::clamp((top_ - z) / (depth_ + top_), 0.0, 1.0);
    const double at = std::sqrt(down) * (nodes - 1);
    const int first = std::clamp(static_cast<int>(at) - 1, 0, nodes - 4);
    const double r = at - first;  // cubic through the nodes 0, 1, 2, 3 beyond `first`
    const std::array<double, 4> weights{-(r - 1) * (r - 2) * (r - 3) / 6, r * (r - 2) * (r - 3) / 2,
                                        -r * (r - 1) * (r - 3) / 2, r * (r - 1) * (r - 2) / 6};
    for (std::size_t component = 0; component < 3; ++component) {
      double sum = 0.0;
      for (std::size_t m = 0; m < 4; ++m)
        sum += weights[m] * column[component][static_cast<std::size_t>(first) + m];
      out[n][component] = sum;
    }
  }
}

}  // namespace mudlark

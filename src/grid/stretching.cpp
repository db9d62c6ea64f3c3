#include "grid/stretching.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace mudlark {
namespace {

/// The wanted size between two ends, of which each may belong to a fine region. `share` of the
/// logarithm of the growth is used.
struct WantedSize {
  double from, to, coarse;
  std::optional<Refinement> before, after;
  double share = 1.0;

  double size(double x) const {
    double h = coarse;
    if (before) h = std::min(h, before->size + share * std::log(before->growth) * (x - from));
    if (after) h = std::min(h, after->size + share * std::log(after->growth) * (to - x));
    return h;
  }

  /// dx/di = h: positions after `count` cells of which each is an integral 1/count of the whole.
  /// Fourth-order Runge-Kutta with many steps per cell; the kinks of h cost what the steps are
  /// small against.
  double advance(double x, double cells) const {
    constexpr int steps = 16;
    const double d = cells / steps;
    for (int k = 0; k < steps; ++k) {
      const double a = size(x), b = size(x + 0.5 * d * a), c = size(x + 0.5 * d * b),
                   e = size(x + d * c);
      x += d * (a + 2.0 * b + 2.0 * c + e) / 6.0;
    }
    return x;
  }

  double cells() const {
    double x = from, count = 0.0;
    while (x < to) {
      const double next = advance(x, 1.0);
      count += next <= to ? 1.0 : (to - x) / (next - x);
      x = next;
    }
    return count;
  }
};

/// Faces after `from` up to `to`.
void add_graded(WantedSize wanted, std::vector<double>& faces) {
  const double whole = std::max(1.0, std::ceil(wanted.cells() - 1e-6));
  double low = 0.0, high = 1.0;  // the less it grows the more cells there are
  if (wanted.before || wanted.after)
    for (int k = 0; k < 45; ++k) {
      wanted.share = 0.5 * (low + high);
      (wanted.cells() > whole ? low : high) = wanted.share;
    }
  const double stride = wanted.cells() / whole;  // 1 but for what bisection cannot reach
  double x = wanted.from;
  for (int i = 1; i < static_cast<int>(whole); ++i) {
    x = wanted.advance(x, stride);
    faces.push_back(x);
  }
  faces.push_back(wanted.to);
}

void add_uniform(const Refinement& region, std::vector<double>& faces) {
  const double length = region.to - region.from;
  const int count = std::max(1, static_cast<int>(std::lround(length / region.size)));
  for (int i = 1; i < count; ++i) faces.push_back(region.from + length * i / count);
  faces.push_back(region.to);
}

}  // namespace

std::vector<double> graded_faces(double lower, double upper, double coarse,
                                 std::vector<Refinement> regions) {
  std::sort(regions.begin(), regions.end(),
            [](const Refinement& a, const Refinement& b) { return a.from < b.from; });
  std::vector<double> faces{lower};
  std::optional<Refinement> before;
  double place = lower;
  const double nothing = 1e-9 * (upper - lower);
  for (const Refinement& region : regions) {
    if (region.from - place > nothing)
      add_graded({place, region.from, coarse, before, region}, faces);
    add_uniform(region, faces);
    place = region.to;
    before = region;
  }
  if (upper - place > nothing) add_graded({place, upper, coarse, before, std::nullopt}, faces);
  faces.back() = upper;
  return faces;
}

}  // namespace mudlark

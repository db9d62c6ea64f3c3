#pragma once
/// B-spline shape functions on one axis, in units of the cell size.
#include <array>
#include <cmath>

namespace mudlark {

/// Weights of a B-spline of the given degree (1, 2, 3) and their derivatives [1/cell] at one place.
/// Node k of the axis sits at coordinate k; the first of the Degree + 1 nodes that matter is
/// `first`. Cubic and quadratic satisfy N3'(r) = N2(r + 1/2) - N2(r - 1/2), which makes the
/// divergence of a composite-spline velocity the interpolated staggered-grid divergence (NUMERICS
/// C2).
template <int Degree>
struct BSpline {
  static_assert(Degree >= 1 && Degree <= 3);
  int first = 0;
  std::array<double, Degree + 1> weight{}, slope{};

  explicit BSpline(double coordinate) {
    if constexpr (Degree == 1) {
      first = static_cast<int>(std::floor(coordinate));
      const double r = coordinate - first;
      weight = {1.0 - r, r};
      slope = {-1.0, 1.0};
    } else if constexpr (Degree == 2) {
      first = static_cast<int>(std::floor(coordinate - 0.5));
      const double r = coordinate - first - 1.0;
      weight = {0.5 * (0.5 - r) * (0.5 - r), 0.75 - r * r, 0.5 * (0.5 + r) * (0.5 + r)};
      slope = {r - 0.5, -2.0 * r, r + 0.5};
    } else {
      first = static_cast<int>(std::floor(coordinate)) - 1;
      const double r = coordinate - first - 1.0, s = 1.0 - r;
      weight = {s * s * s / 6.0, 2.0 / 3.0 - r * r * (1.0 - 0.5 * r),
                2.0 / 3.0 - s * s * (1.0 - 0.5 * s), r * r * r / 6.0};
      slope = {-0.5 * s * s, r * (1.5 * r - 2.0), s * (2.0 - 1.5 * s), 0.5 * r * r};
    }
  }
};

}  // namespace mudlark

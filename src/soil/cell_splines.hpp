#pragma once
/// Splines of points that share a cell. Their stencils are the same: nodes c-1 .. c+2 about faces,
/// c-1 .. c+1 about cell centres, c the cell; quadratic splines about faces end at the middle of a
/// cell and have one zero among the four. Only kernels that are quadratic across.
#include <array>

#include "soil/lanes.hpp"

namespace mudlark {

/// Weights and slopes of N nodes on one axis; `T` holds one value per point.
template <class T, int N>
struct AxisSpline {
  std::array<T, N> weight, slope;
};

/// About faces, of degree 2 or 3; `r` is the place in the cell, 0 to 1; slopes per metre.
template <int Degree, class T>
AxisSpline<T, 4> face_spline(const T& r, double per_spacing) {
  if constexpr (Degree == 3) {
    const T s = 1.0 - r, rr = r * r, ss = s * s;
    return {{ss * s * (1.0 / 6.0), 2.0 / 3.0 - rr * (1.0 - 0.5 * r),
             2.0 / 3.0 - ss * (1.0 - 0.5 * s), rr * r * (1.0 / 6.0)},
            {-0.5 * per_spacing * ss, per_spacing * r * (1.5 * r - 2.0),
             per_spacing * s * (2.0 - 1.5 * s), 0.5 * per_spacing * rr}};
  } else {
    const auto low = r < 0.5;
    const T zero{}, s = low ? r : r - 1.0;  // from the nearest face
    const T below = 0.5 - s, above = 0.5 + s;
    const T a = 0.5 * below * below, b = 0.75 - s * s, c = 0.5 * above * above;
    const T da = -per_spacing * below, db = -2.0 * per_spacing * s, dc = per_spacing * above;
    return {{low ? a : zero, low ? b : a, low ? c : b, low ? zero : c},
            {low ? da : zero, low ? db : da, low ? dc : db, low ? zero : dc}};
  }
}

/// Quadratic, about cell centres.
template <class T>
AxisSpline<T, 3> centre_spline(const T& r, double per_spacing) {
  const T s = r - 0.5, below = 1.0 - r;
  return {{0.5 * below * below, 0.75 - s * s, 0.5 * r * r},
          {-per_spacing * below, -2.0 * per_spacing * s, per_spacing * r}};
}

/// The splines of one point, lanes being the nodes of a row: w = a + u^2 (b + c u), u = u0 + u1 r.
struct NodeSpline {
  Lanes<4> weight, slope;

  static NodeSpline evaluate(const Lanes<4>& a, const Lanes<4>& b, const Lanes<4>& c,
                             const Lanes<4>& u0, const Lanes<4>& u1, double r, double per_spacing) {
    const Lanes<4> u = u0 + u1 * r;
    return {a + u * u * (b + c * u), per_spacing * u1 * (u * (2.0 * b + 3.0 * c * u))};
  }
  template <int Degree>
  static NodeSpline about_faces(double r, double per_spacing) {
    using Four = Lanes<4>;
    if constexpr (Degree == 3)
      return evaluate(Four{0.0, 2.0 / 3.0, 2.0 / 3.0, 0.0}, Four{0.0, -1.0, -1.0, 0.0},
                      Four{1.0 / 6.0, 0.5, 0.5, 1.0 / 6.0}, Four{1.0, 0.0, 1.0, 0.0},
                      Four{-1.0, 1.0, -1.0, 1.0}, r, per_spacing);
    else if (r < 0.5)
      return evaluate(Four{0.0, 0.75, 0.0, 0.0}, Four{0.5, -1.0, 0.5, 0.0}, Four{},
                      Four{0.5, 0.0, 0.5, 0.0}, Four{-1.0, 1.0, 1.0, 0.0}, r, per_spacing);
    else
      return evaluate(Four{0.0, 0.0, 0.75, 0.0}, Four{0.0, 0.5, -1.0, 0.5}, Four{},
                      Four{0.0, 1.5, -1.0, -0.5}, Four{0.0, -1.0, 1.0, 1.0}, r, per_spacing);
  }
  static NodeSpline about_centres(double r, double per_spacing) {
    using Four = Lanes<4>;
    return evaluate(Four{0.0, 0.75, 0.0, 0.0}, Four{0.5, -1.0, 0.5, 0.0}, Four{},
                    Four{1.0, -0.5, 0.0, 0.0}, Four{-1.0, 1.0, 1.0, 0.0}, r, per_spacing);
  }
};

/// Distance of the first node from the lower corner of the cell, in cells.
inline constexpr double first_face = -1.0, first_centre = -0.5;

}  // namespace mudlark

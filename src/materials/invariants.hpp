#pragma once
/// Invariants and principal values of symmetric tensors in closed form. In plane strain (xy = yz =
/// 0) everything is taken from the plane's circle, without angles.
#include <array>
#include <cmath>

#include "base/vec.hpp"

namespace mudlark {

inline double mean_of(const SymTensor& t) { return t.trace() / 3.0; }
inline SymTensor deviator_of(const SymTensor& t) {
  const double mean = mean_of(t);
  return {t.xx - mean, t.yy - mean, t.zz - mean, t.xy, t.yz, t.zx};
}
/// J2 = s : s / 2 of the deviator s of t.
inline double second_invariant(const SymTensor& t) {
  const double a = t.xx - t.yy, b = t.yy - t.zz, c = t.zz - t.xx;
  return (a * a + b * b + c * c) / 6.0 + t.xy * t.xy + t.yz * t.yz + t.zx * t.zx;
}
inline double determinant(const SymTensor& t) {
  return t.xx * (t.yy * t.zz - t.yz * t.yz) - t.xy * (t.xy * t.zz - t.yz * t.zx) +
         t.zx * (t.xy * t.yz - t.yy * t.zx);
}
/// J3 = det s of the deviator s of t.
inline double third_invariant(const SymTensor& t) { return determinant(deviator_of(t)); }
/// Is y a principal direction because nothing shears across the plane x-z?
inline bool is_plane(const SymTensor& t) { return t.xy == 0.0 && t.yz == 0.0; }

/// Three principal values, the largest first.
using PrincipalValues = std::array<double, 3>;

/// Principal values without directions. In space two nearly equal values differ by the square root
/// of round-off (1e-8 of the deviator).
PrincipalValues principal_values(const SymTensor& t);

/// Principal values and directions of a tensor, and the way back. In space after Scherzinger &
/// Dohrmann (2008): the value farthest from the others first, which is well conditioned, then the
/// plane across it; accurate to round-off for equal values too.
class PrincipalAxes {
 public:
  explicit PrincipalAxes(const SymTensor& t);
  const PrincipalValues& values() const { return values_; }
  /// The tensor of the same directions with other values, in the order of values().
  SymTensor tensor(const PrincipalValues& values) const;

 private:
  void set_plane(const SymTensor& t);
  void set_space(const SymTensor& t);
  void take(const std::array<std::array<double, 3>, 3>& directions, PrincipalValues values);

  PrincipalValues values_{};
  bool plane_ = false;
  int out_ = 1;                       ///< plane: which of the values is that of y
  double cosine_ = 1.0, sine_ = 0.0;  ///< plane: of twice the angle of the larger value from x
  std::array<std::array<double, 3>, 3> directions_{};  ///< space: unit vectors
};

inline PrincipalAxes::PrincipalAxes(const SymTensor& t) {
  plane_ = is_plane(t);
  if (plane_)
    set_plane(t);
  else
    set_space(t);
}

inline void PrincipalAxes::set_plane(const SymTensor& t) {
  const double mean = 0.5 * (t.xx + t.zz), difference = 0.5 * (t.xx - t.zz);
  const double radius = std::sqrt(difference * difference + t.zx * t.zx);
  if (radius > 0.0) cosine_ = difference / radius, sine_ = t.zx / radius;
  const double upper = mean + radius, lower = mean - radius;
  if (t.yy > upper) {
    out_ = 0, values_ = {t.yy, upper, lower};
  } else if (t.yy < lower) {
    out_ = 2, values_ = {upper, lower, t.yy};
  } else {
    out_ = 1, values_ = {upper, t.yy, lower};
  }
}

}  // namespace mudlark

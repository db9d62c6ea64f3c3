#include "materials/invariants.hpp"

#include <algorithm>
#include <utility>

namespace mudlark {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector scaled(double f, const Vector& a) { return {f * a[0], f * a[1], f * a[2]}; }
Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector applied(const SymTensor& t, const Vector& v) {
  return {t.xx * v[0] + t.xy * v[1] + t.zx * v[2], t.xy * v[0] + t.yy * v[1] + t.yz * v[2],
          t.zx * v[0] + t.yz * v[1] + t.zz * v[2]};
}

/// The principal value of a deviator that lies farthest from the other two, which is well
/// conditioned whatever they are: 2 sqrt(J2/3) c with 4 c^3 - 3 c = |J3|/2 (3/J2)^1.5 and
/// sqrt(3)/2 <= c <= 1, by Newton from the parabola through three points; of the sign of J3. J2 >
/// 0.
double farthest_value(double j2, double j3) {
  const double radius = std::sqrt(j2 / 3.0);
  const double x = std::min(0.5 * std::abs(j3) / (radius * radius * radius), 1.0);
  double c = 0.8660254037844386 + x * (0.1607198 - 0.0267452 * x);  // x = 0, 1/2, 1
  for (int i = 0; i < 3; ++i) {
    const double square = c * c;
    c = (8.0 * square * c + x) / (12.0 * square - 3.0);
  }
  return std::copysign(2.0 * radius * c, j3);
}

/// Is the deviator lost in the round-off of the mean value?
bool is_isotropic(double j2, double mean) { return j2 <= 1e-32 * mean * mean; }

/// Two unit vectors that span the image of (s - value I), whose rank is two: the plane across the
/// direction of the value.
std::pair<Vector, Vector> plane_across(const SymTensor& s, double value) {
  std::array<Vector, 3> columns{Vector{s.xx - value, s.xy, s.zx}, Vector{s.xy, s.yy - value, s.yz},
                                Vector{s.zx, s.yz, s.zz - value}};
  std::array<double, 3> size{};
  for (std::size_t c = 0; c < 3; ++c) size[c] = dot(columns[c], columns[c]);
  const std::size_t first =
      size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
  const Vector one = scaled(1.0 / std::sqrt(size[first]), columns[first]);
  Vector two{};
  double largest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (c == first) continue;
    const Vector rest = sum(columns[c], scaled(-dot(columns[c], one), one));
    if (dot(rest, rest) > largest) largest = dot(rest, rest), two = rest;
  }
  return {one, scaled(1.0 / std::sqrt(largest), two)};
}

}  // namespace

PrincipalValues principal_values(const SymTensor& t) {
  if (is_plane(t)) return PrincipalAxes(t).values();
  const double mean = mean_of(t), j2 = second_invariant(t);
  if (is_isotropic(j2, mean)) return {mean, mean, mean};
  const double far = farthest_value(j2, third_invariant(t));
  const double others = mean - 0.5 * far;
  const double radius = std::sqrt(std::max(j2 - 0.75 * far * far, 0.0));
  if (far > 0.0) return {mean + far, others + radius, others - radius};
  return {others + radius, others - radius, mean + far};
}

void PrincipalAxes::set_space(const SymTensor& t) {
  const double mean = mean_of(t), j2 = second_invariant(t);
  if (is_isotropic(j2, mean)) {
    take({Vector{1.0, 0.0, 0.0}, Vector{0.0, 1.0, 0.0}, Vector{0.0, 0.0, 1.0}}, {t.xx, t.yy, t.zz});
    return;
  }
  const SymTensor s = deviator_of(t);
  const double far = farthest_value(j2, determinant(s));
  const auto [one, two] = plane_across(s, far);
  const Vector image = applied(s, one), other = applied(s, two);
  const double a = dot(one, image), b = dot(two, image), c = dot(two, other);
  const double half = 0.5 * (a - c), radius = std::sqrt(half * half + b * b);
  // Direction of the larger value of [a b; b c], from the form without cancellation.
  double x = half >= 0.0 ? half + radius : b, y = half >= 0.0 ? b : radius - half;
  const double length = std::sqrt(x * x + y * y);
  if (length > 0.0)
    x /= length, y /= length;
  else
    x = 1.0, y = 0.0;
  const Vector upper = sum(scaled(x, one), scaled(y, two));
  const Vector lower = sum(scaled(-y, one), scaled(x, two));
  const double middle = mean + 0.5 * (a + c);
  take({cross(one, two), upper, lower}, {mean + far, middle + radius, middle - radius});
}

/// Keeps directions and values in falling order of the values.
void PrincipalAxes::take(const std::array<Vector, 3>& directions, PrincipalValues values) {
  directions_ = directions;
  values_ = values;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (values_[i] >= values_[j]) return;
    std::swap(values_[i], values_[j]);
    std::swap(directions_[i], directions_[j]);
  };
  order(0, 1), order(1, 2), order(0, 1);
}

SymTensor PrincipalAxes::tensor(const PrincipalValues& values) const {
  SymTensor t;
  if (plane_) {
    const double upper = out_ == 0 ? values[1] : values[0];
    const double lower = out_ == 2 ? values[1] : values[2];
    const double mean = 0.5 * (upper + lower), radius = 0.5 * (upper - lower);
    t.xx = mean + radius * cosine_, t.zz = mean - radius * cosine_, t.zx = radius * sine_;
    t.yy = values[static_cast<std::size_t>(out_)];
    return t;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector& n = directions_[i];
    t.xx += values[i] * n[0] * n[0], t.yy += values[i] * n[1] * n[1];
    t.zz += values[i] * n[2] * n[2], t.xy += values[i] * n[0] * n[1];
    t.yz += values[i] * n[1] * n[2], t.zx += values[i] * n[2] * n[0];
  }
  return t;
}

}  // namespace mudlark

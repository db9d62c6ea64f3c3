#include "numerics/plic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mudlark {
namespace {

constexpr double smallest = 1e-30;
/// Lead of the centred normal's largest component over which Youngs' normal takes over. On a nearly
/// flat surface beside a wall the two leads are equal in 3D although the normals differ: a switch
/// would leave the choice to round-off.
constexpr double blend = 1e-3;

/// Components of the normal made positive, sorted upwards and scaled to sum 1; unused ones are
/// zero.
struct Sorted {
  double m1 = 0.0, m2 = 0.0, m3 = 0.0;
};

template <int D>
Sorted sorted(const Vec<D>& normal, double sum) {
  double m[3] = {0.0, 0.0, 0.0};
  for (int a = 0; a < D; ++a) m[a + 3 - D] = std::abs(normal[a]) / sum;
  if (m[0] > m[1]) std::swap(m[0], m[1]);
  if (m[1] > m[2]) std::swap(m[1], m[2]);
  if (m[0] > m[1]) std::swap(m[0], m[1]);
  return {m[0], m[1], m[2]};
}

/// Volume below the plane for 0 <= c <= 1/2 with the sorted normal, and its derivative (the area).
struct Cut {
  double volume, area;
};

/// Two components (m1 = 0): a triangle, then a trapezium.
Cut cut_flat(const Sorted& m, double c) {
  if (c < m.m2) return {c * c / (2.0 * m.m2 * m.m3), c / (m.m2 * m.m3)};
  return {(c - 0.5 * m.m2) / m.m3, 1.0 / m.m3};
}

Cut cut_solid(const Sorted& m, double c) {
  const double m12 = m.m1 + m.m2, scale = 6.0 * m.m2 * m.m3;
  if (c < m.m1) return {c * c * c / (m.m1 * scale), 3.0 * c * c / (m.m1 * scale)};
  Cut cut{};
  if (c < m12) {
    const double beyond = std::max(c - m.m2, 0.0);
    cut.volume = (3.0 * c * (c - m.m1) + m.m1 * m.m1 - beyond * beyond * beyond / m.m1) / scale;
    cut.area = (6.0 * c - 3.0 * m.m1 - 3.0 * beyond * beyond / m.m1) / scale;
  } else {
    cut.volume = (c - 0.5 * m12) / m.m3;
    cut.area = 1.0 / m.m3;
  }
  if (c >
      m.m3) {  // the corner that lies beyond the third side: needs m12 > m3, so no small divisor
    const double d = c - m.m3;
    cut.volume -= (d < m.m1 ? d * d * d / m.m1 : 3.0 * d * (d - m.m1) + m.m1 * m.m1) / scale;
    cut.area -= (d < m.m1 ? 3.0 * d * d / m.m1 : 6.0 * d - 3.0 * m.m1) / scale;
  }
  return cut;
}

Cut cut_half(const Sorted& m, double c) { return m.m1 < 1e-12 ? cut_flat(m, c) : cut_solid(m, c); }

/// Middle root of c^3 + a2 c^2 + a1 c + a0 (Scardovelli & Zaleski 2000, eq. 17).
double middle_root(double a2, double a1, double a0) {
  const double p = a1 / 3.0 - a2 * a2 / 9.0, q = (a1 * a2 - 3.0 * a0) / 6.0 - a2 * a2 * a2 / 27.0;
  const double root = std::sqrt(std::max(-p, smallest));
  const double angle = std::acos(std::clamp(q / (root * root * root), -1.0, 1.0)) / 3.0;
  return root * (std::numbers::sqrt3 * std::sin(angle) - std::cos(angle)) - a2 / 3.0;
}

/// Plane constant for 0 <= volume <= 1/2.
double constant_half(const Sorted& m, double volume) {
  if (m.m1 < 1e-12) {
    const double c = std::sqrt(2.0 * m.m2 * m.m3 * volume);
    return c < m.m2 ? c : m.m3 * volume + 0.5 * m.m2;
  }
  const double m12 = m.m1 + m.m2;
  const double v1 = m.m1 * m.m1 / (6.0 * m.m2 * m.m3), v2 = v1 + 0.5 * (m.m2 - m.m1) / m.m3;
  const double v3 = cut_solid(m, std::min(m12, m.m3)).volume;
  const double product = 6.0 * m.m1 * m.m2 * m.m3 * volume;
  if (volume < v1) return std::cbrt(product);
  if (volume < v2) return 0.5 * (m.m1 + std::sqrt(m.m1 * m.m1 + 8.0 * m.m2 * m.m3 * (volume - v1)));
  const double squares = m.m1 * m.m1 + m.m2 * m.m2;
  const double cubes = m.m1 * m.m1 * m.m1 + m.m2 * m.m2 * m.m2;
  if (volume < v3) return middle_root(-3.0 * m12, 3.0 * squares, product - cubes);
  if (m.m3 >= m12) return m.m3 * volume + 0.5 * m12;
  return middle_root(-1.5, 1.5 * (squares + m.m3 * m.m3),
                     0.5 * (product - cubes - m.m3 * m.m3 * m.m3));
}

}  // namespace

template <int D>
double volume_below(const Plane<D>& plane) {
  double sum = 0.0, c = plane.constant;
  for (int a = 0; a < D; ++a) {
    sum += std::abs(plane.normal[a]);
    c -= std::min(plane.normal[a], 0.0);  // mirrored, so that every component is positive
  }
  if (sum < smallest) return plane.constant >= 0.0 ? 1.0 : 0.0;
  c /= sum;
  if (c <= 0.0) return 0.0;
  if (c >= 1.0) return 1.0;
  const Sorted m = sorted<D>(plane.normal, sum);
  return c <= 0.5 ? cut_half(m, c).volume : 1.0 - cut_half(m, 1.0 - c).volume;
}

template <int D>
Plane<D> plane_of_volume(const Vec<D>& normal, double fraction) {
  double sum = 0.0, mirrored = 0.0;
  for (int a = 0; a < D; ++a) {
    sum += std::abs(normal[a]);
    mirrored += std::min(normal[a], 0.0);
  }
  sum = std::max(sum, smallest);
  const Sorted m = sorted<D>(normal, sum);
  const double volume = std::clamp(fraction, 0.0, 1.0);
  const double small = std::min(volume, 1.0 - volume);
  double c = constant_half(m, small);
  const Cut cut = cut_half(m, c);
  if (c > 0.0 && cut.area > 1e-8) c = std::clamp(c - (cut.volume - small) / cut.area, 0.0, 0.5);
  if (volume > 0.5) c = 1.0 - c;
  return {normal, c * sum + mirrored};
}

template <int D>
double water_in_slab(const Plane<D>& plane, int axis, double from, double width) {
  Plane<D> slab = plane;
  slab.normal[axis] *= width;
  slab.constant -= plane.normal[axis] * from;
  return width * volume_below(slab);
}

namespace {

/// Sum over the two axes other than `axis` with weights (1, weight, 1) per axis, in the layer at
/// `alpha`.
template <int D>
double layer_sum(const double* alpha, const std::ptrdiff_t* stride, int axis, double weight) {
  if constexpr (D == 2) {
    const std::ptrdiff_t s = stride[1 - axis];
    return alpha[-s] + weight * alpha[0] + alpha[s];
  } else {
    const std::ptrdiff_t s = stride[(axis + 1) % 3], t = stride[(axis + 2) % 3];
    return (alpha[-s - t] + weight * alpha[-s] + alpha[-s + t]) +
           weight * (alpha[-t] + weight * alpha[0] + alpha[t]) +
           (alpha[s - t] + weight * alpha[s] + alpha[s + t]);
  }
}

/// Sum of the column of three cells along `axis` through `alpha`.
double column(const double* alpha, std::ptrdiff_t stride) {
  return alpha[-stride] + alpha[0] + alpha[stride];
}

template <int D>
void scale_to_unit_sum(Vec<D>& vec) {
  double sum = 0.0;
  for (int a = 0; a < D; ++a) sum += std::abs(vec[a]);
  if (sum > smallest) vec *= 1.0 / sum;
}

template <int D>
double largest_component(const Vec<D>& vec) {
  double largest = 0.0;
  for (int a = 0; a < D; ++a) largest = std::max(largest, std::abs(vec[a]));
  return largest;
}

}  // namespace

template <int D>
Vec<D> interface_normal(const double* alpha, const std::ptrdiff_t* stride) {
  // Centred columns: the surface as a height function along the axis that it is steepest against.
  Vec<D> best;
  double best_size = -1.0;
  for (int up = 0; up < D; ++up) {
    Vec<D> candidate;
    const std::ptrdiff_t s = stride[up];
    candidate[up] =
        layer_sum<D>(alpha - s, stride, up, 1.0) > layer_sum<D>(alpha + s, stride, up, 1.0) ? 1.0
                                                                                            : -1.0;
    for (int a = 0; a < D; ++a)
      if (a != up)
        candidate[a] = 0.5 * (column(alpha - stride[a], s) - column(alpha + stride[a], s));
    scale_to_unit_sum(candidate);
    if (std::abs(candidate[up]) > best_size) best = candidate, best_size = std::abs(candidate[up]);
  }
  Vec<D> youngs;
  for (int a = 0; a < D; ++a)
    youngs[a] = layer_sum<D>(alpha - stride[a], stride, a, 2.0) -
                layer_sum<D>(alpha + stride[a], stride, a, 2.0);
  scale_to_unit_sum(youngs);
  const double youngs_size = largest_component(youngs);
  if (youngs_size <= smallest) return best;
  const double share = std::clamp((best_size - youngs_size) / blend, 0.0, 1.0);
  return best + share * (youngs - best);
}

template double volume_below<2>(const Plane<2>&);
template double volume_below<3>(const Plane<3>&);
template Plane<2> plane_of_volume<2>(const Vec<2>&, double);
template Plane<3> plane_of_volume<3>(const Vec<3>&, double);
template double water_in_slab<2>(const Plane<2>&, int, double, double);
template double water_in_slab<3>(const Plane<3>&, int, double, double);
template Vec<2> interface_normal<2>(const double*, const std::ptrdiff_t*);
template Vec<3> interface_normal<3>(const double*, const std::ptrdiff_t*);

}  // namespace mudlark

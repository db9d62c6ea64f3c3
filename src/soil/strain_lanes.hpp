#pragma once
/// Tensors of several points at once, component by component, and what the strain measures do with
/// them: see kinematics.hpp.
#include <array>
#include <cstddef>

#include "base/vec.hpp"
#include "soil/lanes.hpp"

namespace mudlark {

/// Points whose tensors are worked on together.
inline constexpr std::size_t tensor_lanes = register_lanes;
using TensorValue = Lanes<static_cast<int>(tensor_lanes)>;

struct TensorLanes {
  TensorValue xx{}, yy{}, zz{}, xy{}, yz{}, zx{};

  void set(std::size_t lane, const SymTensor& t) {
    xx[lane] = t.xx, yy[lane] = t.yy, zz[lane] = t.zz;
    xy[lane] = t.xy, yz[lane] = t.yz, zx[lane] = t.zx;
  }
  SymTensor at(std::size_t lane) const {
    return {xx[lane], yy[lane], zz[lane], xy[lane], yz[lane], zx[lane]};
  }
  TensorValue trace() const { return xx + yy + zz; }
  TensorValue squared_norm() const {
    return xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + zx * zx);
  }
  TensorValue determinant() const {
    return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
  }
  /// t t
  TensorLanes square() const {
    return {xx * xx + xy * xy + zx * zx, xy * xy + yy * yy + yz * yz, zx * zx + yz * yz + zz * zz,
            xx * xy + xy * yy + zx * yz, xy * zx + yy * yz + yz * zz, xx * zx + xy * yz + zx * zz};
  }
  TensorLanes scaled(const TensorValue& by) const {
    return {by * xx, by * yy, by * zz, by * xy, by * yz, by * zx};
  }
  /// a I + b t + c other
  TensorLanes combined(const TensorValue& a, const TensorValue& b, const TensorValue& c,
                       const TensorLanes& other) const {
    return {a + b * xx + c * other.xx, a + b * yy + c * other.yy, a + b * zz + c * other.zz,
            b * xy + c * other.xy,     b * yz + c * other.yz,     b * zx + c * other.zx};
  }
};

/// 3 x 3 matrices, rows first.
using MatrixLanes = std::array<TensorValue, 9>;

/// m t m^T
inline TensorLanes congruent(const TensorLanes& t, const MatrixLanes& m) {
  std::array<TensorValue, 9> mt;
  for (std::size_t i = 0; i < 9; i += 3) {
    mt[i] = m[i] * t.xx + m[i + 1] * t.xy + m[i + 2] * t.zx;
    mt[i + 1] = m[i] * t.xy + m[i + 1] * t.yy + m[i + 2] * t.yz;
    mt[i + 2] = m[i] * t.zx + m[i + 1] * t.yz + m[i + 2] * t.zz;
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    return mt[3 * i] * m[3 * j] + mt[3 * i + 1] * m[3 * j + 1] + mt[3 * i + 2] * m[3 * j + 2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}

/// Gauss-Legendre rule on 0 .. 1.
template <std::size_t N>
struct GaussRule {
  std::array<double, N> place, weight;
};
inline constexpr GaussRule<2> gauss_2{{0.21132486540518713, 0.7886751345948129}, {0.5, 0.5}};
inline constexpr GaussRule<4> gauss_4{
    {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970262},
    {0.17392742256872684, 0.3260725774312731, 0.3260725774312731, 0.17392742256872684}};
inline constexpr GaussRule<7> gauss_7{
    {0.025446043828620757, 0.12923440720030277, 0.2970774243113014, 0.5, 0.7029225756886985,
     0.8707655927996972, 0.9745539561713792},
    {0.06474248308443532, 0.1398526957446383, 0.19091502525255916, 0.20897959183673448,
     0.19091502525255916, 0.1398526957446383, 0.06474248308443532}};

/// 1/2 ln(I + x) as the integral of x (I + t x)^-1 over t from 0 to 1 (Dieci, Morini & Papini 1996)
/// by Gauss' rule, which makes it a Pade approximant. With the invariants of x,
/// x adj(I + t x) = (1 + t I1) x - t x^2 + t^2 I3 I and det(I + t x) = 1 + t I1 + t^2 I2 + t^3 I3.
template <std::size_t N>
TensorLanes half_log_of(const TensorLanes& x, const GaussRule<N>& rule) {
  const TensorLanes square = x.square();
  const TensorValue i1 = x.trace(), i2 = 0.5 * (i1 * i1 - square.trace()), i3 = x.determinant();
  TensorValue a{}, b{}, c{};
  for (std::size_t n = 0; n < N; ++n) {
    const double t = rule.place[n];
    const TensorValue share = rule.weight[n] / (1.0 + t * (i1 + t * (i2 + t * i3)));
    a += t * t * share, b += share * (1.0 + t * i1), c -= t * share;
  }
  return x.combined(0.5 * a * i3, 0.5 * b, 0.5 * c, square);
}

/// exp(x) by Taylor's series up to power N; powers of x from the Cayley-Hamilton theorem.
template <int N>
TensorLanes exp_of(const TensorLanes& x) {
  const TensorLanes square = x.square();
  const TensorValue i1 = x.trace(), i2 = 0.5 * (i1 * i1 - square.trace()), i3 = x.determinant();
  TensorValue a{}, b{}, c = spread<tensor_lanes>(0.5);  // x^n / n! = a I + b x + c x^2
  TensorValue sum_a = spread<tensor_lanes>(1.0), sum_b = sum_a, sum_c = c;
  for (int n = 3; n <= N; ++n) {
    const TensorValue last = c;
    c = (b + last * i1) / n;
    b = (a - last * i2) / n;
    a = last * i3 / n;
    sum_a += a, sum_b += b, sum_c += c;
  }
  return x.combined(sum_a, sum_b, sum_c, square);
}

/// Rotation and strain increment of Hughes & Winget (1980), Eqs. 15-22: with h = g (I + g/2)^-1 the
/// strain is its symmetric part; with a the axial vector of half its skew part the rotation is
/// I + 2/(1 + a^2) (A + A^2).
inline MatrixLanes step_rotation(const MatrixLanes& g, TensorLanes& strain) {
  MatrixLanes m;  // I + g/2
  for (std::size_t i = 0; i < 9; ++i) m[i] = 0.5 * g[i] + (i % 4 == 0 ? 1.0 : 0.0);
  const MatrixLanes adjoint{
      m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
      m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
      m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
  const TensorValue scale = 1.0 / (m[0] * adjoint[0] + m[1] * adjoint[3] + m[2] * adjoint[6]);
  MatrixLanes h;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      h[3 * i + j] = scale * (g[3 * i] * adjoint[j] + g[3 * i + 1] * adjoint[3 + j] +
                              g[3 * i + 2] * adjoint[6 + j]);
  strain = {h[0], h[4], h[8], 0.5 * (h[1] + h[3]), 0.5 * (h[5] + h[7]), 0.5 * (h[2] + h[6])};
  const TensorValue x = 0.25 * (h[7] - h[5]), y = 0.25 * (h[2] - h[6]), z = 0.25 * (h[3] - h[1]);
  const TensorValue xx = x * x, yy = y * y, zz = z * z, f = 2.0 / (1.0 + xx + yy + zz);
  return {1.0 - f * (yy + zz), f * (x * y - z),     f * (x * z + y),
          f * (x * y + z),     1.0 - f * (xx + zz), f * (y * z - x),
          f * (x * z - y),     f * (y * z + x),     1.0 - f * (xx + yy)};
}

}  // namespace mudlark

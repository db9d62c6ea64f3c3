#pragma once
/// Sums and products of symmetric tensors.
#include "base/vec.hpp"

namespace mudlark {

/// a : b = a_ij b_ij.
inline double contraction(const SymTensor& a, const SymTensor& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}
inline SymTensor difference(const SymTensor& a, const SymTensor& b) { return a + -1.0 * b; }
/// a . a, which is symmetric too.
inline SymTensor square(const SymTensor& a) {
  return {a.xx * a.xx + a.xy * a.xy + a.zx * a.zx, a.xy * a.xy + a.yy * a.yy + a.yz * a.yz,
          a.zx * a.zx + a.yz * a.yz + a.zz * a.zz, a.xx * a.xy + a.xy * a.yy + a.zx * a.yz,
          a.xy * a.zx + a.yy * a.yz + a.yz * a.zz, a.xx * a.zx + a.xy * a.yz + a.zx * a.zz};
}
/// K tr(e) I + 2 G dev(e).
inline SymTensor isotropic_stress(double bulk, double shear, const SymTensor& e) {
  return 2.0 * shear * e + ((bulk - 2.0 / 3.0 * shear) * e.trace()) * SymTensor::identity();
}

}  // namespace mudlark

#pragma once
/// Isotropic linear elasticity (Hooke) as a value: the elastic part of the laws that yield.
#include "base/vec.hpp"

namespace mudlark {

struct Elasticity {
  double lame = 0.0;   ///< Lame's first constant [Pa]
  double shear = 0.0;  ///< G [Pa]

  static Elasticity from(double young_modulus, double poisson_ratio) {
    return {young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)),
            young_modulus / (2.0 * (1.0 + poisson_ratio))};
  }
  double bulk() const { return lame + 2.0 / 3.0 * shear; }
  double constrained() const { return lame + 2.0 * shear; }
  /// nu/(1-nu): horizontal over vertical stress under confined compression.
  double confined_ratio() const { return lame / constrained(); }
  SymTensor stress(const SymTensor& strain) const {
    const double even = lame * strain.trace(), twice = 2.0 * shear;
    return {even + twice * strain.xx, even + twice * strain.yy, even + twice * strain.zz,
            twice * strain.xy,        twice * strain.yz,        twice * strain.zx};
  }
  SymTensor strain(const SymTensor& stress) const {
    const double volumetric = stress.trace() / (3.0 * lame + 2.0 * shear);
    return (0.5 / shear) * (stress + (-lame * volumetric) * SymTensor::identity());
  }
};

}  // namespace mudlark

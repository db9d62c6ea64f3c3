#pragma once
/// Elasticity of laws of the Cam-Clay family: K = v p / kappa, with v = 1 + e the specific volume,
/// so that swelling lines are straight over ln p. Everything here is compression positive.
#include <algorithm>
#include <cmath>

#include "materials/invariants.hpp"
#include "materials/separation.hpp"
#include "materials/tensor_algebra.hpp"

namespace mudlark {

struct PorousElasticity {
  double swelling_index;     ///< kappa [-]
  double shear_ratio;        ///< G / K = 3 (1 - 2 nu) / (2 (1 + nu)) [-]
  double mean_stress_floor;  ///< below it K stays what it is there [Pa]

  PorousElasticity(double kappa, double poisson_ratio, double floor)
      : swelling_index(kappa),
        shear_ratio(1.5 * (1.0 - 2.0 * poisson_ratio) / (1.0 + poisson_ratio)),
        mean_stress_floor(floor) {}

  double bulk(double pressure, double specific_volume) const {
    return specific_volume * std::max(pressure, mean_stress_floor) / swelling_index;
  }
  /// Compression of the specific volume by a volumetric strain: dv = -v d eps_v.
  static double compressed(double specific_volume, double volumetric) {
    return specific_volume * std::exp(-volumetric);
  }
  /// Stress after an elastic strain, exact along a straight strain path:
  /// int dp / max(p, floor) = (v_old - v_new) / kappa, and G / K is constant.
  SymTensor stress(const SymTensor& old, double specific_volume, const SymTensor& strain) const {
    const double volumetric = strain.trace(), pressure = mean_of(old);
    const double swing = specific_volume * -std::expm1(-volumetric) / swelling_index;
    const double after = moved(pressure, swing);
    const double secant = std::abs(volumetric) > 1e-9 ? (after - pressure) / volumetric
                                                      : bulk(pressure, specific_volume);
    return old + 2.0 * shear_ratio * secant * deviator_of(strain) +
           (after - pressure) * SymTensor::identity();
  }
  /// int dp / max(p, floor) from no stress to p: 1 + ln(p / floor) above the floor.
  double level(double pressure) const {
    const double ratio = pressure / mean_stress_floor;
    return ratio >= 1.0 ? std::log(ratio) + 1.0 : ratio;
  }
  /// The pressure whose level is that of `pressure` and `swing` more.
  double moved(double pressure, double swing) const {
    const double end = level(pressure) + swing;
    if (pressure >= mean_stress_floor && end >= 1.0) return pressure * std::exp(swing);
    return mean_stress_floor * (end >= 1.0 ? std::exp(end - 1.0) : end);
  }
};

/// Lets soil without stress come apart, and closes its gap (materials/separation.hpp), while the
/// specific volume follows. Returns whether the grains touch; then `strain` (tension positive, as
/// the gap) is what is left of the step.
inline bool in_touch(double pressure, double smallest_pressure, double& separation,
                     double& specific_volume, SymTensor& strain) {
  const double whole = strain.trace();
  const bool apart = still_apart(separation, strain);
  const bool opens = !apart && pressure <= smallest_pressure && strain.trace() > 0.0;
  if (opens) separation = strain.trace();
  const double spent = apart || opens ? whole : whole - strain.trace();
  specific_volume = PorousElasticity::compressed(specific_volume, -spent);
  return !apart && !opens;
}

}  // namespace mudlark

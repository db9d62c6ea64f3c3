#pragma once
/// Pores that are not full of water: how easily they let it pass, and how they hold it.
#include <algorithm>
#include <cmath>

namespace mudlark {

/// power: k_r = S^n (Irmay 1954 and Averjanov 1950: n = 3 to 3.5). van_genuchten: with the m = 1 -
/// 1/n of van Genuchten (1980), Soil Sci. Soc. Am. J. 44, after Mualem: k_r = sqrt(S) [1 - (1 -
/// S^(1/m))^m]^2.
enum class PermeabilityCurve { power, van_genuchten };

struct PoreFilling {
  PermeabilityCurve curve = PermeabilityCurve::power;
  double exponent = 3.0;  ///< n of the curve [-]
  double suction = 0.0;   ///< of the water's surface in the pores against the air [Pa]

  /// Conductivity over that of full pores, at a saturation S [-].
  double relative_permeability(double saturation) const {
    const double s = std::clamp(saturation, 0.0, 1.0);
    if (curve == PermeabilityCurve::power) return std::pow(s, exponent);
    const double m = 1.0 - 1.0 / exponent;
    const double rest = 1.0 - std::pow(1.0 - std::pow(s, 1.0 / m), m);
    return std::sqrt(s) * rest * rest;
  }
};
/// The same curve?
inline bool same_curve(const PoreFilling& one, const PoreFilling& other) {
  return one.curve == other.curve && one.exponent == other.exponent;
}

}  // namespace mudlark

#pragma once
/// Pores that are not full of water: how easily they let it pass, and how they hold it.
#include <algorithm>
#include <cmath>

namespace mudlark {

/// power: k_r = S_e^n (Irmay 1954 and Averjanov 1950: n = 3 to 3.5; Brooks & Corey 1964).
/// van_genuchten: with the m = 1 - 1/n of van Genuchten (1980), Soil Sci. Soc. Am. J. 44, after
/// Mualem: k_r = sqrt(S_e) [1 - (1 - S_e^(1/m))^m]^2.
enum class PermeabilityCurve { power, van_genuchten };

struct PoreFilling {
  PermeabilityCurve curve = PermeabilityCurve::power;
  double exponent = 3.0;  ///< n of the curve [-]
  double residual = 0.0;  ///< S_r, share of the pores whose water does not drain [-]
  double suction = 0.0;   ///< of the water's surface in the pores against the air [Pa]
  double at_start = 0.0;  ///< share of the pores that is full where no body of water is [-]

  /// Conductivity over that of full pores, at an effective saturation S_e = (S - S_r)/(1 - S_r).
  /// Above zero, so that a drag in proportion to its inverse is finite.
  double relative_permeability(double effective) const {
    constexpr double least = 1e-30;
    const double s = std::clamp(effective, 0.0, 1.0);
    if (curve == PermeabilityCurve::power) return std::max(std::pow(s, exponent), least);
    const double m = 1.0 - 1.0 / exponent, part = std::pow(s, 1.0 / m);
    // 1 - (1 - part)^m, also where part is less than the round-off of one
    const double rest = part < 1.0 ? -std::expm1(m * std::log1p(-part)) : 1.0;
    return std::max(std::sqrt(s) * rest * rest, least);
  }
};
/// The same curve?
inline bool same_curve(const PoreFilling& one, const PoreFilling& other) {
  return one.curve == other.curve && one.exponent == other.exponent;
}

}  // namespace mudlark

#pragma once
/// The Mohr-Coulomb surface with tension cut-off in principal stresses, and the exact return to it.
#include <limits>

#include "materials/elasticity.hpp"
#include "materials/invariants.hpp"

namespace mudlark {

/// k s1 - s3 <= q_c and s1 <= t for principal stresses s1 >= s2 >= s3 [Pa], tension positive, with
/// k = (1 + sin phi)/(1 - sin phi) and q_c = 2 c sqrt(k). The flow of the first has the potential
/// m s1 - s3, m from the angle of dilatancy; that of the cut-off is associated. phi = 0 is Tresca.
struct MohrCoulombSurface {
  double slope = 1.0;     ///< k [-]
  double flow = 1.0;      ///< m [-]
  double strength = 0.0;  ///< q_c, strength in unconfined compression [Pa]
  /// t: the cut-off, or where the surface ends, c/tan phi [Pa]
  double tension = std::numeric_limits<double>::infinity();

  /// `tension_cutoff` [Pa] may be infinite.
  static MohrCoulombSurface from(double cohesion, double tan_friction, double tan_dilatancy,
                                 double tension_cutoff);
  bool admits(const PrincipalValues& s) const {
    return slope * s[0] - s[2] <= strength && s[0] <= tension;
  }
  bool admits(const SymTensor& stress) const;
};

/// The stress that belongs to an elastic trial stress outside the surface: backward Euler with
/// Koiter's rule, on the plane, one of the two edges, the apex or the parts of the cut-off
/// (Clausen, Damkilde & Andersen 2006). Exact for constant strength, however long the step.
PrincipalValues returned(const MohrCoulombSurface& surface, const Elasticity& elasticity,
                         const PrincipalValues& trial);

/// Plane strain without a square root too many; in space first the cones inside and around the
/// pyramid, between which alone principal stresses are needed.
inline bool MohrCoulombSurface::admits(const SymTensor& stress) const {
  if (is_plane(stress)) {
    const double mean = 0.5 * (stress.xx + stress.zz), half = 0.5 * (stress.xx - stress.zz);
    const double radius = std::sqrt(half * half + stress.zx * stress.zx);
    const double largest = mean + radius > stress.yy ? mean + radius : stress.yy;
    const double least = mean - radius < stress.yy ? mean - radius : stress.yy;
    return slope * largest - least <= strength && largest <= tension;
  }
  // k s1 - s3 = (k - 1) mean + sqrt(J2) g(theta), with k + 2 <= sqrt(3) g <= 2 sqrt(k^2 + k + 1)
  constexpr double third_root = 0.5773502691896258;
  const double mean = mean_of(stress), root = third_root * std::sqrt(second_invariant(stress));
  const double even = (slope - 1.0) * mean;
  if (even + (slope + 2.0) * root > strength) return false;
  if (even + 2.0 * std::sqrt(slope * slope + slope + 1.0) * root <= strength &&
      mean + 2.0 * root <= tension)
    return true;
  return admits(principal_values(stress));
}

}  // namespace mudlark

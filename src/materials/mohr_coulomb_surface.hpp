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

/// Plane strain without a square root too many; in space first the cone inside the pyramid, whose
/// points need no principal stresses.
inline bool MohrCoulombSurface::admits(const SymTensor& stress) const {
  if (is_plane(stress)) {
    const double mean = 0.5 * (stress.xx + stress.zz), half = 0.5 * (stress.xx - stress.zz);
    const double radius = std::sqrt(half * half + stress.zx * stress.zx);
    const double largest = mean + radius > stress.yy ? mean + radius : stress.yy;
    const double least = mean - radius < stress.yy ? mean - radius : stress.yy;
    return slope * largest - least <= strength && largest <= tension;
  }
  // k s1 - s3 = (k - 1) mean + sqrt(J2) g(theta), g <= 2 sqrt((k^2 + k + 1)/3) whatever Lode's
  // angle
  const double mean = mean_of(stress), root = std::sqrt(second_invariant(stress));
  const double widest = 2.0 * std::sqrt((slope * slope + slope + 1.0) / 3.0);
  if ((slope - 1.0) * mean + widest * root <= strength &&
      mean + 1.1547005383792517 * root <= tension)
    return true;
  return admits(principal_values(stress));
}

}  // namespace mudlark

#include "materials/mohr_coulomb_surface.hpp"

#include <algorithm>
#include <optional>

namespace mudlark {
namespace {

/// One return, with what all its parts share. A plastic multiplier l of a flow direction b takes
/// D b l from the trial stress, D b = L tr(b) + 2 G b.
struct Return {
  const MohrCoulombSurface& surface;
  double lame, twice_shear;
  PrincipalValues trial;

  double friction(double upper, double lower) const {  ///< k s_i - s_j - q_c
    return surface.slope * upper - lower - surface.strength;
  }
  PrincipalValues less(const PrincipalValues& b) const {
    const double even = lame * (b[0] + b[1] + b[2]);
    return {trial[0] - even - twice_shear * b[0], trial[1] - even - twice_shear * b[1],
            trial[2] - even - twice_shear * b[2]};
  }
  PrincipalValues apex() const { return {surface.tension, surface.tension, surface.tension}; }

  std::optional<PrincipalValues> to_friction() const;
  PrincipalValues to_edge(bool compression) const;
  PrincipalValues to_cutoff() const;
  std::optional<PrincipalValues> to_cutoff_and_friction() const;
};

/// To the plane k s1 - s3 = q_c; to one of its edges where the order of the stresses would change;
/// nothing beyond the apex.
std::optional<PrincipalValues> Return::to_friction() const {
  const double k = surface.slope, m = surface.flow;
  const double stiffness = lame * (k - 1.0) * (m - 1.0) + twice_shear * (k * m + 1.0);
  const double multiplier = friction(trial[0], trial[2]) / stiffness;
  const PrincipalValues s = less({m * multiplier, 0.0, -multiplier});
  if (s[0] >= s[1] && s[1] >= s[2]) return s;
  const PrincipalValues first = to_edge(s[1] > s[0]);
  if (first[0] >= first[1] && first[1] >= first[2]) return first;
  return {};
}

/// Edge s1 = s2 (triaxial compression) or s2 = s3 (extension): two planes flow. Where the stress
/// would leave it for the other side the order of the result is wrong, and the apex is left.
PrincipalValues Return::to_edge(bool compression) const {
  const double k = surface.slope, m = surface.flow;
  const double shared = lame * (k - 1.0) * (m - 1.0);
  const double own = shared + twice_shear * (k * m + 1.0);
  const double other = shared + twice_shear * (compression ? 1.0 : k * m);
  const double f = friction(trial[0], trial[2]);
  const double g = compression ? friction(trial[1], trial[2]) : friction(trial[0], trial[1]);
  const double determinant = own * own - other * other;
  const double a = (own * f - other * g) / determinant, b = (own * g - other * f) / determinant;
  PrincipalValues s = compression ? less({m * a, m * b, -a - b}) : less({m * (a + b), -b, -a});
  // Equal but for round-off.
  if (compression)
    s[0] = s[1] = 0.5 * (s[0] + s[1]);
  else
    s[1] = s[2] = 0.5 * (s[1] + s[2]);
  return s;
}

/// To s1 = t with the cut-off alone, with its line on the Mohr-Coulomb plane, or to their corners.
PrincipalValues Return::to_cutoff() const {
  const double t = surface.tension;
  const double one = (trial[0] - t) / (lame + twice_shear);
  const PrincipalValues face{t, trial[1] - lame * one, trial[2] - lame * one};
  const bool frictional = friction(t, face[2]) > 0.0;
  if (!frictional && face[1] <= t) return face;
  if (frictional)
    if (const auto line = to_cutoff_and_friction()) return *line;
  // s1 = s2 = t
  const double both = (trial[0] + trial[1] - 2.0 * t) / (2.0 * lame + twice_shear);
  const double least = trial[2] - lame * both;
  if (least > t) return apex();
  return {t, t, std::max(least, surface.slope * t - surface.strength)};
}

/// To the line s1 = t, s3 = k t - q_c, where both flow; nothing beyond its end s2 = t.
std::optional<PrincipalValues> Return::to_cutoff_and_friction() const {
  const double t = surface.tension, m = surface.flow;
  const double least = surface.slope * t - surface.strength;
  const double first = trial[0] - t, third = trial[2] - least;
  const double even = lame * (m - 1.0);
  const double determinant = -twice_shear * (2.0 * lame + twice_shear);
  const double plane = (third * (lame + twice_shear) - lame * first) / determinant;
  const double cut =
      ((even - twice_shear) * first - (even + twice_shear * m) * third) / determinant;
  const double middle = trial[1] - even * plane - lame * cut;
  if (middle > t) return {};
  return PrincipalValues{t, std::max(middle, least), least};
}

}  // namespace

MohrCoulombSurface MohrCoulombSurface::from(double cohesion, double tan_friction,
                                            double tan_dilatancy, double tension_cutoff) {
  const double root = std::sqrt(1.0 + tan_friction * tan_friction) + tan_friction;  // sqrt(k)
  const double flow_root = std::sqrt(1.0 + tan_dilatancy * tan_dilatancy) + tan_dilatancy;
  MohrCoulombSurface surface;
  surface.slope = root * root;
  surface.flow = flow_root * flow_root;
  surface.strength = 2.0 * cohesion * root;
  surface.tension = tension_cutoff;
  if (tan_friction > 0.0) surface.tension = std::min(tension_cutoff, cohesion / tan_friction);
  return surface;
}

PrincipalValues returned(const MohrCoulombSurface& surface, const Elasticity& elasticity,
                         const PrincipalValues& trial) {
  const Return from{surface, elasticity.lame, 2.0 * elasticity.shear, trial};
  if (from.friction(trial[0], trial[2]) > 0.0) {
    const auto s = from.to_friction();
    if (s && (*s)[0] <= surface.tension) return *s;
  } else if (trial[0] <= surface.tension) {
    return trial;  // outside by no more than round-off
  }
  return from.to_cutoff();
}

}  // namespace mudlark

#include "materials/drucker_prager.hpp"

#include <algorithm>
#include <cmath>

#include "materials/invariants.hpp"
#include "materials/separation.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 2> names{"plastic shear strain [-]", "separation [-]"};

/// Triaxial cones: A = 6 sin(phi) / (sqrt(3) (3 -+ sin(phi))), - for compression.
double triaxial(double sine, double sign) {
  return 6.0 * sine / (std::sqrt(3.0) * (3.0 - sign * sine));
}

}  // namespace

/// Plane strain: at failure nothing flows out of the plane, so s_yy = -2/3 A' sqrt(J2), and the
/// in-plane circle has the radius sqrt(J2) sqrt(1 - A'^2/3) about p + A' sqrt(J2)/3. Coulomb's
/// radius = c cos(phi) - sin(phi) centre gives A; its angle of dilatancy A' = sin(psi)/sqrt(1 +
/// sin(psi)^2/3). For psi = phi that is the A of Drucker & Prager (1952), for psi = 0 it is
/// sin(phi).
DruckerPragerCone DruckerPragerCone::from(const DruckerPragerOptions& options) {
  const double sine = std::sin(options.friction_angle), flow = std::sin(options.dilatancy_angle);
  DruckerPragerCone cone;
  double per_sine = 1.0;
  if (options.match == DruckerPragerMatch::plane_strain) {
    cone.dilatancy = flow / std::sqrt(1.0 + flow * flow / 3.0);
    per_sine = 1.0 / (std::sqrt(1.0 - cone.dilatancy * cone.dilatancy / 3.0) +
                      cone.dilatancy * sine / 3.0);
  } else {
    const double sign = options.match == DruckerPragerMatch::compression ? 1.0 : -1.0;
    cone.dilatancy = triaxial(flow, sign);
    per_sine = 6.0 / (std::sqrt(3.0) * (3.0 - sign * sine));
  }
  cone.friction = per_sine * sine;
  cone.cohesion = per_sine * options.cohesion * std::cos(options.friction_angle);
  cone.tension = options.tension_cutoff;
  if (cone.friction > 0.0) cone.tension = std::min(cone.tension, cone.cohesion / cone.friction);
  return cone;
}

DruckerPrager::DruckerPrager(const DruckerPragerOptions& options)
    : sine_(std::sin(options.friction_angle)),
      elasticity_(Elasticity::from(options.young_modulus, options.poisson_ratio)),
      cone_(DruckerPragerCone::from(options)) {}

std::span<const std::string_view> DruckerPrager::history_names() const { return names; }

/// On the cone without cohesion, sqrt(J2) = (1 - K0)/sqrt(3) and -p = (1 + 2 K0)/3 per vertical
/// stress.
double DruckerPrager::earth_pressure_at_rest() const {
  if (sine_ <= 0.0) return elasticity_.confined_ratio();
  const double root = std::sqrt(3.0);
  return std::max(1.0 - sine_, (root - cone_.friction) / (root + 2.0 * cone_.friction));
}

std::size_t DruckerPrager::update_stress(const MaterialPoints& points) const {
  const double shear = elasticity_.shear, bulk = elasticity_.bulk();
  const double stiffness = shear + bulk * cone_.friction * cone_.dilatancy;
  std::size_t failed = 0;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    SymTensor strain = points.strain_increment[i];
    double &plastic_shear = points.history[2 * i], &separation = points.history[2 * i + 1];
    if (still_apart(separation, strain)) continue;
    SymTensor& stress = points.stress[i];
    stress += elasticity_.stress(strain);
    const double trial_mean = mean_of(stress), trial_root = std::sqrt(second_invariant(stress));
    const double outside = trial_root + cone_.friction * trial_mean - cone_.cohesion;
    if (outside <= 0.0 && trial_mean <= cone_.tension) continue;
    if (!std::isfinite(outside)) {
      ++failed;
      if (!points.failed.empty()) points.failed[i] = 1;
      continue;
    }
    const double multiplier = std::max(outside, 0.0) / stiffness;
    double root = trial_root - shear * multiplier;
    double mean = trial_mean - bulk * cone_.dilatancy * multiplier;
    if (mean > cone_.tension || root < 0.0) {  // the cut-off, and where it meets the cone
      mean = cone_.tension;
      root = std::min(trial_root, std::max(cone_.cohesion - cone_.friction * mean, 0.0));
    }
    plastic_shear += (trial_root - root) / shear;
    if (mean == 0.0 && root == 0.0) separation = trial_mean / bulk;
    const double left = trial_root > 0.0 ? root / trial_root : 0.0;
    stress = left * stress + (mean - left * trial_mean) * SymTensor::identity();
  }
  return failed;
}

}  // namespace mudlark

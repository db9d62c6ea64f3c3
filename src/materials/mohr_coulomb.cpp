#include "materials/mohr_coulomb.hpp"

#include <cmath>

#include "materials/separation.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 2> names{"plastic shear strain [-]", "separation [-]"};

}  // namespace

MohrCoulomb::MohrCoulomb(const MohrCoulombOptions& options)
    : options_(options),
      elasticity_(Elasticity::from(options.young_modulus, options.poisson_ratio)),
      peak_{options.cohesion, std::tan(options.friction_angle), std::tan(options.dilatancy_angle)},
      first_(MohrCoulombSurface::from(peak_.cohesion, peak_.tan_friction, peak_.tan_dilatancy,
                                      options.tension_cutoff)),
      softens_(options.residual.has_value()) {
  if (softens_)
    last_ = {options.residual->cohesion, std::tan(options.residual->friction_angle),
             std::tan(options.residual->dilatancy_angle)};
}

std::span<const std::string_view> MohrCoulomb::history_names() const { return names; }

double MohrCoulomb::earth_pressure_at_rest() const {
  return options_.friction_angle > 0.0 ? 1.0 - std::sin(options_.friction_angle)
                                       : elasticity_.confined_ratio();
}

MohrCoulombSurface MohrCoulomb::surface_at(double plastic_shear, double length) const {
  if (!softens_ || plastic_shear <= 0.0) return first_;
  const double left = options_.residual->softening.share(plastic_shear, length);
  const auto between = [&](double residual, double peak) {
    return residual + left * (peak - residual);
  };
  return MohrCoulombSurface::from(
      between(last_.cohesion, peak_.cohesion), between(last_.tan_friction, peak_.tan_friction),
      between(last_.tan_dilatancy, peak_.tan_dilatancy), options_.tension_cutoff);
}

/// Plastic engineering shear strain sqrt(2 e:e) of a return, e the deviator of what the elastic
/// strain lost.
double MohrCoulomb::shear_between(const PrincipalValues& trial,
                                  const PrincipalValues& stress) const {
  const PrincipalValues lost{trial[0] - stress[0], trial[1] - stress[1], trial[2] - stress[2]};
  const double a = lost[0] - lost[1], b = lost[1] - lost[2], c = lost[2] - lost[0];
  return std::sqrt(2.0 / 3.0 * (a * a + b * b + c * c)) / (2.0 * elasticity_.shear);
}

/// Return to the surface as it is at the end of the step: g = g_0 + (shear of the return to the
/// surface at g), between no softening and the residual surface, by the Illinois rule.
PrincipalValues MohrCoulomb::soften(const PrincipalValues& trial, double length,
                                    double& plastic_shear) const {
  PrincipalValues stress{};
  const auto excess = [&](double g) {
    stress = returned(surface_at(g, length), elasticity_, trial);
    return plastic_shear + shear_between(trial, stress) - g;
  };
  double lower = plastic_shear, below = excess(lower);
  const double tolerance = 1e-15 + 1e-10 * below;
  double upper = lower + below, above = excess(upper);
  if (above >
      tolerance) {  // weaker than at the start, hence more shear: the residual surface bounds
    lower = upper, below = above;
    const PrincipalValues last =
        returned(surface_at(std::numeric_limits<double>::max(), length), elasticity_, trial);
    upper = plastic_shear + shear_between(trial, last);
    above = excess(upper);
  }
  double g = upper, rest = above;
  for (int i = 0; i < 60 && std::abs(rest) > tolerance; ++i) {
    g = (lower * above - upper * below) / (above - below);
    rest = excess(g);
    if (rest > 0.0)
      lower = g, below = rest, above *= 0.5;
    else
      upper = g, above = rest, below *= 0.5;
  }
  plastic_shear = g;
  return stress;
}

/// Takes a stress outside the surface back to it; false when it is no number.
bool MohrCoulomb::yield(SymTensor& stress, double length, double& plastic_shear,
                        double& separation) const {
  const PrincipalAxes axes(stress);
  const PrincipalValues& trial = axes.values();
  if (!std::isfinite(trial[0]) || !std::isfinite(trial[2])) return false;
  PrincipalValues s;
  if (softens_) {
    s = soften(trial, length, plastic_shear);
  } else {
    s = returned(first_, elasticity_, trial);
    plastic_shear += shear_between(trial, s);
  }
  if (s[0] == 0.0 && s[2] == 0.0)  // nothing holds the grains together
    separation = (trial[0] + trial[1] + trial[2]) / (3.0 * elasticity_.bulk());
  stress = axes.tensor(s);
  return true;
}

std::size_t MohrCoulomb::update_stress(const MaterialPoints& points) const {
  std::size_t failed = 0;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    SymTensor strain = points.strain_increment[i];
    double &plastic_shear = points.history[2 * i], &separation = points.history[2 * i + 1];
    if (still_apart(separation, strain)) continue;
    SymTensor& stress = points.stress[i];
    stress += elasticity_.stress(strain);
    const bool softened = softens_ && plastic_shear > 0.0;
    if ((softened ? surface_at(plastic_shear, points.length) : first_).admits(stress)) continue;
    if (yield(stress, points.length, plastic_shear, separation)) continue;
    ++failed;
    if (!points.failed.empty()) points.failed[i] = 1;
  }
  return failed;
}

}  // namespace mudlark

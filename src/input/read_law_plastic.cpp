/// law = { type = "mohr-coulomb", ... }: laws that yield at a strength of their own.
#include <numbers>

#include "input/sections.hpp"

namespace mudlark {
namespace {

constexpr double degree = std::numbers::pi / 180.0;  // [rad]

/// [rad]
double read_angle(Section& section, std::string_view key, const std::string& reason,
                  const std::string& cure, double largest = 90.0,
                  std::optional<double> fallback = {}) {
  const Bounds bounds{.lower = 0.0,
                      .upper = largest,
                      .upper_included = largest < 90.0,
                      .reason = reason,
                      .cure = cure};
  return degree * section.number(key, quantity::angle, bounds, fallback);
}

double read_friction_angle(Section& section) {
  return read_angle(section, "friction_angle",
                    "an angle of friction lies from 0 to below 90 degrees",
                    "Sand has 28-42 degrees.");
}

double read_dilatancy_angle(Section& section, double friction_angle) {
  const double angle =
      read_angle(section, "dilatancy_angle", "soil that shears does not become denser forever",
                 "Sand has 0-15 degrees; 0 keeps the volume.", 90.0, 0.0);
  if (angle > friction_angle)
    section.fail("dilatancy_angle",
                 "larger than the angle of friction: shearing would set work free",
                 "Often the angle of friction less 30 degrees, and at least 0.");
  return angle;
}

double read_cohesion(Section& section, double friction_angle) {
  const double cohesion = section.number(
      "cohesion", quantity::strength,
      not_negative("strength without confinement is not negative", "Clean sand has 0."), 0.0);
  if (cohesion == 0.0 && friction_angle == 0.0)
    section.fail("cohesion", "soil without cohesion and without friction carries no shear at all",
                 "Give it strength, or write type = \"newtonian\".");
  return cohesion;
}

double read_tension_cutoff(Section& section, const std::string& what) {
  return section
      .number_if_set("tension_cutoff", quantity::strength,
                     not_negative(what + ", tension positive", "Cracked or loose soil has 0."))
      .value_or(std::numeric_limits<double>::infinity());
}

constexpr std::string_view without_softening =
    "needs softening_strain, over which the strength falls";

/// softening_strain and softening_length; nothing without the first, and then `others` are refused.
std::optional<Softening> read_softening(Section& section,
                                        std::initializer_list<std::string_view> others) {
  const auto strain = section.number_if_set(
      "softening_strain", quantity::number,
      positive("the plastic shear strain at which 1/e of the loss is left lies above 0",
               "Often 0.02-0.2."));
  if (!strain) {
    for (const std::string_view key : others)
      if (section.has(key)) section.fail(key, std::string(without_softening));
    if (section.has("softening_length"))
      section.fail("softening_length", std::string(without_softening));
    return {};
  }
  Softening softening;
  softening.strain = *strain;
  softening.length = section
                         .number_if_set("softening_length", quantity::length,
                                        positive("the width of the band that softening_strain was "
                                                 "measured at lies above 0",
                                                 "Shear bands in sand are 10-20 grains wide."))
                         .value_or(0.0);
  return softening;
}

}  // namespace

SoilLawOptions read_mohr_coulomb(Section& section) {
  MohrCoulombOptions law;
  law.young_modulus = read_young_modulus(section);
  law.poisson_ratio = read_poisson_ratio(section);
  law.friction_angle = read_friction_angle(section);
  law.cohesion = read_cohesion(section, law.friction_angle);
  law.dilatancy_angle = read_dilatancy_angle(section, law.friction_angle);
  law.tension_cutoff = read_tension_cutoff(section, "the largest principal stress");
  const auto softening = read_softening(
      section, {"residual_cohesion", "residual_friction_angle", "residual_dilatancy_angle"});
  if (!softening) return law;
  MohrCoulombOptions::Residual last;
  last.softening = *softening;
  last.cohesion = section.number("residual_cohesion", quantity::strength,
                                 {.lower = 0.0,
                                  .upper = law.cohesion,
                                  .reason = "what is left lies between 0 and the cohesion",
                                  .cure = {}},
                                 law.cohesion);
  last.friction_angle = read_angle(section, "residual_friction_angle",
                                   "what is left lies between 0 and the angle of friction", {},
                                   law.friction_angle / degree, law.friction_angle / degree);
  last.dilatancy_angle = read_angle(section, "residual_dilatancy_angle",
                                    "what is left lies between 0 and the angle of dilatancy", {},
                                    law.dilatancy_angle / degree, 0.0);
  law.residual = last;
  return law;
}

namespace {

/// undrained_strength, and residual_strength with softening.
template <class Options>
Options read_undrained(Section& section) {
  Options law;
  law.young_modulus = read_young_modulus(section);
  law.poisson_ratio = read_poisson_ratio(section);
  law.undrained_strength =
      section.number("undrained_strength", quantity::strength,
                     positive("an undrained strength lies above 0", "Soft clay has 5-25 kPa."));
  const auto softening = read_softening(section, {"residual_strength"});
  if (!softening) return law;
  const double left =
      section.number("residual_strength", quantity::strength,
                     {.lower = 0.0,
                      .upper = law.undrained_strength,
                      .reason = "what is left lies between 0 and the undrained strength",
                      .cure = "Remoulded clay keeps a half to a tenth."});
  law.residual = UndrainedResidual{left, *softening};
  return law;
}

}  // namespace

SoilLawOptions read_tresca(Section& section) { return read_undrained<TrescaOptions>(section); }
SoilLawOptions read_von_mises(Section& section) { return read_undrained<VonMisesOptions>(section); }

SoilLawOptions read_drucker_prager(Section& section) {
  DruckerPragerOptions law;
  law.young_modulus = read_young_modulus(section);
  law.poisson_ratio = read_poisson_ratio(section);
  law.friction_angle = read_friction_angle(section);
  law.cohesion = read_cohesion(section, law.friction_angle);
  law.dilatancy_angle = read_dilatancy_angle(section, law.friction_angle);
  law.tension_cutoff = read_tension_cutoff(section, "the largest mean stress");
  law.match =
      section.choice<DruckerPragerMatch>("match",
                                         {{"compression", DruckerPragerMatch::compression},
                                          {"extension", DruckerPragerMatch::extension},
                                          {"plane-strain", DruckerPragerMatch::plane_strain}},
                                         law.match);
  return law;
}

}  // namespace mudlark

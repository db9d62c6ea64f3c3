/// law = { type = "mu-i", ... }: laws whose stress depends on the rate of flow.
#include <algorithm>

#include "input/sections.hpp"

namespace mudlark {

SoilLawOptions read_mu_i(Section& section) {
  MuIOptions law;
  law.young_modulus = read_young_modulus(section);
  law.poisson_ratio = read_poisson_ratio(section);
  law.static_friction =
      section.number("static_friction", quantity::number,
                     {.lower = 0.0,
                      .upper = 1.0,
                      .lower_included = false,
                      .reason = "the friction of slow shear, tau/P, lies above 0 and up to 1",
                      .cure = "Glass beads have 0.38, sand about 0.6."},
                     law.static_friction);
  law.limiting_friction =
      section.number("limiting_friction", quantity::number,
                     {.lower = law.static_friction,
                      .reason = "the friction of fast shear is not less than that of slow shear",
                      .cure = "Glass beads have 0.64."},
                     std::max(law.limiting_friction, law.static_friction));
  law.inertial_number =
      section.number("inertial_number", quantity::number,
                     positive("I_0, at which friction is halfway between its limits, lies above 0",
                              "Glass beads have 0.279."),
                     law.inertial_number);
  law.grain_diameter = section.number("grain_diameter", quantity::length,
                                      positive("a diameter lies above 0", "Sand has 0.1-2 mm."));
  return law;
}

SoilLawOptions read_mu_j(Section& section) {
  MuJOptions law;
  law.young_modulus = read_young_modulus(section);
  law.poisson_ratio = read_poisson_ratio(section);
  law.static_friction =
      section.number("static_friction", quantity::number,
                     {.lower = 0.0,
                      .upper = 1.0,
                      .lower_included = false,
                      .reason = "the friction of slow shear, tau/P, lies above 0 and up to 1",
                      .cure = "Glass beads have 0.32, sand about 0.6."},
                     law.static_friction);
  law.limiting_friction =
      section.number("limiting_friction", quantity::number,
                     {.lower = law.static_friction,
                      .reason = "the friction of fast shear is not less than that of slow shear",
                      .cure = "Glass beads have 0.7."},
                     std::max(law.limiting_friction, law.static_friction));
  law.viscous_number =
      section.number("viscous_number", quantity::number,
                     positive("J_0, at which friction is halfway between its limits, lies above 0",
                              "Glass beads have 0.005."),
                     law.viscous_number);
  law.critical_fraction = section.number(
      "critical_fraction", quantity::number,
      {.lower = 0.0,
       .upper = 1.0,
       .lower_included = false,
       .upper_included = false,
       .reason = "the share of grains in the volume that slow shear tends to lies between 0 and 1",
       .cure = "Glass beads have 0.585: one minus the critical porosity."},
      law.critical_fraction);
  law.dilatancy_coefficient =
      section.number("dilatancy_coefficient", quantity::number,
                     not_negative("denser grains do not contract more",
                                  "Glass beads have 4.09; 0 keeps the volume."),
                     law.dilatancy_coefficient);
  law.grain_diameter = section.number("grain_diameter", quantity::length,
                                      positive("a diameter lies above 0", "Sand has 0.1-2 mm."));
  return law;
}

SoilLawOptions read_newtonian(Section& section) {
  NewtonianOptions law;
  law.bulk_modulus = section.number(
      "bulk_modulus", quantity::stiffness,
      positive("a stiffness lies above 0",
               "Water has 2.15e9 Pa; a wave ten times as fast as the flow is stiff enough."));
  law.viscosity =
      section.number("viscosity", quantity::viscosity,
                     not_negative("a viscosity is not negative", "Water has 1e-3 Pa s."));
  law.tension_cutoff = section.number("tension_cutoff", quantity::strength,
                                      not_negative("the largest mean stress, tension positive",
                                                   "0 lets the liquid part as spray does."),
                                      law.tension_cutoff);
  return law;
}

}  // namespace mudlark

/// law = { type = "...", ... } of a [[soil]]
#include <algorithm>
#include <functional>

#include "input/sections.hpp"
#include "materials/registry.hpp"

namespace mudlark {
namespace {

using LawReader = SoilLawOptions (*)(Section&);

SoilLawOptions read_linear_elastic(Section& section) {
  LinearElasticOptions law;
  law.young_modulus = read_young_modulus(section);
  law.poisson_ratio = read_poisson_ratio(section);
  return law;
}

/// Which strain measures a law can be used with; the first is the default.
StrainMeasure read_strain(Section& section, const SoilLawOptions& options, StrainMeasure fallback,
                          bool nothing_wrong) {
  const auto measure = section.choice<StrainMeasure>("strain",
                                                     {{"hencky", StrainMeasure::hencky},
                                                      {"jaumann", StrainMeasure::jaumann},
                                                      {"log", StrainMeasure::logarithmic},
                                                      {"objective", StrainMeasure::objective},
                                                      {"small", StrainMeasure::small}},
                                                     fallback);
  if (nothing_wrong && !make_soil_model(options)->supports(measure))
    section.fail("strain", "this law cannot be used with that strain measure",
                 "Leave the key out, or write \"jaumann\".");
  return measure;
}

}  // namespace

double read_young_modulus(Section& section) {
  return section.number("young_modulus", quantity::stiffness,
                        positive("a stiffness lies above 0", "Loose sand has about 1e7 Pa."));
}

double read_poisson_ratio(Section& section) {
  return section.number("poisson_ratio", quantity::number,
                        {.lower = -1.0,
                         .upper = 0.5,
                         .lower_included = false,
                         .upper_included = false,
                         .reason = "an isotropic elastic solid needs -1 < nu < 0.5",
                         .cure = "Sand is usually 0.2-0.35."});
}

void read_law(Section& soil, double water_viscosity, SoilBody& body) {
  Section section = soil.table("law", Record::Form::block, true);
  if (!soil.has("law")) return;
  const Report& report = section.reading().report;
  const std::size_t before = report.size();
  const LawReader reader =
      section.choice<LawReader>("type",
                                {{"drucker-prager", &read_drucker_prager},
                                 {"linear-elastic", &read_linear_elastic},
                                 {"modified-cam-clay", &read_modified_cam_clay},
                                 {"mohr-coulomb", &read_mohr_coulomb},
                                 {"mu-i", &read_mu_i},
                                 {"mu-j", &read_mu_j},
                                 {"newtonian", &read_newtonian},
                                 {"sanisand", &read_sanisand},
                                 {"sekiguchi-ohta", &read_sekiguchi_ohta},
                                 {"tresca", &read_tresca},
                                 {"umat", &read_umat},
                                 {"von-mises", &read_von_mises}},
                                {}, {"neo-hookean", "hypoplastic", "bingham"});
  if (reader) body.law = reader(section);
  if (auto* law = std::get_if<SekiguchiOhtaOptions>(&body.law))
    resolve_dilatancy(section, body.porosity, *law);
  if (const auto* law = std::get_if<SanisandOptions>(&body.law))
    check_settled_void_ratio(section, body.porosity, *law);
  if (auto* law = std::get_if<MuIOptions>(&body.law)) law->grain_density = body.grain_density;
  if (auto* law = std::get_if<MuJOptions>(&body.law)) {
    law->grain_density = body.grain_density;
    law->liquid_viscosity = water_viscosity;
  }
  const bool good = report.size() == before;
  const bool yields = good && reader && make_soil_model(body.law)->yields();
  body.strain = read_strain(
      section, body.law, yields ? StrainMeasure::jaumann : StrainMeasure::hencky, good && reader);
  section.finish();
}

}  // namespace mudlark

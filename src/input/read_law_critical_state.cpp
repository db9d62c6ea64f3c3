/// law = { type = "modified-cam-clay", ... }: laws that know void ratio and critical state.
#include <fmt/format.h>

#include <array>
#include <limits>

#include "input/sections.hpp"

namespace mudlark {
namespace {

double read_number(Section& section, std::string_view key, const std::string& reason,
                   const std::string& cure, std::optional<double> fallback = {}) {
  return section.number(key, quantity::number, positive(reason, cure), fallback);
}

/// Below it soil is as stiff as there; nobody knows its stiffness at no stress.
double read_mean_stress_floor(Section& section) {
  return section.number("mean_stress_floor", quantity::pressure,
                        positive("stiffness that falls to nothing cannot be integrated",
                                 "\"0.5 kPa\" is the default."),
                        500.0);
}

void read_indices(Section& section, CriticalStateOptions& law) {
  law.compression_index =
      read_number(section, "compression_index", "lambda, the slope of virgin compression over ln p",
                  "Clay has 0.05-0.5; it is the index C_c of log10 / 2.303.");
  law.swelling_index =
      read_number(section, "swelling_index", "kappa, the slope of swelling over ln p",
                  "Usually a tenth to a third of the compression index.");
  if (law.swelling_index >= law.compression_index)
    section.fail("swelling_index",
                 "not below compression_index: virgin compression would leave no plastic strain",
                 "Usually a tenth to a third of it.");
  law.poisson_ratio = read_poisson_ratio(section);
}

void read_critical_stress_ratio(Section& section, CriticalStateOptions& law) {
  law.critical_stress_ratio =
      section.number("critical_stress_ratio", quantity::number,
                     {.lower = 0.0,
                      .upper = 3.0,
                      .lower_included = false,
                      .upper_included = false,
                      .reason = "M = 6 sin(phi) / (3 - sin(phi)) lies between 0 and 3",
                      .cure = "25 degrees of friction are 0.98."});
}

/// M, or the coefficient of dilatancy D that it follows from.
void read_dilatancy(Section& section, SekiguchiOhtaOptions& law) {
  if (!section.has("dilatancy_coefficient")) return read_critical_stress_ratio(section, law);
  section.forbid("critical_stress_ratio", "follows from dilatancy_coefficient");
  law.dilatancy_coefficient =
      read_number(section, "dilatancy_coefficient", "D, the volume lost per stress ratio",
                  "Clay has 0.02-0.1; or give critical_stress_ratio instead.");
}

void read_overconsolidation(Section& section, CriticalStateOptions& law) {
  law.mean_stress_floor = read_mean_stress_floor(section);
  if (section.has("preconsolidation_pressure")) {
    section.forbid("overconsolidation_ratio", "follows from preconsolidation_pressure");
    law.preconsolidation_pressure =
        section.number("preconsolidation_pressure", quantity::pressure,
                       positive("the clay has carried some pressure before",
                                "Leave it out for overconsolidation_ratio = 1."));
  } else {
    law.overconsolidation_ratio = section.number(
        "overconsolidation_ratio", quantity::number,
        {.lower = 1.0,
         .reason = "the size of the yield surface over that through the initial stress",
         .cure = "1: the clay has never carried more than now."},
        1.0);
  }
}

/// A parameter of SANISAND: needed, unless the case names a sand that has it.
struct SanisandKey {
  std::string_view key;
  double SanisandOptions::*value;
  double lower, upper;
  std::string_view reason;
};
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr std::array<SanisandKey, 15> sanisand_keys{{
    {"shear_coefficient", &SanisandOptions::shear_coefficient, 0.0, unbounded,
     "G_0 of the elastic shear modulus"},
    {"poisson_ratio", &SanisandOptions::poisson_ratio, -1.0, 0.5,
     "an isotropic elastic solid needs -1 < nu < 0.5"},
    {"critical_stress_ratio", &SanisandOptions::critical_stress_ratio, 0.0, 3.0,
     "M = 6 sin(phi) / (3 - sin(phi)) lies between 0 and 3"},
    {"extension_ratio", &SanisandOptions::extension_ratio, 0.6, 1.2,
     "c, M in extension over M in compression; below 0.6 the surface is no longer convex"},
    {"critical_slope", &SanisandOptions::critical_slope, 0.0, unbounded,
     "lambda_c of e_c = e_0 - lambda_c (p/p_at)^xi"},
    {"critical_void_ratio", &SanisandOptions::critical_void_ratio, 0.0, 2.5,
     "e_0 of e_c = e_0 - lambda_c (p/p_at)^xi"},
    {"critical_exponent", &SanisandOptions::critical_exponent, 0.0, 2.0,
     "xi of e_c = e_0 - lambda_c (p/p_at)^xi"},
    {"yield_radius", &SanisandOptions::yield_radius, 0.0, 0.2,
     "m, the half width of the cone within which sand is elastic, is small beside M"},
    {"hardening_coefficient", &SanisandOptions::hardening_coefficient, 0.0, unbounded,
     "h_0 of the plastic modulus"},
    {"hardening_void_ratio", &SanisandOptions::hardening_void_ratio, 0.0, 2.0,
     "c_h of h_0 (1 - c_h e)"},
    {"bounding_exponent", &SanisandOptions::bounding_exponent, 0.0, unbounded,
     "n^b of the bounding surface M exp(-n^b psi)"},
    {"dilatancy_coefficient", &SanisandOptions::dilatancy_coefficient, 0.0, unbounded,
     "A_0 of the dilatancy"},
    {"dilatancy_exponent", &SanisandOptions::dilatancy_exponent, 0.0, unbounded,
     "n^d of the dilatancy surface M exp(n^d psi)"},
    {"largest_fabric", &SanisandOptions::largest_fabric, 0.0, unbounded, "z_max of the fabric"},
    {"fabric_rate", &SanisandOptions::fabric_rate, 0.0, unbounded, "c_z of the fabric"},
}};

}  // namespace

SoilLawOptions read_modified_cam_clay(Section& section) {
  ModifiedCamClayOptions law;
  read_indices(section, law);
  read_critical_stress_ratio(section, law);
  read_overconsolidation(section, law);
  return law;
}

SoilLawOptions read_sekiguchi_ohta(Section& section) {
  SekiguchiOhtaOptions law;
  read_indices(section, law);
  read_dilatancy(section, law);
  law.consolidation_ratio =
      section
          .number_if_set(
              "consolidation_ratio", quantity::number,
              positive("K0 of the virgin consolidation under the vertical stress",
                       "Clay has 0.4-0.7; without the key it is that of initial_stress."))
          .value_or(law.consolidation_ratio);
  read_overconsolidation(section, law);
  return law;
}

void resolve_dilatancy(Section& section, double porosity, SekiguchiOhtaOptions& law) {
  if (law.dilatancy_coefficient == 0.0) return;
  law.critical_stress_ratio =
      (law.compression_index - law.swelling_index) * (1.0 - porosity) / law.dilatancy_coefficient;
  if (law.critical_stress_ratio >= 3.0)
    section.fail("dilatancy_coefficient",
                 fmt::format("the critical stress ratio M = (compression_index - swelling_index) "
                             "(1 - porosity) / D would be {:.3g}, and lies below 3",
                             law.critical_stress_ratio),
                 "Clay has 0.02-0.1; or give critical_stress_ratio instead.");
}

void check_settled_void_ratio(Section& section, double porosity, const SanisandOptions& law) {
  const double start = porosity / (1.0 - porosity);
  if (law.settled_void_ratio >= start)
    section.fail("settled_void_ratio",
                 fmt::format("not below the void ratio of the start, n/(1-n) = {:.3f}: sand that "
                             "liquefies settles to a denser state",
                             start),
                 "It is usually 0.02-0.1 smaller; without the key the sand keeps its structure.");
}

SoilLawOptions read_sanisand(Section& section) {
  std::optional<SanisandOptions> sand;
  if (section.has("sand"))
    sand =
        section.choice<SanisandOptions (*)()>("sand", {{"toyoura", &SanisandOptions::toyoura}})();
  SanisandOptions law;
  for (const SanisandKey& key : sanisand_keys)
    law.*key.value =
        section.number(key.key, quantity::number,
                       {.lower = key.lower,
                        .upper = key.upper,
                        .lower_included = false,
                        .upper_included = false,
                        .reason = std::string(key.reason),
                        .cure = "sand = \"toyoura\" has values for all of them."},
                       sand ? std::optional<double>((*sand).*key.value) : std::nullopt);
  law.reference_pressure =
      section.number("reference_pressure", quantity::pressure,
                     positive("the pressure that the parameters were fitted with"), 1e5);
  law.mean_stress_floor = read_mean_stress_floor(section);
  law.settled_void_ratio =
      section
          .number_if_set("settled_void_ratio", quantity::number,
                         positive("the void ratio of sand that has liquefied and settled",
                                  "It lies below that of the start; without the key liquefied sand "
                                  "keeps its void ratio until water drains from it."))
          .value_or(0.0);
  return law;
}

}  // namespace mudlark

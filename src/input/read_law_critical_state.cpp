/// law = { type = "modified-cam-clay", ... }: laws that know void ratio and critical state.
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
  law.critical_stress_ratio =
      section.number("critical_stress_ratio", quantity::number,
                     {.lower = 0.0,
                      .upper = 3.0,
                      .lower_included = false,
                      .upper_included = false,
                      .reason = "M = 6 sin(phi) / (3 - sin(phi)) lies between 0 and 3",
                      .cure = "25 degrees of friction are 0.98."});
  law.poisson_ratio = read_poisson_ratio(section);
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

}  // namespace

SoilLawOptions read_modified_cam_clay(Section& section) {
  ModifiedCamClayOptions law;
  read_indices(section, law);
  read_overconsolidation(section, law);
  return law;
}

}  // namespace mudlark

/// relative_permeability, suction and initial_saturation of [[soil]] and [[porous]].
#include <fmt/format.h>

#include "input/sections.hpp"

namespace mudlark {

PoreFilling read_pore_filling(Section& section, PoreFilling fallback, bool has_curve) {
  PoreFilling filling = fallback;
  const bool given = section.has("relative_permeability");
  if (given || has_curve) {
    Section curve = section.table("relative_permeability", Record::Form::inline_table);
    filling.curve = curve.choice<PermeabilityCurve>(
        "type",
        {{"power", PermeabilityCurve::power}, {"van-genuchten", PermeabilityCurve::van_genuchten}},
        given ? std::nullopt : std::optional(PermeabilityCurve::power));
    if (filling.curve == PermeabilityCurve::van_genuchten)
      filling.exponent = curve.number("n", quantity::number,
                                      {.lower = 1.0,
                                       .lower_included = false,
                                       .reason = "van Genuchten's n lies above 1 (m = 1 - 1/n)",
                                       .cure = "Clay has about 1.1, loam 1.5, sand 2 to 4."});
    else
      filling.exponent = curve.number(
          "exponent", quantity::number,
          {.lower = 1.0,
           .reason = "k_r = S^exponent; below 1 the water would be faster the less there is",
           .cure = "Usual is 3."},
          fallback.exponent);
    if (filling.curve == PermeabilityCurve::van_genuchten)
      curve.forbid("exponent", "it belongs to type = \"power\"");
    else
      curve.forbid("n", "it belongs to type = \"van-genuchten\"");
    filling.residual = curve.number(
        "residual_saturation", quantity::number,
        {.lower = 0.0,
         .upper = 0.9,
         .reason = "the share of the pores whose water does not drain; what is left is to drain",
         .cure = "Sand has about 0.05 to 0.2, loam 0.2 to 0.4."},
        0.0);
    curve.finish();
  }
  filling.suction = section.number(
      "suction", quantity::pressure,
      not_negative("what the surface of the water in the pores holds against the air",
                   "Fine sand has 1 to 5 kPa: 0.1 to 0.5 m of water."),
      0.0);
  const double full = 0.5 * (1.0 + filling.residual);
  filling.at_start =
      section.number("initial_saturation", quantity::number,
                     {.lower = 0.0,
                      .upper = full,
                      .upper_included = false,
                      .reason = fmt::format(
                          "pores are filled so far outside of the bodies of water; from {:g} on, "
                          "half of what drains, they count as full",
                          full),
                      .cure = "Put a [[water.body]] where pores are full."},
                     filling.residual);
  return filling;
}

}  // namespace mudlark

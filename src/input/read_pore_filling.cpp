/// relative_permeability and suction of [[soil]] and [[porous]].
#include "input/sections.hpp"

namespace mudlark {

PoreFilling read_pore_filling(Section& section, PoreFilling fallback) {
  PoreFilling filling = fallback;
  if (section.has("relative_permeability")) {
    Section curve = section.table("relative_permeability", Record::Form::inline_table);
    filling.curve = curve.choice<PermeabilityCurve>(
        "type",
        {{"power", PermeabilityCurve::power}, {"van-genuchten", PermeabilityCurve::van_genuchten}});
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
    curve.finish();
  }
  filling.suction = section.number(
      "suction", quantity::pressure,
      not_negative("what the surface of the water in the pores holds against the air",
                   "Fine sand has 1 to 5 kPa: 0.1 to 0.5 m of water."),
      0.0);
  return filling;
}

}  // namespace mudlark

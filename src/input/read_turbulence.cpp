/// [water.turbulence]
#include "input/sections.hpp"

namespace mudlark {

TurbulenceOptions read_turbulence(Section& water) {
  TurbulenceOptions out;
  const bool given = water.has("turbulence");
  const std::size_t mistakes = water.reading().report.size();
  Section section = water.table("turbulence", Record::Form::block);
  out.model = section.choice<TurbulenceModel>("model",
                                              {{"none", TurbulenceModel::none},
                                               {"smagorinsky", TurbulenceModel::smagorinsky},
                                               {"k-epsilon", TurbulenceModel::k_epsilon}},
                                              given ? std::nullopt : std::optional(out.model));
  if (water.reading().report.size() > mistakes) return out;  // the rest depends on the model
  if (out.model == TurbulenceModel::smagorinsky)
    out.constant = section.number("constant", quantity::number,
                                  {.lower = 0.0,
                                   .upper = 1.0,
                                   .lower_included = false,
                                   .reason = "eddies are smaller than the cells that filter them",
                                   .cure = "Usual are 0.1 to 0.2."},
                                  out.constant);
  else
    section.forbid("constant", "it belongs to model = \"smagorinsky\"");
  if (out.model == TurbulenceModel::k_epsilon) {
    out.initial_k = section.number("initial_energy", quantity::specific_energy,
                                   positive("k-epsilon cannot grow turbulence from none",
                                            "Leave it out for water nearly at rest."),
                                   out.initial_k);
    out.initial_viscosity_ratio = section.number(
        "initial_viscosity_ratio", quantity::number,
        positive("eddy viscosity at the start over that of water"), out.initial_viscosity_ratio);
  } else {
    for (const char* key : {"initial_energy", "initial_viscosity_ratio"})
      section.forbid(key, "it belongs to model = \"k-epsilon\"");
  }
  section.finish();
  return out;
}

}  // namespace mudlark

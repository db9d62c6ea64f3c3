/// [water] and [[water.body]]
#include <fmt/format.h>

#include "input/sections.hpp"

namespace mudlark {
namespace {

void read_bodies(Section& water, FlowOptions& flow) {
  for (Section& body : water.tables("body")) {
    WaterBody out;
    if (auto shape = read_shape(body, "shape")) out.shape = *shape;
    body.choice<bool>("pressure", {{"hydrostatic", true}}, true);
    out.velocity = body.varying_per_axis("velocity", quantity::velocity);
    body.finish();
    flow.bodies.push_back(std::move(out));
  }
}

/// air = "gas" and its properties; nothing for a void.
std::optional<Gas> read_air(Section& water, double water_density) {
  const bool gas = water.choice<bool>("air", {{"void", false}, {"gas", true}}, false);
  if (!gas) {
    for (const char* key : {"air_density", "air_viscosity", "air_bulk_modulus", "air_velocity"})
      water.forbid(key, "it belongs to air = \"gas\"; a void has no such property");
    return {};
  }
  if (!water.has("body"))
    water.fail("air", "gas flows with water, but there is no [[water.body]]",
               "Leave out air, or place water.");
  std::optional<Gas> out(std::in_place);
  out->density = water.number("air_density", quantity::density,
                              {.lower = 0.0,
                               .upper = water_density,
                               .lower_included = false,
                               .reason = "the gas has mass, and less than the water",
                               .cure = "Air has 1.2 kg/m3."},
                              out->density);
  out->viscosity = water.number(
      "air_viscosity", quantity::viscosity,
      positive("a dynamic viscosity lies above 0", "Air has 1.8e-5 Pa s."), out->viscosity);
  out->bulk_modulus = water.number_if_set(
      "air_bulk_modulus", quantity::stiffness,
      positive("a bulk modulus lies above 0",
               "Air in quick compression has 1.4 times its pressure: 142 kPa."));
  out->velocity = water.varying_per_axis("air_velocity", quantity::velocity);
  return out;
}

}  // namespace

WaterProperties read_water(Section& root, CaseOptions& options) {
  WaterProperties water;
  if (!root.has("water")) return water;
  Section section = root.table("water", Record::Form::block);
  water.density = section.number("density", quantity::density,
                                 positive("a density lies above 0", "Fresh water has 1000 kg/m3."),
                                 water.density);
  water.viscosity = section.number(
      "viscosity", quantity::viscosity,
      positive("a dynamic viscosity lies above 0", "Water of 20 degrees has 1.002e-3 Pa s."),
      water.viscosity);
  water.bulk_modulus = section.number_if_set(
      "bulk_modulus", quantity::stiffness,
      positive("a bulk modulus lies above 0", "Pure water has 2.15e9 Pa, less with bubbles."));
  std::optional<Gas> gas = read_air(section, water.density);
  if (section.has("body")) {
    FlowOptions flow;
    flow.density = water.density;
    flow.viscosity = water.viscosity;
    flow.gas = std::move(gas);
    flow.turbulence = read_turbulence(section);
    if (flow.turbulence.model == TurbulenceModel::k_epsilon) flow.wall_law = WallLaw::logarithmic;
    read_bodies(section, flow);
    options.flow = std::move(flow);
  } else if (section.has("turbulence"))
    section.fail("turbulence", "it belongs to flowing water, but there is no [[water.body]]",
                 "Leave it out, or place water.");
  section.finish();
  return water;
}

}  // namespace mudlark

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
  section.choice<bool>("air", {{"void", true}}, true, {"gas"});
  if (section.has("body")) {
    FlowOptions flow;
    flow.density = water.density;
    flow.viscosity = water.viscosity;
    read_bodies(section, flow);
    options.flow = std::move(flow);
  }
  section.finish();
  return water;
}

}  // namespace mudlark

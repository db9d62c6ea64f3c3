/// What pore_water = "unified" goes with: checked when all of the case is read.
#include <fmt/format.h>

#include <algorithm>

#include "input/sections.hpp"

namespace mudlark {
namespace {

bool is_unified(const SoilBody& body) { return body.pore_water == PoreWater::unified; }

/// Soils and coupling must say the same.
bool agree(Section& root, const CaseOptions& options) {
  Report& report = root.reading().report;
  const bool unified = options.coupling.mode == CouplingMode::unified;
  const auto& bodies = options.soil->bodies;
  const auto other = std::find_if(bodies.begin(), bodies.end(), [&](const SoilBody& body) {
    return is_unified(body) != unified;
  });
  if (other == bodies.end()) return unified;
  if (unified)
    report.add(root.place("coupling"),
               fmt::format("coupling.mode = \"unified\" needs pore_water = \"unified\" in every "
                           "[[soil]], and soil \"{}\" has another",
                           other->name));
  else
    report.add(
        root.place("soil"),
        fmt::format("soil \"{}\" has pore_water = \"unified\", whose water is the flow's\n  (it "
                    "needs a [[water.body]] and coupling.mode = \"unified\").",
                    other->name));
  return false;
}

/// Settings of the soil that have no meaning, or none yet, with one water.
std::vector<std::string> excluded(const CaseOptions& options) {
  const SoilOptions& soil = *options.soil;
  std::vector<std::string> words;
  const auto no = [&](bool there, const char* what) {
    if (there) words.emplace_back(what);
  };
  no(takes_implicit_steps(soil), "soil_solver.method = \"implicit\"");
  no(options.flow && options.flow->gas, "water.air = \"gas\"");
  no(options.flow && !options.flow->sides.empty(), "[[opening]], or a [[wave]] at a side,");
  no(!soil.boundaries.empty(), "[[boundary]]");
  no(!soil.stages.empty(), "[[stage]]");
  no(soil.start_in_equilibrium.has_value(), "soil_solver.start_in_equilibrium");
  no(soil.stop_when_static.has_value(), "soil_solver.stop_when_static");
  no(soil.damping > 0.0 || soil.water_damping.value_or(0.0) > 0.0, "soil_solver.damping");
  no(soil.mass_scaling != 1.0, "soil_solver.mass_scaling");
  no(soil.load_form != LoadForm::virtual_stress, "soil_solver.load_form = \"facets\"");
  no(soil.kernel == Kernel::linear, "soil_solver.kernel = \"linear\"");
  no(soil.body_acceleration.has_value(), "soil_solver.body_acceleration");
  no(options.flow && options.flow->body_acceleration.has_value(),
     "flow_solver.body_acceleration, which the grains would not feel,");
  const auto dimension = static_cast<std::size_t>(options.domain.dimension);
  for (std::size_t a = 0; a < dimension; ++a)
    for (std::size_t side = 0; side < 2; ++side) {
      const Wall wall = options.domain.walls[a][side];
      no(wall == Wall::friction, "a wall of type \"friction\"");
      no(wall == Wall::open && !(a == dimension - 1 && side == 1),
         "an \"open\" wall other than the upper one");
    }
  return words;
}

}  // namespace

void check_unified(Section& root, CaseOptions& options) {
  if (!options.soil || !agree(root, options)) return;
  Report& report = root.reading().report;
  for (const std::string& what : excluded(options))
    report.add(root.place("coupling"),
               fmt::format("coupling.mode = \"unified\" does not go with {} yet", what));
  const auto& bodies = options.soil->bodies;
  for (const SoilBody& body : bodies)
    if (body.grain_density != bodies.front().grain_density)
      report.add(
          root.place("soil"),
          fmt::format("with coupling.mode = \"unified\" all soils have grains of one density, "
                      "and soil \"{}\" has {:g} kg/m3, soil \"{}\" {:g} kg/m3",
                      body.name, body.grain_density, bodies.front().name,
                      bodies.front().grain_density));
  for (const SoilBody& body : bodies)
    if (body.grain_diameter != bodies.front().grain_diameter)
      report.add(root.place("soil"),
                 fmt::format("with coupling.mode = \"unified\" all soils have one grain_diameter, "
                             "or none has any, and soil \"{}\" differs from soil \"{}\"",
                             body.name, bodies.front().name));
  if (options.flow)
    for (const WaterBody& water : options.flow->bodies)
      options.soil->flooded.push_back(water.shape);
}

}  // namespace mudlark

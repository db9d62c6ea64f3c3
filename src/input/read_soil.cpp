/// [[soil]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/sections.hpp"
#include "materials/registry.hpp"

namespace mudlark {
namespace {

/// Points per cell and axis.
constexpr int most_per_axis = 6;

/// As many points per cell and axis as keep them at most `point_spacing` apart.
int read_point_spacing(Section& section, int fallback) {
  section.forbid("points_per_cell", "point_spacing says how many points there are");
  const double spacing = section.number_unrecorded("point_spacing", quantity::length,
                                                   positive("points stand some distance apart"));
  const auto& cell = section.reading().spacing;
  const double widest = *std::max_element(cell.begin(), cell.end());
  if (!(spacing > 0.0) || !(widest > 0.0)) return fallback;
  const auto per_axis = static_cast<int>(std::ceil(widest / spacing * (1.0 - 1e-9)));
  if (per_axis < 2 || per_axis > most_per_axis)
    section.fail("point_spacing",
                 fmt::format("cells are {:g} m wide and take 2 to {} points along each axis",
                             widest, most_per_axis),
                 fmt::format("Write a spacing from {:.3g} to {:.3g} m, or change the cells.",
                             widest / most_per_axis, widest / 2));
  const int dimension = section.reading().dimension;
  const auto points = static_cast<int>(std::lround(std::pow(per_axis, dimension)));
  section.record().value("points_per_cell", fmt::format("{}", points));
  return points;
}

int read_points_per_cell(Section& section) {
  const int dimension = section.reading().dimension;
  const int fallback = dimension == 2 ? 4 : 8;
  if (section.has("point_spacing")) return read_point_spacing(section, fallback);
  const std::string possible = dimension == 2 ? "4, 9, 16, 25 or 36" : "8, 27, 64, 125 or 216";
  const Bounds bounds{.lower = static_cast<double>(fallback),
                      .upper = std::pow(most_per_axis, dimension),
                      .reason = "points stand in rows: " + possible};
  const int points = section.integer("points_per_cell", bounds, fallback);
  const auto per_axis = static_cast<int>(std::lround(std::pow(points, 1.0 / dimension)));
  if (static_cast<int>(std::lround(std::pow(per_axis, dimension))) != points)
    section.fail("points_per_cell", bounds.reason);
  return points;
}

GeostaticStress read_geostatic(Section& section) {
  GeostaticStress stress;
  section.choice<bool>("type", {{"geostatic", true}});
  const auto lateral = section.number_if_set(
      "lateral_coefficient", quantity::number,
      not_negative("the ratio of horizontal to vertical effective stress", "Often nu/(1-nu)."));
  stress.lateral_coefficient = lateral.value_or(stress.lateral_coefficient);
  return stress;
}

StressField read_stress_field(Section& section) {
  StressField stress;
  constexpr std::array<std::string_view, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
  for (const std::size_t c : {0, 1, 2, 5, 3, 4})
    if (section.reading().dimension == 3 || (names[c] != "xy" && names[c] != "yz"))
      stress.component[c] = section.varying(names[c], quantity::stress, {}, 0.0);
  return stress;
}

/// "zero", "geostatic", { type = "geostatic", ... } or components.
void read_initial_stress(Section& soil, SoilBody& body) {
  const Value* value = soil.raw("initial_stress");
  const auto* word = value ? std::get_if<std::string>(&value->data) : nullptr;
  const auto* table = value ? std::get_if<Table>(&value->data) : nullptr;
  if (!value || (word && *word == "zero")) {
    soil.record().value("initial_stress", "\"zero\"");
  } else if (word && *word == "geostatic") {
    body.initial_stress = GeostaticStress{};
    soil.record().value("initial_stress", "\"geostatic\"");
  } else if (table) {
    Record& record =
        soil.record().child("initial_stress", Record::Form::inline_table, quantity::stress.unit);
    Section section = soil.over(*table, soil.place("initial_stress"), "initial_stress", record);
    if (find_entry(*table, "type"))
      body.initial_stress = read_geostatic(section);
    else
      body.initial_stress = read_stress_field(section);
    section.finish();
  } else {
    soil.fail(
        "initial_stress",
        "expected \"zero\", \"geostatic\", { type = \"geostatic\", lateral_coefficient = 0.5 } or "
        "effective stresses { xx = ..., yy = ..., zz = ... }, tension positive");
  }
}

/// K0 that the law gives where nothing else is written, for the reader of the resolved case.
void remark_lateral(Section& section, const SoilBody& body) {
  const auto* geostatic = std::get_if<GeostaticStress>(&body.initial_stress);
  if (!geostatic || geostatic->lateral_coefficient >= 0.0 || !section.reading().report.empty())
    return;
  section.record().remark(
      fmt::format("lateral_coefficient = {:.6g} of \"geostatic\", that of the law",
                  make_soil_model(body.law)->earth_pressure_at_rest()));
}

/// How grains and pore water of all soils move: they share the grid.
void read_formulation(Section& section, const WaterProperties& water, SoilOptions& soil) {
  const Formulation formulation = section.choice<Formulation>(
      "formulation",
      {{"u-w", Formulation::u_w}, {"u-w-p", Formulation::u_w_p}, {"u-p", Formulation::u_p}},
      Formulation::u_w);
  const auto other = std::find_if(soil.bodies.begin(), soil.bodies.end(), [](const SoilBody& body) {
    return body.pore_water == PoreWater::two_phase;
  });
  if (other != soil.bodies.end() && formulation != soil.formulation)
    section.fail("formulation",
                 fmt::format("all soils with pore water share one formulation, and soil \"{}\" has "
                             "another",
                             other->name),
                 "Write the same into each [[soil]].");
  soil.formulation = formulation;
  if (formulation == Formulation::u_w_p) {
    constexpr double incompressible = std::numeric_limits<double>::infinity();
    soil.water_bulk_modulus = water.bulk_modulus.value_or(incompressible);
  } else if (!water.bulk_modulus) {
    const std::string reason =
        fmt::format("formulation {} needs compressible pore water: water.bulk_modulus is missing",
                    formulation == Formulation::u_w ? "u-w" : "u-p");
    const std::string cure =
        "Write bulk_modulus under [water], for example \"2.15e9 Pa\", or formulation = \"u-w-p\".";
    if (section.has("pore_water"))
      section.fail("pore_water", reason, cure);
    else
      section.missing("pore_water", "it is \"two-phase\" then, and " + reason + ". " + cure);
  }
}

/// Of pore water and grains: by permeability, or by the diameter of the grains.
void read_drag(Section& section, SoilBody& body, const WaterProperties& water) {
  if (!section.has("grain_diameter")) {
    body.intrinsic_permeability = read_permeability(section, water.density, water.viscosity,
                                                    body.pore_water != PoreWater::none)
                                      .value_or(0.0);
    return;
  }
  if (body.pore_water != PoreWater::unified)
    section.fail("grain_diameter", "drag by the size of grains needs pore_water = \"unified\"",
                 "Write hydraulic_conductivity, or intrinsic_permeability.");
  for (const char* key : {"hydraulic_conductivity", "intrinsic_permeability"})
    section.forbid(key, "grain_diameter says how the grains resist");
  body.grain_diameter = section.number("grain_diameter", quantity::length,
                                       positive("a diameter lies above 0", "Sand has 0.1-2 mm."));
  const double grains = 1.0 - body.porosity;
  body.intrinsic_permeability = body.porosity * body.porosity * body.porosity *
                                body.grain_diameter * body.grain_diameter /
                                (150.0 * grains * grains);
  section.record().remark(
      fmt::format("intrinsic_permeability = {:.6g} m2 at the start", body.intrinsic_permeability));
}

void read_pore_water(Section& section, SoilBody& body, const WaterProperties& water,
                     SoilOptions& soil) {
  const std::size_t mistakes = section.reading().report.size();
  body.pore_water = section.choice<PoreWater>("pore_water",
                                              {{"two-phase", PoreWater::two_phase},
                                               {"none", PoreWater::none},
                                               {"unified", PoreWater::unified}},
                                              body.pore_water);
  const bool unknown = section.reading().report.size() > mistakes;
  const bool wet = body.pore_water == PoreWater::two_phase;
  const bool unified = body.pore_water == PoreWater::unified;
  if (unified)
    soil.water_bulk_modulus = water.bulk_modulus.value_or(std::numeric_limits<double>::infinity());
  if (unknown)
    section.raw("formulation");
  else if (wet)
    read_formulation(section, water, soil);
  else
    section.forbid("formulation", unified ? "pore_water = \"unified\" has one: that of the flow"
                                          : "pore_water = \"none\" has no pore water to formulate");
  read_drag(section, body, water);
  if (body.grain_diameter > 0.0)
    section.forbid("permeability_law", "grain_diameter says how the grains resist");
  else
    body.permeability_law =
        section.choice<PermeabilityLaw>("permeability_law",
                                        {{"constant", PermeabilityLaw::constant},
                                         {"kozeny-carman", PermeabilityLaw::kozeny_carman}},
                                        body.permeability_law);
  if (unified)
    body.filling = read_pore_filling(section, body.filling, true);
  else
    for (const char* key : {"relative_permeability", "suction", "initial_saturation"})
      section.forbid(key, "pores that are not full are known with pore_water = \"unified\"");
  if (section.has("initial_pore_pressure")) {
    if (wet)
      body.initial_pore_pressure = section.varying("initial_pore_pressure", quantity::pressure, {});
    else
      section.forbid("initial_pore_pressure",
                     unified ? "the pressure at the start is that of the flow's water at rest"
                             : "pore_water = \"none\" has no pore pressure");
  }
}

}  // namespace

void read_soil(Section& root, CaseOptions& options, const WaterProperties& water,
               const std::vector<Stage>& stages, std::vector<NamedShape>& grounds) {
  std::vector<Section> sections = root.tables("soil");
  if (sections.empty()) return;
  SoilOptions soil;
  soil.water_density = water.density;
  soil.water_viscosity = water.viscosity;
  soil.water_bulk_modulus = water.bulk_modulus.value_or(soil.water_bulk_modulus);
  std::vector<std::string> names;
  for (Section& section : sections) {
    SoilBody body;
    body.name = read_name(section, names);
    const auto shape = read_shape(section, "shape");
    body.stage = read_stage_of_soil(section, stages);
    if (body.stage > 0 && options.flow)
      section.fail("stage",
                   "flowing water would be where the soil is placed: [[water.body]] "
                   "excludes it");
    body.grain_density = section.number(
        "grain_density", quantity::density,
        positive("a density lies above 0", "Quartz has 2650 kg/m3."), body.grain_density);
    const Value* pore_water = section.raw("pore_water");
    const auto* word = pore_water ? std::get_if<std::string>(&pore_water->data) : nullptr;
    body.porosity =
        section.number("porosity", quantity::number,
                       {.lower = 0.0,
                        .upper = 1.0,
                        .lower_included = word && *word == "none",
                        .upper_included = false,
                        .reason = "the share of pores in the volume lies between 0 and 1",
                        .cure = "Sand has 0.35-0.45."});
    body.points_per_cell = read_points_per_cell(section);
    read_pore_water(section, body, water, soil);
    read_initial_stress(section, body);
    body.initial_velocity = section.varying_per_axis("initial_velocity", quantity::velocity);
    read_law(section, water.viscosity, body);
    remark_lateral(section, body);
    section.finish();
    if (shape) {
      body.shape = *shape;
      grounds.push_back(
          {fmt::format("soil \"{}\"", body.name), *shape, section.place("shape"), body.stage});
    }
    soil.bodies.push_back(std::move(body));
  }
  if (std::all_of(soil.bodies.begin(), soil.bodies.end(),
                  [](const SoilBody& body) { return body.stage > 0; }))
    sections.front().fail("stage", "no soil is there at the start",
                          "Give at least one [[soil]] no stage, or the first one.");
  options.soil = std::move(soil);
}

}  // namespace mudlark

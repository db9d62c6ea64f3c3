/// [[gauge]]
#include <fmt/format.h>

#include <algorithm>

#include "input/sections.hpp"

namespace mudlark {
namespace {

enum class Of { water, soil, both, solid };

struct Kind {
  GaugeQuantity quantity;
  std::string_view name;
  Of of;
  bool has_place;
};

constexpr std::array<Kind, 24> kinds{{
    {GaugeQuantity::water_level, "water_level", Of::water, true},
    {GaugeQuantity::pressure, "pressure", Of::water, true},
    {GaugeQuantity::velocity, "velocity", Of::water, true},
    {GaugeQuantity::front, "front", Of::water, false},
    {GaugeQuantity::total_water, "total_water", Of::water, false},
    {GaugeQuantity::kinetic_energy, "kinetic_energy", Of::both, false},
    {GaugeQuantity::momentum, "momentum", Of::both, false},
    {GaugeQuantity::max_speed, "max_speed", Of::water, false},
    {GaugeQuantity::section_flux, "section_flux", Of::water, false},
    {GaugeQuantity::overtopping, "overtopping", Of::water, false},
    {GaugeQuantity::run_up, "run_up", Of::water, false},
    {GaugeQuantity::energy, "energy", Of::water, false},
    {GaugeQuantity::settlement, "settlement", Of::soil, true},
    {GaugeQuantity::displacement, "displacement", Of::soil, true},
    {GaugeQuantity::pore_pressure, "pore_pressure", Of::soil, true},
    {GaugeQuantity::effective_stress, "effective_stress", Of::soil, true},
    {GaugeQuantity::point_porosity, "point_porosity", Of::soil, true},
    {GaugeQuantity::solid_force, "solid_force", Of::solid, false},
    {GaugeQuantity::solid_moment, "solid_moment", Of::solid, false},
    {GaugeQuantity::solid_displacement, "solid_displacement", Of::solid, false},
    {GaugeQuantity::solid_rotation, "solid_rotation", Of::solid, false},
    {GaugeQuantity::solid_velocity, "solid_velocity", Of::solid, false},
    {GaugeQuantity::solid_collision, "solid_collision", Of::solid, false},
    {GaugeQuantity::discharge, "discharge", Of::soil, false},
}};

const Kind& kind_of(GaugeQuantity quantity) {
  return *std::find_if(kinds.begin(), kinds.end(),
                       [&](const Kind& kind) { return kind.quantity == quantity; });
}

/// Soil within a cell of the gauge: a gauge may stand exactly on a body's edge.
bool near_soil(const Reading& reading, const SoilOptions& soil, const Point3& at) {
  Point3 lower = at, upper = at;
  for (std::size_t a = 0; a < 3; ++a) {
    const double reach = std::max(0.5 * reading.spacing[a], 1e-12);
    lower[a] -= reach, upper[a] += reach;
  }
  return std::any_of(soil.bodies.begin(), soil.bodies.end(), [&](const SoilBody& body) {
    return fraction_inside(body.shape, lower, upper, reading.dimension) > 0.0;
  });
}

/// Pressure and velocity are measured in water, not in a body.
void check_not_in_solid(Section& section, const CaseOptions& options, const GaugeOptions& gauge) {
  if (gauge.quantity != GaugeQuantity::pressure && gauge.quantity != GaugeQuantity::velocity)
    return;
  for (const FlowSolid& solid : options.flow->solids)
    if (std::holds_alternative<FixedSolid>(solid.motion) &&
        distance_to(solid.shape, gauge.at).distance < 0.0)
      return section.fail("at",
                          fmt::format("the gauge stands inside the solid \"{}\", where there "
                                      "is no water",
                                      solid.name),
                          "Put it on the surface or into the water.");
}

/// False with a message when the gauge cannot measure there.
void read_place(Section& section, const CaseOptions& options, const Kind& kind,
                GaugeOptions& gauge) {
  const Reading& reading = section.reading();
  const auto axes = static_cast<std::size_t>(reading.dimension);
  const auto at = section.numbers("at", quantity::length, axes);
  if (at.size() != axes) return;
  gauge.at = point_from_axes(at);
  if (!reading.domain) return;
  for (std::size_t a = 0; a < 3; ++a) {
    const double slack = 1e-9 * (reading.domain->upper[a] - reading.domain->lower[a]);
    if (gauge.at[a] < reading.domain->lower[a] - slack ||
        gauge.at[a] > reading.domain->upper[a] + slack)
      return section.fail("at", "the gauge stands outside the domain");
  }
  if (kind.of == Of::soil && options.soil && reading.report.empty() &&
      !near_soil(reading, *options.soil, gauge.at))
    section.fail("at", "no soil starts there, and this gauge follows soil");
  if (options.flow) check_not_in_solid(section, options, gauge);
}

/// of = "NAME" of a rigid body.
void read_solid_name(Section& section, const CaseOptions& options, GaugeOptions& gauge) {
  Section::Words names;
  std::vector<std::string> led;  // those whose motion is given
  const auto add = [&](const auto& solids) {
    for (const auto& solid : solids) {
      names.push_back(solid.name);
      if (!std::holds_alternative<FreeSolid>(solid.motion)) led.push_back(solid.name);
    }
  };
  if (options.soil)
    add(options.soil->solids);
  else if (options.flow)
    add(options.flow->solids);
  if (names.empty()) {
    section.has("of");
    return section.fail("quantity", "it measures a rigid body, and the case has no [[solid]]");
  }
  std::vector<Choice<std::string>> choices;
  for (const std::string& name : names) choices.push_back({name, name});
  gauge.of = section.choice<std::string>("of", choices);
  if (gauge.quantity == GaugeQuantity::solid_collision &&
      std::find(led.begin(), led.end(), gauge.of) != led.end())
    section.fail("of", "collisions are measured on free bodies, and its motion is given",
                 "Name the free body that meets it: it gets the opposite force.");
}

/// of = "NAME" of a boundary that says something of pore water. Where there are mistakes already it
/// may be what it says that is wrong: the gauge is not blamed for that as well.
void read_boundary_name(Section& section, const CaseOptions& options, GaugeOptions& gauge) {
  std::vector<Choice<std::string>> choices;
  for (const SoilBoundary& boundary : options.soil->boundaries)
    if (boundary.for_water || !section.reading().report.empty())
      choices.push_back({boundary.name, boundary.name});
  if (options.flow)
    for (const GroundSideOptions& side : options.flow->ground_sides)
      choices.push_back({side.name, side.name});
  if (choices.empty()) {
    section.has("of");
    return section.fail("quantity", "the case has no [[boundary]] with pore_water");
  }
  gauge.of = section.choice<std::string>("of", choices);
}

/// The keys that only some quantities have.
void read_own_keys(Section& section, const CaseOptions& options, GaugeOptions& gauge) {
  const bool section_of =
      gauge.quantity == GaugeQuantity::section_flux || gauge.quantity == GaugeQuantity::overtopping;
  const bool run_up = gauge.quantity == GaugeQuantity::run_up;
  if (section_of)
    read_gauge_section(section, gauge.range);
  else
    section.forbid("section", "water is counted at one by section_flux and overtopping");
  // Soil pushes at all of a body: parts are told apart in water alone.
  const bool load = options.flow && !options.soil &&
                    (gauge.quantity == GaugeQuantity::solid_force ||
                     gauge.quantity == GaugeQuantity::solid_moment);
  if (run_up) read_run_up_range(section, gauge);
  if (load) read_solid_part(section, gauge.range);
  const bool whole = !load && (gauge.quantity == GaugeQuantity::solid_force ||
                               gauge.quantity == GaugeQuantity::solid_moment);
  for (const char* key : {"from", "to", "thickness"}) {
    const bool thickness = std::string_view(key) == "thickness";
    if (!run_up && !(load && !thickness))
      section.forbid(key,
                     section_of ? "the extent of a section belongs into section = { ... }"
                     : whole && !thickness
                         ? "where there is soil, force and moment are those on the whole body: "
                           "parts of its surface are told apart in cases of water alone"
                         : "it belongs to quantity = \"run_up\"");
  }
  if (gauge.quantity == GaugeQuantity::water_level)
    gauge.crossings = section.integer(
        "crossings", {.lower = 1, .upper = 9, .reason = "the number of surfaces written"},
        gauge.crossings);
  else
    section.forbid("crossings", "it belongs to quantity = \"water_level\"");
}

const char* why_no_place(const Kind& kind) {
  switch (kind.quantity) {
    case GaugeQuantity::discharge:
      return "it is measured at a boundary";
    case GaugeQuantity::section_flux:
    case GaugeQuantity::overtopping:
      return "it is measured at a section = { ... }";
    case GaugeQuantity::run_up:
      return "it is looked for between from and to";
    default:
      return nullptr;
  }
}

}  // namespace

void read_gauges(Section& root, CaseOptions& options) {
  std::vector<Choice<GaugeQuantity>> choices;
  for (const Kind& kind : kinds) choices.push_back({std::string(kind.name), kind.quantity});
  std::vector<std::string> names;
  for (Section& section : root.tables("gauge")) {
    GaugeOptions gauge;
    gauge.name = read_name(section, names);
    const std::size_t before = root.reading().report.size();
    gauge.quantity =
        section.choice<GaugeQuantity>("quantity", choices, {}, {"section_force", "total_mass"});
    const bool known = root.reading().report.size() == before;
    const Kind& kind = kind_of(gauge.quantity);
    if (known && kind.of == Of::water && !options.flow)
      section.fail("quantity", "it measures flowing water, and the case has no [[water.body]]");
    if (known && kind.of == Of::soil && !root.has("soil"))
      section.fail("quantity", "it measures soil, and the case has no [[soil]]");
    if (known && kind.of == Of::solid)
      read_solid_name(section, options, gauge);
    else if (known && gauge.quantity == GaugeQuantity::discharge && options.soil)
      read_boundary_name(section, options, gauge);
    else if (known)
      section.forbid("of", fmt::format("{} is not measured on a rigid body", kind.name));
    else
      section.has("of");
    if (!known)
      section.has("at");
    else if (kind.has_place)
      read_place(section, options, kind, gauge);
    else
      section.forbid("at", kind.of == Of::solid
                               ? fmt::format("{} is that of a whole body", kind.name)
                           : why_no_place(kind)
                               ? why_no_place(kind)
                               : fmt::format("{} is measured in the whole domain", kind.name));
    if (known) {
      read_own_keys(section, options, gauge);
    } else {
      for (const char* key : {"section", "from", "to", "thickness", "crossings"}) section.has(key);
    }
    gauge.every =
        section.number("every", quantity::time,
                       not_negative("the time between values; 0 for every step"), gauge.every);
    section.finish();
    options.gauges.push_back(std::move(gauge));
  }
}

}  // namespace mudlark

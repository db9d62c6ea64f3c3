/// [[solid]]: rigid bodies in soil, in flowing water, or in both
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/sections.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// One value in the plane, one per axis in space.
std::array<Varying, 3> varying_turn(Section& section, std::string_view key,
                                    const Quantity& quantity) {
  if (section.reading().dimension == 3) return section.varying_per_axis(key, quantity);
  std::array<Varying, 3> all;
  const Value* value = section.raw(key);
  if (value && std::holds_alternative<List>(value->data)) {
    section.fail(key, "in the plane it is one value, counter-clockwise with x to the right");
    return all;
  }
  all[1] = section.varying(key, quantity, {}, 0.0);
  return all;
}

std::array<double, 3> vector_of(Section& section, std::string_view key, const Quantity& quantity) {
  const auto axes = static_cast<std::size_t>(section.reading().dimension);
  const auto values = section.numbers(key, quantity, axes, std::vector<double>(axes, 0.0));
  return values.size() == axes ? point_from_axes(values) : Point3{};
}

/// Displacement and rotation begin where the shape is.
void check_start(Section& motion, std::string_view key, const std::array<Varying, 3>& given) {
  for (const Varying& component : given)
    if (component(Point3{}, 0.0) != 0.0)
      return motion.fail(key, "at time zero it must be 0: the shape says where the body is then",
                         "Begin a table with { time = [0, ...], value = [0, ...] }.");
}

PrescribedSolid read_prescribed(Section& motion) {
  PrescribedSolid solid;
  solid.by_displacement = motion.has("displacement");
  solid.by_rotation = motion.has("rotation");
  if (solid.by_displacement) {
    solid.translation = motion.varying_per_axis("displacement", quantity::length);
    check_start(motion, "displacement", solid.translation);
    motion.forbid("velocity", "displacement is given too");
  } else {
    solid.translation = motion.varying_per_axis("velocity", quantity::velocity);
  }
  if (solid.by_rotation) {
    solid.rotation = varying_turn(motion, "rotation", quantity::rotation);
    check_start(motion, "rotation", solid.rotation);
    motion.forbid("angular_velocity", "rotation is given too");
  } else {
    solid.rotation = varying_turn(motion, "angular_velocity", quantity::angular_velocity);
  }
  return solid;
}

/// locked = ["x", "rotation"], in space "rotation_x" and so on.
void read_locks(Section& motion, FreeSolid& solid) {
  const bool flat = motion.reading().dimension == 2;
  std::vector<std::string> known, found;
  for (const std::string_view axis : axis_names)
    if (!flat || axis != "y") known.emplace_back(axis);
  if (flat)
    known.emplace_back("rotation");
  else
    for (const std::string_view axis : axis_names)
      known.push_back(fmt::format("rotation_{}", axis));
  if (const Value* value = motion.raw("locked")) {
    const auto* list = std::get_if<List>(&value->data);
    const auto good = [&](const Value& item) {
      const auto* word = std::get_if<std::string>(&item.data);
      return word && std::find(known.begin(), known.end(), *word) != known.end();
    };
    if (!list || !std::all_of(list->begin(), list->end(), good))
      return motion.fail("locked", fmt::format("a list of these words: {}", quoted_list(known)));
    for (const Value& item : *list) found.push_back(std::get<std::string>(item.data));
  }
  const auto has = [&](const std::string& word) {
    return std::find(found.begin(), found.end(), word) != found.end();
  };
  for (std::size_t a = 0; a < 3; ++a) {
    solid.locked[a] = has(std::string(axis_names[a]));
    solid.locked_rotation[a] =
        has(flat && a == 1 ? std::string("rotation") : fmt::format("rotation_{}", axis_names[a]));
  }
  motion.record().value("locked", fmt::format("[{}]", quoted_list(found)));
}

void read_inertia(Section& motion, FreeSolid& solid) {
  const Bounds bounds = positive("a moment of inertia lies above 0");
  if (motion.reading().dimension == 2) {
    if (const auto value = motion.number_if_set("inertia", quantity::inertia, bounds))
      solid.inertia = {*value, *value, *value};
    return;
  }
  if (!motion.has("inertia")) return;
  const auto values = motion.numbers("inertia", quantity::inertia, 3);
  if (values.size() != 3) return;
  if (!std::all_of(values.begin(), values.end(), [](double v) { return v > 0.0; }))
    return motion.fail("inertia", bounds.reason);
  solid.inertia = {values[0], values[1], values[2]};
}

FreeSolid read_free(Section& motion) {
  FreeSolid solid;
  const bool flat = motion.reading().dimension == 2;
  solid.mass = motion.number_if_set(
      "mass", quantity::mass,
      positive("a mass lies above 0", flat ? "In the plane it is per metre of thickness." : ""));
  if (solid.mass)
    motion.forbid("density", "mass is given too");
  else if (motion.has("density"))
    solid.density = motion.number("density", quantity::density,
                                  positive("a density lies above 0", "Concrete has 2400 kg/m3."));
  else
    motion.missing("mass", "a free body needs its mass, or density to take it from the shape");
  read_inertia(motion, solid);
  solid.velocity = vector_of(motion, "velocity", quantity::velocity);
  if (motion.reading().dimension == 3)
    solid.angular_velocity = vector_of(motion, "angular_velocity", quantity::angular_velocity);
  else
    solid.angular_velocity[1] =
        motion.number("angular_velocity", quantity::angular_velocity, {}, 0.0);
  solid.force = motion.varying_per_axis("force", quantity::force);
  solid.moment = varying_turn(motion, "moment", quantity::moment);
  read_locks(motion, solid);
  return solid;
}

/// "fixed", { type = "prescribed", ... } or { type = "free", ... }.
void read_motion(Section& section, SolidOptions& solid) {
  const Value* value = section.raw("motion");
  const auto* word = value ? std::get_if<std::string>(&value->data) : nullptr;
  if (!value || (word && *word == "fixed")) return section.record().value("motion", "\"fixed\"");
  if (!std::holds_alternative<Table>(value->data))
    return section.fail("motion",
                        "expected \"fixed\", { type = \"prescribed\", velocity = [0, -0.01] } or "
                        "{ type = \"free\", density = 2400 }");
  Section motion = section.table("motion", Record::Form::inline_table);
  if (motion.choice<bool>("type", {{"prescribed", false}, {"free", true}}))
    solid.motion = read_free(motion);
  else
    solid.motion = read_prescribed(motion);
  motion.finish();
}

bool is_free(Section& section) {
  const Value* value = section.raw("motion");
  const auto* motion = value ? std::get_if<Table>(&value->data) : nullptr;
  const Entry* type = motion ? find_entry(*motion, "type") : nullptr;
  const auto* word = type ? std::get_if<std::string>(&type->value.data) : nullptr;
  return word && *word == "free";
}

double read_friction(Section& section) {
  const Value* value = section.raw("friction_coefficient");
  const auto* word = value ? std::get_if<std::string>(&value->data) : nullptr;
  if (word && *word == "rough") {
    section.record().value("friction_coefficient", "\"rough\"");
    return std::numeric_limits<double>::infinity();
  }
  return section.number(
      "friction_coefficient", quantity::number,
      not_negative("friction cannot push", "0.4 is tan 22 degrees; \"rough\" never slips."), 0.0);
}

void read_contact(Section& section, SolidOptions& solid) {
  solid.adhesion = section.number(
      "adhesion", quantity::strength,
      not_negative("the shear strength of the contact without pressure"), solid.adhesion);
  solid.sharp_edges = section.choice<bool>("edges", {{"smooth", false}, {"sharp", true}}, false);
}

/// `rubs`: there is something that it may slide along.
SolidOptions read_solid(Section& section, bool in_soil, bool rubs,
                        std::vector<std::string>& names) {
  SolidOptions solid;
  solid.name = read_name(section, names);
  if (const auto shape = read_shape(section, "shape", Reach::anywhere)) solid.shape = *shape;
  if (section.has("centre")) {
    const auto axes = static_cast<std::size_t>(section.reading().dimension);
    const auto centre = section.numbers("centre", quantity::length, axes);
    if (centre.size() == axes) solid.centre = point_from_axes(centre);
  } else {
    section.record().remark("centre: that of mass");
  }
  read_motion(section, solid);
  if (rubs)
    solid.friction = read_friction(section);
  else
    section.forbid("friction_coefficient", "it is for soil and for free bodies");
  if (in_soil) read_contact(section, solid);
  return solid;
}

/// The same body as the water sees it.
FlowSolid read_flow_solid(Section& section, const SolidOptions& solid, const FlowOptions& flow,
                          bool in_soil) {
  const bool moves = !std::holds_alternative<FixedSolid>(solid.motion);
  FlowSolid body{solid.name, solid.shape, solid.centre, {}, false, solid.friction};
  std::visit([&](const auto& motion) { body.motion = motion; }, solid.motion);
  if (moves && flow.porous.size() > 0)
    section.fail("motion", "a body that moves in a case with [[porous]] ground is not there yet",
                 "Write \"fixed\", or make the ground [[soil]] (coupling.mode = \"unified\").");
  for (const char* key : {"adhesion", "edges"})
    if (!in_soil) section.forbid(key, "it is for soil; `wall` says how water passes the body");
  body.no_slip = section.choice<bool>("wall", {{"slip", false}, {"no-slip", true}}, false);
  if (body.no_slip && !std::holds_alternative<FixedSolid>(solid.motion))
    section.fail("wall", "water has friction on fixed bodies only");
  return body;
}

}  // namespace

void read_solids(Section& root, CaseOptions& options) {
  std::vector<Section> sections = root.tables("solid");
  if (sections.empty()) return;
  Report& report = root.reading().report;
  const bool in_water = options.flow.has_value(), in_soil = options.soil.has_value();
  if (in_water && in_soil && options.coupling.mode != CouplingMode::unified)
    report.add(root.place("solid"),
               "[[solid]] in soil under flowing water needs coupling.mode = \"unified\"\n  (and "
               "pore_water = \"unified\" in every [[soil]]): the other modes let water or soil "
               "pass it.");
  else if (options.flow && options.flow->gas)
    report.add(root.place("solid"),
               "[[solid]] stands in water under air of no mass; with air = \"gas\" it is not there "
               "yet. Leave one of them out.");
  else if (options.flow && options.flow->turbulence.model != TurbulenceModel::none)
    report.add(root.place("solid"),
               "[[solid]] in water does not go with [water.turbulence] yet: it knows the domain's "
               "walls only. Leave one of them out.");
  else if (!options.flow && !options.soil)
    report.add(root.place("solid"),
               "[[solid]] is a rigid body in soil or water, but there is no [[soil]] and no "
               "[[water.body]]");
  std::vector<std::string> names;
  std::vector<NamedShape> bodies;
  const bool rubs = in_soil || std::any_of(sections.begin(), sections.end(), is_free);
  for (Section& section : sections) {
    const std::size_t before = report.size();
    SolidOptions solid = read_solid(section, in_soil, rubs, names);
    if (in_water)
      options.flow->solids.push_back(read_flow_solid(section, solid, *options.flow, in_soil));
    else
      section.forbid("wall", "it is for bodies in flowing water");
    section.finish();
    if (report.size() == before)
      bodies.push_back(
          {fmt::format("solid \"{}\"", solid.name), solid.shape, section.place("shape")});
    if (options.soil) options.soil->solids.push_back(std::move(solid));
  }
  // In water bodies stand on and in each other: only what is left of the space counts.
  if (options.soil) check_overlaps(root.reading(), bodies);
}

void accelerate_free_bodies(CaseOptions& options) {
  const auto give = [](const std::optional<std::array<Varying, 3>>& acceleration, auto& solids) {
    if (!acceleration) return;
    for (auto& solid : solids)
      if (auto* motion = std::get_if<FreeSolid>(&solid.motion))
        motion->acceleration = *acceleration;
  };
  if (options.soil) give(options.soil->body_acceleration, options.soil->solids);
  if (options.flow) give(options.flow->body_acceleration, options.flow->solids);
}

}  // namespace mudlark

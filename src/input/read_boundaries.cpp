/// [[boundary]]
#include <fmt/format.h>

#include <algorithm>

#include "input/sections.hpp"
#include "input/unified.hpp"

namespace mudlark {
namespace {

void read_moving(Section& section, SoilBoundary& boundary) {
  const bool velocity = section.has("velocity"), displacement = section.has("displacement");
  if (velocity == displacement)
    section.fail(velocity ? "displacement" : "velocity",
                 "a side moves with a given velocity or displacement", "Write one of the two.");
  boundary.motion_is_displacement = displacement;
  if (displacement)
    boundary.motion = section.varying_per_axis("displacement", quantity::length);
  else if (velocity)
    boundary.motion = section.varying_per_axis("velocity", quantity::velocity);
  boundary.holds_along =
      section.choice<bool>("along", {{"fixed", true}, {"slip", false}}, boundary.holds_along);
}

void read_absorbing(Section& section, SoilBoundary& boundary) {
  const Bounds share = not_negative("a factor on the dashpot; 1 swallows waves that come straight");
  boundary.absorber.normal = section.number("normal", quantity::number, share, 1.0);
  boundary.absorber.tangential = section.number("tangential", quantity::number, share, 1.0);
  boundary.absorber.thickness =
      section
          .number_if_set("spring_thickness", quantity::length,
                         positive("the thickness of soil that the springs stand for"))
          .value_or(boundary.absorber.thickness);
}

const std::vector<Choice<GrainSide>> plain_grains{{"slip", GrainSide::slip},
                                                  {"fixed", GrainSide::fixed},
                                                  {"open", GrainSide::open},
                                                  {"absorbing", GrainSide::absorbing}};

/// The word alone: as a table without further keys.
void read_absorbing_word(Section& section, SoilBoundary& boundary) {
  boundary.grains = GrainSide::absorbing;
  const Table none;
  Record& record = section.record().child("grains", Record::Form::inline_table);
  record.value("type", "\"absorbing\"");
  Section table = section.over(none, section.place("grains"), "grains", record);
  read_absorbing(table, boundary);
}

/// A word, or { type = ..., ... }.
void read_grains(Section& section, SoilBoundary& boundary) {
  const Value* value = section.raw("grains");
  if (!value) return section.record().remark("grains: as [domain.walls] says");
  boundary.for_grains = true;
  if (!std::holds_alternative<Table>(value->data)) {
    const auto* word = std::get_if<std::string>(&value->data);
    if (word && (*word == "friction" || *word == "moving"))
      return section.fail("grains", "it needs more than a word",
                          *word == "friction"
                              ? "Write { type = \"friction\", friction_coefficient = 0.5 }."
                              : "Write { type = \"moving\", displacement = [...] }.");
    if (word && *word == "absorbing") return read_absorbing_word(section, boundary);
    boundary.grains = section.choice<GrainSide>("grains", plain_grains);
    return;
  }
  Section table = section.table("grains", Record::Form::inline_table);
  std::vector<Choice<GrainSide>> kinds = plain_grains;
  kinds.push_back({"friction", GrainSide::friction});
  kinds.push_back({"moving", GrainSide::moving});
  const std::size_t before = section.reading().report.size();
  boundary.grains = table.choice<GrainSide>("type", kinds);
  // Which other keys belong here, the type says.
  if (section.reading().report.size() != before) return;
  if (boundary.grains == GrainSide::friction)
    boundary.friction =
        table.number("friction_coefficient", quantity::number,
                     not_negative("friction cannot push", "0.4 is tan 22 degrees."));
  if (boundary.grains == GrainSide::moving) read_moving(table, boundary);
  if (boundary.grains == GrainSide::absorbing) read_absorbing(table, boundary);
  table.finish();
}

enum class WaterWord { sealed, drained, seepage_face, pressure, head, inflow };

const std::vector<Choice<WaterWord>> plain_water{{"sealed", WaterWord::sealed},
                                                 {"drained", WaterWord::drained},
                                                 {"seepage-face", WaterWord::seepage_face}};

/// The value that belongs to a word.
void read_water_value(Section& table, WaterWord word, bool level, SoilBoundary& boundary) {
  if (word == WaterWord::pressure)
    boundary.value = table.varying("pressure", quantity::pressure, {});
  if (word == WaterWord::inflow) boundary.value = table.varying("inflow", quantity::velocity, {});
  if (word != WaterWord::head) return;
  boundary.value = table.varying("head", quantity::length, {});
  boundary.is_head = true;
  if (!level)
    table.fail("head", "water stands level, and gravity is not vertical here",
               "Write { type = \"pressure\", pressure = ... }.");
}

void read_water(Section& section, const DomainOptions& domain, SoilBoundary& boundary) {
  const Value* value = section.raw("pore_water");
  if (!value) return section.record().remark("pore_water: sealed, but for an open side");
  boundary.for_water = true;
  WaterWord word;
  if (!std::holds_alternative<Table>(value->data)) {
    const auto* given = std::get_if<std::string>(&value->data);
    if (given && (*given == "pressure" || *given == "head" || *given == "inflow"))
      return section.fail("pore_water", "it needs a value",
                          fmt::format("Write {{ type = \"{0}\", {0} = ... }}.", *given));
    word = section.choice<WaterWord>("pore_water", plain_water);
  } else {
    Section table = section.table("pore_water", Record::Form::inline_table);
    std::vector<Choice<WaterWord>> kinds = plain_water;
    kinds.push_back({"pressure", WaterWord::pressure});
    kinds.push_back({"head", WaterWord::head});
    kinds.push_back({"inflow", WaterWord::inflow});
    const std::size_t before = section.reading().report.size();
    word = table.choice<WaterWord>("type", kinds);
    if (section.reading().report.size() != before) return;
    bool level = true;
    for (int a = 0; a < domain.dimension - 1; ++a)
      level = level && domain.gravity[static_cast<std::size_t>(a)] == 0.0;
    read_water_value(table, word, level, boundary);
    table.finish();
  }
  boundary.water = word == WaterWord::sealed         ? WaterSide::sealed
                   : word == WaterWord::seepage_face ? WaterSide::seepage_face
                   : word == WaterWord::inflow       ? WaterSide::inflow
                                                     : WaterSide::pressure;
}

bool lets_grains_through(GrainSide kind) {
  return kind == GrainSide::open || kind == GrainSide::absorbing;
}

/// What cannot hold together on one side.
void check_together(Section& section, const CaseOptions& options, const SoilBoundary& boundary) {
  const DomainOptions& domain = options.domain;
  const Wall wall =
      domain
          .walls[static_cast<std::size_t>(boundary.axis)][static_cast<std::size_t>(boundary.side)];
  if (wall == Wall::periodic)
    return section.fail("side", "it is periodic: it has no boundary",
                        "Say under [domain.walls] what else it is.");
  const bool drains = boundary.for_water && boundary.water != WaterSide::sealed;
  const bool wall_is_open = !boundary.for_grains && wall == Wall::open;
  if (drains && (wall_is_open || (boundary.for_grains && lets_grains_through(boundary.grains))))
    section.fail("pore_water",
                 "water is held by sides that hold the grains; an open side lets water out at zero "
                 "pressure, an absorbing one seals it in",
                 "Write grains = \"slip\" or \"fixed\".");
  for (const SoilBoundary& other : options.soil->boundaries) {
    if (!parts_meet(boundary, other, domain.dimension)) continue;
    if (boundary.for_grains && other.for_grains)
      section.fail(
          "grains",
          fmt::format("boundary \"{}\" says already what grains do on a part of it", other.name));
    if (boundary.for_water && other.for_water)
      section.fail("pore_water",
                   fmt::format("boundary \"{}\" says already what pore water does on a part of it",
                               other.name));
    const bool other_drains = other.for_water && other.water != WaterSide::sealed;
    if ((drains && other.for_grains && lets_grains_through(other.grains)) ||
        (other_drains && boundary.for_grains && lets_grains_through(boundary.grains)))
      section.fail(drains ? "pore_water" : "grains",
                   fmt::format("boundary \"{}\" overlaps it, and water is held only by sides that "
                               "hold the grains",
                               other.name));
  }
}

}  // namespace

void read_boundaries(Section& root, CaseOptions& options) {
  std::vector<Section> sections = root.tables("boundary");
  if (!sections.empty() && !options.soil)
    return root.reading().report.add(
        root.place("boundary"), "[[boundary]] speaks of soil at a side, but there is no [[soil]]");
  std::vector<std::string> names;
  for (Section& section : sections) {
    SoilBoundary boundary;
    boundary.name = read_name(section, names);
    const std::size_t before = root.reading().report.size();
    const SidePart part = read_side(section, options.domain.dimension);
    boundary.axis = part.axis, boundary.side = part.side;
    const bool known = root.reading().report.size() == before;
    read_range(section, options.domain.dimension, part.axis, boundary.from, boundary.to);
    read_grains(section, boundary);
    read_water(section, options.domain, boundary);
    section.finish();
    if (!boundary.for_grains && !boundary.for_water)
      section.missing("grains", "a boundary says what holds for grains, pore_water, or both");
    const auto& bodies = options.soil->bodies;
    if (boundary.for_water && std::none_of(bodies.begin(), bodies.end(), [](const SoilBody& body) {
          return body.pore_water != PoreWater::none;
        }))
      section.fail("pore_water", "no soil of this case has pore water");
    if (known) check_together(section, options, boundary);
    options.soil->boundaries.push_back(std::move(boundary));
  }
}

namespace {

/// What a boundary asks for that this case cannot do yet, and because of what; empty if all is
/// well.
std::string not_available(const SoilOptions& soil, const SoilBoundary& boundary) {
  const GrainSide grains = boundary.for_grains ? boundary.grains : GrainSide::slip;
  const bool drains = boundary.for_water && boundary.water != WaterSide::sealed;
  const bool moves = grains == GrainSide::moving || grains == GrainSide::absorbing;
  if (takes_implicit_steps(soil)) {
    if (lets_grains_through(grains) || grains == GrainSide::friction)
      return "grains other than \"slip\", \"fixed\" and moving ones need "
             "soil_solver.method = \"explicit\"";
    return {};
  }
  const char* what = moves ? "sides that move or absorb" : "pore_water other than \"sealed\"";
  if ((drains || moves) && soil.formulation != Formulation::u_w)
    return fmt::format("{} need formulation = \"u-w\" under [[soil]]", what);
  if ((drains || moves) && !soil.solids.empty())
    return fmt::format("{} do not go with [[solid]] yet", what);
  return {};
}

}  // namespace

void check_boundaries(Section& root, const CaseOptions& options) {
  if (!options.soil) return;
  const Value* value = root.raw("boundary");
  const auto* list = value ? std::get_if<List>(&value->data) : nullptr;
  if (is_unified(*options.soil)) return;  // see check_unified()
  const auto& boundaries = options.soil->boundaries;
  for (std::size_t b = 0; b < boundaries.size() && list && b < list->size(); ++b) {
    const std::string problem = not_available(*options.soil, boundaries[b]);
    if (!problem.empty())
      root.reading().report.add(
          (*list)[b].place,
          fmt::format("boundary \"{}\" is not possible\n  ({}).", boundaries[b].name, problem));
  }
  if (!takes_implicit_steps(*options.soil)) return;
  for (const auto& axis : options.domain.walls)
    for (const Wall wall : axis)
      if (wall == Wall::friction)
        return root.reading().report.add(
            root.place("domain"),
            "a wall of friction needs soil_solver.method = \"explicit\"\n  (implicit steps know no "
            "friction yet). Write \"slip\" or \"no-slip\".");
}

}  // namespace mudlark

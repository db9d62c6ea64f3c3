/// What pore_water = "unified" goes with: checked when all of the case is read.
#include <fmt/format.h>

#include <algorithm>

#include "input/sections.hpp"

namespace mudlark {
namespace {

/// Soils and coupling must say the same.
bool agree(Section& root, const CaseOptions& options) {
  Report& report = root.reading().report;
  const bool unified = options.coupling.mode == CouplingMode::unified;
  const auto& bodies = options.soil->bodies;
  const auto other = std::find_if(bodies.begin(), bodies.end(), [&](const SoilBody& body) {
    return (body.pore_water == PoreWater::unified) != unified;
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
  const auto has = [&](auto&& kind) {
    return std::any_of(soil.boundaries.begin(), soil.boundaries.end(), kind);
  };
  const bool passes = has(
      [](const SoilBoundary& part) { return part.for_water && part.water != WaterSide::sealed; });
  no(passes && options.flow && options.flow->body_acceleration,
     "water through a [[boundary]] where flow_solver.body_acceleration shakes it");
  no(has([](const SoilBoundary& part) {
       return part.for_grains && part.grains != GrainSide::slip &&
              part.grains != GrainSide::fixed && part.grains != GrainSide::friction;
     }),
     "a [[boundary]] whose grains are neither \"slip\", \"fixed\" nor \"friction\"");
  no(soil.water_damping.value_or(soil.damping) != soil.damping,
     "a soil_solver.water_damping of its own, as the water is the flow's,");
  no(std::any_of(soil.stages.begin(), soil.stages.end(),
                 [](const SoilStage& stage) { return stage.water_damping.has_value(); }),
     "a water_damping in a [[stage]], as the water is the flow's,");
  no(soil.load_form != LoadForm::virtual_stress, "soil_solver.load_form = \"facets\"");
  no(soil.kernel == Kernel::linear, "soil_solver.kernel = \"linear\"");
  no(soil.body_acceleration.has_value(),
     "soil_solver.body_acceleration, as that of [flow_solver] moves grains and water,");
  const bool free = std::any_of(soil.solids.begin(), soil.solids.end(), [](const auto& solid) {
    return std::holds_alternative<FreeSolid>(solid.motion);
  });
  no(free && soil.start_in_equilibrium,
     "soil_solver.start_in_equilibrium under a [[solid]] that moves freely");
  return words;
}

/// A boundary speaks of a side that holds the grains.
void check_open_sides(Section& root, const CaseOptions& options) {
  const Value* value = root.raw("boundary");
  const auto* list = value ? std::get_if<List>(&value->data) : nullptr;
  const auto& boundaries = options.soil->boundaries;
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const SoilBoundary& part = boundaries[b];
    if (options.domain.walls[static_cast<std::size_t>(part.axis)]
                            [static_cast<std::size_t>(part.side)] != Wall::open)
      continue;
    const std::string side = fmt::format("{}_{}", part.side == 0 ? "lower" : "upper",
                                         "xyz"[coordinate(part.axis, options.domain.dimension)]);
    root.reading().report.add(
        list && b < list->size() ? (*list)[b].place : root.place("boundary"),
        fmt::format(
            "boundary \"{}\" is not possible\n  ({} is \"open\" under [domain.walls], and "
            "with coupling.mode = \"unified\" boundaries are for sides that hold the grains). "
            "Leave {} out there or write \"slip\" or \"no-slip\", or leave the boundary out.",
            part.name, side, side));
  }
}

/// Cells that soil keeps away from sides that water flows through, as wide as its kernel reaches.
constexpr int clear_cells = 2;

/// A side that water flows through as given, or without end where it is open.
struct ThroughSide {
  std::string name;
  int axis, side;
  Point3 from, to;
};

/// A source in a closed floor: water rises through it as given, and grains stand on it.
bool holds_grains(const CaseOptions& options, const FlowSideOptions& side) {
  const auto axis = static_cast<std::size_t>(side.axis);
  return side.axis == options.domain.dimension - 1 && side.side == 0 &&
         options.domain.walls[axis][0] != Wall::open &&
         (side.flow == SideFlow::velocity || side.flow == SideFlow::discharge);
}

std::vector<ThroughSide> sides_of_water(const CaseOptions& options) {
  std::vector<ThroughSide> all;
  const int dimension = options.domain.dimension;
  if (options.flow)
    for (const FlowSideOptions& side : options.flow->sides) {
      if (holds_grains(options, side)) continue;
      all.push_back({fmt::format("\"{}\"", side.name), side.axis, side.side, side.from, side.to});
    }
  constexpr double far = FlowSideOptions::infinite;
  for (int a = 0; a < dimension; ++a)
    for (int side = 0; side < 2; ++side)
      if (options.domain.walls[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)] ==
              Wall::open &&
          !(a == dimension - 1 && side == 1))
        all.push_back({fmt::format("the open side {}_{}", side == 0 ? "lower" : "upper",
                                   "xyz"[coordinate(a, dimension)]),
                       a,
                       side,
                       {-far, -far, -far},
                       {far, far, far}});
  return all;
}

/// Soil is not held where water passes a side, and what it would do there is not computed.
void keep_clear(Section& root, const CaseOptions& options) {
  const DomainOptions& domain = options.domain;
  const int dimension = domain.dimension;
  for (const ThroughSide& side : sides_of_water(options)) {
    Point3 lower{-1.0, -1.0, -1.0}, upper{1.0, 1.0, 1.0};
    double clear = 0.0;
    for (int a = 0; a < dimension; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      const std::size_t c = coordinate(a, dimension);
      lower[c] = std::max(domain.lower[axis], side.from[c]);
      upper[c] = std::min(domain.upper[axis], side.to[c]);
      if (a != side.axis) continue;
      clear = clear_cells * (domain.upper[axis] - domain.lower[axis]) / domain.cells[axis];
      (side.side == 0 ? upper : lower)[c] =
          side.side == 0 ? domain.lower[axis] + clear : domain.upper[axis] - clear;
    }
    for (const SoilBody& body : options.soil->bodies)
      if (fraction_inside(body.shape, lower, upper, dimension) > 0.0)
        root.reading().report.add(
            root.place("soil"),
            fmt::format("soil \"{}\" stands at {}, through which water flows; with "
                        "coupling.mode = \"unified\"\n  soil keeps {} cells, {:g} m, clear of "
                        "such sides (nothing would hold it there). A closed side holds it, and a "
                        "[[boundary]] with\n  pore_water = {{ type = \"head\", head = ... }} holds "
                        "water in it and over it at a level.",
                        body.name, side.name, clear_cells, clear));
  }
}

GroundSideWater water_of(const SoilBoundary& part) {
  if (part.water == WaterSide::inflow) return GroundSideWater::inflow;
  if (part.water == WaterSide::seepage_face) return GroundSideWater::seepage_face;
  // A drain has no water to give either.
  const bool drained = !part.is_head && part.value.constant() && part.value({}, 0.0) == 0.0;
  if (drained) return GroundSideWater::seepage_face;
  return part.is_head ? GroundSideWater::head : GroundSideWater::pressure;
}

/// A level below all that it could hold is a mistake in the datum, or a drain.
void check_head(Section& root, const DomainOptions& domain, const GroundSideOptions& side,
                std::size_t number) {
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  if (side.water != GroundSideWater::head || domain.gravity[up] == 0.0) return;
  const auto axis = static_cast<std::size_t>(side.axis);
  std::vector<double> place;
  for (std::size_t a = 0; a <= up; ++a) {
    const std::size_t c = coordinate(static_cast<int>(a), domain.dimension);
    place.push_back(
        0.5 * (std::max(domain.lower[a], side.from[c]) + std::min(domain.upper[a], side.to[c])));
  }
  place[axis] = (side.side == 0 ? domain.lower : domain.upper)[axis];
  const double head = side.value(point_from_axes(place), 0.0);
  const bool below_part = side.value.constant() && axis != up && head < side.from[2];
  if (!below_part && head >= domain.lower[up]) return;
  const Value* value = root.raw("boundary");
  const auto* list = value ? std::get_if<List>(&value->data) : nullptr;
  root.reading().report.add(
      list && number < list->size() ? (*list)[number].place : root.place("boundary"),
      fmt::format("boundary \"{}\" holds water at a head of {:g} m, below its part of the side, "
                  "which begins at {:g} m.\n  A head is the height of the water's surface on the "
                  "vertical axis, not a depth. Where water only leaves, write pore_water = "
                  "\"seepage-face\".",
                  side.name, head, below_part ? side.from[2] : domain.lower[up]));
}

/// Water in the ground is the flow's, and so are the sides that let it through.
void hand_sides_to_flow(Section& root, CaseOptions& options) {
  for (std::size_t b = 0; b < options.soil->boundaries.size(); ++b) {
    SoilBoundary& part = options.soil->boundaries[b];
    if (!part.for_water) continue;
    part.for_water = false;
    if (part.water == WaterSide::sealed) continue;
    GroundSideOptions side;
    side.name = part.name, side.axis = part.axis, side.side = part.side;
    side.from = part.from, side.to = part.to;
    side.water = water_of(part), side.value = part.value;
    for (const FlowSideOptions& other : options.flow->sides)
      if (parts_meet(side, other, options.domain.dimension))
        root.reading().report.add(
            root.place("boundary"),
            fmt::format("boundary \"{}\" lets water through a part of a side of which \"{}\" says "
                        "already what water does there.\n  Let \"from\" and \"to\" keep them "
                        "apart.",
                        part.name, other.name));
    check_head(root, options.domain, side, b);
    options.flow->ground_sides.push_back(std::move(side));
  }
}

}  // namespace

void check_unified(Section& root, CaseOptions& options) {
  if (!options.soil || !agree(root, options)) return;
  Report& report = root.reading().report;
  for (const std::string& what : excluded(options))
    report.add(root.place("coupling"),
               fmt::format("coupling.mode = \"unified\" does not go with {} yet", what));
  check_open_sides(root, options);
  if (report.empty()) keep_clear(root, options);
  const auto& bodies = options.soil->bodies;
  for (const SoilBody& body : bodies)
    if (body.grain_diameter != bodies.front().grain_diameter)
      report.add(root.place("soil"),
                 fmt::format("with coupling.mode = \"unified\" all soils have one grain_diameter, "
                             "or none has any, and soil \"{}\" differs from soil \"{}\"",
                             body.name, bodies.front().name));
  for (const SoilBody& body : bodies)
    if (body.grain_diameter > 0.0 && body.grain_density != bodies.front().grain_density)
      report.add(root.place("soil"),
                 fmt::format("soils with a grain_diameter have grains of one density, and soil "
                             "\"{}\" has {:g} kg/m3, soil \"{}\" {:g} kg/m3",
                             body.name, body.grain_density, bodies.front().name,
                             bodies.front().grain_density));
  for (const SoilBody& body : bodies)
    if (&body != &bodies.front() && !same_curve(body.filling, bodies.front().filling))
      report.add(root.place("soil"),
                 fmt::format("with coupling.mode = \"unified\" all soils have one "
                             "relative_permeability, and soil \"{}\" has another than soil \"{}\"",
                             body.name, bodies.front().name));
  if (!options.flow) return;
  hand_sides_to_flow(root, options);
  options.soil->body_acceleration = options.flow->body_acceleration;
  for (const WaterBody& water : options.flow->bodies) options.soil->flooded.push_back(water.shape);
}

}  // namespace mudlark

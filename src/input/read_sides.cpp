/// Sides of the domain and parts of them, and [[opening]].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/sections.hpp"
#include "input/unified.hpp"

namespace mudlark {
namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

std::string side_name(int axis, int side, int dimension) {
  return fmt::format("{}_{}", side == 0 ? "lower" : "upper", axes[coordinate(axis, dimension)]);
}

/// A boundary whose head holds the water of a side already, in the ground and over it.
const SoilBoundary* head_at(const CaseOptions& options, const FlowSideOptions& side) {
  if (!options.soil || !is_unified(*options.soil)) return nullptr;
  const auto& all = options.soil->boundaries;
  const auto found = std::find_if(all.begin(), all.end(), [&](const SoilBoundary& part) {
    return part.for_water && part.is_head && part.axis < options.domain.dimension - 1 &&
           parts_meet(side, part, options.domain.dimension);
  });
  return found == all.end() ? nullptr : &*found;
}

/// What the side must be under [domain.walls] for this flow.
void check_wall(Section& section, const CaseOptions& options, const FlowSideOptions& side) {
  const Wall wall =
      options.domain
          .walls[static_cast<std::size_t>(side.axis)][static_cast<std::size_t>(side.side)];
  const bool open = wall == Wall::open, wants_open = side.flow == SideFlow::level;
  if (wall != Wall::periodic && open == wants_open) return;
  if (wants_open && wall != Wall::periodic && options.soil && is_unified(*options.soil))
    return section.fail(
        "side", "water is held at a level by its pressure on an open wall",
        fmt::format("Write {} = \"open\" under [domain.walls]; where ground stands at the side, "
                    "which has to hold it, write a [[boundary]] with pore_water = {{ type = "
                    "\"head\", head = ... }} in place of the opening: it holds the water over the "
                    "ground at its level too.",
                    side_name(side.axis, side.side, options.domain.dimension)));
  section.fail("side",
               wants_open ? "water is held at a level by its pressure on an open wall"
                          : "the velocity of the water is given on a closed wall",
               fmt::format("Write {} = \"{}\" under [domain.walls].",
                           side_name(side.axis, side.side, options.domain.dimension),
                           wants_open ? "open" : "slip"));
}

/// Water outside that stands below all of the domain is a mistake in the datum.
void check_level(Section& section, const DomainOptions& domain, const FlowSideOptions& opening) {
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  const auto axis = static_cast<std::size_t>(opening.axis);
  std::vector<double> place;
  for (std::size_t a = 0; a <= up; ++a) place.push_back(0.5 * (domain.lower[a] + domain.upper[a]));
  place[axis] = (opening.side == 0 ? domain.lower : domain.upper)[axis];
  const double level = (*opening.level)(point_from_axes(place), 0.0);
  if (level < domain.lower[up])
    section.fail("level",
                 fmt::format("at the start it lies at {:g} m, below the domain, which begins at "
                             "{:g} m",
                             level, domain.lower[up]),
                 "It is the height of the water's surface on the vertical axis, not a depth.");
}

void read_flow(Section& section, const DomainOptions& domain, FlowSideOptions& opening) {
  opening.flow = section.choice<SideFlow>("type", {{"velocity", SideFlow::velocity},
                                                   {"discharge", SideFlow::discharge},
                                                   {"level", SideFlow::level}});
  if (opening.flow == SideFlow::velocity)
    opening.value = section.varying("velocity", quantity::velocity, {});
  if (opening.flow == SideFlow::discharge)
    opening.value = section.varying(
        "discharge",
        section.reading().dimension == 3 ? quantity::discharge : quantity::discharge_in_plane, {});
  if (section.has("level")) {
    const std::size_t before = section.reading().report.size();
    opening.level = section.varying("level", quantity::length, {});
    if (section.reading().report.size() == before) check_level(section, domain, opening);
  } else if (opening.flow == SideFlow::level)
    section.missing("level", "the height to which the water outside stands is needed");
}

}  // namespace

SidePart read_side(Section& section, int dimension) {
  std::vector<Choice<int>> sides;
  for (int axis = 0; axis < dimension; ++axis)
    for (int side = 0; side < 2; ++side)
      sides.push_back({side_name(axis, side, dimension), 2 * axis + side});
  const int chosen = section.choice<int>("side", sides);
  return {chosen / 2, chosen % 2};
}

void read_range(Section& section, int dimension, int across, Point3& from, Point3& to) {
  std::vector<std::size_t> along;
  for (int axis = 0; axis < dimension; ++axis)
    if (axis != across) along.push_back(coordinate(axis, dimension));
  for (const auto& [key, range] : {std::pair{"from", &from}, {"to", &to}}) {
    if (!section.has(key)) continue;
    if (dimension == 2) {
      (*range)[along[0]] = section.number(key, quantity::length, {});
      continue;
    }
    const auto values = section.numbers(key, quantity::length, 0);
    if (values.size() != 2 && !values.empty())
      section.fail(key, fmt::format("two lengths are expected, along {} and {}", "xyz"[along[0]],
                                    "xyz"[along[1]]));
    if (values.size() == 2) (*range)[along[0]] = values[0], (*range)[along[1]] = values[1];
  }
  const Reading& reading = section.reading();
  if (!reading.domain || !reading.report.empty()) return;
  for (const std::size_t a : along) {
    const double h = reading.spacing[a], lower = reading.domain->lower[a];
    const double first = std::max(from[a], lower);
    const double last = std::min(to[a], reading.domain->upper[a]);
    const double next_centre = lower + (std::ceil((first - lower) / h - 0.5) + 0.5) * h;
    if (!(next_centre < last))
      return section.fail(section.has("to") ? "to" : "from",
                          "no cell of the side has its centre between from and to",
                          fmt::format("The side goes from {:g} to {:g} m in cells of {:g} m.",
                                      lower, reading.domain->upper[a], h));
  }
}

void add_flow_side(Section& section, CaseOptions& options, const FlowSideOptions& side) {
  if (const SoilBoundary* head = side.flow == SideFlow::level ? head_at(options, side) : nullptr)
    return section.fail("side",
                        fmt::format("the head of boundary \"{}\" holds the water there already, in "
                                    "the ground and over it",
                                    head->name),
                        "Leave the opening out, on a closed side, or keep the two apart by from "
                        "and to.");
  check_wall(section, options, side);
  if (options.flow->gas)
    section.fail("side", "what gas does at such a side is not known yet",
                 "Leave out air = \"gas\" under [water], or make waves in a zone.");
  for (const FlowSideOptions& other : options.flow->sides)
    if (parts_meet(side, other, options.domain.dimension))
      section.fail("side",
                   fmt::format("\"{}\" says already what water does on a part of it", other.name));
  options.flow->sides.push_back(side);
}

void read_openings(Section& root, CaseOptions& options) {
  std::vector<Section> sections = root.tables("opening");
  if (sections.empty()) return;
  if (!options.flow)
    return root.reading().report.add(
        root.place("opening"), "[[opening]] lets water through, but there is no [[water.body]]");
  std::vector<std::string> names;
  for (Section& section : sections) {
    FlowSideOptions opening;
    opening.name = read_name(section, names);
    const std::size_t before = root.reading().report.size();
    const SidePart part = read_side(section, options.domain.dimension);
    opening.axis = part.axis, opening.side = part.side;
    read_range(section, options.domain.dimension, part.axis, opening.from, opening.to);
    read_flow(section, options.domain, opening);
    section.finish();
    if (root.reading().report.size() == before) add_flow_side(section, options, opening);
  }
}

}  // namespace mudlark

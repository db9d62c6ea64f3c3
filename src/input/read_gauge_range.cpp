/// Where a [[gauge]] counts water: section = { x = 2, from = 0.3 }, and the range of a run-up
#include <fmt/format.h>

#include "input/sections.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

std::vector<std::size_t> axes_of(int dimension) {
  return dimension == 2 ? std::vector<std::size_t>{0, 2} : std::vector<std::size_t>{0, 1, 2};
}

/// from and to along the given axes: a number for one, a list for two.
void read_from_to(Section& section, const std::vector<std::size_t>& along, GaugeRange& range) {
  std::string names;
  for (const std::size_t a : along)
    names += (names.empty() ? "" : ", ") + std::string(axis_names[a]);
  for (const auto& [key, bound] : {std::pair{"from", &range.from}, {"to", &range.to}}) {
    if (!section.has(key)) continue;
    if (along.size() == 1) {
      (*bound)[along[0]] = section.number(key, quantity::length, {});
      continue;
    }
    const auto values = section.numbers(key, quantity::length, 0);
    if (values.empty()) continue;
    if (values.size() != along.size())
      section.fail(key, fmt::format("{} lengths are expected, along {}", along.size(), names));
    else
      for (std::size_t i = 0; i < along.size(); ++i) (*bound)[along[i]] = values[i];
  }
  const Reading& reading = section.reading();
  if (!reading.domain || !reading.report.empty()) return;
  for (const std::size_t a : along) {
    const double lower = std::max(range.from[a], reading.domain->lower[a]);
    const double upper = std::min(range.to[a], reading.domain->upper[a]);
    if (lower < upper) continue;
    return section.fail(
        section.has("to") ? "to" : "from",
        fmt::format("nothing of the domain lies between from and to along {}", axis_names[a]),
        fmt::format("The domain goes from {:g} to {:g} m there.", reading.domain->lower[a],
                    reading.domain->upper[a]));
  }
}

}  // namespace

void read_gauge_section(Section& gauge, GaugeRange& range) {
  if (!gauge.has("section"))
    return gauge.missing("section",
                         "water is counted where it passes a plane; write section = { x = 2.0 }");
  Section section = gauge.table("section", Record::Form::inline_table, true);
  const Reading& reading = section.reading();
  const std::vector<std::size_t> axes = axes_of(reading.dimension);
  std::size_t given = 0;
  for (const std::size_t a : axes)
    if (section.has(axis_names[a])) range.axis = a, ++given;
  if (given != 1) {
    for (const std::size_t a : axes) section.has(axis_names[a]);
    section.has("from"), section.has("to"), section.has("direction");
    gauge.fail("section", "a section lies across one axis",
               fmt::format("Write one of {}: where the plane is.",
                           reading.dimension == 2 ? "x and z" : "x, y and z"));
    return section.finish();
  }
  Bounds inside;
  if (reading.domain)
    inside = {.lower = reading.domain->lower[range.axis],
              .upper = reading.domain->upper[range.axis],
              .reason = "the section lies in the domain"};
  range.place = section.number(axis_names[range.axis], quantity::length, inside);
  std::vector<std::size_t> along;
  for (const std::size_t a : axes)
    if (a != range.axis) along.push_back(a);
  read_from_to(section, along, range);
  range.sign = section.choice<double>("direction", {{"positive", 1.0}, {"negative", -1.0}}, 1.0);
  section.finish();
}

void read_solid_part(Section& gauge, GaugeRange& range) {
  read_from_to(gauge, axes_of(gauge.reading().dimension), range);
}

void read_run_up_range(Section& gauge, GaugeOptions& options) {
  const Reading& reading = gauge.reading();
  std::vector<std::size_t> along = axes_of(reading.dimension);
  along.pop_back();
  read_from_to(gauge, along, options.range);
  options.thickness = gauge.number(
      "thickness", quantity::length,
      positive("water of no thickness would be wet everywhere", "Half a cell is the default."),
      0.5 * reading.spacing[2]);
}

}  // namespace mudlark

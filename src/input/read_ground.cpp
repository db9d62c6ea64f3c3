/// Ground surfaces of shapes: lines in the case file, and heights from files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "grid/height_map.hpp"
#include "input/height_file.hpp"
#include "input/sections.hpp"

namespace mudlark {
namespace {

using Line = std::vector<std::array<double, 2>>;

std::optional<Shape> read_line(Section& section) {
  BelowShape below{section.pairs("line", quantity::length)};
  if (below.line.empty()) return {};
  for (std::size_t i = 1; i < below.line.size(); ++i)
    if (!(below.line[i][0] > below.line[i - 1][0])) {
      section.fail("line", "x must grow from point to point of the ground line");
      return {};
    }
  return Shape{below};
}

/// [m] per length unit of the file's column; NaN after a mistake.
double unit_factor(Section& section, const std::string& unit) {
  if (unit.empty()) return 1.0;
  const auto reading = section.reading().units.read("1 " + unit, quantity::length);
  if (reading && reading->value) return *reading->value;
  section.fail("file", fmt::format("its header says [{}]: {}", unit,
                                   reading ? reading->problem : "that is no unit"));
  return std::nan("");
}

/// How the file's coordinates become metres of the case.
struct Placement {
  double scale = 1.0;
  Point3 offset{};
};
Placement read_placement(Section& section) {
  Placement placement;
  placement.scale =
      section.number("scale", quantity::number,
                     positive("lengths of the file are multiplied by it, to metres"), 1.0);
  const auto axes = static_cast<std::size_t>(section.reading().dimension);
  const auto offset =
      section.numbers("offset", quantity::length, axes, std::vector<double>(axes, 0.0));
  if (offset.size() == axes) placement.offset = point_from_axes(offset);
  return placement;
}

/// False with a message when no place of a file lies over the domain: coordinates of another
/// origin.
bool reaches_domain(Section& section, std::size_t axis, const std::vector<double>& places) {
  const auto [first, last] = std::minmax_element(places.begin(), places.end());
  const double lower = section.reading().domain->lower[axis],
               upper = section.reading().domain->upper[axis];
  if (*first<upper&& * last> lower) return true;
  section.fail(
      "file",
      fmt::format("its {} go from {:.10g} to {:.10g} m, beside the domain ({:g} to {:g} m)",
                  "xyz"[axis], *first, *last, lower, upper),
      "`offset` is added to its coordinates.");
  return false;
}

/// The part of a line over the domain, so that what lies beyond it does not count.
Line cropped(const Line& line, double lower, double upper) {
  const auto height = [&](double x) {
    if (x <= line.front()[0]) return line.front()[1];
    for (std::size_t i = 1; i < line.size(); ++i)
      if (x <= line[i][0])
        return line[i - 1][1] +
               (x - line[i - 1][0]) / (line[i][0] - line[i - 1][0]) * (line[i][1] - line[i - 1][1]);
    return line.back()[1];
  };
  Line cut{{lower, height(lower)}};
  for (const auto& point : line)
    if (point[0] > lower && point[0] < upper) cut.push_back(point);
  cut.push_back({upper, height(upper)});
  return cut;
}

std::optional<Shape> line_of(Section& section, HeightFile& file, const Placement& placement) {
  const double unit_x = unit_factor(section, file.units[0]),
               unit_z = unit_factor(section, file.units[2]);
  if (std::isnan(unit_x) || std::isnan(unit_z)) return {};
  Line line;
  for (std::size_t i = 0; i < file.x.size(); ++i)
    line.push_back({unit_x * placement.scale * file.x[i] + placement.offset[0],
                    unit_z * placement.scale * file.heights[i] + placement.offset[2]});
  std::vector<double> places;
  for (const auto& point : line) places.push_back(point[0]);
  if (!reaches_domain(section, 0, places)) return {};
  const BoxShape& domain = *section.reading().domain;
  return Shape{BelowShape{cropped(line, domain.lower[0], domain.upper[0])}};
}

/// Puts a height in the place of those that are missing. False when one is needed and there is
/// none.
bool fill_missing(Section& section, HeightFile& file, const std::optional<double>& substitute) {
  const BoxShape& domain = *section.reading().domain;
  const auto near = [](const std::vector<double>& places, std::size_t i, double lower,
                       double upper) {
    const double before = i > 0 ? places[i - 1] : -std::numeric_limits<double>::infinity();
    const double after =
        i + 1 < places.size() ? places[i + 1] : std::numeric_limits<double>::infinity();
    return after > lower && before < upper;
  };
  for (std::size_t j = 0, k = 0; j < file.y.size(); ++j)
    for (std::size_t i = 0; i < file.x.size(); ++i, ++k) {
      if (!std::isnan(file.heights[k])) continue;
      const bool needed = near(file.x, i, domain.lower[0], domain.upper[0]) &&
                          near(file.y, j, domain.lower[1], domain.upper[1]);
      if (needed && !substitute) {
        section.fail("file",
                     fmt::format("the height at ({:g}, {:g}) m is missing there, and the domain "
                                 "needs it",
                                 file.x[i], file.y[j]),
                     "Fill it in, or write missing_height = the height to take.");
        return false;
      }
      file.heights[k] = substitute.value_or(0.0);
    }
  return true;
}

std::optional<Shape> map_of(Section& section, HeightFile& file, const Placement& placement,
                            const std::optional<double>& substitute) {
  std::array<double, 3> unit{};
  for (std::size_t a = 0; a < 3; ++a) unit[a] = unit_factor(section, file.units[a]);
  if (std::any_of(unit.begin(), unit.end(), [](double u) { return std::isnan(u); })) return {};
  for (double& x : file.x) x = unit[0] * placement.scale * x + placement.offset[0];
  for (double& y : file.y) y = unit[1] * placement.scale * y + placement.offset[1];
  for (double& z : file.heights) z = unit[2] * placement.scale * z + placement.offset[2];
  if (!reaches_domain(section, 0, file.x) || !reaches_domain(section, 1, file.y)) return {};
  if (!fill_missing(section, file, substitute)) return {};
  const BoxShape& domain = *section.reading().domain;
  const HeightMap whole(std::move(file.x), std::move(file.y), std::move(file.heights));
  return Shape{
      HeightMapShape{std::make_shared<const HeightMap>(whole.cropped(domain.lower, domain.upper))}};
}

std::optional<Shape> read_heights(Section& section) {
  const auto path = section.file("file", "a file of heights", "\"bed.csv\" or, in 3D, \"bed.asc\"");
  const Placement placement = read_placement(section);
  const bool flat = section.reading().dimension == 2;
  std::optional<double> substitute;
  if (flat)
    section.forbid("missing_height", "a line has no lattice that heights could be missing on");
  else
    substitute = section.number_if_set("missing_height", quantity::length, {});
  if (path.empty() || !section.reading().domain || !(placement.scale > 0.0)) return {};
  try {
    HeightFile file = read_height_file(path, flat);
    return flat ? line_of(section, file, placement) : map_of(section, file, placement, substitute);
  } catch (const InputError& error) {
    section.fail("file", error.what());
    return {};
  }
}

}  // namespace

std::optional<Shape> read_ground(Section& section) {
  if (!section.has("file")) {
    for (const std::string_view key : {"scale", "offset", "missing_height"})
      section.forbid(key, "it is for a file of heights");
    return read_line(section);
  }
  section.forbid("line", "the heights are in the file");
  return read_heights(section);
}

}  // namespace mudlark

/// [domain] and [domain.walls]
#include <fmt/format.h>

#include <cmath>

#include "input/sections.hpp"

namespace mudlark {
namespace {

constexpr double largest_cell_count = 2e9;
/// Fields, faces, multigrid levels and solver vectors of one cell [bytes], for the message only.
constexpr double bytes_per_cell = 600.0;

std::size_t axes_of(const DomainOptions& domain) {
  return static_cast<std::size_t>(domain.dimension);
}

/// Lower and upper corner; false when they make no domain.
bool read_corners(Section& section, DomainOptions& domain) {
  const std::size_t axes = axes_of(domain);
  const auto lower =
      section.numbers("lower", quantity::length, axes, std::vector<double>(axes, 0.0));
  const auto upper = section.numbers("upper", quantity::length, axes);
  if (lower.size() != axes || upper.size() != axes) return false;
  for (std::size_t a = 0; a < axes; ++a) {
    domain.lower[a] = lower[a], domain.upper[a] = upper[a];
    if (upper[a] > lower[a]) continue;
    section.fail("upper", fmt::format("along {} it must lie above lower = {}",
                                      axis_name(domain.dimension, a), lower[a]));
    return false;
  }
  return true;
}

/// Of a list; 0 of anything else.
std::size_t entries(const Value* value) {
  const List* list = value ? std::get_if<List>(&value->data) : nullptr;
  return list ? list->size() : 0;
}

/// Number of cells of the given size along one axis; 0 with a message when they do not fit.
int fitting_cells(Section& section, double length, double size, std::string_view axis) {
  if (!(size > 0.0)) {
    section.fail("cell_size", "a cell needs a size above 0");
    return 0;
  }
  const double count = length / size, whole = std::round(count);
  if (count > largest_cell_count) {
    section.fail("cell_size", fmt::format("{:.3g} cells along {}", count, axis),
                 "Write a larger size.");
    return 0;
  }
  if (whole >= 1.0 && std::abs(count - whole) <= 1e-6 * whole) return static_cast<int>(whole);
  const double fewer = std::max(1.0, std::floor(count));
  section.fail("cell_size",
               fmt::format("it does not divide the domain's {} m along {}", length, axis),
               fmt::format("The nearest sizes that fit are {:.9g} and {:.9g} m.", length / fewer,
                           length / (std::floor(count) + 1.0)));
  return 0;
}

/// One number for all axes or a list per axis.
std::vector<double> scalar_or_list(Section& section, std::string_view key, const Quantity& quantity,
                                   std::size_t axes) {
  const Value* value = section.raw(key);
  if (!value || std::holds_alternative<List>(value->data))
    return section.numbers(key, quantity, axes);
  const auto scalar = section.si(*value, section.name_of(key), quantity);
  return scalar ? std::vector<double>(axes, *scalar) : std::vector<double>{};
}

bool cells_from_list(Section& section, DomainOptions& domain) {
  const std::size_t axes = axes_of(domain);
  const auto list = section.numbers("cells", quantity::number, axes);
  if (list.size() != axes) return false;
  for (std::size_t a = 0; a < axes; ++a) {
    if (list[a] < 1.0 || list[a] != std::floor(list[a])) {
      section.fail("cells",
                   fmt::format("the number of cells along {} must be a whole number above 0",
                               axis_name(domain.dimension, a)));
      return false;
    }
    domain.cells[a] = static_cast<int>(std::min(list[a], largest_cell_count));
  }
  return true;
}

bool cells_from_size(Section& section, DomainOptions& domain, bool corners_known) {
  const std::size_t axes = axes_of(domain);
  const auto sizes = scalar_or_list(section, "cell_size", quantity::length, axes);
  if (sizes.size() != axes || !corners_known) return false;
  bool good = true;
  std::vector<double> cells;
  for (std::size_t a = 0; a < axes; ++a) {
    domain.cells[a] = fitting_cells(section, domain.upper[a] - domain.lower[a], sizes[a],
                                    axis_name(domain.dimension, a));
    good = good && domain.cells[a] > 0;
    cells.push_back(domain.cells[a]);
  }
  section.record().value("cells", toml_numbers(cells), "-");
  return good;
}

bool read_cells(Section& section, DomainOptions& domain, bool corners_known) {
  const bool by_number = section.has("cells"), by_size = section.has("cell_size");
  const std::string_view key = by_size ? "cell_size" : "cells";
  if (by_number && by_size) {
    section.fail("cell_size", "cells is given too", "Write one of the two.");
    return false;
  }
  if (!by_number && !by_size) {
    section.missing("cells", "the number of cells per axis, or cell_size, is needed");
    return false;
  }
  const bool good =
      by_size ? cells_from_size(section, domain, corners_known) : cells_from_list(section, domain);
  if (!good) return false;
  double total = 1.0;
  for (std::size_t a = 0; a < axes_of(domain); ++a) total *= domain.cells[a];
  if (total <= largest_cell_count) return true;
  section.fail(
      key,
      fmt::format("{:.3g} cells would take about {:.0f} GiB of memory; the limit is {:.0e} cells",
                  total, total * bytes_per_cell / (1u << 30u), largest_cell_count),
      "Write fewer or larger cells.");
  return false;
}

void read_gravity(Section& section, DomainOptions& domain) {
  const std::size_t axes = axes_of(domain);
  const Value* value = section.raw("gravity");
  std::vector<double> gravity(axes, 0.0);
  if (value && std::holds_alternative<List>(value->data)) {
    gravity = section.numbers("gravity", quantity::acceleration, axes);
    if (gravity.size() != axes) return;
    if (gravity.back() > 0.0)
      return section.fail("gravity", "it points upwards: a list is a vector, z upwards",
                          fmt::format("Write {:g} for the last entry.", -gravity.back()));
  } else {
    const auto scalar = value
                            ? section.si(*value, section.name_of("gravity"), quantity::acceleration)
                            : std::optional<double>(9.81);
    if (!scalar) return;
    if (*scalar < 0.0)
      return section.fail("gravity", "a single number points downwards and cannot be negative",
                          "Write a list per axis for another direction.");
    gravity.back() = *scalar == 0.0 ? 0.0 : -*scalar;
    section.record().value("gravity", toml_numbers(gravity), quantity::acceleration.unit);
  }
  for (std::size_t a = 0; a < axes; ++a) domain.gravity[a] = gravity[a];
}

/// A word, or { type = "friction", friction_coefficient = .. }.
void read_wall(Section& walls, const std::string& key, const std::vector<Choice<Wall>>& kinds,
               Wall& wall, double& friction) {
  const Value* value = walls.has(key) ? walls.raw(key) : nullptr;
  const auto* word = value ? std::get_if<std::string>(&value->data) : nullptr;
  if (word && (*word == "absorbing" || *word == "fixed" || *word == "moving")) {
    walls.fail(
        key, "that is said of soil only",
        fmt::format("Write [[boundary]] with side = \"{}\" and grains = \"{}\".", key, *word));
    return;
  }
  if (!value || !std::holds_alternative<Table>(value->data)) {
    wall = walls.choice<Wall>(key, kinds, Wall::slip);
    return;
  }
  Section section = walls.table(key, Record::Form::inline_table);
  wall = section.choice<Wall>("type", {{"friction", Wall::friction}});
  friction = section.number("friction_coefficient", quantity::number,
                            not_negative("friction cannot push", "0.4 is tan 22 degrees."));
  section.finish();
}

void read_walls(Section& section, DomainOptions& domain, bool cells_known) {
  Section walls = section.table("walls", Record::Form::block);
  const std::vector<Choice<Wall>> kinds{{"slip", Wall::slip},
                                        {"no-slip", Wall::no_slip},
                                        {"open", Wall::open},
                                        {"periodic", Wall::periodic}};
  for (std::size_t a = 0; a < axes_of(domain); ++a) {
    const std::string_view axis = axis_name(domain.dimension, a);
    const std::array<std::string, 2> keys{fmt::format("lower_{}", axis),
                                          fmt::format("upper_{}", axis)};
    for (std::size_t side = 0; side < 2; ++side)
      read_wall(walls, keys[side], kinds, domain.walls[a][side], domain.wall_friction[a][side]);
    const bool lower = domain.walls[a][0] == Wall::periodic,
               upper = domain.walls[a][1] == Wall::periodic;
    if (lower != upper) {
      const std::string& one = keys[lower ? 0 : 1];
      walls.fail(one, "a periodic side is joined to the opposite side, which is not periodic",
                 fmt::format("Write {} = \"periodic\" too.", keys[lower ? 1 : 0]));
    } else if (lower && cells_known && domain.cells[a] < 3) {
      walls.fail(keys[0],
                 fmt::format("a periodic axis needs at least 3 cells, it has {}", domain.cells[a]));
    }
  }
  if (domain.dimension == 2)
    for (const char* key : {"lower_y", "upper_y"})
      walls.forbid(key, "a plane strain domain has the axes x and z only");
  walls.finish();
}

}  // namespace

void read_domain(Section& root, CaseOptions& options) {
  Section section = root.table("domain", Record::Form::block, true);
  DomainOptions& domain = options.domain;
  if (!root.has("domain")) return;
  domain.dimension = section.integer(
      "dimension", {.lower = 2, .upper = 3, .reason = "2 is plane strain in x and z, 3 is x, y, z"},
      entries(section.raw("upper")) == 3 ? 3 : 2);
  Reading& reading = root.reading();
  reading.dimension = domain.dimension;
  const bool corners_known = read_corners(section, domain);
  const bool cells_known = read_cells(section, domain, corners_known);
  read_gravity(section, domain);
  read_walls(section, domain, cells_known);
  const auto mean_cells = domain.cells;
  read_refinements(section, domain, corners_known && cells_known);
  section.finish();
  if (!corners_known) return;
  const std::size_t axes = axes_of(domain);
  const std::vector<double> lower(domain.lower.begin(), domain.lower.begin() + domain.dimension);
  const std::vector<double> upper(domain.upper.begin(), domain.upper.begin() + domain.dimension);
  BoxShape box{point_from_axes(lower), point_from_axes(upper)};
  if (axes == 2) {
    box.lower[1] = -std::numeric_limits<double>::infinity();
    box.upper[1] = std::numeric_limits<double>::infinity();
  }
  reading.domain = box;
  if (!cells_known) return;
  for (std::size_t a = 0; a < axes; ++a)
    reading.spacing[axes == 2 && a == 1 ? 2 : a] =
        (domain.upper[a] - domain.lower[a]) / mean_cells[a];
}

std::string_view axis_name(int dimension, std::size_t axis) {
  constexpr std::array<std::string_view, 2> two{"x", "z"};
  constexpr std::array<std::string_view, 3> three{"x", "y", "z"};
  return dimension == 2 ? two[axis] : three[axis];
}

Point3 point_from_axes(const std::vector<double>& axes) {
  if (axes.size() == 2) return {axes[0], 0.0, axes[1]};
  return {axes[0], axes[1], axes[2]};
}

}  // namespace mudlark

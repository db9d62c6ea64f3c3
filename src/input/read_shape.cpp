/// Shapes, names, and the space that bodies fill
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "input/sections.hpp"

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::optional<Shape> read_form(Section& shape, const Place& place, int depth);

Point3 read_point(Section& section, std::string_view key, bool& good) {
  const auto axes = static_cast<std::size_t>(section.reading().dimension);
  const auto point = section.numbers(key, quantity::length, axes);
  good = good && point.size() == axes;
  return point.size() == axes ? point_from_axes(point) : Point3{};
}

double read_radius(Section& section, bool& good) {
  const double radius =
      section.number("radius", quantity::length, positive("a radius lies above 0"));
  good = good && radius > 0.0;
  return radius;
}

std::optional<Shape> read_box(Section& section) {
  bool good = true;
  BoxShape box{read_point(section, "lower", good), read_point(section, "upper", good)};
  if (!good) return {};
  for (std::size_t a = 0; a < 3; ++a) {
    if (section.reading().dimension == 2 && a == 1) {
      box.lower[1] = -infinity, box.upper[1] = infinity;
    } else if (!(box.upper[a] > box.lower[a])) {
      section.fail("upper", "the upper corner must lie above the lower one along every axis");
      return {};
    }
  }
  return Shape{box};
}

/// Twice the area that the corners enclose, with sign [m2].
double shoelace(const std::vector<std::array<double, 2>>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
    sum += corners[j][0] * corners[i][1] - corners[i][0] * corners[j][1];
  return sum;
}

/// Do two sides of the outline cross (sides that share a corner aside)?
bool crosses_itself(const std::vector<std::array<double, 2>>& corners) {
  const std::size_t count = corners.size();
  const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (corners[b][0] - corners[a][0]) * (corners[c][1] - corners[a][1]) -
           (corners[b][1] - corners[a][1]) * (corners[c][0] - corners[a][0]);
  };
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j == count - 1) continue;
      const std::size_t i2 = i + 1, j2 = (j + 1) % count;
      if (turn(i, i2, j) * turn(i, i2, j2) < 0.0 && turn(j, j2, i) * turn(j, j2, i2) < 0.0)
        return true;
    }
  return false;
}

std::optional<Shape> read_polygon(Section& section) {
  PolygonShape polygon;
  polygon.corners = section.pairs("corners", quantity::length);
  if (section.reading().dimension == 3) {
    polygon.vertical_plane = section.choice<bool>("plane", {{"xy", false}, {"xz", true}}, false);
    if (!polygon.vertical_plane) {
      polygon.bottom = section.number("bottom", quantity::length, {});
      polygon.top = section.number("top", quantity::length, {});
      if (!(polygon.top > polygon.bottom)) {
        if (section.has("top")) section.fail("top", "it must lie above bottom");
        return {};
      }
    }
  }
  if (polygon.corners.empty()) return {};
  if (polygon.corners.size() < 3 || shoelace(polygon.corners) == 0.0) {
    section.fail("corners", "a polygon needs at least three corners that enclose an area");
    return {};
  }
  if (crosses_itself(polygon.corners)) {
    section.fail("corners", "the outline crosses itself", "Write the corners in order around it.");
    return {};
  }
  return Shape{polygon};
}

std::optional<Shape> read_sphere(Section& section, bool circle) {
  bool good = true;
  const SphereShape sphere{read_point(section, "centre", good), read_radius(section, good), circle};
  if (!good) return {};
  return Shape{sphere};
}

std::optional<Shape> read_cylinder(Section& section) {
  bool good = true;
  const CylinderShape cylinder{read_point(section, "from", good), read_point(section, "to", good),
                               read_radius(section, good)};
  if (good && cylinder.from == cylinder.to) {
    section.fail("to", "the axis needs two different ends");
    return {};
  }
  if (!good) return {};
  return Shape{cylinder};
}

/// The part of [0, 1) that the i-th point of Halton's sequence takes along an axis (van der Corput,
/// 1935).
double radical_inverse(int i, int base) {
  double value = 0.0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

/// The i-th of many places spread over a box.
Point3 place_in(const BoxShape& box, int i) {
  constexpr std::array<int, 3> bases{2, 3, 5};
  Point3 place;
  for (std::size_t a = 0; a < 3; ++a)
    place[a] = std::isinf(box.upper[a])
                   ? 0.0
                   : box.lower[a] + (box.upper[a] - box.lower[a]) * radical_inverse(i, bases[a]);
  return place;
}

bool has_room(const Shape& shape, const BoxShape& domain) {
  constexpr int samples = 16384;
  for (int i = 1; i <= samples; ++i)
    if (shape.contains(place_in(domain, i))) return true;
  return false;
}

/// What of the domain lies over a ground.
std::optional<Shape> read_above(Section& section) {
  auto ground = read_ground(section);
  const auto& domain = section.reading().domain;
  if (!ground || !domain) return {};
  return Shape{DifferenceShape{{Shape{*domain}, std::move(*ground)}}};
}

/// Below one ground and above another.
std::optional<Shape> read_between(Section& section) {
  std::vector<Shape> grounds;
  for (const std::string_view key : {"upper", "lower"}) {
    if (!section.has(key)) {
      section.missing(key, "for example { line = [[0, 1], [10, 2]] }");
      continue;
    }
    Section part = section.table(key, Record::Form::inline_table);
    if (auto ground = read_ground(part)) grounds.push_back(std::move(*ground));
    part.finish();
  }
  const auto& domain = section.reading().domain;
  if (grounds.size() != 2 || !domain) return {};
  Shape layer{DifferenceShape{std::move(grounds)}};
  if (has_room(layer, *domain)) return layer;
  section.fail("lower", "it lies above the upper ground everywhere: nothing is between them");
  return {};
}

/// union and difference: a list of shapes.
std::optional<Shape> read_parts(Section& shape, std::string_view key, int depth) {
  const Value* value = shape.raw(key);
  const auto* list = std::get_if<List>(&value->data);
  constexpr int deepest = 16;
  if (!list || list->size() < 2 || depth > deepest) {
    shape.fail(key, "a list of at least two shapes is expected");
    return {};
  }
  Record& record = shape.record().child(key, Record::Form::inline_list);
  std::vector<Shape> parts;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Value& item = (*list)[i];
    const auto* table = std::get_if<Table>(&item.data);
    if (!table) {
      shape.fail(key, "every part must be a shape, for example { box = { ... } }");
      return {};
    }
    Section part = shape.over(*table, item.place, fmt::format("{}[{}]", key, i),
                              record.child("", Record::Form::inline_table));
    if (auto form = read_form(part, item.place, depth + 1)) parts.push_back(std::move(*form));
  }
  if (parts.size() != list->size()) return {};
  if (key == "union") return Shape{UnionShape{std::move(parts)}};
  return Shape{DifferenceShape{std::move(parts)}};
}

std::optional<Shape> read_form(Section& shape, const Place& place, int depth) {
  const bool flat = shape.reading().dimension == 2;
  std::vector<std::string> found;
  for (const std::string key : {"box", "polygon", "circle", "sphere", "cylinder", "below", "above",
                                "between", "union", "difference", "stl"})
    if (shape.has(key)) found.push_back(key);
  if (found == std::vector<std::string>{"stl"}) {
    if (flat) {
      shape.fail("stl", "a surface in space has no place in two dimensions",
                 "Write a polygon, or dimension = 3 in [domain].");
      for (const char* key : {"scale", "offset"}) shape.has(key);
      shape.finish();
      return {};
    }
    auto form = read_stl(shape);
    shape.finish();
    return form;
  }
  shape.finish();
  if (found.size() != 1) {
    shape.reading().report.add(
        place,
        fmt::format("{} needs exactly one form\n  (box, polygon, circle, sphere, cylinder, below, "
                    "above, between, union, difference, stl). For example {{ box = {{ lower = [0, "
                    "0], upper = [1, "
                    "1] }} }}.",
                    shape.path()));
    return {};
  }
  const std::string& key = found.front();
  if (key == "union" || key == "difference") return read_parts(shape, key, depth);
  if (flat ? key == "sphere" || key == "cylinder" : key == "circle") {
    shape.fail(key, fmt::format("this form does not exist in {} dimensions", flat ? 2 : 3),
               flat ? "Write circle." : "Write sphere or cylinder.");
    return {};
  }
  Section section = shape.table(key, Record::Form::inline_table);
  auto form = key == "box"        ? read_box(section)
              : key == "polygon"  ? read_polygon(section)
              : key == "cylinder" ? read_cylinder(section)
              : key == "below"    ? read_ground(section)
              : key == "above"    ? read_above(section)
              : key == "between"  ? read_between(section)
                                  : read_sphere(section, key == "circle");
  section.finish();
  return form;
}

/// Does the box have something of the domain, but for the faces of both?
bool meets(const BoxShape& box, const BoxShape& domain) {
  for (std::size_t a = 0; a < 3; ++a)
    if (!std::isinf(domain.lower[a]) &&
        !(box.lower[a] < domain.upper[a] && box.upper[a] > domain.lower[a]))
      return false;
  return true;
}

/// "0 to 10 m along x and 0 to 2 m along z"
std::string extent_of(const BoxShape& domain) {
  std::string words;
  for (std::size_t a = 0; a < 3; ++a)
    if (!std::isinf(domain.lower[a]))
      words += fmt::format("{}{:g} to {:g} m along {}",
                           words.empty() ? ""
                           : a == 2      ? " and "
                                         : ", ",
                           domain.lower[a], domain.upper[a], "xyz"[a]);
  return words;
}

bool overlap(const Shape& one, const Shape& other, const BoxShape& domain) {
  constexpr double largest_slack = 1e3;  // the domain may have no end along y
  BoxShape common;
  const BoxShape a = bounds(one), b = bounds(other);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    common.lower[axis] = std::max({a.lower[axis], b.lower[axis], domain.lower[axis]});
    common.upper[axis] = std::min({a.upper[axis], b.upper[axis], domain.upper[axis]});
    const double size = common.upper[axis] - common.lower[axis];
    if (std::isinf(size))
      common.lower[axis] = common.upper[axis] = 0.0;
    else if (size <= 1e-9 * std::min(domain.upper[axis] - domain.lower[axis], largest_slack))
      return false;
  }
  constexpr int samples = 16384;
  for (int i = 1; i <= samples; ++i) {
    const Point3 place = place_in(common, i);
    if (one.contains(place) && other.contains(place)) return true;
  }
  return false;
}

}  // namespace

std::optional<Shape> read_shape(Section& section, std::string_view key, Reach reach) {
  if (!section.has(key)) {
    section.missing(key, "for example { box = { lower = [0, 0], upper = [1, 1] } }");
    return {};
  }
  Section shape = section.table(key, Record::Form::inline_table, false, quantity::length.unit);
  if (!std::holds_alternative<Table>(section.raw(key)->data)) return {};
  auto form = read_form(shape, section.place(key), 0);
  const auto& domain = section.reading().domain;
  if (!form || !domain) return form;
  const BoxShape box = bounds(*form);
  const double top = domain->upper[2], slack = 1e-9 * (top - domain->lower[2]);
  if (!meets(box, *domain)) {
    section.fail(key, fmt::format("it lies outside the domain, which is {}", extent_of(*domain)),
                 "Move the shape, or make the domain larger.");
  } else if (reach == Reach::below_the_top && std::isfinite(box.upper[2]) &&
             box.upper[2] > top + slack) {
    section.fail(
        key,
        fmt::format("it reaches up to z = {:g} m, over the domain's top at {:g} m, and the "
                    "weight of what lies above would be missing",
                    box.upper[2], top),
        "Make the domain higher, or end the shape at its top. Over sides and bottom it may "
        "reach: it ends there.");
  } else {
    return form;
  }
  return {};
}

void check_overlaps(Reading& reading, const std::vector<NamedShape>& grounds) {
  if (!reading.domain) return;
  for (std::size_t i = 0; i < grounds.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (grounds[i].stage == grounds[j].stage &&
          overlap(grounds[i].shape, grounds[j].shape, *reading.domain))
        reading.report.add(grounds[i].place,
                           fmt::format("{} overlaps {}\n  (no two bodies can fill the same space).",
                                       grounds[i].what, grounds[j].what));
}

std::string read_name(Section& section, std::vector<std::string>& used) {
  const std::string name = section.text("name");
  const Value* written = section.raw("name");
  if (!written || !std::holds_alternative<std::string>(written->data)) return name;
  const bool plain =
      !name.empty() && name.size() <= 100 && name.front() != '.' &&
      std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) || c == ' ' || c == '_' || c == '-' || c == '+' || c == '.';
      });
  if (!plain)
    section.fail(
        "name",
        "a name consists of at most 100 letters, digits, blanks and _ - + . and does not begin "
        "with a dot");
  else if (std::find(used.begin(), used.end(), name) != used.end())
    section.fail("name", "another one has this name already", "Give each its own name.");
  used.push_back(name);
  return name;
}

}  // namespace mudlark

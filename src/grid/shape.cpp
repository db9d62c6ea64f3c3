#include "grid/shape.hpp"

#include <algorithm>
#include <limits>

#include "grid/height_map.hpp"
#include "grid/triangle_mesh.hpp"

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr BoxShape everywhere{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};

bool inside(const BoxShape& box, const Point3& position) {
  for (std::size_t a = 0; a < 3; ++a)
    if (position[a] < box.lower[a] || position[a] > box.upper[a]) return false;
  return true;
}

/// Even-odd rule: a ray to the right crosses the outline an odd number of times.
bool inside(const PolygonShape& polygon, const Point3& position) {
  const double first = position[0], second = polygon.vertical_plane ? position[2] : position[1];
  if (!polygon.vertical_plane && (position[2] < polygon.bottom || position[2] > polygon.top))
    return false;
  bool odd = false;
  for (std::size_t i = 0, j = polygon.corners.size() - 1; i < polygon.corners.size(); j = i++) {
    const auto &a = polygon.corners[i], &b = polygon.corners[j];
    if ((a[1] > second) == (b[1] > second)) continue;
    if (first < a[0] + (b[0] - a[0]) * (second - a[1]) / (b[1] - a[1])) odd = !odd;
  }
  return odd;
}

bool inside(const SphereShape& sphere, const Point3& position) {
  const double x = position[0] - sphere.centre[0];
  const double y = sphere.circle ? 0.0 : position[1] - sphere.centre[1];
  const double z = position[2] - sphere.centre[2];
  return x * x + y * y + z * z <= sphere.radius * sphere.radius;
}

bool inside(const CylinderShape& cylinder, const Point3& position) {
  double length2 = 0.0, along = 0.0, distance2 = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double axis = cylinder.to[a] - cylinder.from[a], way = position[a] - cylinder.from[a];
    length2 += axis * axis, along += axis * way, distance2 += way * way;
  }
  if (along < 0.0 || along > length2) return false;
  return distance2 - along * along / length2 <= cylinder.radius * cylinder.radius;
}

bool inside(const BelowShape& below, const Point3& position) {
  const auto& line = below.line;
  const double x = position[0];
  if (x <= line.front()[0]) return position[2] <= line.front()[1];
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (x > line[i][0]) continue;
    const double share = (x - line[i - 1][0]) / (line[i][0] - line[i - 1][0]);
    return position[2] <= line[i - 1][1] + share * (line[i][1] - line[i - 1][1]);
  }
  return position[2] <= line.back()[1];
}

bool inside(const HeightMapShape& ground, const Point3& position) {
  return position[2] <= ground.map->height_at(position[0], position[1]);
}

bool inside(const StlShape& stl, const Point3& position) { return stl.mesh->contains(position); }

bool inside(const UnionShape& whole, const Point3& position) {
  return std::any_of(whole.parts.begin(), whole.parts.end(),
                     [&](const Shape& part) { return part.contains(position); });
}

bool inside(const DifferenceShape& whole, const Point3& position) {
  return whole.parts.front().contains(position) &&
         std::none_of(whole.parts.begin() + 1, whole.parts.end(),
                      [&](const Shape& part) { return part.contains(position); });
}

double box_fraction(const BoxShape& box, const Point3& lower, const Point3& upper, int dimension) {
  double fraction = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (dimension == 2 && a == 1) continue;
    const double overlap = std::min(box.upper[a], upper[a]) - std::max(box.lower[a], lower[a]);
    fraction *= std::clamp(overlap / (upper[a] - lower[a]), 0.0, 1.0);
  }
  return fraction;
}

/// The same at all y: a slice of it has the same shares in space as in the plane.
bool is_prism(const Shape& shape) {
  const auto* polygon = std::get_if<PolygonShape>(&shape.form);
  return std::holds_alternative<BelowShape>(shape.form) || (polygon && polygon->vertical_plane);
}

double sampled_fraction(const Shape& shape, const Point3& lower, const Point3& upper,
                        int dimension) {
  const int samples = dimension == 2 ? 16 : 8, across = dimension == 2 ? 1 : samples;
  const auto at = [&](std::size_t axis, int i, int count) {
    return lower[axis] + (upper[axis] - lower[axis]) * (i + 0.5) / count;
  };
  int hits = 0;
  for (int k = 0; k < samples; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < samples; ++i) {
        const double y = dimension == 2 ? 0.0 : at(1, j, across);
        if (shape.contains({at(0, i, samples), y, at(2, k, samples)})) ++hits;
      }
  return static_cast<double>(hits) / (samples * across * samples);
}

/// Whether the straight line from a to b comes into the open rectangle from `low` to `high`, or
/// may.
bool may_cross(const std::array<double, 2>& a, const std::array<double, 2>& b,
               const std::array<double, 2>& low, const std::array<double, 2>& high) {
  for (std::size_t k = 0; k < 2; ++k)
    if (std::max(a[k], b[k]) <= low[k] || std::min(a[k], b[k]) >= high[k]) return false;
  int left = 0, right = 0;  // corners of the rectangle on either side of the line
  for (const double first : {low[0], high[0]})
    for (const double second : {low[1], high[1]}) {
      const double side = (b[0] - a[0]) * (second - a[1]) - (b[1] - a[1]) * (first - a[0]);
      if (side >= 0.0) ++left;
      if (side <= 0.0) ++right;
    }
  return left < 4 && right < 4;
}

bool may_cross(const PolygonShape& polygon, const Point3& lower, const Point3& upper) {
  const std::size_t second = polygon.vertical_plane ? 2 : 1;
  if (!polygon.vertical_plane)
    for (const double level : {polygon.bottom, polygon.top})
      if (level > lower[2] && level < upper[2]) return true;
  const auto& corners = polygon.corners;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
    if (may_cross(corners[j], corners[i], {lower[0], lower[second]}, {upper[0], upper[second]}))
      return true;
  return false;
}

bool may_cross(const BelowShape& below, const Point3& lower, const Point3& upper) {
  const auto& line = below.line;
  const std::array<double, 2> low{lower[0], lower[2]}, high{upper[0], upper[2]};
  if (may_cross({-infinity, line.front()[1]}, line.front(), low, high)) return true;
  for (std::size_t i = 1; i < line.size(); ++i)
    if (may_cross(line[i - 1], line[i], low, high)) return true;
  return may_cross(line.back(), {infinity, line.back()[1]}, low, high);
}

bool outside(const BoxShape& box, const Point3& lower, const Point3& upper) {
  for (std::size_t a = 0; a < 3; ++a)
    if (upper[a] < box.lower[a] || lower[a] > box.upper[a]) return true;
  return false;
}

/// Whether the surface of a shape may pass through the box [lower, upper]; where it does not, the
/// box is inside or outside as a whole and need not be sampled.
bool surface_may_cross(const Shape& shape, const Point3& lower, const Point3& upper) {
  const auto in_part = [&](const Shape& part) { return surface_may_cross(part, lower, upper); };
  if (const auto* polygon = std::get_if<PolygonShape>(&shape.form))
    return may_cross(*polygon, lower, upper);
  if (const auto* below = std::get_if<BelowShape>(&shape.form))
    return may_cross(*below, lower, upper);
  if (const auto* ground = std::get_if<HeightMapShape>(&shape.form)) {
    const auto [lowest, highest] = ground->map->range(lower, upper);
    return upper[2] > lowest && lower[2] <= highest;
  }
  if (const auto* whole = std::get_if<UnionShape>(&shape.form))
    return std::any_of(whole->parts.begin(), whole->parts.end(), in_part);
  if (const auto* whole = std::get_if<DifferenceShape>(&shape.form))
    return std::any_of(whole->parts.begin(), whole->parts.end(), in_part);
  const BoxShape around = bounds(shape);
  const bool box = std::holds_alternative<BoxShape>(shape.form);
  return !outside(around, lower, upper) && !(box && inside(around, lower) && inside(around, upper));
}

void grow(BoxShape& box, std::size_t axis, double value) {
  box.lower[axis] = std::min(box.lower[axis], value);
  box.upper[axis] = std::max(box.upper[axis], value);
}

BoxShape bounds_of(const BoxShape& box) { return box; }

BoxShape bounds_of(const PolygonShape& polygon) {
  BoxShape box = everywhere;
  const std::size_t second = polygon.vertical_plane ? 2 : 1;
  for (const std::size_t axis : {std::size_t{0}, second})
    box.lower[axis] = infinity, box.upper[axis] = -infinity;
  for (const auto& corner : polygon.corners) {
    grow(box, 0, corner[0]);
    grow(box, second, corner[1]);
  }
  if (!polygon.vertical_plane) box.lower[2] = polygon.bottom, box.upper[2] = polygon.top;
  return box;
}

BoxShape bounds_of(const SphereShape& sphere) {
  BoxShape box = everywhere;
  for (std::size_t a = 0; a < 3; ++a) {
    if (sphere.circle && a == 1) continue;
    box.lower[a] = sphere.centre[a] - sphere.radius;
    box.upper[a] = sphere.centre[a] + sphere.radius;
  }
  return box;
}

/// The end discs reach radius * sin(angle between the cylinder and the axis) along each axis.
BoxShape bounds_of(const CylinderShape& cylinder) {
  BoxShape box;
  double length2 = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
    length2 += (cylinder.to[a] - cylinder.from[a]) * (cylinder.to[a] - cylinder.from[a]);
  for (std::size_t a = 0; a < 3; ++a) {
    const double way = cylinder.to[a] - cylinder.from[a];
    const double reach = cylinder.radius * std::sqrt(std::max(0.0, 1.0 - way * way / length2));
    box.lower[a] = std::min(cylinder.from[a], cylinder.to[a]) - reach;
    box.upper[a] = std::max(cylinder.from[a], cylinder.to[a]) + reach;
  }
  return box;
}

BoxShape bounds_of(const BelowShape& below) {
  BoxShape box = everywhere;
  box.upper[2] = -infinity;
  for (const auto& point : below.line) box.upper[2] = std::max(box.upper[2], point[1]);
  return box;
}

BoxShape bounds_of(const HeightMapShape& ground) {
  BoxShape box = everywhere;
  box.upper[2] = ground.map->highest();
  return box;
}

BoxShape bounds_of(const StlShape& stl) { return {stl.mesh->lower(), stl.mesh->upper()}; }

BoxShape bounds_of(const UnionShape& whole) {
  BoxShape box{everywhere.upper, everywhere.lower};
  for (const Shape& part : whole.parts) {
    const BoxShape other = bounds(part);
    for (std::size_t a = 0; a < 3; ++a) {
      grow(box, a, other.lower[a]);
      grow(box, a, other.upper[a]);
    }
  }
  return box;
}

BoxShape bounds_of(const DifferenceShape& whole) { return bounds(whole.parts.front()); }

}  // namespace

bool Shape::contains(const Point3& position) const {
  return std::visit([&](const auto& kind) { return inside(kind, position); }, form);
}

double fraction_inside(const Shape& shape, const Point3& lower, const Point3& upper,
                       int dimension) {
  if (const auto* box = std::get_if<BoxShape>(&shape.form))
    return box_fraction(*box, lower, upper, dimension);
  if (const auto* stl = std::get_if<StlShape>(&shape.form)) {
    Point3 middle{};
    double reach2 = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      middle[a] = 0.5 * (lower[a] + upper[a]);
      reach2 += 0.25 * (upper[a] - lower[a]) * (upper[a] - lower[a]);
    }
    const double away = stl->mesh->distance_to(middle).distance;
    if (away * away > reach2) return away < 0.0 ? 1.0 : 0.0;
  }
  if (!surface_may_cross(shape, lower, upper)) {
    Point3 middle{};
    for (std::size_t a = 0; a < 3; ++a) middle[a] = 0.5 * (lower[a] + upper[a]);
    return shape.contains(middle) ? 1.0 : 0.0;
  }
  return sampled_fraction(shape, lower, upper, is_prism(shape) ? 2 : dimension);
}

BoxShape bounds(const Shape& shape) {
  return std::visit([](const auto& kind) { return bounds_of(kind); }, shape.form);
}

}  // namespace mudlark

#include "grid/shape_distance.hpp"

#include <algorithm>
#include <limits>

#include "grid/height_map.hpp"
#include "grid/triangle_mesh.hpp"

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double scalar(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Two conditions that both hold inside a body, each with its own distance and normal, at right
/// angles: the wall and the end of a prism or cylinder.
SurfaceDistance both(const SurfaceDistance& one, const SurfaceDistance& other) {
  if (one.distance <= 0.0 || other.distance <= 0.0)
    return one.distance >= other.distance ? one : other;
  const double length = std::hypot(one.distance, other.distance);
  SurfaceDistance edge{length, {}};
  for (std::size_t a = 0; a < 3; ++a)
    edge.normal[a] = (one.distance * one.normal[a] + other.distance * other.normal[a]) / length;
  return edge;
}

/// Between two planes across an axis.
SurfaceDistance slab(double lower, double upper, double place, const Point3& axis) {
  if (lower - place > place - upper) return {lower - place, {-axis[0], -axis[1], -axis[2]}};
  return {place - upper, axis};
}

SurfaceDistance distance(const BoxShape& box, const Point3& position) {
  SurfaceDistance nearest = slab(box.lower[0], box.upper[0], position[0], {1.0, 0.0, 0.0});
  if (std::isfinite(box.lower[1]) || std::isfinite(box.upper[1]))
    nearest = both(nearest, slab(box.lower[1], box.upper[1], position[1], {0.0, 1.0, 0.0}));
  return both(nearest, slab(box.lower[2], box.upper[2], position[2], {0.0, 0.0, 1.0}));
}

struct Flat {
  double distance, first, second;  ///< distance and normal in the polygon's plane
};

/// The nearest side of a closed outline; at a corner the normal points from the corner.
Flat outline_distance(const std::vector<std::array<double, 2>>& corners, double x, double z,
                      bool inside) {
  double best = infinity, area = 0.0;
  Flat nearest{0.0, 0.0, 1.0};
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
    area += corners[j][0] * corners[i][1] - corners[i][0] * corners[j][1];
  const double turn = area > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const double ex = corners[i][0] - corners[j][0], ez = corners[i][1] - corners[j][1];
    const double length2 = ex * ex + ez * ez;
    if (length2 == 0.0) continue;
    const double wx = x - corners[j][0], wz = z - corners[j][1];
    const double share = std::clamp((wx * ex + wz * ez) / length2, 0.0, 1.0);
    const double rx = wx - share * ex, rz = wz - share * ez;
    const double distance2 = rx * rx + rz * rz;
    if (distance2 >= best) continue;
    best = distance2;
    const double length = std::sqrt(length2), away = std::sqrt(distance2);
    const double scale = std::abs(corners[j][0]) + std::abs(corners[j][1]) + length;
    if (away <= 1e-12 * scale)
      nearest = {0.0, turn * ez / length, -turn * ex / length};
    else
      nearest = {away, (inside ? -rx : rx) / away, (inside ? -rz : rz) / away};
  }
  if (inside) nearest.distance = -nearest.distance;
  return nearest;
}

SurfaceDistance distance(const PolygonShape& polygon, const Point3& position) {
  Point3 level =
      position;  // inside the prism's height, for the question whether it is in the plane
  if (!polygon.vertical_plane) level[2] = 0.5 * (polygon.bottom + polygon.top);
  const bool inside = Shape{polygon}.contains(level);
  const double second = polygon.vertical_plane ? position[2] : position[1];
  const Flat flat = outline_distance(polygon.corners, position[0], second, inside);
  if (polygon.vertical_plane) return {flat.distance, {flat.first, 0.0, flat.second}};
  return both({flat.distance, {flat.first, flat.second, 0.0}},
              slab(polygon.bottom, polygon.top, position[2], {0.0, 0.0, 1.0}));
}

SurfaceDistance distance(const SphereShape& sphere, const Point3& position) {
  Point3 way = minus(position, sphere.centre);
  if (sphere.circle) way[1] = 0.0;
  const double length = std::sqrt(scalar(way, way));
  if (length == 0.0) return {-sphere.radius, {0.0, 0.0, 1.0}};
  return {length - sphere.radius, {way[0] / length, way[1] / length, way[2] / length}};
}

SurfaceDistance distance(const CylinderShape& cylinder, const Point3& position) {
  Point3 axis = minus(cylinder.to, cylinder.from);
  const double length = std::sqrt(scalar(axis, axis));
  for (double& component : axis) component /= length;
  Point3 way = minus(position, cylinder.from);
  const double along = scalar(way, axis);
  for (std::size_t a = 0; a < 3; ++a) way[a] -= along * axis[a];
  const double radial = std::sqrt(scalar(way, way));
  SurfaceDistance wall{radial - cylinder.radius, {}};
  if (radial > 0.0) {
    for (std::size_t a = 0; a < 3; ++a) wall.normal[a] = way[a] / radial;
  } else {  // on the axis: any direction across it
    const std::size_t across = std::abs(axis[0]) < 0.9 ? 0 : 1;
    Point3 normal{};
    normal[across] = 1.0;
    const double part = scalar(normal, axis);
    for (std::size_t a = 0; a < 3; ++a) normal[a] -= part * axis[a];
    const double size = std::sqrt(scalar(normal, normal));
    for (std::size_t a = 0; a < 3; ++a) wall.normal[a] = normal[a] / size;
  }
  return both(wall, slab(0.0, length, along, axis));
}

/// The ground line with level ends far beyond the place.
SurfaceDistance distance(const BelowShape& below, const Point3& position) {
  std::vector<std::array<double, 2>> line = below.line;
  const double reach = 1.0 + std::abs(position[0]) + std::abs(position[2]) +
                       std::abs(line.front()[0]) + std::abs(line.back()[0]) +
                       std::abs(line.front()[1]) + std::abs(line.back()[1]);
  line.insert(line.begin(), {line.front()[0] - 4.0 * reach, line.front()[1]});
  line.push_back({line.back()[0] + 4.0 * reach, line.back()[1]});
  const double deep = std::min_element(line.begin(), line.end(),
                                       [](const auto& a, const auto& b) { return a[1] < b[1]; })
                          ->at(1) -
                      8.0 * reach;
  line.push_back({line.back()[0], deep});
  line.push_back({line.front()[0], deep});
  const Flat flat =
      outline_distance(line, position[0], position[2], Shape{below}.contains(position));
  return {flat.distance, {flat.first, 0.0, flat.second}};
}

SurfaceDistance distance(const UnionShape& whole, const Point3& position) {
  SurfaceDistance nearest{infinity, {0.0, 0.0, 1.0}};
  for (const Shape& part : whole.parts) {
    const SurfaceDistance one = distance_to(part, position);
    if (one.distance < nearest.distance) nearest = one;
  }
  return nearest;
}

SurfaceDistance distance(const DifferenceShape& whole, const Point3& position) {
  SurfaceDistance nearest = distance_to(whole.parts.front(), position);
  for (std::size_t i = 1; i < whole.parts.size(); ++i) {
    const SurfaceDistance hole = distance_to(whole.parts[i], position);
    if (-hole.distance > nearest.distance)
      nearest = {-hole.distance, {-hole.normal[0], -hole.normal[1], -hole.normal[2]}};
  }
  return nearest;
}

SurfaceDistance distance(const HeightMapShape& ground, const Point3& position) {
  return ground.map->distance_to(position);
}

SurfaceDistance distance(const StlShape& stl, const Point3& position) {
  return stl.mesh->distance_to(position);
}

}  // namespace

SurfaceDistance distance_to(const Shape& shape, const Point3& position) {
  return std::visit([&](const auto& kind) { return distance(kind, position); }, shape.form);
}

}  // namespace mudlark

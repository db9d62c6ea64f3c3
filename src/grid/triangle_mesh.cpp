#include "grid/triangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

#include "base/errors.hpp"

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t leaf_size = 4;

Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point3 plus(const Point3& a, double factor, const Point3& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double scalar(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point3 unit(const Point3& a) {
  const double length = std::sqrt(scalar(a, a));
  return length > 0.0 ? Point3{a[0] / length, a[1] / length, a[2] / length} : Point3{};
}

/// The part of a triangle that is nearest to a place: 0 its face, 1-3 the edge from that corner on,
/// 4-6 the corner.
struct Nearest {
  double distance2 = infinity;
  Point3 place{};
  int part = 0;
};

void try_place(Nearest& nearest, const Point3& from, const Point3& place, int part) {
  const Point3 way = minus(from, place);
  const double distance2 = scalar(way, way);
  if (distance2 < nearest.distance2) nearest = {distance2, place, part};
}

Nearest nearest_of_triangle(const Triangle& t, const Point3& p) {
  Nearest nearest;
  const Point3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const double area2 = scalar(normal, normal);
  if (area2 > 0.0) {  // does the foot of the perpendicular lie within?
    bool within = true;
    for (std::size_t i = 0; i < 3; ++i)
      within = within && scalar(cross(minus(t[(i + 1) % 3], t[i]), minus(p, t[i])), normal) > 0.0;
    if (within) {
      try_place(nearest, p, plus(p, -scalar(minus(p, t[0]), normal) / area2, normal), 0);
      return nearest;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3 edge = minus(t[(i + 1) % 3], t[i]);
    const double length2 = scalar(edge, edge);
    const double share = length2 > 0.0 ? scalar(minus(p, t[i]), edge) / length2 : 0.0;
    const int here = static_cast<int>(i);
    if (share <= 0.0)
      try_place(nearest, p, t[i], 4 + here);
    else if (share < 1.0)
      try_place(nearest, p, plus(t[i], share, edge), 1 + here);
  }
  return nearest;
}

double box_distance2(const Point3& lower, const Point3& upper, const Point3& p) {
  double sum = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double out = std::max({lower[a] - p[a], p[a] - upper[a], 0.0});
    sum += out * out;
  }
  return sum;
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32u) | std::max(a, b);
}

}  // namespace

TriangleMesh::TriangleMesh(const std::vector<Triangle>& triangles) {
  if (triangles.empty()) throw InputError("it holds no triangle");
  join_corners(triangles);
  check_closed();
  face_outwards();
  nodes_.reserve(2 * corners_.size() / leaf_size + 2);
  build(0, static_cast<std::uint32_t>(corners_.size()));
  set_normals();
}

Triangle TriangleMesh::triangle(std::size_t i) const {
  return {places_[corners_[i][0]], places_[corners_[i][1]], places_[corners_[i][2]]};
}

/// Corners within the tolerance of an earlier one become that one; found through a map of small
/// cubes.
void TriangleMesh::join_corners(const std::vector<Triangle>& triangles) {
  lower_.fill(infinity);
  upper_.fill(-infinity);
  for (const Triangle& triangle : triangles)
    for (const Point3& corner : triangle)
      for (std::size_t a = 0; a < 3; ++a) {
        if (!std::isfinite(corner[a])) throw InputError("a corner is not a finite number");
        lower_[a] = std::min(lower_[a], corner[a]);
        upper_[a] = std::max(upper_[a], corner[a]);
      }
  const Point3 size = minus(upper_, lower_);
  const double tolerance = 1e-7 * std::sqrt(scalar(size, size));
  if (!(tolerance > 0.0)) throw InputError("all corners lie in one place");
  using Cube = std::array<std::int64_t, 3>;
  std::map<Cube, std::vector<std::uint32_t>> cubes;
  const auto cube_of = [&](const Point3& p) {
    Cube cube;
    for (std::size_t a = 0; a < 3; ++a)
      cube[a] = static_cast<std::int64_t>(std::floor((p[a] - lower_[a]) / (4.0 * tolerance)));
    return cube;
  };
  const auto number_of = [&](const Point3& p) {
    const Cube first = cube_of(plus(p, -tolerance, {1, 1, 1})),
               last = cube_of(plus(p, tolerance, {1, 1, 1}));
    for (auto i = first[0]; i <= last[0]; ++i)
      for (auto j = first[1]; j <= last[1]; ++j)
        for (auto k = first[2]; k <= last[2]; ++k) {
          const auto found = cubes.find({i, j, k});
          if (found == cubes.end()) continue;
          for (const std::uint32_t known : found->second) {
            const Point3 way = minus(places_[known], p);
            if (scalar(way, way) <= tolerance * tolerance) return known;
          }
        }
    places_.push_back(p);
    const auto number = static_cast<std::uint32_t>(places_.size() - 1);
    cubes[cube_of(p)].push_back(number);
    return number;
  };
  for (const Triangle& triangle : triangles) {
    const std::array<std::uint32_t, 3> corners{number_of(triangle[0]), number_of(triangle[1]),
                                               number_of(triangle[2])};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      corners_.push_back(corners);
  }
  if (corners_.empty()) throw InputError("no triangle has an area");
}

void TriangleMesh::check_closed() const {
  struct Use {
    int along = 0, against = 0;
  };
  std::unordered_map<std::uint64_t, Use> edges;
  edges.reserve(2 * corners_.size());
  for (const auto& corners : corners_)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
      Use& use = edges[edge_key(a, b)];
      ++(a < b ? use.along : use.against);
    }
  std::size_t open = 0, crowded = 0, turned = 0;
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  for (const auto& [key, use] : edges) {
    if (use.along == 1 && use.against == 1) continue;
    const int sum = use.along + use.against;
    ++(sum == 1 ? open : sum == 2 ? turned : crowded);
    first = std::min(first, key);
  }
  if (open + crowded + turned == 0) return;
  const Point3 &a = places_[first >> 32u], &b = places_[first & 0xffffffffu];
  std::string kinds;
  const auto name = [&](std::size_t count, const char* what) {
    if (count > 0) kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, what);
  };
  name(open, "edges of a hole (one triangle only)");
  name(crowded, "edges shared by more than two triangles");
  name(turned, "edges whose two triangles face opposite sides");
  throw InputError(
      fmt::format("the surface is not closed: {}; the first one lies at ({:.6g}, {:.6g}, {:.6g}) m",
                  kinds, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])));
}

/// The volume is the sum of the tetrahedra between the triangles and one place (divergence
/// theorem).
void TriangleMesh::face_outwards() {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Triangle t = triangle(i);
    sum += scalar(minus(t[0], lower_), cross(minus(t[1], lower_), minus(t[2], lower_))) / 6.0;
  }
  if (sum < 0.0)
    for (auto& corners : corners_) std::swap(corners[1], corners[2]);
  volume_ = std::abs(sum);
  const Point3 size = minus(upper_, lower_);
  if (!(volume_ > 1e-12 * std::pow(scalar(size, size), 1.5)))
    throw InputError("the surface encloses no volume");
}

void TriangleMesh::set_normals() {
  face_normal_.resize(corners_.size());
  edge_normal_.resize(corners_.size());
  corner_normal_.assign(places_.size(), Point3{});
  std::unordered_map<std::uint64_t, Point3> edges;
  edges.reserve(2 * corners_.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Triangle t = triangle(i);
    face_normal_[i] = unit(cross(minus(t[1], t[0]), minus(t[2], t[0])));
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 next = minus(t[(k + 1) % 3], t[k]), before = minus(t[(k + 2) % 3], t[k]);
      const Point3 turn = cross(next, before);
      const double angle = std::atan2(std::sqrt(scalar(turn, turn)), scalar(next, before));
      Point3& corner = corner_normal_[corners_[i][k]];
      corner = plus(corner, angle, face_normal_[i]);
      Point3& edge = edges[edge_key(corners_[i][k], corners_[i][(k + 1) % 3])];
      edge = plus(edge, 1.0, face_normal_[i]);
    }
  }
  for (Point3& normal : corner_normal_) normal = unit(normal);
  for (std::size_t i = 0; i < corners_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      edge_normal_[i][k] = unit(edges[edge_key(corners_[i][k], corners_[i][(k + 1) % 3])]);
}

/// Splits the triangles [first, last) at the median of their centres along the widest axis.
std::uint32_t TriangleMesh::build(std::uint32_t first, std::uint32_t last) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.lower.fill(infinity);
  node.upper.fill(-infinity);
  for (std::uint32_t i = first; i < last; ++i)
    for (const std::uint32_t corner : corners_[i])
      for (std::size_t a = 0; a < 3; ++a) {
        node.lower[a] = std::min(node.lower[a], places_[corner][a]);
        node.upper[a] = std::max(node.upper[a], places_[corner][a]);
      }
  if (last - first <= leaf_size) {
    node.first = first;
    node.count = last - first;
  } else {
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (node.upper[a] - node.lower[a] > node.upper[axis] - node.lower[axis]) axis = a;
    const auto centre = [&](const std::array<std::uint32_t, 3>& c) {
      return places_[c[0]][axis] + places_[c[1]][axis] + places_[c[2]][axis];
    };
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(
        corners_.begin() + first, corners_.begin() + middle, corners_.begin() + last,
        [&](const auto& one, const auto& other) { return centre(one) < centre(other); });
    build(first, middle);
    node.first = build(middle, last);
  }
  nodes_[number] = node;
  return number;
}

SurfaceDistance TriangleMesh::distance_to(const Point3& position) const {
  Nearest best;
  std::size_t owner = 0;
  std::array<std::uint32_t, 64> stack{};  // deep enough: the tree halves at each level
  std::size_t height = 1;
  while (height > 0) {
    const std::uint32_t number = stack[--height];
    const Node& node = nodes_[number];
    if (box_distance2(node.lower, node.upper, position) >= best.distance2) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Nearest here = nearest_of_triangle(triangle(i), position);
      if (here.distance2 < best.distance2) best = here, owner = i;
    }
    if (node.count > 0) continue;
    std::array<std::uint32_t, 2> child{number + 1, node.first};
    const auto far = [&](std::uint32_t c) {
      return box_distance2(nodes_[c].lower, nodes_[c].upper, position);
    };
    if (far(child[0]) < far(child[1])) std::swap(child[0], child[1]);
    for (const std::uint32_t c : child) stack[height++] = c;  // the nearer one on top
  }
  const auto part = static_cast<std::size_t>(best.part);
  const Point3& normal = part == 0  ? face_normal_[owner]
                         : part < 4 ? edge_normal_[owner][part - 1]
                                    : corner_normal_[corners_[owner][part - 4]];
  const Point3 way = minus(position, best.place);
  const double away = std::sqrt(best.distance2);
  const double sign = scalar(way, normal) < 0.0 ? -1.0 : 1.0;
  const Point3 size = minus(upper_, lower_);
  if (away <= 1e-9 * std::sqrt(scalar(size, size))) return {sign * away, normal};
  return {sign * away, {sign * way[0] / away, sign * way[1] / away, sign * way[2] / away}};
}

bool TriangleMesh::contains(const Point3& position) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (position[a] < lower_[a] || position[a] > upper_[a]) return false;
  return distance_to(position).distance <= 0.0;
}

}  // namespace mudlark

#include "grid/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mudlark {
namespace {

/// The interval of ascending places that a value lies in, from -1 (before the first) on.
std::ptrdiff_t interval(const std::vector<double>& places, double value) {
  return std::upper_bound(places.begin(), places.end(), value) - places.begin() - 1;
}

/// Interval inside and the share of it that lies before the value; beyond the ends the end.
struct Spot {
  std::size_t index;
  double share;
};
Spot spot(const std::vector<double>& places, double value) {
  const auto last = static_cast<std::ptrdiff_t>(places.size()) - 2;
  const auto i =
      static_cast<std::size_t>(std::clamp(interval(places, value), std::ptrdiff_t{0}, last));
  const double share = (value - places[i]) / (places[i + 1] - places[i]);
  return {i, std::clamp(share, 0.0, 1.0)};
}

/// The places inside an interval, and its ends.
std::vector<double> within(const std::vector<double>& places, double lower, double upper) {
  std::vector<double> cut{lower};
  const double hair = 1e-9 * (upper - lower);
  for (const double place : places)
    if (place > lower + hair && place < upper - hair) cut.push_back(place);
  cut.push_back(upper);
  return cut;
}

/// z = a + b u + c v + d u v over the rectangle of u, v in 0 .. 1.
struct Patch {
  double x, y, dx, dy;
  double a, b, c, d;

  Point3 at(double u, double v) const {
    return {x + u * dx, y + v * dy, a + b * u + (c + d * u) * v};
  }
  /// Place of a stationary distance, by Newton's method from (u, v); false if none is found inside.
  bool foot(const Point3& p, double& u, double& v) const {
    for (int i = 0; i < 30; ++i) {
      const Point3 q = at(u, v);
      const double up = b + d * v, vp = c + d * u, off = q[2] - p[2];
      const double fu = (q[0] - p[0]) * dx + off * up, fv = (q[1] - p[1]) * dy + off * vp;
      const double huu = dx * dx + up * up, hvv = dy * dy + vp * vp, huv = up * vp + off * d;
      const double determinant = huu * hvv - huv * huv;
      if (!(determinant > 1e-12 * huu * hvv)) return false;
      const double du = (huv * fv - hvv * fu) / determinant;
      const double dv = (huv * fu - huu * fv) / determinant;
      u += du, v += dv;
      if (!(std::abs(u) < 3.0 && std::abs(v) < 3.0)) return false;
      if (std::abs(du) + std::abs(dv) < 1e-13) break;
    }
    return u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
  }
};

double squared_distance(const Point3& p, const Point3& q) {
  const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  return x * x + y * y + z * z;
}

/// The nearest place found so far.
struct Nearest {
  Point3 position;
  double squared;
  Point3 place{};
  Point3 normal{};  ///< of the surface there, upwards

  void offer(const Patch& patch, double u, double v) {
    const Point3 q = patch.at(u, v);
    const double away = squared_distance(position, q);
    if (away >= squared) return;
    squared = away, place = q;
    const double slope_x = (patch.b + patch.d * v) / patch.dx;
    const double slope_y = (patch.c + patch.d * u) / patch.dy;
    const double size = std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    normal = {-slope_x / size, -slope_y / size, 1.0 / size};
  }
  /// The patch's inside, then its four straight edges.
  void search(const Patch& patch) {
    double u = std::clamp((position[0] - patch.x) / patch.dx, 0.0, 1.0);
    double v = std::clamp((position[1] - patch.y) / patch.dy, 0.0, 1.0);
    offer(patch, u, v);
    if (patch.foot(position, u, v)) offer(patch, u, v);
    for (const double side : {0.0, 1.0}) {
      const auto along = [&](const Point3& from, const Point3& to) {
        double length2 = 0.0, way = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          length2 += (to[k] - from[k]) * (to[k] - from[k]);
          way += (position[k] - from[k]) * (to[k] - from[k]);
        }
        return std::clamp(way / length2, 0.0, 1.0);
      };
      offer(patch, along(patch.at(0.0, side), patch.at(1.0, side)), side);
      offer(patch, side, along(patch.at(side, 0.0), patch.at(side, 1.0)));
    }
  }
  /// Could a box hold something nearer?
  bool reaches(const Patch& patch) const {
    const double low = patch.a + std::min({0.0, patch.b, patch.c, patch.b + patch.c + patch.d});
    const double high = patch.a + std::max({0.0, patch.b, patch.c, patch.b + patch.c + patch.d});
    const auto gap = [](double value, double lower, double upper) {
      return std::max({lower - value, value - upper, 0.0});
    };
    const Point3 off{gap(position[0], patch.x, patch.x + patch.dx),
                     gap(position[1], patch.y, patch.y + patch.dy), gap(position[2], low, high)};
    return off[0] * off[0] + off[1] * off[1] + off[2] * off[2] < squared;
  }
};

}  // namespace

HeightMap::HeightMap(std::vector<double> x, std::vector<double> y, std::vector<double> heights)
    : x_(std::move(x)), y_(std::move(y)), heights_(std::move(heights)) {}

double HeightMap::node(std::ptrdiff_t i, std::ptrdiff_t j) const {
  const auto columns = static_cast<std::ptrdiff_t>(x_.size());
  const auto rows = static_cast<std::ptrdiff_t>(y_.size());
  i = std::clamp(i, std::ptrdiff_t{0}, columns - 1);
  j = std::clamp(j, std::ptrdiff_t{0}, rows - 1);
  return heights_[static_cast<std::size_t>(j * columns + i)];
}

double HeightMap::height_at(double x, double y) const {
  const Spot i = spot(x_, x), j = spot(y_, y);
  const double* row = &heights_[j.index * x_.size() + i.index];
  const double* next = row + x_.size();
  const double low = row[0] + i.share * (row[1] - row[0]);
  const double high = next[0] + i.share * (next[1] - next[0]);
  return low + j.share * (high - low);
}

HeightMap HeightMap::cropped(const Point3& lower, const Point3& upper) const {
  std::vector<double> x = within(x_, lower[0], upper[0]), y = within(y_, lower[1], upper[1]);
  std::vector<double> heights;
  heights.reserve(x.size() * y.size());
  for (const double along_y : y)
    for (const double along_x : x) heights.push_back(height_at(along_x, along_y));
  return {std::move(x), std::move(y), std::move(heights)};
}

std::array<double, 2> HeightMap::range(const Point3& lower, const Point3& upper) const {
  const std::ptrdiff_t i0 = interval(x_, lower[0]), i1 = interval(x_, upper[0]) + 1;
  const std::ptrdiff_t j0 = interval(y_, lower[1]), j1 = interval(y_, upper[1]) + 1;
  std::array<double, 2> bounds{node(i0, j0), node(i0, j0)};
  for (std::ptrdiff_t j = j0; j <= j1; ++j)
    for (std::ptrdiff_t i = i0; i <= i1; ++i) {
      bounds[0] = std::min(bounds[0], node(i, j));
      bounds[1] = std::max(bounds[1], node(i, j));
    }
  return bounds;
}

SurfaceDistance HeightMap::distance_to(const Point3& position) const {
  const double height = height_at(position[0], position[1]), above = position[2] - height;
  const double reach = std::abs(above);
  Nearest nearest{position, std::numeric_limits<double>::infinity()};
  const auto edge = [&](const std::vector<double>& places, std::ptrdiff_t i, double value) {
    if (i < 0) return std::min(places.front(), value - reach) - 1.0;
    if (i >= static_cast<std::ptrdiff_t>(places.size()))
      return std::max(places.back(), value + reach) + 1.0;
    return places[static_cast<std::size_t>(i)];
  };
  const auto search = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    const double x = edge(x_, i, position[0]), y = edge(y_, j, position[1]);
    const double a = node(i, j), b = node(i + 1, j) - a, c = node(i, j + 1) - a;
    const Patch patch{x, y, edge(x_, i + 1, position[0]) - x, edge(y_, j + 1, position[1]) - y, a,
                      b, c, node(i + 1, j + 1) - a - b - c};
    if (nearest.reaches(patch)) nearest.search(patch);
  };
  search(interval(x_, position[0]), interval(y_, position[1]));
  // The patch straight above or below has a place within `reach`; nothing farther away matters.
  const double around = std::sqrt(nearest.squared);
  const std::ptrdiff_t i1 = interval(x_, position[0] + around);
  const std::ptrdiff_t j1 = interval(y_, position[1] + around);
  for (std::ptrdiff_t j = interval(y_, position[1] - around); j <= j1; ++j)
    for (std::ptrdiff_t i = interval(x_, position[0] - around); i <= i1; ++i) search(i, j);
  const double distance = std::sqrt(squared_distance(position, nearest.place));
  const double side = above >= 0.0 ? 1.0 : -1.0;
  SurfaceDistance result{side * distance, nearest.normal};
  const double scale = std::abs(position[0]) + std::abs(position[1]) + std::abs(position[2]) + 1.0;
  if (distance > 1e-12 * scale)
    for (std::size_t k = 0; k < 3; ++k)
      result.normal[k] = side * (position[k] - nearest.place[k]) / distance;
  return result;
}

double HeightMap::highest() const { return *std::max_element(heights_.begin(), heights_.end()); }

}  // namespace mudlark

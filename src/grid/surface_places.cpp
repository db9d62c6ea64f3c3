#include "grid/surface_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "grid/rigid_pose.hpp"
#include "grid/shape_distance.hpp"

namespace mudlark {
namespace {

/// A lattice over a box; in the plane one layer of it.
struct Lattice {
  Point3 lower{};
  std::array<long, 3> count{1, 1, 1};
  double spacing = 0.0;

  Lattice(const BoxShape& box, int dimension) {
    double longest = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
      if (dimension == 3 || a != 1) longest = std::max(longest, box.upper[a] - box.lower[a]);
    spacing = longest / (dimension == 2 ? 96.0 : 32.0);
    for (std::size_t a = 0; a < 3; ++a) {
      if (dimension == 2 && a == 1) continue;
      lower[a] = box.lower[a] - 1.75 * spacing;  // no place of it on the faces of a box
      count[a] = static_cast<long>(std::ceil((box.upper[a] - lower[a]) / spacing)) + 2;
    }
  }

  template <class F>
  void for_each_place(F&& f) const {
    for (long k = 0; k < count[2]; ++k)
      for (long j = 0; j < count[1]; ++j)
        for (long i = 0; i < count[0]; ++i)
          f(Point3{lower[0] + static_cast<double>(i) * spacing,
                   lower[1] + static_cast<double>(j) * spacing,
                   lower[2] + static_cast<double>(k) * spacing});
  }
};

/// Parts that are cut away up to the surface leave one with no body on either side.
bool has_body_beside(const Shape& shape, const Eigen::Vector3d& on, double little) {
  for (int way = 0; way < 27; ++way) {
    const Eigen::Vector3d beside(way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1);
    if (distance_to(shape, to_point(on + little * beside)).distance < 0.0) return true;
  }
  return false;
}

}  // namespace

/// The surface place nearest to a place outside is the corner for all places before a corner. A
/// quarter (eighth) of a circle (sphere) of 1.5 (1.8) spacings always holds a lattice place.
std::vector<SurfacePlace> surface_places(const Shape& shape, const BoxShape& within,
                                         int dimension) {
  BoxShape box = bounds(shape);
  for (std::size_t a = 0; a < 3; ++a) {
    if (dimension == 2 && a == 1) continue;
    box.lower[a] = std::max(box.lower[a], within.lower[a]);
    box.upper[a] = std::min(box.upper[a], within.upper[a]);
    if (box.lower[a] >= box.upper[a]) return {};
  }
  const Lattice lattice(box, dimension);
  if (!(lattice.spacing > 0.0)) return {};
  const double band = (dimension == 2 ? 1.5 : 1.8) * lattice.spacing;
  std::vector<SurfacePlace> places;
  const bool has_cuts = std::holds_alternative<DifferenceShape>(shape.form);
  std::set<std::array<long long, 3>> known;  // corners are found many times
  lattice.for_each_place([&](const Point3& place) {
    const SurfaceDistance away = distance_to(shape, place);
    if (away.distance < -0.6 * lattice.spacing || away.distance > band) return;
    Eigen::Vector3d on = Eigen::Vector3d::Zero();
    std::array<long long, 3> key{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double x = place[a] - away.distance * away.normal[a];
      on[static_cast<int>(a)] = x;
      key[a] = std::llround(x / (1e-6 * lattice.spacing));
    }
    if (dimension == 2) on[1] = 0.0, key[1] = 0;
    if (known.count(key) == 0 && (!has_cuts || has_body_beside(shape, on, 1e-5 * lattice.spacing)))
      places.push_back({on, to_vector(away.normal)});
    known.insert(key);
  });
  return places;
}

}  // namespace mudlark

#pragma once
/// A part of a side of the domain, its faces and the directions there.
#include <algorithm>
#include <limits>
#include <string>

#include "flow/flow_checks.hpp"
#include "grid/grid.hpp"
#include "numerics/loops.hpp"

namespace mudlark {

/// A side of the domain, or those of its faces whose centres lie between two corners.
struct PartOfSide {
  std::string name;
  int axis = 0, side = 0;
  Point3 from{-infinite, -infinite, -infinite}, to{infinite, infinite, infinite};  ///< [m]

  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Whether a position lies within the part; the part's own axis does not count.
  template <int D>
  bool covers(const Vec<D>& position) const {
    const Point3 place = to_point3(position);
    for (int across = 0; across < D; ++across) {
      const auto a = static_cast<std::size_t>(D == 2 && across == 1 ? 2 : across);
      if (across != axis && !(place[a] >= from[a] && place[a] < to[a])) return false;
    }
    return true;
  }
  double inwards() const { return side == 0 ? 1.0 : -1.0; }
  /// From a face of the side to the cell outside it, and from there on.
  template <int D>
  std::ptrdiff_t outward(const Grid<D>& grid) const {
    return side == 0 ? -grid.stride(axis) : grid.stride(axis);
  }
};

/// Calls body(at, index) for the faces of a part that lie in `box` across its axis: this rank's
/// owned ones, or all that it has.
template <int D, class Body>
void for_each_face_of(const Grid<D>& grid, const PartOfSide& part, IndexBox<D> box, Body&& body) {
  if (!grid.touches(part.axis, part.side)) return;
  const IndexBox<D> wall = wall_faces(grid, part.axis, part.side);
  box.lower[part.axis] = wall.lower[part.axis];
  box.upper[part.axis] = wall.upper[part.axis];
  for_each_place(grid, box, [&](std::ptrdiff_t at, const Index<D>& index) {
    if (part.covers<D>(grid.face_centre(part.axis, index))) body(at, index);
  });
}

/// Share of the height of a face [-] that lies below a level [m].
template <int D>
double share_below(const Grid<D>& grid, const Index<D>& face, double level) {
  const double foot = grid.face_position(D - 1, face[D - 1]);
  return std::clamp((level - foot) / grid.width(D - 1, face[D - 1]), 0.0, 1.0);
}

/// Pressure [Pa] that water at rest behind a side has turned into motion where it comes in with a
/// velocity [m/s] (Bernoulli). Without it what swings before the side gains energy with each swing:
/// water goes out with its own and would come in with more than that of the level.
inline double lost_to_inflow(double density, double inwards) {
  const double velocity = std::max(inwards, 0.0);
  return 0.5 * density * velocity * velocity;
}

}  // namespace mudlark

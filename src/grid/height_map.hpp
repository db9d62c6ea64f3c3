#pragma once
/// Ground surfaces given by heights on a lattice.
#include <array>
#include <vector>

#include "base/vec.hpp"
#include "grid/surface_distance.hpp"

namespace mudlark {

/// Heights z at (x_i, y_j), bilinear in between and level beyond the edges.
class HeightMap {
 public:
  /// `heights` row after row, x fastest; x and y ascend, each with at least two entries [m].
  HeightMap(std::vector<double> x, std::vector<double> y, std::vector<double> heights);

  double height_at(double x, double y) const;
  /// The part over a rectangle, with new lines of heights along its edges: the same surface there.
  HeightMap cropped(const Point3& lower, const Point3& upper) const;
  /// Bounds of the heights over a rectangle; not the tightest.
  std::array<double, 2> range(const Point3& lower, const Point3& upper) const;
  /// Distance to the surface, negative below it; the normal points upwards out of the ground.
  SurfaceDistance distance_to(const Point3& position) const;

  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }
  const std::vector<double>& heights() const { return heights_; }
  double highest() const;

 private:
  double node(std::ptrdiff_t i, std::ptrdiff_t j) const;

  std::vector<double> x_, y_, heights_;
};

}  // namespace mudlark

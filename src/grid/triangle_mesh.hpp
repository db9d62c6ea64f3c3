#pragma once
/// Closed surfaces made of triangles, as STL files hold them.
#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.hpp"
#include "grid/surface_distance.hpp"

namespace mudlark {

using Triangle = std::array<Point3, 3>;

/// A closed surface of triangles that face outwards, with a tree of boxes so that a place finds
/// its nearest triangle among n in about log n steps.
class TriangleMesh {
 public:
  /// Corners closer than 1e-7 of the mesh's size are one. Throws InputError when the surface is not
  /// closed: each edge must belong to two triangles that run along it in opposite directions. A
  /// surface that faces inwards as a whole is turned.
  explicit TriangleMesh(const std::vector<Triangle>& triangles);

  /// Signed distance by the angle-weighted normals of Baerentzen & Aanaes (2005), which give the
  /// right side at edges and corners too.
  SurfaceDistance distance_to(const Point3& position) const;
  bool contains(const Point3& position) const;

  std::size_t size() const { return corners_.size(); }
  Triangle triangle(std::size_t i) const;
  const Point3& lower() const { return lower_; }  ///< [m]
  const Point3& upper() const { return upper_; }  ///< [m]
  double volume() const { return volume_; }       ///< [m3]

 private:
  struct Node {
    Point3 lower, upper;
    std::uint32_t first = 0;  ///< first triangle of a leaf, or the second child
    std::uint32_t count = 0;  ///< triangles of a leaf; 0: not a leaf, the first child comes next
  };
  void join_corners(const std::vector<Triangle>& triangles);
  void check_closed() const;
  void face_outwards();
  void set_normals();
  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  std::vector<Point3> places_;                         ///< of the corners
  std::vector<std::array<std::uint32_t, 3>> corners_;  ///< of each triangle
  std::vector<Point3> face_normal_, corner_normal_;
  std::vector<std::array<Point3, 3>> edge_normal_;  ///< edge i joins corners i and i + 1
  std::vector<Node> nodes_;
  Point3 lower_{}, upper_{};
  double volume_ = 0.0;
};

}  // namespace mudlark

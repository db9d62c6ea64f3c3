#pragma once
/// Regions of space that case files are drawn with.
#include <memory>
#include <variant>
#include <vector>

#include "base/vec.hpp"

namespace mudlark {

struct Shape;
class HeightMap;
class TriangleMesh;

/// All lengths in metres; positions are (x, y, z), in 2D y = 0 and boxes span every y.
struct BoxShape {
  Point3 lower, upper;
};
/// Prism over a polygon in the x-z plane (2D) or, in 3D, over a polygon in the x-y plane between
/// two heights.
struct PolygonShape {
  std::vector<std::array<double, 2>> corners;
  bool vertical_plane = true;      ///< true: corners are (x, z); false: (x, y)
  double bottom = 0.0, top = 0.0;  ///< [m] heights, only for vertical_plane = false
};
/// Circle in 2D (y ignored), sphere in 3D.
struct SphereShape {
  Point3 centre;
  double radius;
  bool circle = false;  ///< true: ignore y
};
struct CylinderShape {
  Point3 from, to;  ///< ends of the axis
  double radius;
};
/// Everything below a ground line given as (x, z) pairs, linear between them, level beyond the
/// ends.
struct BelowShape {
  std::vector<std::array<double, 2>> line;
};
/// Everything below heights on a lattice; 3D only.
struct HeightMapShape {
  std::shared_ptr<const HeightMap> map;
};
/// Inside of a closed surface of triangles; 3D only.
struct StlShape {
  std::shared_ptr<const TriangleMesh> mesh;
};
struct UnionShape {
  std::vector<Shape> parts;
};
/// What is in the first part and in none of the others.
struct DifferenceShape {
  std::vector<Shape> parts;
};

struct Shape {
  std::variant<BoxShape, PolygonShape, SphereShape, CylinderShape, BelowShape, HeightMapShape,
               StlShape, UnionShape, DifferenceShape>
      form;

  bool contains(const Point3& position) const;
};

/// Share of the box [lower, upper] that lies inside the shape, 0..1: exact for boxes, by regular
/// sampling (16 points per axis in 2D, 8 in 3D) otherwise, but only where the shape's surface may
/// pass through the box.
double fraction_inside(const Shape& shape, const Point3& lower, const Point3& upper, int dimension);

/// Smallest box around a shape; sides to which the shape has no end are infinite.
BoxShape bounds(const Shape& shape);

}  // namespace mudlark

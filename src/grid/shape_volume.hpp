#pragma once
/// Volume, centre and second moments of shapes.
#include <optional>

#include "grid/shape.hpp"

namespace mudlark {

/// Volume [m^D], its centre [m] and its second moments about the centre.
struct SolidVolume {
  double volume = 0.0;
  Point3 centre{};
  std::array<std::array<double, 3>, 3> moments{};  ///< integral of r r^T [m^(D+2)]
};
/// Exact for boxes and surfaces of triangles, to some 1e-4 for other shapes. Nothing for a shape
/// without end (in the plane: along x or z) and for an empty one.
std::optional<SolidVolume> volume_of(const Shape& shape, int dimension);

}  // namespace mudlark

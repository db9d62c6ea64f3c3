#pragma once
/// Where a place lies relative to a surface.
#include "base/vec.hpp"

namespace mudlark {

struct SurfaceDistance {
  double distance = 0.0;         ///< to the surface [m], negative inside
  Point3 normal{0.0, 0.0, 1.0};  ///< unit vector out of the body at the nearest surface point
};

}  // namespace mudlark

#pragma once
/// Signed distance to the surface of a shape.
#include "grid/shape.hpp"
#include "grid/surface_distance.hpp"

namespace mudlark {

/// Distance of a place to the surface of a shape, negative inside, and the outward normal there.
/// Exact for the simple forms and for the outside of a union; elsewhere in unions and differences
/// it is the distance to the surface of one part: right in sign, and never larger in size than the
/// exact one near the places where the parts' surfaces cross.
SurfaceDistance distance_to(const Shape& shape, const Point3& position);

}  // namespace mudlark

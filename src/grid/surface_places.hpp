#pragma once
/// Places on the surface of a body that stand for all of it.
#include <Eigen/Core>
#include <vector>

#include "grid/shape.hpp"

namespace mudlark {

struct SurfacePlace {
  Eigen::Vector3d place, normal;  ///< [m], and out of the body; of a corner one of many
};

/// Places on the surface of a shape within a box [m], from a lattice around it: right and sharper
/// corners exactly, blunter ones, edges and faces at about a 96th of the longest side in the plane
/// (y = 0), a 32nd in space.
std::vector<SurfacePlace> surface_places(const Shape& shape, const BoxShape& within, int dimension);

}  // namespace mudlark

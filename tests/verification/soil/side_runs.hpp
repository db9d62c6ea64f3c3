#pragma once
/// What the tests of the domain's sides share.
#include "verification/soil/soil_runs.hpp"

namespace mudlark::soil_runs {

inline constexpr double viscosity = 1.002e-3;

inline SoilBoundary side_of(int axis, int side) {
  SoilBoundary boundary;
  boundary.name = std::to_string(axis) + std::to_string(side);
  boundary.axis = axis, boundary.side = side;
  return boundary;
}
inline SoilBoundary water_side(int axis, int side, WaterSide kind, Varying value) {
  SoilBoundary boundary = side_of(axis, side);
  boundary.for_water = true;
  boundary.water = kind;
  boundary.value = std::move(value);
  return boundary;
}

/// Stiff soil that fills the domain; k [m/s].
inline SoilOptions filled(int dimension, double conductivity) {
  SoilOptions options = make_soil(dimension, {-9, -9, -9}, {9, 9, 9}, true);
  options.bodies[0].intrinsic_permeability = conductivity * viscosity / 9810.0;
  options.bodies[0].law = LinearElasticOptions{2e7, 0.2};
  return options;
}

/// Largest difference of the points' pore pressure from a straight line along an axis [Pa].
template <int D>
double worst_pressure(const SoilSolver<D>& soil, int axis, double at_zero, double slope) {
  double worst = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    worst = std::max(
        worst, std::abs(points.pore_pressure[p] - at_zero - slope * points.position[axis][p]));
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return worst;
}

}  // namespace mudlark::soil_runs

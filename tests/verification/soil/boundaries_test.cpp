// ranks: 1 3
// Grains at the sides of the domain, explicit steps: sides that move, absorb, hold in part.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

SoilBoundary grain_side(int axis, int side, GrainSide kind) {
  SoilBoundary boundary;
  boundary.name = std::to_string(axis) + std::to_string(side);
  boundary.axis = axis, boundary.side = side;
  boundary.for_grains = true;
  boundary.grains = kind;
  return boundary;
}

constexpr double young = 1e7, density = 0.6 * 2650.0;

/// Dry elastic soil without lateral contraction that fills the domain.
SoilOptions filled(int dimension) {
  SoilOptions options = make_soil(dimension, {-9, -9, -9}, {99, 9, 99}, false);
  options.bodies[0].law = LinearElasticOptions{young, 0.0};
  options.flip_fraction = 1.0;
  return options;
}

/// Smooth push: displacement that goes from 0 to `size` within `rise`.
Varying push(double size, double rise) {
  return Varying(
      [=](const Point3&, double t) {
        const double s = std::clamp(t / rise, 0.0, 1.0);
        return size * (s - std::sin(2.0 * std::numbers::pi * s) / (2.0 * std::numbers::pi));
      },
      "push");
}
double pushed_velocity(double size, double rise, double t) {
  if (t < 0.0 || t > rise) return 0.0;
  return size / rise * (1.0 - std::cos(2.0 * std::numbers::pi * t / rise));
}

/// Largest difference of the velocities along an axis from a wave that a side at x = 0 sends.
template <int D>
double wave_error(const SoilSolver<D>& soil, int component, double size, double rise, double speed,
                  double time) {
  double worst = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double exact = pushed_velocity(size, rise, time - points.position[0][p] / speed);
    worst = std::max(worst, std::abs(points.velocity[component][p] - exact));
  }
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return worst / (2.0 * size / rise);
}

// A side that is pushed sends the wave v(t - x/c), compression (c_p) or shear (c_s).
template <int D>
void expect_wave(int component, bool velocity) {
  const double h = 0.025, size = 1e-4, rise = 16e-3;
  const char* walls = D == 2 ? "sspp" : "sspppp";
  const Grid<D> grid = make_grid<D>({80, 3, 3}, h, walls, 0.0, MPI_COMM_WORLD);
  SoilOptions options = filled(D);
  SoilBoundary side = grain_side(0, 0, GrainSide::moving);
  const auto u = static_cast<std::size_t>(component == D - 1 ? 2 : component);
  side.motion_is_displacement = !velocity;
  side.motion[u] = velocity ? Varying([=](const Point3&, double t) {
    return pushed_velocity(size, rise, t);
  }, "velocity") : push(size, rise);
  options.boundaries.push_back(side);
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  const double speed = std::sqrt((component == 0 ? young : young / 2.0) / density);
  const double end = 1.5 / speed;
  const int steps = static_cast<int>(std::ceil(end / (0.4 * soil.stable_step())));
  double time = 0.0;
  run(soil, time, steps, end / steps);
  const double error = wave_error(soil, component, size, rise, speed, end);
  std::printf("%dD, component %d, %s: off by %.2f %% of the largest velocity\n", D, component,
              velocity ? "velocity" : "displacement", 100.0 * error);
  EXPECT_LT(error, 0.03);
}

TEST(MovingSide, SendsAWaveOfCompression) {
  expect_wave<2>(0, false);
  expect_wave<2>(0, true);
  expect_wave<3>(0, false);
}
TEST(MovingSide, SendsAWaveOfShear) {
  expect_wave<2>(1, false);
  expect_wave<3>(1, true);
}

/// Share of a pulse's energy and velocity that comes back from the far side.
template <int D>
double reflection(int component, double angle_free_fraction) {
  const double h = 0.025, size = 1e-4, rise = 16e-3;
  const Grid<D> grid = make_grid<D>({80, 3, 3}, h, D == 2 ? "sspp" : "sspppp", 0.0, MPI_COMM_WORLD);
  SoilOptions options = filled(D);
  SoilBoundary near = grain_side(0, 0, GrainSide::moving);
  near.motion_is_displacement = true;
  near.motion[static_cast<std::size_t>(component == D - 1 ? 2 : component)] = push(size, rise);
  options.boundaries.push_back(near);
  SoilBoundary far = grain_side(0, 1, GrainSide::absorbing);
  far.absorber.thickness = angle_free_fraction;
  options.boundaries.push_back(far);
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  const double speed = std::sqrt((component == 0 ? young : young / 2.0) / density);
  const double end = 3.5 / speed;  // the pulse would have left, or be on its way back
  const int steps = static_cast<int>(std::ceil(end / (0.4 * soil.stable_step())));
  double time = 0.0;
  run(soil, time, steps, end / steps);
  double worst = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    worst = std::max(worst, std::abs(points.velocity[component][p]));
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return worst / (2.0 * size / rise);
}

TEST(AbsorbingSide, SwallowsPulsesOfCompressionAndShear) {
  const double none = std::numeric_limits<double>::infinity();
  for (const int component : {0, 1}) {
    const double plane = reflection<2>(component, none), space = reflection<3>(component, none);
    std::printf("component %d: %.2f %% come back in the plane, %.2f %% in space\n", component,
                100.0 * plane, 100.0 * space);
    EXPECT_LT(plane, 0.02);
    EXPECT_LT(space, 0.02);
  }
}

}  // namespace
}  // namespace mudlark

#include "verification/soil/manufactured.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using soil_runs::make_grid;

struct Scheme {
  Kernel kernel = Kernel::composite;
  Transfer transfer = Transfer::flip;
  double flip_fraction = 1.0;
};

SoilOptions solid_soil(const ElasticSolid& solid, const Scheme& scheme, const Point3& lower,
                       const Point3& upper) {
  SoilOptions soil = soil_runs::make_soil(2, lower, upper, false);
  SoilBody& body = soil.bodies[0];
  body.law = LinearElasticOptions{solid.young, solid.poisson};
  body.porosity = 0.5;
  body.grain_density = 2.0 * solid.density;
  soil.kernel = scheme.kernel;
  soil.transfer = scheme.transfer;
  soil.flip_fraction = scheme.flip_fraction;
  return soil;
}

/// Root mean square of the error of position [m] over all points.
template <class Exact>
double position_error(const SoilParticles<2>& points, Exact&& exact) {
  double sum = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec<2> start{{points.start[0][p], points.start[1][p]}};
    const Vec<2> off = points.position_of(p) - exact(start);
    sum += dot(off, off);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Error after 0.3 of a period, steps a fixed share of the cell. Velocities live half a step before
/// positions, so they start there.
double axis_aligned_error(int cells, double amplitude, const Scheme& scheme) {
  AxisAligned motion;
  motion.amplitude = amplitude;
  SoilOptions soil = solid_soil(motion.solid, scheme, {0, -1, 0}, {1, 1, 1});
  std::array<Varying, 3> given;
  for (const int axis : {0, 1})
    given[axis == 0 ? 0u : 2u] = Varying(
        [motion, axis](const Point3& x, double t) {
          return motion.body_acceleration(axis, Vec<2>{{x[0], x[2]}}, t);
        },
        "manufactured");
  soil.body_acceleration = given;
  const Grid<2> grid = make_grid<2>({cells, cells, 1}, 1.0 / cells, "ssss");
  SoilSolver<2> solver(grid, soil);
  solver.initialise();
  const double end = 0.6 * std::numbers::pi / motion.rate();
  const int steps = 12 * cells;
  const double dt = end / steps;
  auto& points = solver.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int a = 0; a < 2; ++a)
      points.velocity[a][p] = motion.velocity(a, points.start[a][p], -0.5 * dt);
  double time = 0.0;
  soil_runs::run(solver, time, steps, dt);
  return position_error(points, [&](const Vec<2>& start) {
    Vec<2> place = start;
    for (int a = 0; a < 2; ++a) place[a] += motion.displacement(a, start[a], end);
    return place;
  });
}

double vortex_error(int cells_per_metre, double end, const Scheme& scheme) {
  const Vortex motion;
  SoilOptions soil = solid_soil(motion.solid, scheme, {0, -1, 0}, {3, 1, 3});
  soil.bodies[0].points_per_cell = 9;
  soil.bodies[0].shape.form = BoxShape{{0, -1, 0}, {3, 1, 3}};
  std::array<Varying, 3> given;
  for (const int axis : {0, 1})
    given[axis == 0 ? 0u : 2u] = Varying(
        [motion, axis](const Point3& x, double t) {
          return motion.body_acceleration(Vec<2>{{x[0], x[2]}}, t)[axis];
        },
        "manufactured");
  soil.body_acceleration = given;
  const int cells = 3 * cells_per_metre;
  const Grid<2> grid = make_grid<2>({cells, cells, 1}, 1.0 / cells_per_metre, "ssss");
  SoilSolver<2> solver(grid, soil);
  solver.initialise();
  const int steps = static_cast<int>(std::ceil(end * 4.0 * cells_per_metre));
  const double dt = end / steps;
  auto& points = solver.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec<2> v = motion.velocity(points.position_of(p), -0.5 * dt);
    for (int a = 0; a < 2; ++a) points.velocity[a][p] = v[a];
  }
  double time = 0.0;
  soil_runs::run(solver, time, steps, dt);
  return position_error(points, [&](const Vec<2>& start) { return motion.position(start, end); });
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

// Points stay in their cells: 0.2 mm against cells of 30 mm.
TEST(Manufactured, AxisAlignedMotionIsOfSecondOrderWhilePointsStayInTheirCells) {
  for (const Kernel kernel : {Kernel::quadratic, Kernel::composite})
    for (const Transfer transfer : {Transfer::flip, Transfer::apic}) {
      const Scheme scheme{kernel, transfer};
      const double coarse = axis_aligned_error(16, 1e-3, scheme);
      const double fine = axis_aligned_error(32, 1e-3, scheme);
      std::printf("contiguous: error %.3e m, order %.2f\n", fine, order(coarse, fine));
      EXPECT_GT(order(coarse, fine), transfer == Transfer::flip ? 1.95 : 1.8);
      EXPECT_LT(fine, 0.025 * 1e-3);
    }
}

// Points cross one cell and a half, strain reaches 30 %.
TEST(Manufactured, AxisAlignedMotionKeepsItsOrderAcrossCellsWithTheCompositeKernel) {
  for (const Transfer transfer : {Transfer::flip, Transfer::apic}) {
    const Scheme scheme{Kernel::composite, transfer};
    const double coarse = axis_aligned_error(16, 0.05, scheme);
    const double fine = axis_aligned_error(32, 0.05, scheme);
    std::printf("crossing: error %.3e m, order %.2f\n", fine, order(coarse, fine));
    EXPECT_GT(order(coarse, fine), 1.8);
    EXPECT_LT(fine, 0.02 * 0.05);
  }
}

// Shear reaches 3 at t = 0.25 s and 5 at 0.375 s, where neighbours lose touch.
TEST(Manufactured, VortexIsOfSecondOrderAndThenOfOneAndAHalf) {
  for (const Transfer transfer : {Transfer::flip, Transfer::apic}) {
    const Scheme scheme{Kernel::composite, transfer};
    for (const double end : {0.25, 0.375}) {
      const double coarse = vortex_error(16, end, scheme), fine = vortex_error(32, end, scheme);
      std::printf("vortex at %g s: error %.3e m, order %.2f\n", end, fine, order(coarse, fine));
      EXPECT_GT(order(coarse, fine), end < 0.3 ? 1.8 : 1.5);
      EXPECT_LT(fine, end < 0.3 ? 5e-3 : 1.1e-2);
    }
  }
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "grid/stretching.hpp"
#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

constexpr double pi = std::numbers::pi;

/// Faces of a smooth map of the unit interval whose cells differ by a factor of 2.3.
std::vector<double> smooth_faces(int cells) {
  std::vector<double> faces;
  for (int i = 0; i <= cells; ++i) {
    const double s = static_cast<double>(i) / cells;
    faces.push_back(s + 0.4 / (2.0 * pi) * std::sin(2.0 * pi * s));
  }
  faces.back() = 1.0;
  return faces;
}

/// Largest error at t = 0.05 s of u = sin(2 pi x) cos(2 pi z) e^{-2 nu k^2 t} in a box of slip
/// walls (Taylor & Green 1937).
double taylor_green_error(int cells, bool advection) {
  const double nu = 0.01, k = 2.0 * pi, end = 0.05;
  FlowOptions options;
  options.density = 1.0;
  options.viscosity = nu;
  options.advection = advection;
  WaterBody body = water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away});
  body.velocity[0] = Varying(
      [k](const Point3& x, double) { return std::sin(k * x[0]) * std::cos(k * x[2]); }, "u");
  body.velocity[2] = Varying(
      [k](const Point3& x, double) { return -std::cos(k * x[0]) * std::sin(k * x[2]); }, "w");
  options.bodies = {body};
  DomainOptions domain = flow_domain({cells, cells, 1}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  domain.faces[0] = smooth_faces(cells);
  domain.faces[1] = smooth_faces(cells);
  FlowRun<2> run(domain, options);
  const int steps = cells * cells / 16;
  for (int step = 0; step < steps; ++step) run.step(end / steps);
  double largest = 0.0;
  for_each(run.grid.owned(), [&](const Index<2>& face) {
    const Vec<2> x = run.grid.face_centre(0, face);
    const double exact =
        std::sin(k * x[0]) * std::cos(k * x[1]) * std::exp(-2.0 * nu * k * k * end);
    largest = std::max(largest, std::abs(run.flow.velocity()[0][face] - exact));
  });
  return max_over_ranks(run.grid, largest);
}

TEST(StretchedGrid, TaylorGreenVorticesDecayAtSecondOrderWithoutAdvection) {
  const double coarse = taylor_green_error(16, false), middle = taylor_green_error(32, false),
               fine = taylor_green_error(64, false);
  EXPECT_GT(std::log2(coarse / middle), 1.8) << coarse << " " << middle << " " << fine;
  EXPECT_GT(std::log2(middle / fine), 1.9) << coarse << " " << middle << " " << fine;
}

TEST(StretchedGrid, TaylorGreenVorticesDecayAtSecondOrderWithAdvection) {
  const double coarse = taylor_green_error(16, true), middle = taylor_green_error(32, true),
               fine = taylor_green_error(64, true);
  EXPECT_GT(std::log2(middle / fine), 1.7) << coarse << " " << middle << " " << fine;
}

DomainOptions pool(bool open_top) {
  DomainOptions domain = flow_domain({1, 1, 1}, {2.0, 1.0, 1.0}, {0.0, -9.81, 0.0});
  domain.faces[0] = graded_faces(0.0, 2.0, 0.1, {{0.8, 1.0, 0.02, 1.1}});
  domain.faces[1] = graded_faces(0.0, 1.0, 0.08, {{0.45, 0.6, 0.015, 1.1}});
  for (std::size_t a = 0; a < 2; ++a)
    domain.cells[a] = static_cast<int>(domain.faces[a].size()) - 1;
  if (open_top) domain.walls[1][1] = Wall::open;
  return domain;
}

TEST(StretchedGrid, WaterOverAPorousStepStaysAtRest) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {3.0, 2.0, 0.537})};
  PorousGround mound;
  mound.shape.form = BoxShape{{0.5, -1.0, -1.0}, {0.93, 1.0, 0.7}};
  mound.porosity = 0.45;
  mound.drag = DragLaw::ergun;
  mound.grain_size = 0.02;
  options.porous = {mound};
  FlowRun<2> run(pool(true), options);
  for (int step = 0; step < 300; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_LT(run.flow.max_speed().speed, 1e-12);
  EXPECT_NEAR(run.flow.surface_height(Vec<2>{{0.3, 0.0}}), 0.537, 1e-9);
  // Linear between the centres of cells, whatever their sizes.
  for (const Vec<2> place : {Vec<2>{{0.3, 0.21}}, Vec<2>{{0.91, 0.44}}})
    EXPECT_NEAR(run.flow.pressure_at(place), 9810.0 * (0.537 - place[1]), 1e-6);
}

TEST(StretchedGrid, AClosedBoxFullOfWaterHasThePressureOfItsDepth) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {3.0, 2.0, 2.0})};
  FlowRun<2> run(pool(false), options);
  run.step(1e-3);
  EXPECT_LT(run.flow.max_speed().speed, 1e-12);
  EXPECT_NEAR(run.flow.pressure_at(Vec<2>{{0.3, 0.21}}), 9810.0 * 0.79, 1e-6);
}

/// The front of a falling column is that of the uniform grid as fine as the finest cells, and no
/// drop of water is lost.
TEST(StretchedGrid, AFallingColumnKeepsItsWaterAndRunsAsOnAUniformGrid) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {0.4, 2.0, 0.5})};
  const auto front = [&](bool stretched) {
    DomainOptions domain = flow_domain({80, 40, 1}, {2.0, 1.0, 1.0}, {0.0, -9.81, 0.0});
    if (stretched) {
      domain.faces[0] = graded_faces(0.0, 2.0, 0.06, {{0.0, 1.3, 0.025, 1.1}});
      domain.faces[1] = graded_faces(0.0, 1.0, 0.06, {{0.0, 0.4, 0.025, 1.1}});
      for (std::size_t a = 0; a < 2; ++a)
        domain.cells[a] = static_cast<int>(domain.faces[a].size()) - 1;
    }
    FlowRun<2> run(domain, options);
    while (run.time < 0.3)
      run.step(std::min(run.flow.stable_step(run.medium), 0.3 - run.time + 1e-12));
    const WaterLedger water = run.flow.ledger();
    EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
    EXPECT_NEAR(water.initial, 0.2, 1e-12);
    return run.flow.front();
  };
  EXPECT_NEAR(front(true), front(false), 0.02);
}

}  // namespace
}  // namespace mudlark

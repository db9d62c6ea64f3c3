// ranks: 1 3
// Coulomb friction on the sides of the domain.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

/// A layer on a floor of friction, joined to itself along the slope; gravity acts as on a slope.
template <int D>
double sliding_speed(double along, double friction, double time, double inertia = 1.0) {
  DomainOptions domain;
  domain.dimension = D;
  domain.cells = {9, D == 2 ? 8 : 3, 8};
  const double h = 0.1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a)
    domain.upper[a] = domain.cells[a] * h;
  domain.walls[0] = {Wall::periodic, Wall::periodic};
  domain.walls[D - 1] = {Wall::friction, Wall::open};
  domain.wall_friction[D - 1][0] = friction;
  domain.gravity[0] = along;
  domain.gravity[D - 1] = -10.0;
  const Grid<D> grid(domain, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 0.4}, false);
  options.mass_scaling = inertia;
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].law = LinearElasticOptions{1e8, 0.3};  // swings far faster than it slides
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double now = 0.0;
  const int steps = static_cast<int>(std::ceil(time / soil.stable_step()));
  soil_runs::run(soil, now, steps, time / steps);
  const auto totals = soil.totals();
  return totals.momentum[0] / (totals.grain_mass + totals.water_mass);
}

TEST(WallFriction, HoldsALayerBelowTheAngleOfFriction) {
  EXPECT_NEAR(sliding_speed<2>(3.0, 0.4, 0.2), 0.0, 0.01 * 3.0 * 0.2);
  EXPECT_NEAR(sliding_speed<3>(3.0, 0.4, 0.1), 0.0, 0.01 * 3.0 * 0.1);
}

// a = g_x - mu g_z
TEST(WallFriction, LetsALayerSlideAboveItAsABlockOnASlope) {
  const double time = 0.2;
  for (const double friction : {0.0, 0.2, 0.4}) {
    const double exact = (6.0 - 10.0 * friction) * time,
                 speed = sliding_speed<2>(6.0, friction, time);
    std::printf("friction %.1f: %.4f m/s, exact %.4f m/s\n", friction, speed, exact);
    EXPECT_NEAR(speed, exact, 0.01 * 6.0 * time);
  }
  EXPECT_NEAR(sliding_speed<3>(6.0, 0.4, 0.1), 0.2, 0.012);
}

TEST(WallFriction, GrowsSlowerSpeedsWithScaledInertia) {
  EXPECT_NEAR(sliding_speed<2>(6.0, 0.4, 0.2, 4.0), 2.0 * 0.2 / 4.0, 0.01 * 6.0 * 0.2 / 4.0);
}

/// Speed of a block that slides on a floor of friction. It springs out where its sides are free,
/// and swings: the wall presses and pulls in turn.
double block_speed(double young_modulus, double time) {
  constexpr int D = 2;
  DomainOptions domain;
  domain.dimension = D;
  domain.cells = {30, 12, 12};
  const double h = 0.05;
  for (std::size_t a = 0; a < D; ++a) domain.upper[a] = domain.cells[a] * h;
  domain.walls[0] = {Wall::open, Wall::open};
  domain.walls[D - 1] = {Wall::friction, Wall::open};
  domain.wall_friction[D - 1][0] = 0.5;
  domain.gravity[0] = 6.0;
  domain.gravity[D - 1] = -8.0;
  const Grid<D> grid(domain, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(D, {0.2, -1, -1}, {0.7, 0.2, 0.2}, false);
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].law = LinearElasticOptions{young_modulus, 0.2};
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double now = 0.0;
  const int steps = static_cast<int>(std::ceil(time / soil.stable_step()));
  soil_runs::run(soil, now, steps, time / steps);
  const auto totals = soil.totals();
  return totals.momentum[0] / (totals.grain_mass + totals.water_mass);
}

// In the mean it rests with its weight, whatever it swings by: without debts the pressing half of
// the swings rubs like twice its weight.
TEST(WallFriction, SlowsABlockThatSwingsByItsWeight) {
  const double time = 0.3, exact = (6.0 - 0.5 * 8.0) * time;
  const double found = block_speed(1e7, time);
  std::printf("block: %.4f m/s, exact %.4f\n", found, exact);
  EXPECT_NEAR(found, exact, 0.06 * exact);
}

/// Momentum over mass of a sheet that stretches and sinks while it slides, u = 1 + 2x, w = -2z.
template <int D>
double spreading_speed(Transfer transfer, bool wet, double friction, double time) {
  DomainOptions domain;
  domain.dimension = D;
  domain.cells = {60, D == 2 ? 8 : 2, 8};
  const double h = 0.005;
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a)
    domain.upper[a] = domain.cells[a] * h;
  domain.walls[0] = {Wall::open, Wall::open};
  domain.walls[D - 1] = {Wall::friction, Wall::open};
  domain.wall_friction[D - 1][0] = friction;
  domain.gravity[D - 1] = -10.0;
  const Grid<D> grid(domain, MPI_COMM_WORLD);
  SoilOptions options =
      soil_runs::make_soil(D, {0.01, -1, -1}, {0.06, D == 2 ? 0.005 : 1.0, 0.005}, wet);
  options.transfer = transfer;
  options.bodies[0].points_per_cell = D == 2 ? 4 : 8;
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].strain = StrainMeasure::jaumann;
  MohrCoulombOptions law;
  law.young_modulus = 1e6, law.poisson_ratio = 0.3, law.friction_angle = 0.35;
  options.bodies[0].law = law;
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  auto& points = soil.points(0);
  points.carries_affine = transfer == Transfer::apic;
  soil_runs::set_velocity(soil, [](int axis, const Vec<D>& x, std::int64_t) {
    return axis == 0 ? 1.0 + 2.0 * x[0] : axis == D - 1 ? -2.0 * x[D - 1] : 0.0;
  });
  if (transfer == Transfer::apic)
    for (std::size_t p = 0; p < points.size(); ++p) {
      points.affine[0][p] = 2.0, points.affine[D * D - 1][p] = -2.0;
      if (wet) points.water_affine[0][p] = 2.0, points.water_affine[D * D - 1][p] = -2.0;
    }
  const auto speed = [&] {
    const auto totals = soil.totals();
    return totals.momentum[0] / (totals.grain_mass + totals.water_mass);
  };
  const double start = speed();
  double now = 0.0;
  const int steps = static_cast<int>(std::ceil(time / soil.stable_step()));
  soil_runs::run(soil, now, steps, time / steps);
  return speed() - start;
}

// The motion behind the wall is then not that of a layer at rest, and must not count as pressure
// on the wall: what slows the sheet is its weight, -mu g t; of wet soil the buoyant weight.
TEST(WallFriction, SlowsSoilThatSpreadsByItsWeight) {
  const double time = 0.04, dry = -0.3 * 10.0 * time;
  const double grains = 0.6 * 2650.0, water = 0.4 * 1000.0;
  const double wet = dry * 0.6 * (2650.0 - 1000.0) / (grains + water);
  for (const Transfer transfer : soil_runs::every_transfer) {
    for (const bool is_wet : {false, true}) {
      const double exact = is_wet ? wet : dry;
      const double plane = spreading_speed<2>(transfer, is_wet, 0.3, time);
      const double space = spreading_speed<3>(transfer, is_wet, 0.3, time);
      std::printf("%s, %s: %.4f m/s in the plane, %.4f in space, exact %.4f\n",
                  transfer == Transfer::flip ? "flip" : "apic", is_wet ? "wet" : "dry", plane,
                  space, exact);
      EXPECT_NEAR(plane, exact, 0.05 * std::abs(exact));
      EXPECT_NEAR(space, exact, 0.05 * std::abs(exact));
    }
  }
}

}  // namespace
}  // namespace mudlark

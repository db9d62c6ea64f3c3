// ranks: 1 3
// Momentum of water and grains in a closed box, one water (NUMERICS C2): pressure and drag pass it
// from one to the other, and with grain_share = "cells" none of it goes astray.
#include <gtest/gtest.h>

#include <cmath>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

/// A block of soil that is thrown across a box full of water, round which it must go: slip floor
/// and lid, periodic sides, so nothing holds either back along x.
CaseOptions thrown_block(GrainShare share, double viscosity) {
  CaseOptions c = soil_in_water(Shape{BoxShape{{0.35, -9, 0.12}, {0.73, 9, 0.41}}}, 9.0, 1e-2, 2e5);
  c.domain.cells = {27, 14, 1};
  c.domain.upper = {1.35, 0.7, 0.0};
  c.domain.walls[0] = {Wall::periodic, Wall::periodic};
  c.domain.walls[1] = {Wall::slip, Wall::slip};
  c.domain.gravity = {};
  c.flow->viscosity = viscosity;
  c.coupling.grain_share = share;
  SoilBody& block = c.soil->bodies.front();
  block.initial_velocity[0] = Varying(0.3);
  return c;
}

double drift_of_momentum(GrainShare share, int steps) {
  World<2> world(thrown_block(share, 1e-3), MPI_COMM_WORLD);
  world.initialise();
  GaugeOptions gauge;
  gauge.quantity = GaugeQuantity::momentum;
  const double first = read_gauge(world, gauge)[0];
  double worst = 0.0;
  for (int step = 0; step < steps; ++step) {
    world.advance(world.stable_step());
    worst = std::max(worst, std::abs(read_gauge(world, gauge)[0] - first));
  }
  expect_conservation(world);
  const double moved = world.soil()->totals().momentum[0];
  printf("momentum %.6g kg/s at first, %.6g of it among grains after %.3g s, drift %.3g\n", first,
         moved / first, world.clock().time(), worst / std::abs(first));
  return worst / std::abs(first);
}

TEST(OneWaterMomentum, IsKeptWhereGrainsTakeWhatTheWaterLeaves) {
  EXPECT_LT(drift_of_momentum(GrainShare::cells, 200), 1e-10);
}

/// The other share keeps rest exactly, and momentum less well: the gauge sees the difference.
TEST(OneWaterMomentum, DriftsWhereGrainsTakeTheShareOfTheirPoints) {
  EXPECT_GT(drift_of_momentum(GrainShare::points, 50), 1e-6);
}

/// In a frame that is accelerated grains and water fall alike. What moves them against each other
/// is the drift of the cells' porosity that is led back: little.
TEST(OneWaterMomentum, GrowsAlikeInGrainsAndWaterThatAreAccelerated) {
  CaseOptions c = thrown_block(GrainShare::cells, 1e-3);
  c.soil->bodies.front().initial_velocity[0] = Varying(0.0);
  c.flow->body_acceleration = {Varying([](const Point3&, double t) { return 1.0 + 20.0 * t; }, "a"),
                               Varying(0.0), Varying(0.0)};
  c.soil->body_acceleration = c.flow->body_acceleration;  // as the reader has it
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  for (int step = 0; step < 20; ++step) world.advance(1e-3);
  const double time = world.clock().time(), speed = time + 10.0 * time * time;
  const double grains = world.soil()->totals().grain_mass;
  const double water = 1000.0 * world.flow()->ledger().present;
  GaugeOptions gauge;
  gauge.quantity = GaugeQuantity::momentum;
  EXPECT_NEAR(read_gauge(world, gauge)[0], (grains + water) * speed, 1e-12 * (grains + water));
  EXPECT_NEAR(world.unified()->grain_momentum()[0], grains * speed, 1e-3 * grains * speed);
}

}  // namespace
}  // namespace mudlark

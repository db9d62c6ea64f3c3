// ranks: 1 3
// Soil that starts from rest under water (soil_solver.start_in_equilibrium with one water).
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

/// A bank without stress, its foot under water, its top dry.
CaseOptions bank(double longest) {
  PolygonShape shape;
  shape.corners = {{-1.0, -1.0}, {1.4, -1.0}, {1.2, 0.0}, {0.5, 0.7}, {-1.0, 0.7}};
  CaseOptions c = soil_in_water(Shape{shape}, 0.4, 1e-3, 2e6);
  c.domain.cells = {18, 12, 1};
  c.domain.upper = {1.35, 0.9, 0.0};
  c.domain.walls[1][0] = Wall::no_slip;
  EquilibriumStart start;
  start.longest = longest;
  start.rest.unbalanced_force = 1e-3;
  start.reset_displacements = false;
  c.soil->start_in_equilibrium = start;
  return c;
}

double settlement(World<2>& world) {
  GaugeOptions gauge;
  gauge.quantity = GaugeQuantity::settlement;
  gauge.at = {0.1, 0.0, 0.68};
  return read_gauge(world, gauge)[0];
}

TEST(OneWaterEquilibrium, StaysWhereItWasFound) {
  World<2> world(bank(9.0), MPI_COMM_WORLD);
  world.initialise();
  world.find_equilibrium();
  const double settled = settlement(world);
  // Dry weight above the water, submerged below it, over the modulus of a layer that is held
  // sideways: the bank gives way to the side, and a little more.
  const double dry = 0.6 * 2650.0 * 9.81, wet = 0.6 * 1650.0 * 9.81;
  const double layer = (dry * 0.3 * (0.15 + 0.4) + wet * 0.5 * 0.4 * 0.4) / (2e6 * 0.7 / 0.52);
  EXPECT_GT(settled, layer);
  EXPECT_LT(settled, 1.6 * layer);
  run_until(world, 0.2);
  EXPECT_NEAR(settlement(world), settled, 1e-2 * settled);
  EXPECT_LT(world.flow()->max_speed().speed, 1e-3);
  expect_conservation(world);
}

TEST(OneWaterEquilibrium, IsNotFoundInNoTime) {
  World<2> world(bank(1e-3), MPI_COMM_WORLD);
  world.initialise();
  EXPECT_THROW(world.find_equilibrium(), InputError);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
// Soil on a floor of Coulomb friction, under water (NUMERICS C2): its effective weight presses.
#include <gtest/gtest.h>

#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double along = 2.0, down = 9.6, depth = 0.4;
constexpr double mixture = 0.6 * 2650.0 + 0.4 * 1000.0, submerged = mixture - 1000.0;

/// A layer without end on a slope, full of water: grains and pore water move as one. Mean velocity
/// of the grains along the slope after a time [m/s].
double slide(double friction, Transfer transfer, double time) {
  CaseOptions c = soil_in_water(Shape{BoxShape{{-9, -9, -9}, {9, 9, depth}}}, depth, 1e-4, 2e7);
  c.domain.cells = {9, 16, 1};
  c.domain.upper = {0.45, 0.8, 0.0};
  c.domain.gravity = {along, -down, 0.0};
  c.domain.walls[0] = {Wall::periodic, Wall::periodic};
  c.domain.walls[1][0] = Wall::friction;
  c.domain.wall_friction[1][0] = friction;
  c.soil->bodies.front().initial_stress = GeostaticStress{};
  c.soil->transfer = transfer;
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, time);
  expect_conservation(world);
  const auto totals = world.soil()->totals();
  return totals.momentum[0] / totals.grain_mass;
}

TEST(OneWaterFriction, LetsALayerSlideAsItsSubmergedWeightAllows) {
  const double friction = 0.2, time = 0.3;
  const double exact = (along - friction * down * submerged / mixture) * time;
  for (const Transfer transfer : {Transfer::flip, Transfer::apic}) {
    const double found = slide(friction, transfer, time);
    printf("%.4f m/s, exact %.4f\n", found, exact);
    EXPECT_NEAR(found, exact, 0.01 * exact);
  }
}

TEST(OneWaterFriction, HoldsALayerThatIsNotSteepEnough) {
  const double critical = mixture * along / (submerged * down);
  EXPECT_LT(std::abs(slide(1.1 * critical, Transfer::flip, 0.3)), 0.01);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
// Stages with one water that end when soil and water are at rest (stop_when_static).
#include <gtest/gtest.h>

#include <cmath>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double h = 0.05, top = 6 * h, length = 18 * h, modulus = 1e6, end = 1000.0;

/// A bed without stress of its own under water, one stage until rest and one after it. Rain falls
/// once the first is over.
CaseOptions bed_under_water(double left, double right) {
  CaseOptions c = soil_in_water(Shape{BoxShape{{-9, -9, -9}, {9, 9, top}}}, 0.0, 1e-2, modulus);
  c.domain.dimension = 2;
  c.domain.cells = {18, 14, 1};
  c.domain.upper = {length, 14 * h, 0.0};
  c.time.end = end + 0.5;
  c.time.stage_ends = {end, end + 0.5};
  c.flow->bodies.clear();
  c.flow->bodies.push_back({Shape{BoxShape{{-9, -9, -9}, {0.5 * length, 9, left}}}, {}});
  c.flow->bodies.push_back({Shape{BoxShape{{0.5 * length, -9, -9}, {9, 9, right}}}, {}});
  c.soil->flooded.clear();
  for (const WaterBody& body : c.flow->bodies) c.soil->flooded.push_back(body.shape);
  c.soil->bodies[0].points_per_cell = 4;
  c.soil->bodies[0].law = LinearElasticOptions{modulus, 0.0};
  c.soil->bodies[0].strain = StrainMeasure::small;
  c.soil->damping = 0.7;
  c.soil->stages.resize(2);
  c.soil->stages[0].name = "rest", c.soil->stages[1].name = "rain";
  c.soil->stages[0].stop_when_static = RestCriterion{};
  const auto rain = [](const Point3&, double time) { return time > end ? 1e-3 : 0.0; };
  c.flow->rains.push_back({"rain", {}, {}, Varying(rain, "rain")});
  c.flow->rains[0].from = {-9, -9, -9}, c.flow->rains[0].to = {9, 9, 9};
  return c;
}

void step(World<2>& world) { world.advance(world.clock().choose_step(world.stable_step())); }

/// Returns when rest was found [s].
double run_to_rest(World<2>& world) {
  world.initialise();
  while (!world.clock().stage_over() && world.clock().time() < 60.0) step(world);
  EXPECT_EQ(world.clock().time(), end);
  return world.stages()[0].rested;
}

double settlement(World<2>& world) {
  GaugeOptions gauge;
  gauge.quantity = GaugeQuantity::settlement;
  gauge.at = {0.5 * length, 0.0, top};
  return read_gauge(world, gauge)[0];
}

TEST(OneWaterRest, ABedThatSettlesUnderWaterEndsItsStageSettled) {
  World<2> world(bed_under_water(9 * h, 9 * h), MPI_COMM_WORLD);
  const double rested = run_to_rest(world);
  EXPECT_GT(rested, 0.01);
  const double exact = 0.6 * 1650.0 * 9.81 * 0.5 * top * top / modulus;
  EXPECT_NEAR(settlement(world), exact, 0.03 * exact);
  const auto statics = world.statics();
  EXPECT_TRUE(statics && statics->at_rest(RestCriterion{}));
}

/// Long after the bed has settled the water still swings.
TEST(OneWaterRest, WaterThatSwingsKeepsAStageGoing) {
  World<2> still(bed_under_water(9 * h, 9 * h), MPI_COMM_WORLD);
  World<2> world(bed_under_water(10 * h, 8 * h), MPI_COMM_WORLD);
  const double bed_alone = run_to_rest(still);
  world.initialise();
  while (!world.clock().stage_over() && world.clock().time() < 10.0 * bed_alone) step(world);
  EXPECT_FALSE(world.clock().stage_over());
  const auto statics = world.statics();
  EXPECT_GT(statics->kinetic_energy, 1e-3);
}

/// Water and soil have the time of the clock: what varies in time does not depend on how soon they
/// were at rest.
TEST(OneWaterRest, TheNextStageBeginsAtItsTime) {
  World<2> world(bed_under_water(9 * h, 9 * h), MPI_COMM_WORLD);
  run_to_rest(world);
  EXPECT_EQ(world.flow()->ledger().outflow, 0.0);
  world.begin_next_stage();
  while (!world.clock().finished()) step(world);
  const double fallen = 1e-3 * 0.5 * length;
  EXPECT_NEAR(-world.flow()->ledger().outflow, fallen, 0.03 * fallen);
  expect_conservation(world);
}

}  // namespace
}  // namespace mudlark

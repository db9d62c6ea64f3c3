// ranks: 1 3
#include <gtest/gtest.h>

#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

PorousGround mound(Point3 lower, Point3 upper, double porosity) {
  PorousGround ground;
  ground.shape.form = BoxShape{lower, upper};
  ground.porosity = porosity;
  ground.drag = DragLaw::ergun;
  ground.grain_size = 0.02;
  return ground;
}

TEST(Hydrostatics, APondOverAStepOfPorosityStaysAtRestForAThousandSteps) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.537})};
  options.porous = {mound({-1.0, -1.0, -1.0}, {0.5, 1.0, 0.33}, 0.4),
                    mound({0.7, -1.0, -1.0}, {2.0, 1.0, 0.7}, 0.35)};
  FlowRun<2> run(flow_domain({32, 24, 1}, {1.0, 0.75, 1.0}, {0.0, -9.81, 0.0}), options);
  for (int step = 0; step < 1000; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_LT(run.flow.max_speed().speed, 1e-12);
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
  // Exact pressure, also below the surface that lies within a cell and inside the mound that rises
  // above it.
  for (const Vec<2> place : {Vec<2>{{0.2, 0.2}}, Vec<2>{{0.6, 0.3}}, Vec<2>{{0.8, 0.45}}})
    EXPECT_NEAR(run.flow.pressure_at(place), 9810.0 * (0.537 - place[1]), 1e-6);
  EXPECT_NEAR(run.flow.surface_height(Vec<2>{{0.6, 0.0}}), 0.537, 1e-9);
}

TEST(Hydrostatics, AThreeDimensionalPondOverAStepOfPorosityStaysAtRest) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.537})};
  options.porous = {mound({-1.0, 0.3, -1.0}, {0.5, 2.0, 0.33}, 0.4)};
  FlowRun<3> run(flow_domain({12, 10, 16}, {1.0, 0.9, 0.8}, {0.0, 0.0, -9.81}), options);
  for (int step = 0; step < 200; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_LT(run.flow.max_speed().speed, 1e-12);
}

TEST(Hydrostatics, AClosedBoxFullOfWaterStaysAtRestUnderTiltedGravity) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 2.0})};
  options.porous = {mound({-1.0, -1.0, -1.0}, {0.5, 1.0, 0.33}, 0.4)};
  FlowRun<2> run(flow_domain({30, 26, 1}, {1.0, 0.8, 1.0}, {3.1, -9.2, 0.0}), options);
  for (int step = 0; step < 500; ++step) run.step(1e-3);
  EXPECT_LT(run.flow.max_speed().speed, 1e-8);
  // Zero pressure in the corner that lies highest against gravity, linear from there.
  EXPECT_NEAR(run.flow.pressure_at(Vec<2>{{0.4, 0.3}}), 1000.0 * (3.1 * 0.4 + 9.2 * 0.5), 1e-6);
}

/// Water fills the part below a plane at right angles to gravity. Near the walls the reconstructed
/// normal is not exact, so the test looks at how fast the disturbance gets in a short time against
/// free fall.
TEST(Hydrostatics, ATiltedSurfaceHardlyMoves) {
  FlowOptions options;
  WaterBody body;
  body.shape.form = BelowShape{{{-1.0, 0.7}, {2.0, 0.1}}};  // slope -1/5
  options.bodies = {body};
  FlowRun<2> run(flow_domain({40, 40, 1}, {1.0, 1.0, 1.0},
                             {-9.81 / std::sqrt(26.0), -9.81 * 5.0 / std::sqrt(26.0), 0.0}),
                 options);
  for (int step = 0; step < 20; ++step) run.step(1e-3);
  EXPECT_LT(run.flow.max_speed().speed, 0.05 * 9.81 * 0.02);
}

TEST(Hydrostatics, AThinColumnOfHundredsOfCellsStaysAtRest) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 40.0})};
  options.porous = {mound({-1.0, -1.0, -1.0}, {2.0, 1.0, 1.0}, 0.3)};
  FlowRun<2> run(flow_domain({3, 835, 1}, {0.15, 41.75, 1.0}, {0.0, -9.81, 0.0}), options);
  for (int step = 0; step < 100; ++step) run.step(run.flow.stable_step(run.medium));
  EXPECT_LT(run.flow.max_speed().speed, 1e-11);
  EXPECT_NEAR(run.flow.pressure_at(Vec<2>{{0.07, 0.5}}), 9810.0 * 39.5, 1e-4);
}

}  // namespace
}  // namespace mudlark

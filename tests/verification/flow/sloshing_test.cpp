// ranks: 1 2
#include <gtest/gtest.h>

#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

/// A closed tank, shaken so hard that the water hits the lid: nothing is clipped (the solver stops
/// when a bound breaks), no number is lost, volume stays to round-off, and no water runs away: a
/// void that closes under the lid throws single jets of some 20 m/s (cases/sloshing), the bound is
/// above those. The long version is cases/sloshing.
TEST(Sloshing, ViolentWaterInAClosedTankKeepsItsVolumeAndItsBounds) {
  FlowOptions options;
  options.courant = 0.5;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.24})};
  options.body_acceleration.emplace();
  (*options.body_acceleration)[0] =
      Varying([](const Point3&, double t) { return 12.0 * std::sin(5.3 * t); }, "along");
  (*options.body_acceleration)[1] =
      Varying([](const Point3&, double t) { return 6.0 * std::sin(7.1 * t); }, "across");
  FlowRun<3> run(flow_domain({12, 9, 9}, {0.8, 0.6, 0.6}, {0.0, 0.0, -9.81}), options);
  const double volume = run.flow.ledger().present;
  double highest = 0.0;
  for (int step = 0; step < 150; ++step) {
    run.step(run.flow.stable_step(run.medium));
    ASSERT_NEAR(run.flow.ledger().present, volume, 1e-13 * volume);
    ASSERT_LT(run.flow.max_speed().speed, 25.0);
    highest = std::max(highest, run.flow.surface_height(Vec<3>{{0.79, 0.3, 0.0}}));
  }
  EXPECT_EQ(run.flow.ledger().outflow, 0.0);
  EXPECT_GT(highest, 0.55);  // it did hit the lid
}

/// Shaken along x with a constant acceleration, the water ends up with a surface aslant: the mean
/// slope is a/g.
TEST(Sloshing, UnderAConstantAccelerationThePressureIsThatOfTiltedGravity) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 2.0})};
  options.body_acceleration.emplace();
  (*options.body_acceleration)[0] = Varying(3.0);
  FlowRun<2> run(flow_domain({16, 12, 1}, {0.8, 0.6, 1.0}, {0.0, -9.81, 0.0}), options);
  for (int step = 0; step < 3; ++step) run.step(0.01);
  EXPECT_LT(run.flow.max_speed().speed, 1e-9);
  const Vec<2> low{{0.1, 0.1}}, right{{0.7, 0.1}};
  EXPECT_NEAR(run.flow.pressure_at(right) - run.flow.pressure_at(low), 3000.0 * 0.6, 1e-4);
}

}  // namespace
}  // namespace mudlark

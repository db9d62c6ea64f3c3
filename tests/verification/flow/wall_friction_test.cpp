// ranks: 1 3
#include "flow/wall_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

/// Mean over a layer [m/s] of u = u_tau min(y+, 8.3 y+^(1/7)), by the midpoint rule on cells that
/// shrink towards the wall.
double mean_speed(double friction_velocity, double thickness, double viscosity) {
  const int count = 200000;
  double sum = 0.0, below = 0.0;
  for (int i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count, above = thickness * share * share * share;
    const double y = 0.5 * (below + above) * friction_velocity / viscosity;
    sum += (above - below) * friction_velocity * (y < 11.81 ? y : 8.3 * std::pow(y, 1.0 / 7.0));
    below = above;
  }
  return sum / thickness;
}

TEST(WallFriction, IsTheStressWhosePowerLawHasTheLayersMeanSpeed) {
  for (const double friction_velocity : {0.002, 0.01, 0.05, 0.2}) {
    const double thickness = 4e-3, viscosity = 1e-6;
    const double speed = mean_speed(friction_velocity, thickness, viscosity);
    const double stress = werner_wengle_stress(speed, thickness, 1000.0, viscosity);
    EXPECT_NEAR(std::sqrt(stress / 1000.0), friction_velocity, 2e-3 * friction_velocity);
  }
}

TEST(WallFriction, IsTheLinearProfileInTheViscousSublayer) {
  EXPECT_DOUBLE_EQ(werner_wengle_stress(0.01, 1e-3, 1000.0, 1e-6), 2.0 * 1e-3 * 0.01 / 1e-3);
  EXPECT_EQ(werner_wengle_stress(0.0, 1e-3, 1000.0, 1e-6), 0.0);
}

/// Water that slides over a rough floor at 1 m/s: the lowest row loses tau / (rho h) and what
/// molecular viscosity takes, the rows above lose nothing.
template <int D>
void expect_slowed_floor() {
  FlowOptions options;
  options.advection = false;
  options.wall_law = WallLaw::werner_wengle;
  options.bodies = {water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away})};
  options.bodies[0].velocity[0] = Varying(1.0);
  DomainOptions domain = D == 2 ? flow_domain({12, 4, 1}, {0.24, 0.08, 1.0}, {0.0, 0.0, 0.0})
                                : flow_domain({12, 4, 4}, {0.24, 0.08, 0.08}, {0.0, 0.0, 0.0});
  for (int a = 0; a < D - 1; ++a)
    domain.walls[static_cast<std::size_t>(a)] = {Wall::periodic, Wall::periodic};
  domain.walls[D - 1][0] = Wall::no_slip;
  FlowRun<D> run(domain, options);
  const double dt = 1e-4, h = 0.02;
  run.step(dt);
  Vec<D> place;
  for (int a = 0; a < D; ++a) place[a] = 0.05;
  place[D - 1] = 0.5 * h;
  const double loss = 1.0 - run.flow.velocity_at(place)[0];
  const double exact = dt * werner_wengle_stress(1.0, h, 1000.0, 1.002e-6) / (1000.0 * h);
  EXPECT_NEAR(loss, exact, 1e-3 * exact);
  place[D - 1] = 1.5 * h;
  EXPECT_NEAR(run.flow.velocity_at(place)[0], 1.0, 1e-9);
}

TEST(WallFriction, SlowsTheLowestRowOfAStreamOnly) {
  expect_slowed_floor<2>();
  expect_slowed_floor<3>();
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
/// Bodies that move as the water, their weight and given forces make them.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, rho = 1000.0;
const double pi = std::acos(-1.0);

FlowSolid free_body(const Shape& shape, const FreeSolid& motion) {
  return {"body", shape, {}, motion, false};
}

FreeSolid of_density(double density) {
  FreeSolid motion;
  motion.density = density;
  return motion;
}

/// A tank of still water, as deep as `level`, with a body in it.
template <int D>
struct Tank {
  FlowOptions options;
  DomainOptions domain;

  Tank(const FlowSolid& solid, double size, int cells, double level) {
    const int n = cells;
    domain = D == 2 ? flow_domain({n, n, 1}, {size, size, 1.0}, {0.0, -gravity, 0.0})
                    : flow_domain({n, n, n}, {size, size, size}, {0.0, 0.0, -gravity});
    options.viscosity = 0.0;
    options.bodies = {water_box({-1.0, -1.0, -1.0}, {9.0, 9.0, level})};
    options.solids = {solid};
  }
};

template <int D>
double height_of(const FlowRun<D>& run) {
  return run.flow.solids().pose(0).centre()[2];
}

/// m a = (m - rho V) g - C rho V a: a circle has C = 1 in wide water (Lamb 1932, art. 68), a sphere
/// 1/2 (art. 92); what walls add to it at distance is 2/3 (pi a / W)^2 in a channel of width W.
/// Light bodies are as stable as heavy ones.
TEST(FreeSolids, ACircleFallsAndRisesWithItsAddedMass) {
  const double radius = 0.15, width = 2.0;
  const double added = 1.0 + 2.0 / 3.0 * std::pow(pi * radius / width, 2);
  for (const double ratio : {0.01, 0.3, 2.0, 7.0}) {
    const Shape circle{SphereShape{{1.0, 0.0, 0.95}, radius, true}};
    Tank<2> tank(free_body(circle, of_density(ratio * rho)), width, 48, 1.9);
    FlowRun<2> run(tank.domain, tank.options);
    const double dt = 1e-3;
    for (int step = 0; step < 10; ++step) run.step(dt);
    const double before = run.flow.solids().velocity(0).velocity[2];
    for (int step = 0; step < 10; ++step) run.step(dt);
    const double acceleration = (run.flow.solids().velocity(0).velocity[2] - before) / (10.0 * dt);
    const double exact = (1.0 - ratio) / (ratio + added) * gravity;
    EXPECT_NEAR(acceleration, exact, 0.018 * std::abs(exact)) << ratio;
  }
}

/// In a full tank that is accelerated sideways, a = (m - rho V)/(m + C rho V) a_frame along the
/// tank.
TEST(FreeSolids, ACircleInAShakenTankGoesWithTheFrame) {
  const double radius = 0.15, width = 2.0, frame = 2.0;
  const double added = 1.0 + 2.0 / 3.0 * std::pow(pi * radius / width, 2);
  for (const double ratio : {0.3, 1.0, 2.0}) {
    const Shape circle{SphereShape{{1.0, 0.0, 1.0}, radius, true}};
    FreeSolid motion = of_density(ratio * rho);
    motion.locked[2] = true;
    motion.acceleration[0] = Varying(frame);
    Tank<2> tank(free_body(circle, motion), width, 48, 2.0);
    tank.options.body_acceleration.emplace();
    (*tank.options.body_acceleration)[0] = Varying(frame);
    FlowRun<2> run(tank.domain, tank.options);
    const double dt = 1e-3;
    for (int step = 0; step < 10; ++step) run.step(dt);
    const double before = run.flow.solids().velocity(0).velocity[0];
    for (int step = 0; step < 10; ++step) run.step(dt);
    const double acceleration = (run.flow.solids().velocity(0).velocity[0] - before) / (10.0 * dt);
    const double exact = (ratio - 1.0) / (ratio + added) * frame;
    EXPECT_NEAR(acceleration, exact, 0.018 * frame) << ratio;
  }
}

TEST(FreeSolids, ASphereFallsWithItsAddedMass) {
  const Shape sphere{SphereShape{{0.5, 0.5, 0.5}, 0.16}};
  Tank<3> tank(free_body(sphere, of_density(2.0 * rho)), 1.0, 20, 0.95);
  FlowRun<3> run(tank.domain, tank.options);
  for (int step = 0; step < 8; ++step) run.step(1e-3);
  const double before = run.flow.solids().velocity(0).velocity[2];
  for (int step = 0; step < 4; ++step) run.step(1e-3);
  const double acceleration = (run.flow.solids().velocity(0).velocity[2] - before) / 4e-3;
  EXPECT_NEAR(acceleration, -gravity / 2.5, 0.05 * gravity / 2.5);  // six cells across
}

/// A box as heavy as water, on faces of the grid where its volume is exact. Held upright: pressure
/// turns it by what the middle of a wall in a cell cannot tell.
TEST(FreeSolids, ABodyAsHeavyAsWaterStaysAtRest) {
  FreeSolid motion = of_density(rho);
  motion.locked_rotation[1] = true;
  const Shape box{BoxShape{{0.25, -9.0, 0.3125}, {0.5, 9.0, 0.4375}}};
  Tank<2> tank(free_body(box, motion), 1.0, 16, 0.8);
  FlowRun<2> run(tank.domain, tank.options);
  for (int step = 0; step < 60; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_LT(run.flow.max_speed().speed, 1e-10);
  EXPECT_LT(run.flow.solids().velocity(0).velocity.norm(), 1e-9);
}

/// A box whose side is 2a hangs with its centre of mass, where it turns, a distance d below its
/// middle: (I + A) theta'' = -rho V g d sin(theta), A = 0.725 rho a^4 + 4.754 rho a^2 d^2 (Newman
/// 1977, table 4.3) about that centre, which stays where it is.
TEST(FreeSolids, ABoxSwingsInWaterWithItsAddedInertia) {
  const double a = 0.15, d = 0.05, angle = 0.1;
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<std::array<double, 2>> corners;
  for (const auto& [x, z] :
       {std::array{-a, -a}, std::array{a, -a}, std::array{a, a}, std::array{-a, a}})
    corners.push_back({1.0 + c * x - s * (z + d), 1.0 + s * x + c * (z + d)});
  FreeSolid motion = of_density(rho);
  motion.locked = {true, true, true};
  FlowSolid swing = free_body({PolygonShape{corners}}, motion);
  swing.centre = Point3{1.0, 0.0, 1.0};
  Tank<2> tank(swing, 2.0, 40, 1.9);
  FlowRun<2> run(tank.domain, tank.options);
  const double mass = rho * 4.0 * a * a;
  const double inertia = mass * (2.0 / 3.0 * a * a + d * d);
  const double added = rho * (0.725 * std::pow(a, 4) + 4.754 * a * a * d * d);
  const double period = 2.0 * pi * std::sqrt((inertia + added) / (mass * gravity * d));
  double crossed = 0.0, turned = 0.0;
  while (crossed == 0.0 && run.time < period) {
    const double dt = std::min(5e-3, run.flow.stable_step(run.medium));
    run.step(dt);
    const double now = run.flow.solids().pose(0).turned()[1];
    if (std::abs(now) >= angle)
      crossed = run.time - dt * (std::abs(now) - angle) / std::abs(now - turned);
    turned = now;
  }
  EXPECT_NEAR(crossed, 0.25 * period, 0.025 * 0.25 * period);
}

TEST(FreeSolids, ABodyThatIsHeldIsAFixedOne) {
  FreeSolid motion = of_density(2.0 * rho);
  motion.locked = {true, true, true}, motion.locked_rotation = {true, true, true};
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {0.3, 9.0, 0.6})};  // a dam that breaks
  options.solids = {free_body({BoxShape{{0.5, -9.0, 0.1}, {0.7, 9.0, 0.3}}}, motion)};
  FlowOptions other = options;
  other.solids[0].motion = FixedSolid{};
  const DomainOptions domain = flow_domain({32, 24, 1}, {1.0, 0.75, 1.0}, {0.0, -gravity, 0.0});
  FlowRun<2> held(domain, options), fixed(domain, other);
  for (int step = 0; step < 60; ++step) {
    const double dt = fixed.flow.stable_step(fixed.medium);
    held.step(dt), fixed.step(dt);
  }
  const SolidLoad one = held.flow.solid_load(0, {}), two = fixed.flow.solid_load(0, {});
  EXPECT_NEAR(one.force[0], two.force[0], 1e-9 * two.force.norm());
  EXPECT_NEAR(one.force[2], two.force[2], 1e-9 * two.force.norm());
}

/// A box starts 7 mm above its draught and heaves through the surface with Archimedes' level for
/// its mean, in the long steps of the water, and does not gain.
TEST(FreeSolids, AFloatingBoxHeavesAroundItsDraught) {
  const double width = 0.4, height = 0.3, level = 0.613;
  const Shape box{BoxShape{{0.81, -9.0, 0.47}, {0.81 + width, 9.0, 0.47 + height}}};
  FreeSolid motion = of_density(0.5 * rho);
  motion.locked[0] = motion.locked_rotation[1] = true;
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {3.0, 9.0, level})};
  options.solids = {free_body(box, motion)};
  const DomainOptions domain = flow_domain({40, 20, 1}, {2.0, 1.0, 1.0}, {0.0, -gravity, 0.0});
  FlowRun<2> run(domain, options), alone(domain, options, MPI_COMM_SELF);
  double mean = 0.0, span = 0.0, late = 0.0;
  while (run.time < 3.0) {
    const double dt = run.flow.stable_step(run.medium);
    run.step(dt), alone.step(dt);
    const double off = height_of(run) - level;
    if (run.time > 1.0) mean += dt * off, span += dt;
    if (run.time > 1.8) late = std::max(late, std::abs(off));
  }
  EXPECT_NEAR(mean / span, 0.0, 0.001);
  EXPECT_LT(late, 0.011);  // the first trough is 9.5 mm deep
  EXPECT_GT(late, 0.003);
  EXPECT_NEAR(height_of(run), height_of(alone), 1e-9);
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
}

/// A box that floats upright (metacentre 8 cm above its centre) and is set rolling: waves take some
/// of its swing away and nothing may bring it back, in the long steps of the water either.
TEST(FreeSolids, AFloatingBoxRollsWithoutGain) {
  const double width = 0.4, height = 0.2, level = 0.613;
  const double left = 0.81, bottom = level - 0.5 * height;
  const Shape box{BoxShape{{left, -9.0, bottom}, {left + width, 9.0, bottom + height}}};
  FreeSolid motion = of_density(0.5 * rho);
  motion.locked[0] = true;
  motion.angular_velocity[1] = 0.5;
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {3.0, 9.0, level})};
  options.solids = {free_body(box, motion)};
  const DomainOptions domain = flow_domain({40, 20, 1}, {2.0, 1.0, 1.0}, {0.0, -gravity, 0.0});
  FlowRun<2> run(domain, options);
  double early = 0.0, late = 0.0;
  while (run.time < 4.5) {
    run.step(run.flow.stable_step(run.medium));
    const double angle = std::abs(run.flow.solids().pose(0).turned()[1]);
    if (run.time < 1.5) early = std::max(early, angle);
    if (run.time > 3.0) late = std::max(late, angle);
  }
  EXPECT_GT(early, 0.06);  // 0.5 rad/s over 2 pi/T with T of 1.2 s is 0.095
  EXPECT_LT(late, early);
  EXPECT_GT(late, 0.3 * early);
}

/// Half a cell above the floor, where water still flows under it: it slides where the force is
/// more than friction on its weight under water, and comes to rest at the wall.
TEST(FreeSolids, ABlockOnTheFloorSlidesByTheLawOfCoulomb) {
  const double friction = 0.5;
  const Shape block{BoxShape{{0.25, -9.0, 0.03125}, {0.5, 9.0, 0.21875}}};
  Tank<2> still({"body", block, {}, FixedSolid{}}, 1.0, 16, 0.8);
  const double lift = FlowRun<2>(still.domain, still.options).flow.solid_load(0, {}).force[2];
  const double weight = 2.0 * rho * gravity * 0.25 * 0.1875 - lift;
  for (const double share : {0.9, 1.5}) {
    FreeSolid motion = of_density(2.0 * rho);
    motion.force[0] = Varying(share * friction * weight);
    FlowSolid solid = free_body(block, motion);
    solid.friction = friction;
    Tank<2> tank(solid, 1.0, 16, 0.8);
    FlowRun<2> run(tank.domain, tank.options);
    const auto moved = [&] {
      const RigidPose& pose = run.flow.solids().pose(0);
      return pose.centre() - pose.start_centre();
    };
    for (int step = 0; step < 40; ++step) run.step(2e-3);
    const Eigen::Vector3d floor = run.flow.solids().collision_force(0);
    EXPECT_NEAR(floor[2], weight, 0.01 * weight) << share;
    EXPECT_NEAR(floor[0], -std::min(share, 1.0) * friction * weight, 0.01 * weight) << share;
    if (share < 1.0)
      EXPECT_LT(moved().norm(), 1e-6);
    else
      EXPECT_GT(moved()[0], 1e-3);
    if (share < 1.0) continue;
    while (run.time < 2.0) run.step(std::min(5e-3, run.flow.stable_step(run.medium)));
    EXPECT_NEAR(moved()[0], 0.5 - 0.03125, 2e-3);  // half a cell from the wall
    EXPECT_NEAR(moved()[2], 0.0, 1e-3);
  }
}

/// In a shaft little wider than the circle the water answers with far more than the added mass of
/// wide water, which only an added mass that grows can follow; a light circle rises without a jerk.
TEST(FreeSolids, ALightCircleRisesInANarrowShaft) {
  const double radius = 0.2;
  FreeSolid motion = of_density(0.05 * rho);
  motion.locked[0] = motion.locked_rotation[1] = true;
  const Shape circle{SphereShape{{0.25, 0.0, 0.4}, radius, true}};
  FlowOptions options;
  options.viscosity = 0.0;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {9.0, 9.0, 1.4})};
  options.solids = {free_body(circle, motion)};
  FlowRun<2> run(flow_domain({20, 64, 1}, {0.5, 1.6, 1.0}, {0.0, -gravity, 0.0}), options);
  double fastest = 0.0;
  while (run.time < 0.3) {
    run.step(std::min(1e-3, run.flow.stable_step(run.medium)));
    fastest = std::max(fastest, run.flow.solids().velocity(0).velocity.norm());
    ASSERT_LT(fastest, 1.5);
  }
  EXPECT_GT(height_of(run), 0.41);
  EXPECT_GT(run.flow.solids().velocity(0).velocity[2], 0.0);
}

/// A body that sinks comes to rest on the floor and is not thrown back.
TEST(FreeSolids, ACircleSinksToTheFloorAndStays) {
  const double radius = 0.1;
  const Shape circle{SphereShape{{0.5, 0.0, 0.3}, radius, true}};
  Tank<2> tank(free_body(circle, of_density(3.0 * rho)), 1.0, 24, 0.8);
  FlowRun<2> run(tank.domain, tank.options);
  const double floor = radius + 0.5 / 24.0;
  double lowest = 1.0, after = 0.0;
  while (run.time < 0.8) {
    run.step(std::min(5e-3, run.flow.stable_step(run.medium)));
    lowest = std::min(lowest, height_of(run));
    if (lowest < floor + 0.005) after = std::max(after, height_of(run));
  }
  EXPECT_NEAR(lowest, floor, 0.002);
  EXPECT_LT(after, floor + 0.007);
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
}

}  // namespace
}  // namespace mudlark

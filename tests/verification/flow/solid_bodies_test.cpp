// ranks: 1 3
/// Impermeable bodies in the water: rest, forces, volume, slip.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

FlowSolid body(const std::string& name, const Shape& shape) { return {name, shape, {}, {}, false}; }

Shape polygon(std::vector<std::array<double, 2>> corners) {
  return {PolygonShape{std::move(corners)}};
}

/// A beach, and a leaning pile that pierces the surface.
std::vector<FlowSolid> beach_and_pile() {
  return {body("beach", polygon({{0.55, -0.1}, {1.1, -0.1}, {1.1, 0.7}, {0.55, 0.03}})),
          body("pile", polygon({{0.2, 0.3}, {0.33, 0.23}, {0.43, 0.63}, {0.3, 0.7}}))};
}

TEST(SolidBodies, APondOverABeachAroundAPileStaysAtRest) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.537})};
  options.solids = beach_and_pile();
  FlowRun<2> run(flow_domain({32, 24, 1}, {1.0, 0.75, 1.0}, {0.0, -9.81, 0.0}), options);
  for (int step = 0; step < 500; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_LT(run.flow.max_speed().speed, 1e-12);
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
  EXPECT_LT(water.initial, 0.9 * 0.537);  // beach and pile take their part of the box
  EXPECT_NEAR(run.flow.surface_height(Vec<2>{{0.6, 0.0}}), 0.537, 1e-9);
}

TEST(SolidBodies, APondAroundABallInSpaceStaysAtRest) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.537})};
  options.solids = {body("ball", {SphereShape{{0.47, 0.4, 0.45}, 0.21}})};
  FlowRun<3> run(flow_domain({12, 10, 16}, {1.0, 0.9, 0.8}, {0.0, 0.0, -9.81}), options);
  for (int step = 0; step < 100; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_LT(run.flow.max_speed().speed, 1e-12);
  // Archimedes: the volume below the level.
  const double deep = 0.537 - 0.24, pi = std::acos(-1.0);
  const double weight = 9810.0 * pi * deep * deep * (0.21 - deep / 3.0);
  const SolidLoad load = run.flow.solid_load(0, {});
  EXPECT_NEAR(load.force[2], weight, 0.1 * weight);  // five cells across
  EXPECT_NEAR(load.force[0], 0.0, 0.01 * weight);
}

TEST(SolidBodies, BuoyancyOfATiltedBoxIsItsVolumesWeight) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.9})};
  options.solids = {body("box", polygon({{0.3, 0.3}, {0.6, 0.4}, {0.55, 0.55}, {0.25, 0.45}}))};
  FlowRun<2> run(flow_domain({40, 40, 1}, {1.0, 1.0, 1.0}, {0.0, -9.81, 0.0}), options);
  const double area = 0.3 * 0.15 + 0.1 * 0.05;
  const SolidLoad load = run.flow.solid_load(0, {});
  EXPECT_NEAR(load.force[2], 9810.0 * area, 0.01 * 9810.0 * area);
  EXPECT_NEAR(load.force[0], 0.0, 0.01 * 9810.0 * area);
  EXPECT_NEAR(load.moment[1], 0.0, 0.01 * 9810.0 * area * 0.3);  // about the middle
}

TEST(SolidBodies, PressureOnACaissonIsHydrostaticToRoundOff) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {0.6, 2.0, 0.537})};
  options.solids = {body("caisson", {BoxShape{{0.43, -9.0, -1.0}, {0.71, 9.0, 0.63}}})};
  FlowRun<2> run(flow_domain({32, 24, 1}, {1.0, 0.75, 1.0}, {0.0, -9.81, 0.0}), options);
  for (int step = 0; step < 20; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  const double force = 0.5 * 9810.0 * 0.537 * 0.537;
  EXPECT_NEAR(run.flow.solid_load(0, {}).force[0], force, 1e-9 * force);
  // The part below z = 0.25, eight cells high.
  const BoxShape part{{0.0, -9.0, -1.0}, {1.0, 9.0, 0.25}};
  const double low = 9810.0 * 0.25 * (0.537 - 0.125);
  EXPECT_NEAR(run.flow.solid_load(0, part).force[0], low, 1e-9 * low);
}

/// Parts whose edges lie anywhere between the faces of cells: each piece of a plane counts by what
/// lies in the part, so parts add up and none jumps as an edge passes the middle of a cell.
TEST(SolidBodies, PressureOnAPartOfACaissonIsThatOfItsShareOfEachCell) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {0.6, 2.0, 0.537})};
  options.solids = {body("caisson", {BoxShape{{0.43, -9.0, -1.0}, {0.71, 9.0, 0.63}}})};
  FlowRun<2> run(flow_domain({32, 24, 1}, {1.0, 0.75, 1.0}, {0.0, -9.81, 0.0}), options);
  for (int step = 0; step < 20; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  for (const double top : {0.2344, 0.25, 0.2587, 0.265625, 0.2657, 0.28, 0.51}) {
    const BoxShape part{{0.0, -9.0, -1.0}, {1.0, 9.0, top}};
    const double force = 9810.0 * top * (0.537 - 0.5 * top);
    EXPECT_NEAR(run.flow.solid_load(0, part).force[0], force, 1e-9 * force) << top;
  }
}

/// On a sloping wall a strip counts by its own length, in the plane and in space. What touches the
/// box counts up to 1e-9 of a cell beyond it, a share of 3e-9 of the narrow strip.
template <int D>
void check_strip_of_a_slope() {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.537})};
  const double slope = 0.6;  // the wall is x = 0.4 + slope z, the body lies behind it
  options.solids = {
      body("wall", polygon({{0.4 - slope, -1.0}, {0.4 + slope, 1.0}, {9.0, 1.0}, {9.0, -1.0}}))};
  FlowRun<D> run(
      flow_domain({32, D == 2 ? 24 : 9, D == 2 ? 1 : 24}, {1.0, D == 2 ? 0.75 : 0.28125, 0.75},
                  {0.0, D == 2 ? -9.81 : 0.0, D == 2 ? 0.0 : -9.81}),
      options);
  for (int step = 0; step < 5; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  const double width = D == 2 ? 1.0 : 0.041;
  for (const double low : {0.1, 0.1103, 0.1211}) {
    const double high = low + 0.137;
    const BoxShape part{{-9.0, D == 2 ? -9.0 : 0.02, low}, {9.0, D == 2 ? 9.0 : 0.061, high}};
    const double push = 9810.0 * width * (high - low) * (0.537 - 0.5 * (high + low));
    const Eigen::Vector3d force = run.flow.solid_load(0, part).force;
    EXPECT_NEAR(force[0], push, 1e-8 * push) << low;
    EXPECT_NEAR(force[2], -slope * push, 1e-8 * push) << low;
  }
}

TEST(SolidBodies, PressureOnAStripOfASlopeIsThatOfItsShareOfEachCell) {
  check_strip_of_a_slope<2>();
  check_strip_of_a_slope<3>();
}

TEST(SolidBodies, WaterSlipsAlongAnInclinedChannelWithoutLoss) {
  // A full channel between two parallel walls at an angle, without gravity and viscosity, open at
  // both ends: water keeps its speed until it leaves.
  const double slope = 0.4, speed = 1.0;
  FlowOptions options;
  options.viscosity = 0.0;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {3.0, 2.0, 3.0})};
  const double along = speed / std::hypot(1.0, slope);
  options.bodies[0].velocity = {Varying(along), Varying(0.0), Varying(slope * along)};
  options.solids = {
      body("low", {BelowShape{{{-4.0, 0.2 - 4.0 * slope}, {6.0, 0.2 + 6.0 * slope}}}}),
      body(
          "high",
          polygon({{-4.0, 0.6 - 4.0 * slope}, {6.0, 0.6 + 6.0 * slope}, {6.0, 9.0}, {-4.0, 9.0}}))};
  FlowRun<2> run(flow_domain({40, 48, 1}, {1.0, 1.2, 1.0}, {0.0, 0.0, 0.0}, Wall::open), options);
  EXPECT_NEAR(run.flow.ledger().initial, 0.4, 1e-9);  // the gap, not the box
  const auto energy = [&] { return run.flow.kinetic_energy() / run.flow.ledger().present; };
  const double start = energy();
  for (int step = 0; step < 40; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_NEAR(energy(), start, 0.02 * start);
  const Vec<2> v = run.flow.velocity_at(Vec<2>{{0.5, 0.6}});
  EXPECT_NEAR(v[0], along, 0.02);
  EXPECT_NEAR(v[1], slope * along, 0.02);
}

/// Linear theory of the piston: height over stroke is 2 (cosh 2kh - 1) / (sinh 2kh + 2kh) (Dean &
/// Dalrymple 1991, eq. 6.25).
TEST(SolidBodies, APaddleMakesWavesOfTheHeightOfTheoryAndKeepsTheVolume) {
  const double depth = 0.5, period = 1.5, stroke = 0.04, pi = std::acos(-1.0);
  const double rate = 2.0 * pi / period;
  double k = rate * rate / 9.81;
  for (int i = 0; i < 200; ++i) k = rate * rate / 9.81 / std::tanh(k * depth);
  const double kd = 2.0 * k * depth;
  const double height = stroke * 2.0 * (std::cosh(kd) - 1.0) / (std::sinh(kd) + kd);
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {20.0, 2.0, depth})};
  PrescribedSolid motion;
  motion.by_displacement = true;
  motion.translation[0] = Varying(
      [=](const Point3&, double t) {
        return 0.5 * stroke * (1.0 - std::exp(-0.5 * t * t)) * std::sin(rate * t);
      },
      "paddle");
  FlowSolid paddle = body("paddle", {BoxShape{{-1.0, -9.0, -1.0}, {0.4, 9.0, 0.8}}});
  paddle.motion = motion;
  options.solids = {paddle};
  FlowRun<2> run(flow_domain({120, 26, 1}, {9.0, 0.65, 1.0}, {0.0, -9.81, 0.0}), options);
  double low = 1.0, high = 0.0;
  while (run.time < 6.0) {  // the wave has not come back from the far end then
    run.step(std::min(0.02, run.flow.stable_step(run.medium)));
    if (run.time < 4.0) continue;
    const double level = run.flow.surface_height(Vec<2>{{3.5, 0.0}});
    low = std::min(low, level), high = std::max(high, level);
  }
  EXPECT_NEAR(high - low, height, 0.1 * height);
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
}

/// A column falls against a round post: no water is lost, and ranks agree.
TEST(SolidBodies, ADamBreakAgainstAPostKeepsItsVolume) {
  FlowOptions options = column_and_mound<2>();
  options.porous.clear();
  options.solids = {
      body("post", {SphereShape{{0.35, 0.0, 0.06}, 0.05, true}}),
      body("ramp", polygon({{0.42, -0.1}, {0.61, -0.1}, {0.61, 0.1}, {0.42, -0.01}}))};
  FlowRun<2> run(tank<2>(8), options), alone(tank<2>(8), options, MPI_COMM_SELF);
  while (run.time < 0.25) {
    const double dt = std::min(run.flow.stable_step(run.medium), 0.25 - run.time + 1e-12);
    run.step(dt);
    alone.step(dt);
  }
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
  const Eigen::Vector3d one = run.flow.solid_load(0, {}).force,
                        other = alone.flow.solid_load(0, {}).force;
  EXPECT_NEAR(one[0], other[0], 1e-8 * (1.0 + std::abs(other[0])));
  EXPECT_NEAR(run.flow.kinetic_energy(), alone.flow.kinetic_energy(),
              1e-8 * alone.flow.kinetic_energy());
}

/// A wedge whose sides rise by 30 degrees enters with 4 m/s: F = 14.139 rho V^3 t (Zhao & Faltinsen
/// 1993, table 1). Steps in which a cell near the surface closes are above that.
TEST(SolidBodies, AWedgeEntersWater) {
  const double speed = 4.0, exact = 14.139;
  PrescribedSolid motion;
  motion.translation[2] = Varying(-speed);
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {9.0, 9.0, 1.0})};
  const Shape wedge{PolygonShape{{{1.307, 1.42}, {2.0, 1.02}, {2.693, 1.42}}}};
  options.solids = {{"wedge", wedge, {}, motion, false, 0.0}};
  FlowRun<2> run(flow_domain({100, 50, 1}, {4.0, 2.0, 1.0}, {0.0, -9.81, 0.0}), options);
  std::vector<double> shares;
  while (run.time < 0.05) {
    run.step(run.flow.stable_step(run.medium));
    const double since = run.time - 0.005;
    if (since > 0.01)
      shares.push_back(run.flow.solid_load(0, {}).force[2] / (1000.0 * std::pow(speed, 3) * since));
  }
  std::sort(shares.begin(), shares.end());
  double mean = 0.0;
  for (const double share : shares) mean += share / static_cast<double>(shares.size());
  EXPECT_NEAR(shares[shares.size() / 2], exact, 0.1 * exact);
  EXPECT_NEAR(mean, exact, 0.15 * exact);
  EXPECT_GT(shares.front(), 0.3 * exact);
  EXPECT_LT(shares.back(), 4.0 * exact);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/errors.hpp"
#include "flow/wave_theory.hpp"
#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

/// A channel of 4 m with 0.2 m of water.
DomainOptions channel(int cells, Wall lower, Wall upper) {
  DomainOptions domain = flow_domain({cells, 16, 1}, {4.0, 0.4, 1.0}, {0.0, -9.81, 0.0});
  domain.walls[0] = {lower, upper};
  domain.walls[1][1] = Wall::open;
  return domain;
}

FlowOptions water(double speed = 0.0) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {99.0, 99.0, 0.2})};
  options.bodies[0].velocity[0] = Varying(speed);
  return options;
}

FlowSideOptions opening(int side, SideFlow flow, const Varying& value) {
  FlowSideOptions options;
  options.name = side == 0 ? "left" : "right";
  options.side = side;
  options.flow = flow;
  if (flow == SideFlow::level)
    options.level = value;
  else
    options.value = value;
  return options;
}

/// Still water outside, or a wave that comes in.
FlowSideOptions wave_side(int side, const WaveKind& wave, double current = 0.0) {
  FlowSideOptions options = opening(side, SideFlow::wave, Varying(0.0));
  options.wave.wave = wave;
  options.wave.outer = side == 0 ? 0.0 : 4.0;
  options.wave.inner = side == 0 ? 4.0 : 0.0;
  options.wave.still_level = options.wave.depth = 0.2;
  options.wave.current = current;
  return options;
}

double fastest_change(FlowRun<2>& run, double speed) {
  double worst = 0.0;
  const auto& grid = run.grid;
  for_each(grid.owned_faces(0), [&](const Index<2>& face) {
    if (grid.face_centre(0, face)[1] < 0.19)
      worst = std::max(worst, std::abs(run.flow.velocity()[0][face] - speed));
  });
  return max_over_ranks(grid, worst);
}

// Through a part of the side that is wet all the time, with a hydrograph.
TEST(FlowSides, ADischargeBringsJustItsVolume) {
  FlowOptions options = water();
  const auto hydrograph = [](double t) { return 0.02 * (1.0 + std::sin(3.0 * t)); };
  options.sides = {
      opening(0, SideFlow::discharge,
              Varying([=](const Point3&, double t) { return hydrograph(t); }, "hydrograph"))};
  options.sides[0].to[2] = 0.1;
  FlowRun<2> run(channel(40, Wall::slip, Wall::slip), options);
  double brought = 0.0;
  for (int step = 0; step < 150; ++step) {
    const double dt = std::min(0.01, run.flow.stable_step(run.medium));
    brought += dt * hydrograph(run.time);  // the flux of a step is that of its start
    run.step(dt);
  }
  const WaterLedger ledger = run.flow.ledger();
  EXPECT_GT(brought, 0.015);
  EXPECT_NEAR(-ledger.outflow, brought, 1e-12);
  EXPECT_NEAR(ledger.present, ledger.initial + brought, 1e-12);
}

TEST(FlowSides, AGivenVelocityBringsItsVolumeThroughItsPart) {
  FlowOptions options = water();
  options.sides = {opening(0, SideFlow::velocity, Varying(0.2))};
  options.sides[0].to[2] = 0.1;
  FlowRun<2> run(channel(40, Wall::slip, Wall::slip), options);
  for (int step = 0; step < 50; ++step) run.step(0.01);
  const WaterLedger ledger = run.flow.ledger();
  EXPECT_NEAR(-ledger.outflow, 0.2 * 0.1 * 0.5, 1e-12);
  EXPECT_NEAR(ledger.present, ledger.initial - ledger.outflow, 1e-12);
}

// A body that moves makes the solver look at all velocities anew before the water is carried.
TEST(FlowSides, BringWaterBesideABodyThatMoves) {
  PrescribedSolid motion;
  motion.translation[0] = Varying(0.05);
  const Shape stirrer{BoxShape{{2.0, -9.0, 0.05}, {2.5, 9.0, 0.15}}};
  FlowOptions options = water();
  options.solids = {{"stirrer", stirrer, {}, motion, false, 0.0}};
  options.sides = {opening(0, SideFlow::velocity, Varying(0.2))};
  options.sides[0].to[2] = 0.1;
  FlowRun<2> run(channel(40, Wall::slip, Wall::slip), options);
  for (int step = 0; step < 50; ++step) run.step(0.01);
  const WaterLedger ledger = run.flow.ledger();
  EXPECT_NEAR(-ledger.outflow, 0.2 * 0.1 * 0.5, 1e-12);
  EXPECT_NEAR(ledger.present, ledger.initial - ledger.outflow, 1e-12);
}

TEST(FlowSides, ALevelOutsideHoldsStillWaterAndFillsALowerPool) {
  FlowOptions options = water();
  options.sides = {opening(1, SideFlow::level, Varying(0.2))};
  FlowRun<2> still(channel(40, Wall::slip, Wall::open), options);
  for (int step = 0; step < 30; ++step) still.step(0.01);
  EXPECT_LT(still.flow.max_speed().speed, 1e-10);

  options.sides[0].level = Varying(0.25);
  FlowRun<2> filling(channel(40, Wall::slip, Wall::open), options);
  // Nothing damps the swing of the pool, whose longest period is 4 L/c: the mean counts.
  const double swing = 16.0 / std::sqrt(9.81 * 0.225);
  double mean = 0.0, from = 0.0;
  while (filling.time < 3.0 * swing) {
    const double dt = std::min(0.02, filling.flow.stable_step(filling.medium));
    filling.step(dt);
    if (filling.time < swing) continue;
    if (from == 0.0) from = filling.time - dt;
    mean += dt * filling.flow.ledger().present / 4.0;
  }
  mean /= filling.time - from;
  std::printf("pool: %.5f m in the mean (outside 0.25 m)\n", mean);
  const WaterLedger ledger = filling.flow.ledger();
  EXPECT_NEAR(mean, 0.25, 0.005);
  EXPECT_NEAR(ledger.present, ledger.initial - ledger.outflow, 1e-12);
}

TEST(FlowSides, AUniformCurrentPassesUnchanged) {
  FlowOptions options = water(0.3);
  options.viscosity = 0.0;
  options.sides = {wave_side(0, StillWater{}, 0.3), wave_side(1, StillWater{}, 0.3)};
  FlowRun<2> run(channel(40, Wall::slip, Wall::slip), options);
  for (int step = 0; step < 100; ++step) run.step(0.01);
  EXPECT_LT(fastest_change(run, 0.3), 1e-9);
  const WaterLedger ledger = run.flow.ledger();
  EXPECT_NEAR(ledger.present, ledger.initial, 1e-10);
}

// A long wave comes in on the left and leaves on the right: what stays is reflection.
TEST(FlowSides, ALongWaveComesInAndLeaves) {
  GivenWave hump;
  hump.level = Varying(
      [](const Point3&, double t) {
        return t < 2.0 ? 0.005 * (1.0 - std::cos(3.14159265358979 * t)) : 0.0;
      },
      "hump");
  FlowOptions options = water();
  options.sides = {wave_side(0, hump), wave_side(1, StillWater{})};
  FlowRun<2> run(channel(80, Wall::slip, Wall::slip), options);
  double highest = 0.0, left = 0.0;
  while (run.time < 8.0) {
    run.step(std::min(0.01, run.flow.stable_step(run.medium)));
    const double level = run.flow.surface_height(Vec<2>{{2.0, 0.0}}) - 0.2;
    if (run.time < 4.2) highest = std::max(highest, level);
    if (run.time > 4.7) left = std::max(left, std::abs(level));  // 2 m there, 4 m back
  }
  std::printf("long wave of 0.0100 m: %.4f m in the middle, %.1f %% come back\n", highest,
              100.0 * left / highest);
  EXPECT_NEAR(highest, 0.01, 5e-4);
  EXPECT_LT(left, 0.04 * highest);
  const WaterLedger ledger = run.flow.ledger();
  EXPECT_NEAR(ledger.present, ledger.initial - ledger.outflow, 1e-12);
}

// Into a pool that lies lower water comes in above its surface and falls along the side, from rest:
// never faster than from the level outside to the floor.
TEST(FlowSides, WhatFallsInFallsFreely) {
  FlowOptions options = water();
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {99.0, 99.0, 0.12})};
  options.sides = {wave_side(0, StillWater{})};
  DomainOptions domain = flow_domain({80, 32, 1}, {1.0, 0.4, 1.0}, {0.0, -9.81, 0.0});
  domain.walls[0] = {Wall::slip, Wall::slip};
  domain.walls[1][1] = Wall::open;
  FlowRun<2> run(domain, options);
  double fastest = 0.0;
  while (run.time < 1.5) {
    run.step(std::min(0.005, run.flow.stable_step(run.medium)));
    fastest = std::max(fastest, run.flow.max_speed().speed);
  }
  std::printf("fastest water beside the side: %.3f m/s\n", fastest);
  EXPECT_LT(fastest, std::sqrt(2.0 * 9.81 * 0.2));
  EXPECT_GT(run.flow.ledger().present, 0.15);
}

// Water that starts 3 cm out of level before a lake swings, and loses what it brings to the lake:
// what comes back in has no more energy than the lake's level.
TEST(FlowSides, WaterBeforeALakeSwingsLessAndLess) {
  FlowOptions options = water();
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {99.0, 99.0, 0.97})};
  options.sides = {opening(0, SideFlow::level, Varying(1.0))};
  DomainOptions domain = flow_domain({9, 50, 1}, {0.2, 1.1, 1.0}, {0.0, -9.81, 0.0});
  domain.walls[0] = {Wall::open, Wall::slip};
  domain.walls[1][1] = Wall::open;
  FlowRun<2> run(domain, options);
  double late = 0.0;
  while (run.time < 8.0) {
    run.step(std::min(0.01, run.flow.stable_step(run.medium)));
    if (run.time > 6.0)
      late = std::max(late, std::abs(run.flow.surface_height(Vec<2>{{0.18, 0.0}}) - 1.0));
  }
  std::printf("swings by 3 cm at first, by %.1f cm after 6 s\n", 100.0 * late);
  EXPECT_LT(late, 0.03);
}

TEST(FlowSides, ADischargeWithoutWaterIsAnError) {
  FlowOptions options = water();
  options.sides = {opening(0, SideFlow::discharge, Varying(0.01))};
  options.sides[0].from[2] = 0.3;
  EXPECT_THROW(FlowRun<2>(channel(40, Wall::slip, Wall::slip), options), DivergenceError);
}

}  // namespace
}  // namespace mudlark

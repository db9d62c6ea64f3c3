// ranks: 1 3
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

/// A flume of 16 m with 0.5 m of water, a maker over the first `zone` metres, a beach over the last
/// four.
template <int D>
struct Flume {
  static DomainOptions domain() {
    DomainOptions domain = D == 2 ? flow_domain({160, 32, 1}, {16.0, 0.64, 1.0}, {0.0, -9.81, 0.0})
                                  : flow_domain({160, 4, 32}, {16.0, 0.4, 0.64}, {0.0, 0.0, -9.81});
    domain.walls[D - 1][1] = Wall::open;
    return domain;
  }
  static FlowOptions options(const WaveKind& wave, double zone) {
    FlowOptions options;
    options.bodies = {water_box({-1.0, -1.0, -1.0}, {99.0, 99.0, 0.5})};
    options.waves = {{"maker", wave, 0, 0.0, zone, 0.5, 0.5, 0.0},
                     {"beach", StillWater{}, 0, 16.0, 12.0, 0.5, 0.5, 0.0}};
    return options;
  }
};

double level_at(FlowRun<2>& run, double x) {
  return run.flow.surface_height(Vec<2>{{x, 0.0}}) - 0.5;
}

// The crest starts 6 m before the flume and passes x = 9 m after 15 m of its way.
TEST(Waves, ASolitaryWaveKeepsItsHeightAndSpeed) {
  const SolitaryWave wave{0.05, -6.0};
  const double speed = make_wave(wave, {.depth = 0.5})->celerity();
  FlowRun<2> run(Flume<2>::domain(), Flume<2>::options(wave, 4.0));
  double highest = 0.0, when = 0.0, before = 0.0, last = 0.0;
  const double dt = 0.01;
  while (run.time < 15.0 / speed + 0.5) {
    run.step(std::min(dt, run.flow.stable_step(run.medium)));
    const double level = level_at(run, 9.05);
    if (last > highest) {  // parabola through three levels around the highest
      const double curvature = level - 2.0 * last + before;
      highest = last;
      when = run.time - dt * (1.0 + (level - before) / (2.0 * curvature));
    }
    before = last;
    last = level;
  }
  std::printf("solitary wave: crest %.4f m after %.3f s; exact 0.05 m after %.3f s\n", highest,
              when, 15.05 / speed);
  EXPECT_NEAR(highest, 0.05, 0.03 * 0.05);
  EXPECT_NEAR(when, 15.05 / speed, 0.01 * 15.05 / speed);
  const WaterLedger water = run.flow.ledger();
  EXPECT_LT(water.outflow, 0.0);  // the maker brought water in
  EXPECT_NEAR(water.present, water.initial - water.outflow, 1e-12 * water.initial);
}

// The crest starts 6 m before the flume, so all of the wave comes in: one that starts half in the
// maker is followed by short waves of up to 5 %, which are none of the beach's.
TEST(Waves, TheBeachTakesASolitaryWaveAway) {
  const SolitaryWave wave{0.05, -6.0};
  FlowRun<2> run(Flume<2>::domain(), Flume<2>::options(wave, 4.0));
  const double speed = make_wave(wave, {.depth = 0.5})->celerity();
  while (run.time < 28.0 / speed) run.step(std::min(0.01, run.flow.stable_step(run.medium)));
  double largest = 0.0, where = 0.0;  // the wave would be on its way back, between 10 and 6 m
  for (double x = 4.05; x < 12.0; x += 0.1)
    if (std::abs(level_at(run, x)) > largest) largest = std::abs(level_at(run, x)), where = x;
  std::printf("reflected: %.2f %% of the wave, at %.2f m\n", 100.0 * largest / 0.05, where);
  EXPECT_LT(largest, 0.05 * 0.05);
}

// Steps as long as these show whether water and velocity in the zone belong to the same time: half
// a step is 1.8 degrees.
TEST(Waves, AZoneMakesAWaveWithItsPhaseAlsoWithLongSteps) {
  const double period = 2.0, dt = period / 100.0;
  const RegularWave wave{0.04, period};
  DomainOptions domain = flow_domain({120, 28, 1}, {12.0, 0.56, 1.0}, {0.0, -9.81, 0.0});
  domain.walls[1][1] = Wall::open;
  FlowOptions options = Flume<2>::options(wave, 4.0);
  options.waves[1].outer = 12.0, options.waves[1].inner = 8.0;
  FlowRun<2> run(domain, options);
  const double k = 2.0 * std::numbers::pi / make_wave(wave, {.depth = 0.5})->length();
  const std::array<double, 3> places{4.55, 5.05, 6.05};
  std::array<std::complex<double>, 3> amplitudes{};
  for (int step = 0; step < 500; ++step) {
    run.step(dt);
    if (step < 400) continue;
    for (std::size_t g = 0; g < 3; ++g)
      amplitudes[g] +=
          0.02 * std::polar(1.0, std::numbers::pi * run.time) * level_at(run, places[g]);
  }
  // Least squares of forth exp(ikx) + back exp(-ikx).
  std::complex<double> cross = 0.0, first = 0.0, second = 0.0;
  for (std::size_t g = 0; g < 3; ++g) {
    const auto forth = std::polar(1.0, k * places[g]);
    cross += std::conj(forth) * std::conj(forth);
    first += std::conj(forth) * amplitudes[g];
    second += forth * amplitudes[g];
  }
  const auto forth = (3.0 * first - cross * second) / (9.0 - std::norm(cross));
  const double late = std::arg(forth) * 180.0 / std::numbers::pi;
  std::printf("zone: first harmonic %.5f m, %+.2f degrees late\n", std::abs(forth), late);
  EXPECT_NEAR(late, 0.0, 0.6);
}

// Not to the last digit: the sweeps of the interface go through three axes in turn, not two.
TEST(Waves, InThreeDimensionsAreThoseOfThePlane) {
  const RegularWave wave{0.04, 1.5};
  FlowRun<2> plane(Flume<2>::domain(), Flume<2>::options(wave, 4.0));
  FlowRun<3> space(Flume<3>::domain(), Flume<3>::options(wave, 4.0));
  for (int step = 0; step < 40; ++step) {
    plane.step(0.005);
    space.step(0.005);
  }
  for (const double x : {0.55, 1.55, 3.05})
    EXPECT_NEAR(space.flow.surface_height(Vec<3>{{x, 0.25, 0.0}}),
                plane.flow.surface_height(Vec<2>{{x, 0.0}}), 1e-6);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
/// Waves made by a source in the water.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

constexpr double period = 2.0, height = 0.03, depth = 0.5, steps_per_period = 160.0;

/// 18 m of water 0.5 m deep with a source at 8 m, and still water at both ends that absorbs waves:
/// a short zone would send back some of them, and they would add to the others. 41 cells over a
/// wave.
FlowOptions flume() {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {99.0, 99.0, depth})};
  options.waves = {{"left", StillWater{}, 0, 0.0, 6.0, depth, depth, 0.0},
                   {"right", StillWater{}, 0, 18.0, 12.5, depth, depth, 0.0}};
  WaveSourceOptions source;
  source.wave = {
      "source", RegularWave{height, period, RegularTheory::linear}, 0, 8.0, 18.0, depth, depth,
      period};
  source.box = {{7.8, -99.0, 0.16}, {8.2, 99.0, 0.34}};
  options.wave_sources = {source};
  return options;
}

DomainOptions box() {
  DomainOptions domain = flow_domain({180, 32, 1}, {18.0, 0.64, 1.0}, {0.0, -9.81, 0.0});
  domain.walls[1][1] = Wall::open;
  return domain;
}

// Lin & Liu (1999): the wave that leaves the source has the height that was asked for, within 2 %.
TEST(WaveMakers, ASourceMakesWavesOfTheHeightAskedForAndKeepsTheLedger) {
  FlowRun<2> run(box(), flume());
  const double k = wave_number(period, depth, 9.81), rate = 2.0 * std::numbers::pi / period;
  const std::array<double, 3> places{10.05, 10.95, 11.95};
  std::array<std::complex<double>, 3> amplitudes{};
  const double dt = period / steps_per_period;
  for (int step = 0; step < 6 * 160; ++step) {
    run.step(dt);
    if (step < 5 * 160) continue;
    for (std::size_t g = 0; g < 3; ++g)
      amplitudes[g] += 2.0 / steps_per_period * std::polar(1.0, rate * run.time) *
                       (run.flow.surface_height(Vec<2>{{places[g], 0.0}}) - depth);
  }
  // Least squares of forth exp(ikx) + back exp(-ikx), x from the middle of the source on.
  std::complex<double> cross = 0.0, first = 0.0, second = 0.0;
  for (std::size_t g = 0; g < 3; ++g) {
    const auto forth = std::polar(1.0, k * (places[g] - 8.0));
    cross += std::conj(forth) * std::conj(forth);
    first += std::conj(forth) * amplitudes[g];
    second += forth * amplitudes[g];
  }
  const auto wave = (3.0 * first - cross * second) / (9.0 - std::norm(cross));
  const auto back = (second - std::conj(cross) * wave) / 3.0;
  const double angle = std::arg(wave) * 180.0 / std::numbers::pi;
  std::printf("source: height %.5f m (asked for: %.3f m), %.1f degrees, %.1f %% come back\n",
              2.0 * std::abs(wave), height, angle, 100.0 * std::abs(back) / std::abs(wave));
  EXPECT_NEAR(2.0 * std::abs(wave), height, 0.02 * height);
  EXPECT_NEAR(angle, 0.0, 10.0);
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial - water.outflow, 1e-12 * water.initial);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 2
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "flow/wave_theory.hpp"
#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

constexpr double pi = std::numbers::pi;

// Half a wave in a box of 1 m, 0.5 m deep, 40 cells long: w^2 = g k tanh(k d).
TEST(StandingWave, HasThePeriodOfTheoryAndKeepsItsHeight) {
  DomainOptions domain = flow_domain({40, 28, 1}, {1.0, 0.7, 1.0}, {0.0, -9.81, 0.0});
  domain.walls[1][1] = Wall::open;
  FlowOptions options;
  BelowShape ground;
  for (int i = 0; i <= 200; ++i)
    ground.line.push_back({i / 200.0, 0.5 + 0.01 * std::cos(pi * i / 200.0)});
  options.bodies.resize(1);
  options.bodies[0].shape.form = ground;
  FlowRun<2> run(domain, options);
  const double exact = 2.0 * pi / std::sqrt(9.81 * pi * std::tanh(0.5 * pi));
  // First cosine of the surface: its zeros give the period, its turning points the height.
  double before = 0.01, first = -1.0, last = -1.0, top = 0.0, late_top = 0.0;
  int zeros = 0;
  while (run.time < 6.3 * exact) {
    const double dt = std::min(0.02, run.flow.stable_step(run.medium));
    run.step(dt);
    double cosine = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double x = (i + 0.5) / 40.0;
      cosine += 2.0 / 40.0 * (run.flow.surface_height(Vec<2>{{x, 0.0}}) - 0.5) * std::cos(pi * x);
    }
    if (before < 0.0 && cosine >= 0.0) {
      last = run.time - dt * cosine / (cosine - before);
      if (zeros == 0) first = last;
      ++zeros;
    }
    if (run.time > 0.8 * exact && run.time < 1.3 * exact) top = std::max(top, cosine);
    if (run.time > 5.8 * exact) late_top = std::max(late_top, cosine);
    before = cosine;
  }
  const double period = (last - first) / (zeros - 1), loss = 1.0 - std::pow(late_top / top, 0.2);
  std::printf("standing wave: period %+.3f %%, height lost per period %+.3f %%\n",
              100.0 * (period / exact - 1.0), 100.0 * loss);
  EXPECT_EQ(zeros, 6);
  EXPECT_NEAR(period, exact, 0.002 * exact);
  EXPECT_LT(std::abs(loss), 0.005);
}

/// A steady wave of the stream function in a periodic box of its own length.
TEST(SteadyWaveInABox, TravelsWithoutDrivingACurrent) {
  const double height = 0.1, period = 2.0, depth = 0.5;
  const std::shared_ptr<const WaveMotion> wave =
      make_wave(RegularWave{height, period}, {.depth = depth});
  DomainOptions domain =
      flow_domain({40, 51, 1}, {wave->length(), 51 * 0.0125, 1.0}, {0.0, -9.81, 0.0});
  domain.walls[0] = {Wall::periodic, Wall::periodic};
  domain.walls[1][1] = Wall::open;
  BelowShape surface;
  for (int i = -4; i <= 804; ++i) {
    const double x = wave->length() * i / 800.0;
    surface.line.push_back({x, depth + wave->elevation({x, 0.0}, 0.0)});
  }
  FlowOptions options;
  options.bodies.resize(1);
  options.bodies[0].shape.form = surface;
  for (const std::size_t component : {0u, 2u})
    options.bodies[0].velocity[component] = Varying(
        [=](const Point3& p, double) {
          const WavePlace place{p[0], 0.0};
          return wave->velocity(place, std::min(p[2] - depth, wave->elevation(place, 0.0)),
                                0.0)[component];
        },
        "wave");
  FlowRun<2> run(domain, options);
  const auto momentum = [&] {
    double sum = 0.0;
    for_each(run.grid.owned_faces(0), [&](const Index<2>& face) {
      sum += 0.5 *
             (run.flow.water_fraction()[face] + run.flow.water_fraction()[face.shifted(0, -1)]) *
             run.flow.velocity()[0][face];
    });
    return sum_over_ranks(run.grid, sum);
  };
  const double start = momentum();
  while (run.time < 2.0 * period)
    run.step(std::min(2.0 * period - run.time + 1e-12, run.flow.stable_step(run.medium)));
  double sine = 0.0, cosine = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double phase = 2.0 * pi * (i + 0.5) / 40.0;
    const double level =
        run.flow.surface_height(Vec<2>{{wave->length() * (i + 0.5) / 40.0, 0.0}}) - depth;
    sine += level * std::sin(phase) / 20.0;
    cosine += level * std::cos(phase) / 20.0;
  }
  const double ahead = std::atan2(sine, cosine) * 180.0 / pi;
  std::printf(
      "steady wave after 2 periods: momentum %+.2f %%, phase %+.2f degrees, first harmonic "
      "%.5f m\n",
      100.0 * (momentum() / start - 1.0), ahead, std::hypot(sine, cosine));
  EXPECT_NEAR(momentum(), start, 0.03 * start);
  EXPECT_LT(std::abs(ahead), 1.0);
  EXPECT_NEAR(std::hypot(sine, cosine), 0.0485, 0.01 * 0.0485);  // of the exact wave
}

}  // namespace
}  // namespace mudlark

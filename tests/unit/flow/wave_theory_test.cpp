#include "flow/wave_theory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "flow/steady_wave.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81;

TEST(WaveTheory, WaveNumberSolvesTheDispersionRelation) {
  for (const double period : {0.5, 2.0, 8.0, 300.0})
    for (const double depth : {0.1, 1.0, 100.0}) {
      const double k = wave_number(period, depth, gravity), w = 2.0 * std::numbers::pi / period;
      EXPECT_NEAR(gravity * k * std::tanh(k * depth), w * w, 1e-12 * w * w);
    }
}

// Figures of an independent Fourier solution (SciPy least squares, 16 modes): H = 2 m, T = 8 s on
// 10 m; H = 0.1 m, T = 2 s on 0.5 m.
TEST(SteadyWave, AgreesWithAnIndependentSolution) {
  const SteadyWave high(2.0, 8.0, 10.0, gravity);
  EXPECT_NEAR(2.0 * std::numbers::pi / high.wave_number(), 71.9488896, 1e-5);
  EXPECT_NEAR(high.elevation(0.0), 1.15471124, 1e-6);
  EXPECT_NEAR(high.elevation(1.0), 0.44008137, 1e-6);
  EXPECT_NEAR(high.elevation(std::numbers::pi), -0.84528876, 1e-6);
  EXPECT_NEAR(high.velocity(0.0, 0.0)[0], 1.22747765, 1e-6);
  EXPECT_NEAR(high.velocity(1.0, -3.0)[0], 0.44595794, 1e-6);
  EXPECT_NEAR(high.velocity(1.0, -3.0)[1], 0.48746795, 1e-6);
  const SteadyWave flume(0.1, 2.0, 0.5, gravity);
  EXPECT_NEAR(2.0 * std::numbers::pi / flume.wave_number(), 4.11980998, 1e-6);
  EXPECT_NEAR(flume.elevation(0.0), 0.05896826, 1e-7);
}

TEST(SteadyWave, RefusesAWaveThatIsTooHigh) {
  EXPECT_THROW(SteadyWave(0.5, 2.0, 0.5, gravity), InputError);
}

/// Largest of |du/ds + dw/dz| and of |deta/dt + u deta/ds - w| over a wave, in m/s per m and m/s.
std::array<double, 2> misfits(const WaveMotion& wave, double depth, double from, double to) {
  std::array<double, 2> worst{};
  const double h = 1e-4;
  for (int i = 0; i <= 40; ++i) {
    const double s = from + (to - from) * i / 40.0, t = 0.3;
    const double z = -0.4 * depth;
    const double divergence =
        (wave.velocity(s + h, z, t)[0] - wave.velocity(s - h, z, t)[0]) / (2 * h) +
        (wave.velocity(s, z + h, t)[1] - wave.velocity(s, z - h, t)[1]) / (2 * h);
    const double level = wave.elevation(s, t);
    const auto v = wave.velocity(s, level, t);
    const double surface = (wave.elevation(s, t + h) - wave.elevation(s, t - h)) / (2 * h) +
                           v[0] * (wave.elevation(s + h, t) - wave.elevation(s - h, t)) / (2 * h) -
                           v[1];
    worst = {std::max(worst[0], std::abs(divergence)), std::max(worst[1], std::abs(surface))};
  }
  return worst;
}

TEST(WaveTheory, KeepsVolumeAndTheSurfaceIsMaterial) {
  const WaveMotion steady = make_wave(RegularWave{0.1, 2.0, true}, 0.5, gravity);
  const auto exact = misfits(steady, 0.5, 0.0, steady.length);
  EXPECT_LT(exact[0], 1e-6);
  EXPECT_LT(exact[1], 1e-6);
  const WaveMotion solitary = make_wave(SolitaryWave{0.05, 0.0}, 0.5, gravity);
  const auto third_order = misfits(solitary, 0.5, -3.0, 3.0);
  EXPECT_LT(third_order[0], 1e-3);
  EXPECT_LT(third_order[1], 1e-3);
  EXPECT_NEAR(solitary.elevation(0.0, 0.0), 0.05, 1e-15);
  // Grimshaw's speed for H/d = 0.3, d = 1 m: 3.5633556 m/s
  EXPECT_NEAR(make_wave(SolitaryWave{0.3, 0.0}, 1.0, gravity).celerity, 3.5633556, 1e-6);
}

TEST(WaveTheory, IrregularSeaHasItsSignificantHeightAndRepeatsWithItsSeed) {
  const IrregularSea sea{0.1, 1.5, 3.3, 300, 7};
  const WaveMotion one = make_wave(sea, 0.5, gravity), two = make_wave(sea, 0.5, gravity);
  double sum = 0.0;
  const int count = 30000;
  for (int i = 0; i < count; ++i) {
    const double level = one.elevation(0.0, 0.05 * i);
    sum += level * level;
    EXPECT_EQ(level, two.elevation(0.0, 0.05 * i));
  }
  EXPECT_NEAR(4.0 * std::sqrt(sum / count), 0.1, 0.004);
}

TEST(WaveTheory, AGivenLevelTravelsAsALongWave) {
  GivenWave wave;
  wave.level = Varying([](const Point3&, double t) { return 0.01 * std::sin(t); }, "sine");
  const WaveMotion motion = make_wave(wave, 0.4, gravity);
  const double speed = std::sqrt(gravity * 0.4);
  EXPECT_NEAR(motion.elevation(2.0, 5.0), 0.01 * std::sin(5.0 - 2.0 / speed), 1e-12);
  EXPECT_LT(misfits(motion, 0.4, 0.0, 0.5)[0], 1e-5);
}

}  // namespace
}  // namespace mudlark

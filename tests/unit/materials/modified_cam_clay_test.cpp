#include "materials/modified_cam_clay.hpp"

#include <gtest/gtest.h>

#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

constexpr double lambda = 0.2, kappa = 0.04, m = 1.1, start = 1e5, specific_volume = 1.0 / 0.6;

ModifiedCamClayOptions clay(double ratio = 1.0) {
  ModifiedCamClayOptions options;
  options.compression_index = lambda, options.swelling_index = kappa;
  options.critical_stress_ratio = m, options.poisson_ratio = 0.25;
  options.overconsolidation_ratio = ratio;
  return options;
}
SymTensor even(double pressure) { return -pressure * SymTensor::identity(); }
double pressure_of(const TestPoint& point) { return -mean_of(point.stress); }
/// Vertical less horizontal compression.
double shear_of(const TestPoint& point) { return point.stress.xx - point.stress.zz; }
double volume_of(const TestPoint& point) { return 1.0 + point.history[1]; }

TEST(ModifiedCamClay, KeepsToTheLinesOfVirginCompressionAndOfSwelling) {
  const ModifiedCamClay law(clay());
  TestPoint point(law, even(start));
  EXPECT_NEAR(volume_of(point), specific_volume, 1e-12);
  point.strain(-0.03 * SymTensor::identity(), 20);
  const double top = pressure_of(point), volume = volume_of(point);
  EXPECT_NEAR(volume, specific_volume * std::exp(-0.09), 1e-12);
  EXPECT_NEAR(top, start * std::exp((specific_volume - volume) / lambda), 1e-4 * top);
  point.strain(0.01 * SymTensor::identity(), 3);
  EXPECT_NEAR(pressure_of(point), top * std::exp((volume - volume_of(point)) / kappa), 1e-9 * top);
  point.strain(-0.01 * SymTensor::identity());
  EXPECT_NEAR(pressure_of(point), top, 1e-8 * top);
  point.strain(-0.01 * SymTensor::identity());
  EXPECT_NEAR(pressure_of(point), top * std::exp((volume - volume_of(point)) / lambda), 1e-4 * top);
}

/// p / p_0 = ((M^2 + eta_0^2) / (M^2 + eta^2))^(1 - kappa/lambda): Wood (1990), Soil behaviour and
/// critical state soil mechanics, section 5.4.
TEST(ModifiedCamClay, ShearsUndrainedAlongTheClosedPathFromEvenAndUnevenStress) {
  for (const double eta0 : {0.0, 0.6}) {
    const ModifiedCamClay law(clay());
    TestPoint point(law,
                    even(start) + (eta0 * start) * SymTensor{1. / 3, 1. / 3, -2. / 3, 0, 0, 0});
    for (int i = 0; i < 40; ++i) {
      point.strain({0.0025, 0.0025, -0.005, 0, 0, 0});
      const double eta = shear_of(point) / pressure_of(point);
      const double expected =
          start * std::pow((m * m + eta0 * eta0) / (m * m + eta * eta), 1.0 - kappa / lambda);
      EXPECT_NEAR(pressure_of(point), expected, 1e-4 * start);
    }
    EXPECT_NEAR(shear_of(point) / pressure_of(point), m, 0.01 * m);
  }
}

/// Undrained strength of overconsolidated clay: p_f / p_0 = (R / 2)^(1 - kappa/lambda), Wood
/// (1990).
TEST(ModifiedCamClay, FailsUndrainedAtTheStrengthThatOverconsolidationGives) {
  for (const double ratio : {1.0, 1.5, 2.0, 4.0, 10.0}) {
    const ModifiedCamClay law(clay(ratio));
    for (const double sign : {1.0, -1.0}) {
      TestPoint point(law, even(start));
      point.strain(sign * SymTensor{0.3, 0.3, -0.6, 0, 0, 0}, 100);
      const double expected = start * std::pow(0.5 * ratio, 1.0 - kappa / lambda);
      EXPECT_NEAR(pressure_of(point), expected, 2e-3 * expected) << ratio;
      EXPECT_NEAR(sign * shear_of(point), m * expected, 2e-3 * m * expected) << ratio;
    }
  }
}

TEST(ModifiedCamClay, ShearsDrainedAcrossItsStateSurfaceToTheCriticalState) {
  const ModifiedCamClay law(clay());
  TestPoint point(law, even(start));
  for (int i = 0; i < 300; ++i) {
    point.triaxial(-0.004);
    const double pressure = pressure_of(point), eta = shear_of(point) / pressure;
    ASSERT_NEAR(shear_of(point), 3.0 * (pressure - start), 1e-4 * start);
    const double volume = specific_volume - lambda * std::log(pressure / start) -
                          (lambda - kappa) * std::log(1.0 + eta * eta / (m * m));
    ASSERT_NEAR(volume_of(point), volume, 1e-4);
  }
  const double last = 3.0 * start / (3.0 - m);
  EXPECT_NEAR(pressure_of(point), last, 2e-3 * last);
  const double critical =
      specific_volume - lambda * std::log(last / start) - (lambda - kappa) * std::log(2.0);
  EXPECT_NEAR(volume_of(point), critical, 1e-3);
}

TEST(ModifiedCamClay, GivesNearlyTheSameInOneLargeStepAndInManySmallOnes) {
  const ModifiedCamClay law(clay(1.3));
  const SymTensor strain{0.02, -0.01, -0.05, 0.01, -0.02, 0.03};
  TestPoint once(law, {-1e5, -9e4, -1.2e5, 1e4, 0, -5e3}), often = once;
  once.strain(strain);
  often.strain(strain, 2000);
  EXPECT_LT(largest_difference(once.stress, often.stress), 2e-4 * pressure_of(often));
  EXPECT_NEAR(once.history[0], often.history[0], 2e-4 * often.history[0]);
  EXPECT_NEAR(law.yield_function(-1.0 * once.stress, once.history[0]), 0.0,
              1e-8 * once.history[0] * once.history[0]);
}

TEST(ModifiedCamClay, PulledApartCarriesNothingUntilItsGapHasClosed) {
  const ModifiedCamClay law(clay(2.0));
  TestPoint point(law, even(2e3));
  const double before = volume_of(point);
  point.strain({0.1, 0.1, 0.1, 0, 0, 0.05}, 50);
  EXPECT_EQ(point.stress, SymTensor{});
  const double gap = point.history[2];
  EXPECT_GT(gap, 0.09);
  EXPECT_NEAR(volume_of(point), before * std::exp(0.3), 1e-9);
  point.strain((-0.99 / 3.0 * gap) * SymTensor::identity(), 10);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain(-0.03 * SymTensor::identity(), 10);
  EXPECT_EQ(point.history[2], 0.0);
  EXPECT_GT(pressure_of(point), 500.0);
}

TEST(ModifiedCamClay, IsAsStiffAgainstWavesAsAgainstASmallUnloading) {
  const ModifiedCamClay law(clay());
  TestPoint point(law, {-8e4, -8e4, -1.4e5, 0, 0, 0});
  const double modulus = law.wave_modulus({&point.stress, 1}, point.history);
  const double before = point.stress.zz, strain = 1e-7;
  point.strain({0, 0, strain, 0, 0, 0});
  EXPECT_NEAR((point.stress.zz - before) / strain, modulus, 1e-4 * modulus);
}

TEST(ModifiedCamClay, NamesThePointThatItCannotIntegrate) {
  const ModifiedCamClay law(clay());
  std::array<SymTensor, 2> stress{even(start), even(start)};
  const std::array<SymTensor, 2> strain{SymTensor{-1e-3, 0, 0, 0, 0, 0},
                                        SymTensor{std::nan(""), 0, 0, 0, 0, 0}};
  std::array<double, 6> history{start, 1.0, 0.0, start, 1.0, 0.0};
  std::array<unsigned char, 2> failed{};
  MaterialPoints points{strain, stress, history};
  points.failed = failed;
  EXPECT_EQ(law.update_stress(points), 1u);
  EXPECT_EQ(failed[0], 0);
  EXPECT_EQ(failed[1], 1);
}

}  // namespace
}  // namespace mudlark

#include "materials/sekiguchi_ohta.hpp"

#include <gtest/gtest.h>

#include <random>

#include "materials/tensor_algebra.hpp"
#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

constexpr double lambda = 0.2, kappa = 0.04, m = 1.1, specific_volume = 1.0 / 0.6;
constexpr double irreversible = 1.0 - kappa / lambda;
constexpr double k0 = 0.55, start = 1e5;  // start: mean effective stress
constexpr double rounding = 0.005;        // a of the rounded tip
constexpr double eta0 = 3.0 * (1.0 - k0) / (1.0 + 2.0 * k0);

SekiguchiOhtaOptions clay(double ratio = 1.0) {
  SekiguchiOhtaOptions options;
  options.compression_index = lambda, options.swelling_index = kappa;
  options.critical_stress_ratio = m, options.poisson_ratio = 0.3;
  options.overconsolidation_ratio = ratio;
  return options;
}
SymTensor even(double pressure) { return -pressure * SymTensor::identity(); }
/// Consolidated under K0 with the vertical along z.
SymTensor at_rest(double pressure) {
  const double vertical = 3.0 * pressure / (1.0 + 2.0 * k0);
  return {-k0 * vertical, -k0 * vertical, -vertical, 0, 0, 0};
}
double pressure_of(const TestPoint& point) { return -mean_of(point.stress); }
/// Vertical less horizontal compression.
double shear_of(const TestPoint& point) { return point.stress.xx - point.stress.zz; }
double volume_of(const TestPoint& point) { return 1.0 + point.history[7]; }
double size_of(const TestPoint& point) { return point.history[6]; }
SymTensor axis_of(const TestPoint& point) {
  const auto& h = point.history;
  return {h[0], h[1], h[2], h[3], h[4], h[5]};
}
double eta_star(const TestPoint& point) {
  const SymTensor ratio = (-1.0 / pressure_of(point)) * deviator_of(point.stress);
  return std::sqrt(1.5 * difference(ratio, axis_of(point)).squared_norm());
}

/// eta* as the rounded surface counts it.
double rounded(double eta_star) { return std::hypot(eta_star, rounding) - rounding; }

TEST(SekiguchiOhta, RemembersTheStressRatioThatItWasConsolidatedUnder) {
  const SekiguchiOhta law(clay());
  TestPoint point(law, at_rest(start));
  EXPECT_NEAR(axis_of(point).zz, 2.0 / 3.0 * eta0, 1e-14);
  EXPECT_NEAR(eta_star(point), 0.0, 1e-14);
  EXPECT_NEAR(size_of(point), start, 1e-9 * start);
  SekiguchiOhtaOptions given = clay();
  given.consolidation_ratio = k0;  // whatever it carries now
  const SekiguchiOhta other(given);
  TestPoint unloaded(other, even(start));
  EXPECT_NEAR(axis_of(unloaded).zz, 2.0 / 3.0 * eta0, 1e-14);
  EXPECT_NEAR(size_of(unloaded), start * std::exp(rounded(eta0) / m), 1e-9 * start);
  EXPECT_EQ(other.earth_pressure_at_rest(), k0);
}

/// On the K0 line the tip of the yield surface moves along: v falls by lambda ln p, K0 stays as far
/// as the rounding lets it, where |de^p| sqrt(2/3) M <= d eps_v^p + eta_0 : de^p.
TEST(SekiguchiOhta, CompressesOneDimensionallyAlongTheK0LineWithSlopeLambda) {
  const SekiguchiOhta law(clay());
  for (const int steps : {1, 50}) {
    TestPoint point(law, at_rest(start));
    for (int i = 0; i < steps; ++i) point.strain({0, 0, -0.1 / steps, 0, 0, 0});
    const double expected = start * std::exp(specific_volume * (1.0 - std::exp(-0.1)) / lambda);
    EXPECT_NEAR(pressure_of(point), expected, 0.004 * expected);
    EXPECT_NEAR(point.stress.xx / point.stress.zz, k0, 0.003);
    EXPECT_NEAR(volume_of(point), specific_volume * std::exp(-0.1), 1e-12);
    // Unloading is elastic: slope kappa.
    const double top = pressure_of(point), volume = volume_of(point);
    point.strain({0, 0, 0.002, 0, 0, 0}, 5);
    EXPECT_NEAR(pressure_of(point), top * std::exp((volume - volume_of(point)) / kappa),
                1e-9 * top);
    point.strain({0, 0, -0.002, 0, 0, 0}, 5);
    EXPECT_NEAR(pressure_of(point), top, 1e-9 * top);
    EXPECT_NEAR(size_of(point), top, 0.004 * top);
  }
}

/// Undrained, v constant: lambda ln(p/p_0) = -(lambda - kappa) eta*/M, along any path of strain.
/// Ohta, Nishihara & Morita (1985) give the strengths where eta* has grown to what each mode of
/// shear can carry: M - eta_0 in triaxial compression, M + eta_0 in extension, M -+ sqrt(3)/2 eta_0
/// in plane strain, M in simple shear.
TEST(SekiguchiOhta, ShearsUndrainedAlongTheClosedPathToTheStrengthOfEachModeOfShear) {
  struct Mode {
    const char* name;
    SymTensor strain;
    double eta_star;
  };
  const double half_root3 = 0.5 * std::sqrt(3.0);
  for (const Mode& mode : {Mode{"compression", {0.5, 0.5, -1, 0, 0, 0}, m - eta0},
                           Mode{"extension", {-0.5, -0.5, 1, 0, 0, 0}, m + eta0},
                           Mode{"plane, active", {1, 0, -1, 0, 0, 0}, m - half_root3 * eta0},
                           Mode{"plane, passive", {-1, 0, 1, 0, 0, 0}, m + half_root3 * eta0},
                           Mode{"simple shear", {0, 0, 0, 0, 0, 0.5}, m}}) {
    const SekiguchiOhta law(clay());
    TestPoint point(law, at_rest(start));
    for (int i = 0; i < 400; ++i) {
      point.strain(0.002 * mode.strain);
      const double expected = start * std::exp(-irreversible * rounded(eta_star(point)) / m);
      ASSERT_NEAR(pressure_of(point), expected, 1e-8 * start) << mode.name << i;
    }
    EXPECT_NEAR(eta_star(point), mode.eta_star, 2e-3) << mode.name;
    const double last = start * std::exp(-irreversible * mode.eta_star / m);
    EXPECT_NEAR(pressure_of(point), last, 5e-3 * last) << mode.name;
    const double plane = m * last / std::sqrt(3.0);  // s_u
    if (mode.strain.zx != 0.0)
      EXPECT_NEAR(point.stress.zx, plane, 6e-3 * plane);
    else if (mode.strain.yy == 0.0)
      EXPECT_NEAR(std::abs(shear_of(point)), 2.0 * plane, 0.012 * plane) << mode.name;
    else
      EXPECT_NEAR(std::abs(shear_of(point)), m * last, 6e-3 * m * last) << mode.name;
  }
}

/// Original Cam-Clay (Roscoe & Schofield 1963): f = q/(M p) + ln(p/p_c); drained compression
/// follows v = v_0 - lambda ln(p/p_0) - (lambda - kappa) eta/M to q = M p at p = 3 p_0/(3 - M).
TEST(SekiguchiOhta, FromEvenStressIsTheOriginalCamClay) {
  const SekiguchiOhta law(clay());
  TestPoint undrained(law, even(start));
  undrained.strain({0.3, 0.3, -0.6, 0, 0, 0}, 60);
  const double strength = start * std::exp(-irreversible);
  EXPECT_NEAR(pressure_of(undrained), strength, 5e-3 * strength);
  EXPECT_NEAR(shear_of(undrained), m * strength, 5e-3 * strength);
  TestPoint point(law, even(start));
  point.triaxial(-1e-4);
  for (int i = 0; i < 250; ++i) {
    point.triaxial(-0.005);
    const double pressure = pressure_of(point), eta = shear_of(point) / pressure;
    const double volume =
        specific_volume - lambda * std::log(pressure / start) - (lambda - kappa) * rounded(eta) / m;
    ASSERT_NEAR(shear_of(point), 3.0 * (pressure - start), 1e-4 * start);
    ASSERT_NEAR(volume_of(point), volume, 1e-7);
  }
  EXPECT_NEAR(pressure_of(point), 3.0 * start / (3.0 - m), 2e-3 * start);
}

/// The same closed path holds once overconsolidated clay yields; until then p stays.
TEST(SekiguchiOhta, OverconsolidatedKeepsItsMeanStressUntilItYields) {
  const SekiguchiOhta law(clay(2.0));
  TestPoint point(law, at_rest(start));
  EXPECT_NEAR(size_of(point), 2.0 * start, 1e-9 * start);
  bool yielded = false;
  for (int i = 0; i < 300; ++i) {
    point.strain({0.0005, 0.0005, -0.001, 0, 0, 0});
    const double wanted = irreversible * (std::log(2.0) - rounded(eta_star(point)) / m);
    if (size_of(point) == 2.0 * start) {
      EXPECT_FALSE(yielded);
      EXPECT_NEAR(pressure_of(point), start, 1e-9 * start);
    } else {
      yielded = true;
      ASSERT_NEAR(pressure_of(point), start * std::exp(wanted), 1e-8 * start);
    }
  }
  EXPECT_TRUE(yielded);
  EXPECT_NEAR(shear_of(point) / pressure_of(point), m, 0.01);
}

TEST(SekiguchiOhta, GivesNearlyTheSameInOneLargeStepAndInManySmallOnes) {
  for (const double ratio : {1.0, 1.3}) {
    const SekiguchiOhta law(clay(ratio));
    const SymTensor strain{0.02, -0.01, -0.05, 0.01, -0.02, 0.03};
    TestPoint once(law, {-1e5, -9e4, -1.2e5, 1e4, 0, -5e3}), often = once;
    once.strain(strain);
    often.strain(strain, 2000);
    EXPECT_LT(largest_difference(once.stress, often.stress), 2e-4 * pressure_of(often));
    EXPECT_NEAR(once.history[6], often.history[6], 2e-4 * often.history[6]);
    EXPECT_NEAR(law.yield_function(-1.0 * once.stress, axis_of(once), size_of(once)), 0.0, 1e-9);
  }
}

/// Sheared, then compressed until the stress is back at the tip, and away from it again.
TEST(SekiguchiOhta, ComesBackToTheTipOfItsSurfaceAndLeavesItAgain) {
  const SekiguchiOhta law(clay());
  TestPoint coarse(law, at_rest(start)), fine = coarse;
  const auto along = [&](const SymTensor& strain, double close) {
    coarse.strain(strain, 10), fine.strain(strain, 2000);
    EXPECT_LT(largest_difference(coarse.stress, fine.stress), close * pressure_of(fine));
  };
  along({0.002, 0, -0.002, 0, 0, 0.002}, 4e-4);
  EXPECT_GT(eta_star(fine), 0.05);
  along({0, 0, -0.1, 0, 0, 0}, 4e-4);
  EXPECT_LT(eta_star(fine), 2.0 * rounding);
  EXPECT_NEAR(fine.stress.xx / fine.stress.zz, k0, 0.003);
  along({0, 0.005, -0.005, 0.003, 0, 0}, 4e-4);
  EXPECT_GT(eta_star(fine), 0.05);
}

/// Random walks of strain of up to 2 % a step: the law must answer, and its answers must satisfy
/// f <= 0 and the line of volumes v + lambda ln p_c - kappa ln(p_c/p) = const.
TEST(SekiguchiOhta, AnswersWhateverTheStrain) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  for (int walk = 0; walk < 200; ++walk) {
    const SekiguchiOhta law(clay(walk % 2 == 0 ? 1.0 : 2.5));
    TestPoint point(law, at_rest(start));
    const double scale = std::pow(10.0, -5.0 + 0.017 * walk);
    const double constant = volume_of(point) + lambda * std::log(size_of(point)) -
                            kappa * std::log(size_of(point) / pressure_of(point));
    for (int i = 0; i < 100; ++i) {
      SymTensor strain{side(random), side(random), side(random),
                       side(random), side(random), side(random)};
      strain += (-strain.trace() / 3.0) * SymTensor::identity() +
                (0.1 * side(random)) * SymTensor::identity();
      point.strain(scale * strain);
      if (point.stress == SymTensor{} || pressure_of(point) < 600.0 || size_of(point) <= 500.0)
        break;
      ASSERT_LE(law.yield_function(-1.0 * point.stress, axis_of(point), size_of(point)), 1e-9);
      const double now = volume_of(point) + lambda * std::log(size_of(point)) -
                         kappa * std::log(size_of(point) / pressure_of(point));
      ASSERT_NEAR(now, constant, 1e-9) << walk << ' ' << i;
    }
  }
}

TEST(SekiguchiOhta, PulledApartCarriesNothingUntilItsGapHasClosed) {
  const SekiguchiOhta law(clay(2.0));
  TestPoint point(law, at_rest(2e3));
  const double before = volume_of(point);
  point.strain({0.1, 0.1, 0.1, 0, 0, 0.05}, 50);
  EXPECT_EQ(point.stress, SymTensor{});
  const double gap = point.history[8];
  EXPECT_GT(gap, 0.09);
  EXPECT_NEAR(volume_of(point), before * std::exp(0.3), 1e-9);
  point.strain((-0.99 / 3.0 * gap) * SymTensor::identity(), 10);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain(-0.03 * SymTensor::identity(), 10);
  EXPECT_EQ(point.history[8], 0.0);
  EXPECT_GT(pressure_of(point), 500.0);
}

TEST(SekiguchiOhta, IsAsStiffAgainstWavesAsAgainstASmallUnloading) {
  const SekiguchiOhta law(clay());
  TestPoint point(law, at_rest(start));
  const double modulus = law.wave_modulus({&point.stress, 1}, point.history);
  const double before = point.stress.zz, strain = 1e-7;
  point.strain({0, 0, strain, 0, 0, 0});
  EXPECT_NEAR((point.stress.zz - before) / strain, modulus, 1e-4 * modulus);
}

}  // namespace
}  // namespace mudlark

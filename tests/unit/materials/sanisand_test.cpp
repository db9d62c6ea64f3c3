#include "materials/sanisand.hpp"

#include <gtest/gtest.h>

#include <random>

#include "materials/invariants.hpp"
#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

const Sanisand toyoura(SanisandOptions::toyoura());

SymTensor even(double pressure) { return -pressure * SymTensor::identity(); }
double pressure_of(const TestPoint& point) { return -mean_of(point.stress); }
double shear_of(const TestPoint& point) { return point.stress.xx - point.stress.zz; }
/// Compression along z at constant volume; the axial strain is the shear strain eps_q.
SymTensor undrained(double axial) { return {0.5 * axial, 0.5 * axial, -axial, 0, 0, 0}; }

struct Sand : TestPoint {
  Sand(double void_ratio, double pressure) : TestPoint(toyoura, even(pressure)) {
    history.assign(toyoura.history_names().size(), 0.0);
    toyoura.initialise_history({&stress, 1}, void_ratio / (1.0 + void_ratio), history);
  }
  double void_ratio() const { return history[18]; }
};

/// Mean stress and deviator [kPa] at eps_q = 1, 5 and 20 % in undrained compression: the triaxial
/// form of the law, integrated by itself with steps of 5e-6.
TEST(Sanisand, ShearsUndrainedAlongTheTriaxialFormOfTheLaw) {
  struct Row {
    double void_ratio, start, pressure[3], shear[3];
  };
  constexpr Row rows[] = {
      {0.735, 1000, {925.09632, 1707.3531, 2870.8713}, {876.26829, 2252.7157, 3593.712}},
      {0.833, 1000, {759.54749, 723.8755, 1074.0508}, {611.92096, 898.50056, 1345.6029}},
      {0.833, 100, {98.805858, 405.8884, 1062.772}, {117.50438, 540.43809, 1334.1273}},
      {0.907, 2000, {1302.4367, 357.97771, 177.13011}, {734.40198, 400.97792, 220.98859}}};
  for (const Row& row : rows) {
    Sand sand(row.void_ratio, 1e3 * row.start);
    const double strain[] = {0.01, 0.04, 0.15};
    for (int i = 0; i < 3; ++i) {
      sand.strain(undrained(strain[i]), static_cast<int>(strain[i] / 2e-4));
      EXPECT_NEAR(pressure_of(sand), 1e3 * row.pressure[i], 2e-3 * 1e3 * row.pressure[i]);
      EXPECT_NEAR(shear_of(sand), 1e3 * row.shear[i], 2e-3 * 1e3 * row.shear[i]);
    }
  }
}

/// Where contraction turns into dilation, and the peak before sand gets weak: the triaxial form of
/// the law, integrated by itself.
TEST(Sanisand, TurnsFromContractionToDilationWhereTheTriaxialFormDoes) {
  Sand medium(0.833, 1e6);
  double least = 1e6, shear = 0.0;
  for (int i = 0; i < 500; ++i) {
    medium.strain(undrained(1e-4));
    if (pressure_of(medium) < least) least = pressure_of(medium), shear = shear_of(medium);
  }
  EXPECT_NEAR(least, 659.5e3, 5e-3 * 659.5e3);
  EXPECT_NEAR(shear, 743e3, 0.01 * 743e3);
  Sand loose(0.907, 1e6);
  double peak = 0.0;
  for (int i = 0; i < 500; ++i) {
    loose.strain(undrained(2e-5));
    peak = std::max(peak, shear_of(loose));
  }
  EXPECT_NEAR(peak, 425.8e3, 5e-3 * 425.8e3);
}

/// p_ss = p_at ((e_0 - e) / lambda_c)^(1/xi), q_ss = M p_ss.
TEST(Sanisand, EndsUndrainedAtTheCriticalStateOfItsVoidRatio) {
  for (const double void_ratio : {0.735, 0.833, 0.907}) {
    Sand sand(void_ratio, 1e6);
    sand.strain(undrained(1.5), 3000);
    const double steady = 1e5 * std::pow((0.934 - void_ratio) / 0.019, 1.0 / 0.7);
    EXPECT_NEAR(pressure_of(sand), steady, 5e-3 * steady);
    EXPECT_NEAR(shear_of(sand), 1.25 * steady, 5e-3 * 1.25 * steady);
  }
}

TEST(Sanisand, EndsDrainedAtTheCriticalVoidRatioOfItsMeanStress) {
  for (const double void_ratio : {0.75, 0.9}) {
    Sand sand(void_ratio, 2e5);
    for (int i = 0; i < 250; ++i) sand.triaxial(-0.004, 1e-6);
    const double pressure = pressure_of(sand);
    EXPECT_NEAR(shear_of(sand) / pressure, 1.25, 5e-3 * 1.25);
    EXPECT_NEAR(sand.void_ratio(), toyoura.critical_void_ratio(pressure), 2e-3);
  }
}

/// Mean stress [kPa] and strain where q = +-114.2 kPa is reached in undrained cycles from e =
/// 0.808, p = 294 kPa: the triaxial form of the law, integrated by itself with steps of 5e-7. The
/// sand liquefies and sways with 5 % of strain after 5.5 cycles.
TEST(Sanisand, LiquefiesUnderCyclesLikeTheTriaxialFormOfTheLaw) {
  constexpr double pressure[] = {281.806, 232.240, 169.477, 137.134, 89.3508, 114.083,
                                 82.6698, 113.681, 82.6287, 113.680, 82.6283};
  constexpr double strain[] = {0.0013225, -0.0044435, 0.001736,  -0.013955, 0.005059,  -0.0268905,
                               -0.005245, -0.0374785, -0.015822, -0.048056, -0.0263995};
  Sand sand(0.808, 294e3);
  double now = 0.0, sign = 1.0;
  const double step = 4e-6;
  for (int reversal = 0; reversal < 11; ++reversal) {
    while (sign * shear_of(sand) < 114.2e3) {
      ASSERT_LT(std::abs(now), 0.06);
      sand.strain(undrained(sign * step));
      now += sign * step;
    }
    EXPECT_NEAR(pressure_of(sand), 1e3 * pressure[reversal], 2e-3 * 1e3 * pressure[reversal]);
    EXPECT_NEAR(now, strain[reversal], 5e-5);
    sign = -sign;
  }
}

TEST(Sanisand, KnowsNoDirection) {
  Sand along_z(0.8, 2e5), along_x(0.8, 2e5), oblique(0.8, 2e5);
  const double r = std::sqrt(0.5);  // turned by 45 degrees about y
  for (const double sign : {1.0, -1.0, 1.0}) {
    along_z.strain({sign * 0.001, sign * 0.0005, -sign * 0.002, 0, 0, 0}, 20);
    along_x.strain({-sign * 0.002, sign * 0.001, sign * 0.0005, 0, 0, 0}, 20);
    oblique.strain({-sign * 0.0005, sign * 0.0005, -sign * 0.0005, 0, 0, sign * 0.0015}, 20);
  }
  const SymTensor& a = along_z.stress;
  EXPECT_LT(largest_difference(along_x.stress, {a.zz, a.xx, a.yy, 0, 0, 0}), 1.0);
  const double mean = r * r * (a.xx + a.zz), half = r * r * (a.xx - a.zz);
  EXPECT_LT(largest_difference(oblique.stress, {mean, a.yy, mean, 0, 0, half}), 1.0);
}

TEST(Sanisand, GivesNearlyTheSameInLargeStepsAndInSmallOnes) {
  Sand few(0.8, 2e5), many(0.8, 2e5);
  for (const double sign : {1.0, -1.0}) {
    const SymTensor strain{sign * 0.004, -sign * 0.001, -sign * 0.006, sign * 0.002, 0,
                           sign * 0.003};
    few.strain(strain, 4);
    many.strain(strain, 2000);
  }
  EXPECT_LT(largest_difference(few.stress, many.stress), 0.01 * pressure_of(many));
}

TEST(Sanisand, PulledApartCarriesNothingUntilItsGapHasClosed) {
  Sand sand(0.8, 2e3);
  sand.strain({0.01, 0.01, 0.01, 0, 0, 0.002}, 50);
  EXPECT_EQ(sand.stress, SymTensor{});
  EXPECT_NEAR(sand.void_ratio(), 1.8 * std::exp(0.03) - 1.0, 1e-9);
  const double gap = sand.history[19];
  EXPECT_GT(gap, 0.02);
  sand.strain((-0.99 / 3.0 * gap) * SymTensor::identity(), 10);
  EXPECT_EQ(sand.stress, SymTensor{});
  sand.strain(-1e-3 * SymTensor::identity(), 10);
  EXPECT_EQ(sand.history[19], 0.0);
  EXPECT_GT(pressure_of(sand), 500.0);
}

/// Sand that a turn of the loading left beyond its bounding surface, at hardly any stress: found in
/// a shaken column.
TEST(Sanisand, GoesOnFromBeyondItsBoundingSurfaceInAnyDirection) {
  std::mt19937 generator(1);
  std::normal_distribution<double> any;
  for (const double size : {1e-6, 1e-4, 1e-2})
    for (int i = 0; i < 300; ++i) {
      Sand sand(0.818, 100.0);
      sand.stress = {-112.4, -22.22, -126.7, 0, 0, -41.72};
      sand.history = {0.292, -0.7403, 0.4482,  0,      0,       0.4774, 0.2955, -0.7412, 0.4457, 0,
                      0,     0.4796,  -0.4534, 0.8286, -0.3752, 0,      0,      -0.1332, 0.818,  0};
      sand.strain({size * any(generator), 0, size * any(generator), 0, 0, size * any(generator)});
      ASSERT_TRUE(std::isfinite(sand.stress.squared_norm()));
    }
}

/// The loosest Toyoura sand flows; its grains then sink until they touch at the void ratio given.
TEST(Sanisand, ShakenApartCarriesNothingUntilItHasSettled) {
  SanisandOptions options = SanisandOptions::toyoura();
  options.settled_void_ratio = 0.85;
  const Sanisand law(options);
  TestPoint sand(law, {-2500, -2500, -5000, 0, 0, 0});
  law.initialise_history({&sand.stress, 1}, 0.96 / 1.96, sand.history);
  double sign = 1.0;
  for (int i = 0; i < 10000 && sand.stress.zz < 0.0; ++i) {
    sand.strain({0, 0, 0, 0, 0, sign * 1e-5});
    if (sign * sand.stress.zx > 500.0) sign = -sign;
  }
  EXPECT_EQ(sand.stress, SymTensor{});
  EXPECT_NEAR(sand.history[18], 0.96, 1e-12);
  const double gap = std::log(1.96 / 1.85);
  EXPECT_NEAR(sand.history[19], gap, 1e-12);
  sand.strain({0, 0, -0.99 * gap, 0, 0, 0.01}, 100);
  EXPECT_EQ(sand.stress, SymTensor{});
  sand.strain({0, 0, -0.06 * gap, 0, 0, 0}, 20);
  EXPECT_LT(sand.stress.zz, -500.0);
  EXPECT_NEAR(sand.history[18], 0.85, 0.01);
}

/// Whether stress goes to nothing in shear or because the sand is pulled apart, the structure is
/// lost: in one step and in many it then settles to the same void ratio.
TEST(Sanisand, PulledApartItLosesItsLooseStructureWhateverTheStep) {
  SanisandOptions options = SanisandOptions::toyoura();
  options.settled_void_ratio = 0.85;
  const Sanisand law(options);
  const double opening = 2e-3, third = opening / 3.0;
  for (const double shear : {0.0, 1e-3})
    for (const int steps : {1, 3, 1000}) {
      TestPoint sand(law, even(100.0));
      law.initialise_history({&sand.stress, 1}, 0.96 / 1.96, sand.history);
      sand.strain({third, third, third, 0, 0, shear}, steps);
      EXPECT_EQ(sand.stress, SymTensor{}) << steps;
      const double gap = std::log(1.96 / 1.85) + opening;
      EXPECT_NEAR(sand.history[19], gap, 1e-12) << steps;
      sand.strain({0, 0, -0.99 * gap, 0, 0, 0}, 100);
      EXPECT_EQ(sand.stress, SymTensor{}) << steps;
      sand.strain({0, 0, -0.02 * gap, 0, 0, 0}, 100);
      EXPECT_LT(sand.stress.zz, -100.0) << steps;
    }
}

/// Sand that is placed without stress has not been shaken apart, and sand denser than the settled
/// one keeps what it has.
TEST(Sanisand, OnlyLooseSandThatCarriedSomethingLosesItsStructure) {
  SanisandOptions options = SanisandOptions::toyoura();
  options.settled_void_ratio = 0.85;
  const Sanisand law(options);
  TestPoint placed(law, SymTensor{}), dense(law, even(100.0));
  law.initialise_history({&placed.stress, 1}, 0.96 / 1.96, placed.history);
  law.initialise_history({&dense.stress, 1}, 0.8 / 1.8, dense.history);
  for (TestPoint* sand : {&placed, &dense}) {
    sand->strain(1e-3 * SymTensor::identity(), 10);
    EXPECT_EQ(sand->stress, SymTensor{});
    EXPECT_LE(sand->history[19], 3e-3 * (1.0 + 1e-12));
    sand->strain(-1.2e-3 * SymTensor::identity(), 10);
    EXPECT_LT(sand->stress.zz, -1.0);
  }
}

TEST(Sanisand, IsAsStiffAgainstWavesAsAgainstASmallUnloading) {
  Sand sand(0.8, 1e5);
  const double modulus = toyoura.wave_modulus({&sand.stress, 1}, sand.history);
  sand.strain({0, 0, -1e-8, 0, 0, 0});
  EXPECT_NEAR((-1e5 - sand.stress.zz) / 1e-8, modulus, 1e-3 * modulus);
}

TEST(Sanisand, NamesThePointThatItCannotIntegrate) {
  Sand sand(0.8, 1e5);
  const SymTensor strain{0, 0, std::nan(""), 0, 0, 0};
  std::array<unsigned char, 1> failed{};
  MaterialPoints points{{&strain, 1}, {&sand.stress, 1}, sand.history};
  points.failed = failed;
  EXPECT_EQ(toyoura.update_stress(points), 1u);
  EXPECT_EQ(failed[0], 1);
}

}  // namespace
}  // namespace mudlark

// mu(I) and the Newtonian liquid: steady shear, rates, pressure, grains and drops that part.
#include <cmath>

#include "materials/invariants.hpp"
#include "materials/mu_i.hpp"
#include "materials/newtonian.hpp"
#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

MuIOptions beads() {
  MuIOptions options;
  options.young_modulus = 1e7, options.poisson_ratio = 0.3;
  options.grain_diameter = 5e-3, options.grain_density = 2450.0;
  return options;
}

TEST(MuI, SteadyShearCarriesMuOfIWhateverTheStep) {
  const MuIOptions options = beads();
  const MuI law(options);
  const double pressure = 500.0;
  for (const double rate : {0.1, 1.0, 30.0, 1e4})
    for (const double step : {1e-5, 1e-3}) {
      TestPoint point(law, -pressure * SymTensor::identity());
      point.dt = step;
      for (double shear = 0.0; shear < 1e-3 || shear < 10.0 * rate * step; shear += rate * step)
        point.strain({0, 0, 0, 0, 0, 0.5 * rate * step});
      const double inertial =
          rate * options.grain_diameter * std::sqrt(options.grain_density / pressure);
      const double mu =
          options.static_friction + (options.limiting_friction - options.static_friction) /
                                        (1.0 + options.inertial_number / inertial);
      EXPECT_NEAR(point.stress.zx / pressure, mu, 1e-9) << rate << " " << step;
      EXPECT_NEAR(mean_of(point.stress), -pressure, 1e-9);
    }
}

TEST(MuI, IsElasticBelowItsStaticFriction) {
  const MuI law(beads());
  TestPoint point(law, -1e3 * SymTensor::identity());
  const double shear = 0.38 * 1e3;
  point.strain({0, 0, 0, 0, 0, shear / (2.0 * law.shear_modulus())});
  EXPECT_NEAR(point.stress.zx, shear, 1e-9);
  EXPECT_EQ(point.history[0], 0.0);
}

TEST(MuI, SparseGrainsCarryNothingUntilTheyAreDenseAgain) {
  const MuI law(beads());
  TestPoint point(law, -50.0 * SymTensor::identity());
  const double bulk = 1e7 / (3.0 * 0.4);
  point.strain(0.02 * SymTensor::identity(), 5);
  EXPECT_EQ(point.stress, SymTensor{});
  EXPECT_NEAR(point.history[1], 0.06 - 50.0 / bulk, 1e-12);
  point.strain({-0.01, 0, -0.02, 0, 0, 0.5}, 3);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain(-0.011 * SymTensor::identity(), 3);
  EXPECT_NEAR(mean_of(point.stress), -bulk * (0.003 + 50.0 / bulk), 1e-6);
}

TEST(Newtonian, SimpleShearCarriesViscosityTimesRateAndForgetsItAtRest) {
  const Newtonian law({2e6, 3.0, 0.0});
  TestPoint point(law, -1e3 * SymTensor::identity());
  point.dt = 0.01;
  point.strain({0, 0, 0, 0, 0, 0.5 * 4.0 * 0.01}, 1);  // rate 4 1/s
  EXPECT_NEAR(point.stress.zx, 12.0, 1e-12);
  EXPECT_NEAR(mean_of(point.stress), -1e3, 1e-10);
  point.strain({});
  EXPECT_LT(largest_difference(point.stress, -1e3 * SymTensor::identity()), 1e-10);
}

TEST(Newtonian, StretchingMeetsTroutonsStresses) {
  const Newtonian law({2e6, 3.0, 0.0});
  TestPoint point(law, -1e3 * SymTensor::identity());
  point.dt = 0.01;
  point.strain({-0.01, -0.01, 0.02, 0, 0, 0}, 1);  // rate 2 1/s along z, at constant volume
  EXPECT_NEAR(point.stress.zz - point.stress.xx, 3.0 * 3.0 * 2.0, 1e-9);
}

TEST(Newtonian, PressureGrowsByTheBulkModulusAndTheLiquidPartsUnderTension) {
  const Newtonian law({2e6, 0.0, 0.0});
  TestPoint point(law, {});
  point.strain(-0.001 * SymTensor::identity(), 4);
  EXPECT_NEAR(mean_of(point.stress), -2e6 * 0.003, 1e-9);
  point.strain(0.011 * SymTensor::identity(), 4);
  EXPECT_EQ(point.stress, SymTensor{});
  EXPECT_NEAR(point.history[0], 0.03, 1e-15);
  point.strain(-0.009 * SymTensor::identity(), 4);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain(-0.002 * SymTensor::identity(), 4);
  EXPECT_NEAR(mean_of(point.stress), -2e6 * 0.003, 1e-7);
  EXPECT_DOUBLE_EQ(law.wave_viscosity(), 0.0);
  EXPECT_DOUBLE_EQ(law.wave_modulus({}, {}), 2e6);
}

TEST(Newtonian, HoldsTensionUpToItsCutoff) {
  const Newtonian law({2e6, 0.0, 700.0});
  TestPoint point(law, {});
  point.strain(0.001 * SymTensor::identity());
  EXPECT_NEAR(mean_of(point.stress), 700.0, 1e-12);
  point.strain(-0.001 * SymTensor::identity());
  EXPECT_NEAR(mean_of(point.stress), 0.0, 1e-9);
}

}  // namespace
}  // namespace mudlark

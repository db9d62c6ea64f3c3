// mu(J): steady shear, dilation of dense grains and contraction of loose ones, grains that part.
#include "materials/mu_j.hpp"

#include <cmath>

#include "materials/invariants.hpp"
#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

MuJOptions beads() {
  MuJOptions options;
  options.young_modulus = 1e6, options.poisson_ratio = 0.3;
  options.grain_diameter = 2e-4, options.grain_density = 2500.0;
  options.liquid_viscosity = 0.01;
  return options;
}

double bulk_of(const MuJOptions& options) {
  return options.young_modulus / (3.0 * (1.0 - 2.0 * options.poisson_ratio));
}

/// Sheared at constant volume, grains find the pressure at which their share of the volume is that
/// of steady shear: phi = phi_m/(1 + sqrt J).
TEST(MuJ, SteadyShearAtConstantVolumeFindsThePressureThatGoesWithTheDensity) {
  const MuJOptions options = beads();
  const MuJ law(options);
  for (const double fraction : {0.50, 0.56})
    for (const double step : {1e-4, 1e-3}) {
      const double rate = 2.0;
      TestPoint point(law, -200.0 * SymTensor::identity());
      point.history[0] = fraction;
      point.dt = step;
      for (double shear = 0.0; shear < 4.0; shear += rate * step)
        point.strain({0, 0, 0, 0, 0, 0.5 * rate * step});
      const double root_j = options.critical_fraction / fraction - 1.0, j = root_j * root_j;
      const double flow = options.liquid_viscosity * rate +
                          0.1 * options.grain_density * std::pow(options.grain_diameter * rate, 2);
      const double pressure = flow / j;
      const double mu = options.static_friction +
                        (options.limiting_friction - options.static_friction) /
                            (1.0 + options.viscous_number / j) +
                        2.5 * options.critical_fraction * root_j;
      EXPECT_NEAR(-mean_of(point.stress), pressure, 1e-3 * pressure) << fraction << " " << step;
      EXPECT_NEAR(std::abs(point.stress.zx), mu * pressure, 1e-3 * mu * pressure) << fraction;
      EXPECT_EQ(point.history[0], fraction);
    }
}

/// In a volume that is held, dense grains press harder when they are sheared slowly, loose ones let
/// go: dP = K_e K (phi - phi_m) d(plastic shear).
TEST(MuJ, DenseGrainsDilateAndLooseOnesContract) {
  const MuJOptions options = beads();
  const MuJ law(options);
  for (const double fraction : {0.60, 0.575}) {
    TestPoint point(law, -1000.0 * SymTensor::identity());
    point.history[0] = fraction;
    point.dt = 1.0;  // so slow that J is nothing
    point.strain({0, 0, 0, 0, 0, 1e-3});
    const double plastic = point.history[1], grown = -mean_of(point.stress) - 1000.0;
    EXPECT_GT(plastic, 1e-4);
    const double distance = fraction - options.critical_fraction;
    EXPECT_NEAR(grown, bulk_of(options) * options.dilatancy_coefficient * distance * plastic,
                0.05 * std::abs(grown) + 1.0);
    EXPECT_GT(grown * distance, 0.0);
  }
}

TEST(MuJ, IsElasticBelowTheFrictionOfItsDensity) {
  const MuJOptions options = beads();
  const MuJ law(options);
  for (const double fraction : {0.60, 0.56}) {
    TestPoint point(law, -1000.0 * SymTensor::identity());
    point.history[0] = fraction;
    const double friction = options.static_friction +
                            options.dilatancy_coefficient * (fraction - options.critical_fraction);
    const double shear = 0.999 * friction * 1000.0;
    point.strain({0, 0, 0, 0, 0, shear / (2.0 * law.shear_modulus())});
    EXPECT_NEAR(point.stress.zx, shear, 1e-9);
    EXPECT_EQ(point.history[1], 0.0);
    point.strain({0, 0, 0, 0, 0, 0.01 * shear / (2.0 * law.shear_modulus())});
    EXPECT_GT(point.history[1], 0.0);
  }
}

TEST(MuJ, GrainsThatPartCarryNothingUntilTheirGapHasClosed) {
  const MuJOptions options = beads();
  const MuJ law(options);
  TestPoint point(law, -50.0 * SymTensor::identity());
  point.history[0] = 0.585;
  point.strain(0.01 * SymTensor::identity(), 5);
  EXPECT_EQ(point.stress, SymTensor{});
  EXPECT_NEAR(point.history[2], 0.03 - 50.0 / bulk_of(options), 1e-12);
  EXPECT_NEAR(point.history[0], 0.585 * std::exp(-0.03), 1e-12);
  point.strain(-0.009 * SymTensor::identity(), 3);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain(-0.002 * SymTensor::identity(), 3);
  EXPECT_NEAR(mean_of(point.stress), -bulk_of(options) * 0.003 - 50.0, 1e-6);
}

TEST(MuJ, StartsWithTheDensityOfItsPorosity) {
  const MuJ law(beads());
  std::array<double, 6> history{};
  const std::array<SymTensor, 2> stress{};
  law.initialise_history(stress, 0.42, history);
  EXPECT_DOUBLE_EQ(history[0], 0.58);
  EXPECT_DOUBLE_EQ(history[3], 0.58);
}

}  // namespace
}  // namespace mudlark

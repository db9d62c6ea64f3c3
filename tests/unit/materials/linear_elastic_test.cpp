#include "materials/linear_elastic.hpp"

#include <gtest/gtest.h>

#include "materials/registry.hpp"

namespace mudlark {
namespace {

constexpr double young = 3e6, poisson = 0.25;

SymTensor stress_after(const SoilModel& law, SymTensor stress, const SymTensor& strain) {
  EXPECT_EQ(law.update_stress({{&strain, 1}, {&stress, 1}, {}, 0.1}), 0u);
  return stress;
}

void expect_near(const SymTensor& a, const SymTensor& b, double tolerance) {
  EXPECT_NEAR(a.xx, b.xx, tolerance);
  EXPECT_NEAR(a.yy, b.yy, tolerance);
  EXPECT_NEAR(a.zz, b.zz, tolerance);
  EXPECT_NEAR(a.xy, b.xy, tolerance);
  EXPECT_NEAR(a.yz, b.yz, tolerance);
  EXPECT_NEAR(a.zx, b.zx, tolerance);
}

TEST(LinearElastic, UniaxialStressStretchesByYoungAndNarrowsByPoisson) {
  const LinearElastic law({young, poisson});
  const double e = 1e-3;
  expect_near(stress_after(law, {}, {-poisson * e, -poisson * e, e, 0, 0, 0}),
              {0, 0, young * e, 0, 0, 0}, 1e-9 * young * e);
}

TEST(LinearElastic, ConfinedCompressionMeetsTheWaveModulusAndTheLateralPressure) {
  const LinearElastic law({young, poisson});
  const double e = -2e-3, modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  EXPECT_NEAR(law.wave_modulus({}, {}), modulus, 1e-9 * modulus);
  const double lateral = poisson / (1 - poisson) * modulus * e;
  expect_near(stress_after(law, {}, {0, 0, e, 0, 0, 0}), {lateral, lateral, modulus * e, 0, 0, 0},
              1e-9 * modulus);
}

TEST(LinearElastic, TensorShearMeetsTwiceTheShearModulus) {
  const LinearElastic law({young, poisson});
  const double shear = young / (2 * (1 + poisson));
  EXPECT_DOUBLE_EQ(law.shear_modulus(), shear);
  expect_near(stress_after(law, {}, {0, 0, 0, 1e-3, -2e-3, 3e-3}),
              {0, 0, 0, 2e-3 * shear, -4e-3 * shear, 6e-3 * shear}, 1e-9 * shear);
}

TEST(LinearElastic, AddsToTheStressThatIsThere) {
  const LinearElastic law({young, poisson});
  const SymTensor strain{1e-3, -2e-3, 5e-4, 1e-4, 2e-4, -3e-4}, start{1, 2, 3, 4, 5, 6};
  expect_near(stress_after(law, start, strain), start + stress_after(law, {}, strain), 1e-8);
}

TEST(LinearElastic, ElasticStrainIsTheInverseOfTheStress) {
  for (const double nu : {-0.5, 0.0, 0.3, 0.499}) {
    const LinearElastic law({young, nu});
    const SymTensor stress{-1e4, 2e4, -3e4, 5e3, -6e3, 7e3};
    expect_near(stress_after(law, {}, law.elastic_strain(stress)), stress, 1e-7);
  }
}

TEST(Registry, MakesTheLawAndKnowsWhatItCanDo) {
  const SoilLawOptions options = LinearElasticOptions{young, poisson};
  const auto law = make_soil_model(options);
  EXPECT_EQ(law->name(), "linear-elastic");
  EXPECT_TRUE(law->history_names().empty());
  EXPECT_DOUBLE_EQ(law->shear_modulus(), young / (2 * (1 + poisson)));
  EXPECT_FALSE(law->yields());
  EXPECT_TRUE(law->supports(StrainMeasure::jaumann));
  EXPECT_NEAR(law->earth_pressure_at_rest(), poisson / (1 - poisson), 1e-15);
}

}  // namespace
}  // namespace mudlark

#include "materials/linear_elastic.hpp"

#include <gtest/gtest.h>

#include <array>

#include "materials/registry.hpp"

namespace mudlark {
namespace {

constexpr double young = 1e6, poisson = 0.3;  // [Pa], [-]: the paper's Table 1
const LinearElastic law(LinearElasticOptions{young, poisson});

SymTensor stress_of(const SymTensor& strain) {
  std::array<SymTensor, 1> stress{};
  const std::array<SymTensor, 1> increment{strain};
  EXPECT_EQ(law.update_stress({increment, stress, {}, 0.0}), 0u);
  return stress[0];
}

TEST(LinearElastic, StretchesAndNarrowsABarByYoungAndPoisson) {
  const SymTensor stress = stress_of({0.01, -0.003, -0.003, 0.0, 0.0, 0.0});
  EXPECT_NEAR(stress.xx, young * 0.01, 1e-9);
  EXPECT_NEAR(stress.yy, 0.0, 1e-9);
  EXPECT_NEAR(stress.zz, 0.0, 1e-9);
}

TEST(LinearElastic, ShearsByTwiceTheShearModulus) {
  const SymTensor stress = stress_of({0.0, 0.0, 0.0, 0.01, -0.02, 0.03});
  const double shear = young / (2.0 * (1.0 + poisson));
  EXPECT_NEAR(law.shear_modulus(), shear, 1e-9);
  EXPECT_NEAR(stress.xy, 2.0 * shear * 0.01, 1e-9);
  EXPECT_NEAR(stress.yz, 2.0 * shear * -0.02, 1e-9);
  EXPECT_NEAR(stress.zx, 2.0 * shear * 0.03, 1e-9);
  EXPECT_EQ(stress.trace(), 0.0);
}

TEST(LinearElastic, ResistsConfinedCompressionWithItsWaveModulus) {
  const double modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  EXPECT_NEAR(law.wave_modulus({}, {}), modulus, 1e-8);
  EXPECT_NEAR(stress_of({0.0, 0.0, -0.02, 0.0, 0.0, 0.0}).zz, -0.02 * modulus, 1e-9);
}

TEST(LinearElastic, AddsToTheStressThatIsThereAndFindsItsStrainAgain) {
  const SymTensor first{-0.01, 0.02, -0.03, 0.004, 0.005, -0.006};
  const SymTensor second{0.03, 0.01, 0.0, -0.001, 0.002, 0.003};
  std::array<SymTensor, 1> stress{stress_of(first)};
  const std::array<SymTensor, 1> increment{second};
  law.update_stress({increment, stress, {}, 0.0});
  const SymTensor strain = law.elastic_strain(stress[0]), sum = first + second;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR(strain.between<3>(row, column), sum.between<3>(row, column), 1e-15);
}

TEST(SoilLaws, ComeFromTheirOptionsByOneRegistry) {
  const SoilLawOptions options = LinearElasticOptions{young, poisson, StrainMeasure::objective};
  const auto made = make_soil_model(options);
  EXPECT_EQ(made->name(), "linear-elastic");
  EXPECT_EQ(strain_measure(options), StrainMeasure::objective);
}

}  // namespace
}  // namespace mudlark

// Strength reduction: the reduced law fails at the reduced strength; other laws are refused.
#include "materials/strength_reduction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"

namespace mudlark {
namespace {

TEST(StrengthReduction, DividesCohesionAndTheTangentOfFriction) {
  MohrCoulombOptions soil;
  soil.cohesion = 12e3, soil.friction_angle = 0.6, soil.dilatancy_angle = 0.5;
  soil.tension_cutoff = 2e3;
  soil.residual = MohrCoulombOptions::Residual{3e3, 0.4, 0.0, {0.1, 0.02}};
  const auto weak = std::get<MohrCoulombOptions>(reduced(soil, 1.5));
  EXPECT_DOUBLE_EQ(weak.cohesion, 8e3);
  EXPECT_NEAR(std::tan(weak.friction_angle), std::tan(0.6) / 1.5, 1e-15);
  EXPECT_DOUBLE_EQ(weak.dilatancy_angle, weak.friction_angle);  // 0.5 would be more than it
  EXPECT_DOUBLE_EQ(weak.residual->cohesion, 2e3);
  EXPECT_NEAR(std::tan(weak.residual->friction_angle), std::tan(0.4) / 1.5, 1e-15);
  EXPECT_DOUBLE_EQ(weak.residual->softening.length, 0.02);
  EXPECT_DOUBLE_EQ(weak.tension_cutoff, 2e3);

  DruckerPragerOptions cone;
  cone.cohesion = 3e3, cone.friction_angle = 0.5;
  const auto other = std::get<DruckerPragerOptions>(reduced(cone, 0.5));
  EXPECT_DOUBLE_EQ(other.cohesion, 6e3);
  EXPECT_NEAR(std::tan(other.friction_angle), 2.0 * std::tan(0.5), 1e-15);
}

TEST(StrengthReduction, DividesUndrainedStrengths) {
  const auto weak = std::get<TrescaOptions>(
      reduced(TrescaOptions{1e6, 0.49, 20e3, UndrainedResidual{8e3, {}}}, 2));
  EXPECT_DOUBLE_EQ(weak.undrained_strength, 10e3);
  EXPECT_DOUBLE_EQ(weak.residual->strength, 4e3);
  EXPECT_DOUBLE_EQ(std::get<VonMisesOptions>(reduced(VonMisesOptions{1e6, 0.49, 20e3, {}}, 4))
                       .undrained_strength,
                   5e3);
}

TEST(StrengthReduction, RefusesLawsWithoutSuchStrength) {
  EXPECT_THROW(reduced(LinearElasticOptions{1e6, 0.3}, 1.2), InputError);
  EXPECT_THROW(reduced(NewtonianOptions{1e6, 1.0, 0.0}, 1.2), InputError);
}

}  // namespace
}  // namespace mudlark

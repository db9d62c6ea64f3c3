// Tresca and von Mises: strength in shear, plane strain and the triaxial cell; softening.
#include <algorithm>

#include "materials/invariants.hpp"
#include "materials/tresca.hpp"
#include "materials/von_mises.hpp"
#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

constexpr double young = 6e6, poisson = 0.49, strength = 20e3;
const Tresca tresca({young, poisson, strength, {}});
const VonMises von_mises({young, poisson, strength, {}});

TEST(Undrained, SimpleShearCarriesTheStrengthWhateverTheStepAndTheConfinement) {
  for (const SoilModel* law :
       {static_cast<const SoilModel*>(&tresca), static_cast<const SoilModel*>(&von_mises)})
    for (const int steps : {1, 7, 100}) {
      TestPoint point(*law, -70e3 * SymTensor::identity());
      point.strain({0, 0, 0, 0, 0, 0.05}, steps);
      EXPECT_LT(largest_difference(point.stress, {-70e3, -70e3, -70e3, 0, 0, strength}), 1e-6)
          << law->name();
      EXPECT_NEAR(point.history[0], 0.1 - strength / law->shear_modulus(), 1e-12);
    }
}

TEST(Undrained, TriaxialStrengthIsTwiceSuOfTrescaAndRootThreeSuOfVonMises) {
  const std::array<std::pair<const SoilModel*, double>, 2> laws{
      {{&tresca, 2.0}, {&von_mises, std::sqrt(3.0)}}};
  for (const auto& [law, factor] : laws)
    for (const double direction : {-1.0, 1.0}) {
      TestPoint point(*law, -100e3 * SymTensor::identity());
      for (int i = 0; i < 40; ++i) point.triaxial(direction * 5e-4);
      EXPECT_NEAR(direction * (point.stress.zz - point.stress.xx), factor * strength, 1.0)
          << law->name();
    }
}

TEST(Undrained, PlaneStrainEndsAtTwiceSuForBothAndKeepsTheVolume) {
  for (const SoilModel* law :
       {static_cast<const SoilModel*>(&tresca), static_cast<const SoilModel*>(&von_mises)}) {
    TestPoint point(*law, -100e3 * SymTensor::identity());
    point.strain({0.05, 0, -0.05, 0, 0, 0}, 200);
    EXPECT_NEAR(point.stress.xx - point.stress.zz, 2.0 * strength, 2e-3 * strength) << law->name();
    EXPECT_NEAR(mean_of(point.stress), -100e3, 1e-6);
  }
}

TEST(Undrained, SoftensAlongTheExponentialInOneStepAsInAThousand) {
  const UndrainedResidual rest{5e3, {0.1, 0.02}};
  const Tresca first({young, poisson, strength, rest});
  const VonMises second({young, poisson, strength, rest});
  for (const SoilModel* law :
       {static_cast<const SoilModel*>(&first), static_cast<const SoilModel*>(&second)})
    for (const int steps : {1, 10, 1000}) {
      TestPoint point(*law, {});
      point.length = 0.05;  // 2.5 band widths
      point.strain({0, 0, 0, 0, 0, 0.04}, steps);
      const double g = point.history[0];
      EXPECT_NEAR(point.stress.zx, 5e3 + 15e3 * std::exp(-2.5 * g / 0.1), 1e-3) << law->name();
      EXPECT_NEAR(g, 0.08 - point.stress.zx / law->shear_modulus(), 1e-8) << law->name();
    }
}

TEST(Undrained, SensitiveSoilBeyondItsSnapStillFindsItsSurface) {
  const UndrainedResidual rest{1e3, {1e-4, 0.0}};  // falls faster than elasticity unloads
  const Tresca first({young, poisson, strength, rest});
  const VonMises second({young, poisson, strength, rest});
  for (const SoilModel* law :
       {static_cast<const SoilModel*>(&first), static_cast<const SoilModel*>(&second)}) {
    TestPoint point(*law, {});
    point.strain({0, 0, 0, 0, 0, 0.02}, 50);
    EXPECT_NEAR(point.stress.zx, 1e3, 1e-3) << law->name();
  }
}

}  // namespace
}  // namespace mudlark

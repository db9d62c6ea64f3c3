// Drucker-Prager: agreement with Mohr-Coulomb where `match` says so, dilatancy, apex, cut-off.
#include "materials/drucker_prager.hpp"

#include <numbers>

#include "materials/invariants.hpp"
#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double young = 20e6, poisson = 0.3;

DruckerPragerOptions soil(double cohesion, double friction, double dilatancy,
                          DruckerPragerMatch match = DruckerPragerMatch::plane_strain) {
  DruckerPragerOptions options;
  options.young_modulus = young, options.poisson_ratio = poisson;
  options.cohesion = cohesion;
  options.friction_angle = friction * degree, options.dilatancy_angle = dilatancy * degree;
  options.match = match;
  return options;
}

TEST(DruckerPrager, FailsInThePlaneAtCoulombsCircleForEveryAngleOfDilatancy) {
  const double c = 5e3, phi = 32.0 * degree;
  for (const double dilatancy : {0.0, 10.0, 32.0}) {
    const DruckerPrager law(soil(c, 32.0, dilatancy));
    TestPoint point(law, {-50e3, -50e3, -50e3, 0, 0, 0});
    const double spread =
        (1.0 + std::sin(dilatancy * degree)) / (1.0 - std::sin(dilatancy * degree));
    // Along the flow of failure: then only the out-of-plane stress still moves.
    point.strain({spread * 0.02, 0, -0.02, 0, 0, 0}, 400);
    const SymTensor& s = point.stress;
    const double mean = 0.5 * (s.xx + s.zz), radius = 0.5 * (s.xx - s.zz);
    EXPECT_NEAR(radius / (-mean * std::sin(phi) + c * std::cos(phi)), 1.0, 1e-6) << dilatancy;
    const double before = mean;
    point.strain({spread * 1e-4, 0, -1e-4, 0, 0, 0});
    EXPECT_NEAR(0.5 * (point.stress.xx + point.stress.zz) / before, 1.0, 1e-6) << dilatancy;
  }
}

TEST(DruckerPrager, FailsInTheTriaxialCellAtRankinesStressOfTheMatchedSide) {
  const double k = 3.0, q = 2.0 * 5e3 * std::sqrt(k);
  const DruckerPrager squeezed(soil(5e3, 30.0, 10.0, DruckerPragerMatch::compression));
  TestPoint compression(squeezed, -50e3 * SymTensor::identity());
  double horizontal = 0.0;
  for (int i = 0; i < 60; ++i) horizontal = compression.triaxial(-5e-4);
  EXPECT_NEAR(compression.stress.zz, -(k * 50e3 + q), 1.0);
  const double sine = std::sin(10.0 * degree);
  EXPECT_NEAR(2.0 * horizontal / 5e-4, (1.0 + sine) / (1.0 - sine), 1e-4);
  const DruckerPrager stretched(soil(5e3, 30.0, 10.0, DruckerPragerMatch::extension));
  TestPoint extension(stretched, -50e3 * SymTensor::identity());
  for (int i = 0; i < 60; ++i) extension.triaxial(5e-4);
  EXPECT_NEAR(extension.stress.zz, -(50e3 - q) / k, 1.0);
}

TEST(DruckerPrager, HoldsTheMeanStressAtItsApexOrCutoffAndTheShearOnTheCone) {
  DruckerPragerOptions options = soil(5e3, 30.0, 0.0);
  const DruckerPrager whole(options);
  TestPoint apex(whole, {});
  apex.strain(0.01 * SymTensor::identity(), 3);
  EXPECT_LT(
      largest_difference(apex.stress, (5e3 / std::tan(30.0 * degree)) * SymTensor::identity()),
      1e-8);
  options.tension_cutoff = 1e3;
  const DruckerPrager cut(options);
  TestPoint point(cut, {});
  point.strain({0.01, 0.01, 0.01, 0, 0, 0.02}, 3);
  EXPECT_NEAR(mean_of(point.stress), 1e3, 1e-9);
  const double cone = 5e3 * std::cos(30.0 * degree) - 1e3 * std::sin(30.0 * degree);
  EXPECT_NEAR(point.stress.zx, cone, 1e-9);
  EXPECT_NEAR(std::sqrt(second_invariant(point.stress)), cone, 1e-9);
}

TEST(DruckerPrager, ReturnsFromAnyTrialToTheNearestPointInTheElasticEnergyIfAssociated) {
  const DruckerPrager law(soil(5e3, 25.0, 25.0));
  const DruckerPragerCone cone = DruckerPragerCone::from(soil(5e3, 25.0, 25.0));
  const double bulk = young / (3 * (1 - 2 * poisson)), shear = law.shear_modulus();
  for (const double mean : {-80e3, -20e3, 0.0, 8e3, 30e3})
    for (const double root : {0.5e3, 9e3, 40e3}) {
      TestPoint point(law, {});
      point.strain((mean / (3 * bulk)) * SymTensor::identity() +
                   SymTensor{0, 0, 0, 0, 0, root / (2 * shear)});
      // Energy norm of the distance over the cone's states (p, sqrt(J2)), by brute force.
      double best = 1e300, best_mean = 0.0, best_root = 0.0;
      for (int i = 0; i <= 20000; ++i) {
        const double p = -120e3 + (cone.tension + 120e3) * i / 20000.0;
        const double r = std::min(root, cone.cohesion - cone.friction * p);
        const double distance = (p - mean) * (p - mean) / bulk + (r - root) * (r - root) / shear;
        if (distance < best) best = distance, best_mean = p, best_root = r;
      }
      EXPECT_NEAR(mean_of(point.stress), best_mean, 10.0);
      EXPECT_NEAR(point.stress.zx, best_root, 10.0);
    }
}

TEST(DruckerPrager, OneStepIsAsGoodAsAHundredOnAProportionalPath) {
  const DruckerPrager law(soil(5e3, 30.0, 10.0));
  TestPoint once(law, -20e3 * SymTensor::identity()), often(law, -20e3 * SymTensor::identity());
  const SymTensor shear{0, 0, 0, 2e-3, -1e-3, 4e-3};
  once.strain(shear);
  often.strain(shear, 100);
  EXPECT_LT(largest_difference(once.stress, often.stress), 1e-6);
}

TEST(DruckerPrager, GrainsWithoutCohesionComeApartAndMeetAgain) {
  const DruckerPrager law(soil(0.0, 33.0, 0.0));
  TestPoint point(law, -100.0 * SymTensor::identity());
  const double bulk = young / (3.0 * (1.0 - 2.0 * poisson));
  point.strain(0.01 * SymTensor::identity(), 3);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain({0, 0, -0.02, 0, 0, 0.3}, 4);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain(-0.01 * SymTensor::identity(), 5);
  EXPECT_NEAR(mean_of(point.stress), -bulk * (0.02 + 100.0 / bulk), 1e-6);
}

TEST(DruckerPrager, StartsInsideItsConeAtRest) {
  for (const auto match : {DruckerPragerMatch::plane_strain, DruckerPragerMatch::compression,
                           DruckerPragerMatch::extension})
    for (const double friction : {10.0, 30.0, 45.0}) {
      const DruckerPrager law(soil(0.0, friction, 0.0, match));
      const double k0 = law.earth_pressure_at_rest();
      TestPoint point(law, 1e3 * SymTensor{-k0, -k0, -1.0, 0, 0, 0});
      const SymTensor before = point.stress;
      point.strain({});
      EXPECT_LT(largest_difference(point.stress, before), 1e-9);
    }
}

}  // namespace
}  // namespace mudlark

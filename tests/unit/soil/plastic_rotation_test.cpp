// Laws that yield, driven through the strain measures: an observer who turns sees the same stress.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "materials/registry.hpp"
#include "soil/kinematics.hpp"

namespace mudlark {
namespace {

using Matrix = Eigen::Matrix3d;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Matrix stress_of(const SoilParticles<3>& points) {
  const SymTensor t = get_tensor(points.stress, 0);
  Matrix m;
  m << t.xx, t.xy, t.zx, t.xy, t.yy, t.yz, t.zx, t.yz, t.zz;
  return m;
}

template <int D = 3>
SoilParticles<D> one_point(const SoilModel& law, StrainMeasure measure) {
  SoilParticles<D> points;
  points.set_history(law.history_names());
  points.resize(1);
  points.volume[0] = points.start_volume[0] = 1.0;
  set_tensor(points.stress, 0, -20e3 * SymTensor::identity());
  initialise_material_state(points, law, measure, 0.4);
  return points;
}

void take_step(SoilParticles<3>& points, const Matrix& gradient, const SoilModel& law,
               StrainMeasure measure) {
  const RowMajor g = gradient;
  points.volume[0] *= (Matrix::Identity() + gradient).determinant();
  ASSERT_EQ(update_stress(points, {g.data(), 9}, law, measure, {1e-3, 0.0, 0.1}).failed, 0u);
}

std::vector<SoilLawOptions> laws() {
  MohrCoulombOptions mohr_coulomb{2e7, 0.3, 3e3, 0.5, 0.1};
  mohr_coulomb.residual = MohrCoulombOptions::Residual{1e3, 0.4, 0.0, {0.02, 0.0}};
  MuIOptions beads;
  beads.young_modulus = 2e7, beads.poisson_ratio = 0.3, beads.grain_diameter = 1e-3;
  return {mohr_coulomb, TrescaOptions{2e7, 0.45, 8e3, {}}, VonMisesOptions{2e7, 0.45, 8e3, {}},
          DruckerPragerOptions{2e7, 0.3, 3e3, 0.5, 0.1}, beads};
}

TEST(PlasticRotation, TurnsTheStressOfAYieldingPointAndChangesNothingElse) {
  Matrix shear;
  shear << 1e-4, 3e-4, 4e-4, -1e-4, 0, 2e-4, 2e-4, 0, -3e-4;
  const Matrix turn =
      (Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, -1).normalized())).toRotationMatrix();
  for (const SoilLawOptions& options : laws())
    for (const StrainMeasure measure : {StrainMeasure::jaumann, StrainMeasure::hencky}) {
      const auto law = make_soil_model(options);
      SoilParticles<3> still = one_point(*law, measure), turned = one_point(*law, measure);
      Matrix frame = Matrix::Identity();
      for (int round = 0; round < 5; ++round) {
        for (int i = 0; i < 20; ++i) {
          take_step(still, shear, *law, measure);
          take_step(turned, frame * shear * frame.transpose(), *law, measure);
        }
        for (int i = 0; i < 40; ++i) {
          take_step(turned, turn - Matrix::Identity(), *law, measure);
          take_step(still, Matrix::Zero(), *law, measure);  // laws of rate relax meanwhile
          frame = turn * frame;
        }
        const Matrix expected = frame * stress_of(still) * frame.transpose();
        EXPECT_LT((stress_of(turned) - expected).norm(), 1e-10 * expected.norm())
            << law->name() << " round " << round;
        EXPECT_NEAR(turned.history[0][0], still.history[0][0], 1e-12) << law->name();
      }
      EXPECT_GT(still.history[0][0], 0.01) << law->name();
    }
}

/// The ratio eta_0 of Sekiguchi-Ohta's consolidation lies in the soil and turns with it.
TEST(PlasticRotation, TurnsTheAnisotropyOfSekiguchiOhtaWithTheSoil) {
  SekiguchiOhtaOptions clay;
  clay.compression_index = 0.2, clay.swelling_index = 0.04, clay.critical_stress_ratio = 1.1;
  clay.consolidation_ratio = 0.5;
  const auto law = make_soil_model(clay);
  SoilParticles<3> still = one_point(*law, StrainMeasure::jaumann),
                   turned = one_point(*law, StrainMeasure::jaumann);
  Matrix shear;
  shear << 1e-4, 3e-4, 4e-4, -1e-4, 0, 2e-4, 2e-4, 0, -3e-4;
  const Matrix turn =
      (Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, -1).normalized())).toRotationMatrix();
  Matrix frame = Matrix::Identity();
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 20; ++i) {
      take_step(still, shear, *law, StrainMeasure::jaumann);
      take_step(turned, frame * shear * frame.transpose(), *law, StrainMeasure::jaumann);
    }
    for (int i = 0; i < 40; ++i) {
      take_step(turned, turn - Matrix::Identity(), *law, StrainMeasure::jaumann);
      frame = turn * frame;
    }
    const Matrix expected = frame * stress_of(still) * frame.transpose();
    EXPECT_LT((stress_of(turned) - expected).norm(), 1e-9 * expected.norm()) << round;
  }
}

TEST(PlasticRotation, HenckyAndJaumannAgreeAsLongAsElasticStrainsAreSmall) {
  for (const SoilLawOptions& options : laws()) {
    const auto law = make_soil_model(options);
    SoilParticles<3> a = one_point(*law, StrainMeasure::jaumann),
                     b = one_point(*law, StrainMeasure::hencky);
    Matrix shear = Matrix::Zero();
    shear(0, 0) = 2e-4, shear(2, 2) = -2e-4, shear(0, 1) = 5e-5;
    for (int i = 0; i < 100; ++i) {
      take_step(a, shear, *law, StrainMeasure::jaumann);
      take_step(b, shear, *law, StrainMeasure::hencky);
    }
    EXPECT_LT((stress_of(a) - stress_of(b)).norm(), 5e-3 * stress_of(a).norm()) << law->name();
  }
}

TEST(PlasticRotation, AProblemInThePlaneIsTheSameInTwoAndThreeDimensions) {
  const std::array<double, 4> plane{3e-3, -8e-3, 2.5e-2, -4e-3};  // strain and much rotation
  Matrix space = Matrix::Zero();
  space(0, 0) = plane[0], space(0, 2) = plane[1], space(2, 0) = plane[2], space(2, 2) = plane[3];
  for (const SoilLawOptions& options : laws())
    for (const StrainMeasure measure : {StrainMeasure::jaumann, StrainMeasure::hencky}) {
      const auto law = make_soil_model(options);
      SoilParticles<3> three = one_point(*law, measure);
      SoilParticles<2> two = one_point<2>(*law, measure);
      for (int i = 0; i < 30; ++i) {
        take_step(three, space, *law, measure);
        two.volume[0] = three.volume[0];
        ASSERT_EQ(update_stress(two, plane, *law, measure, {1e-3, 0.0, 0.1}).failed, 0u);
      }
      const Matrix expected = stress_of(three);
      const SymTensor t = get_tensor(two.stress, 0);
      const double tolerance = 1e-11 * expected.norm();
      EXPECT_NEAR(t.xx, expected(0, 0), tolerance) << law->name();
      EXPECT_NEAR(t.yy, expected(1, 1), tolerance) << law->name();
      EXPECT_NEAR(t.zz, expected(2, 2), tolerance) << law->name();
      EXPECT_NEAR(t.zx, expected(0, 2), tolerance) << law->name();
    }
}

/// Grains that fill less than half of the room they started in do not touch, whatever the steps
/// that led there; when they come together they press again, and from nothing.
TEST(GrainsApart, CarryNothingUntilTheyAreTogetherAgain) {
  const auto law = make_soil_model(MohrCoulombOptions{2e7, 0.3, 3e3, 0.5, 0.1});
  const Matrix squeeze = -1e-4 * Matrix::Identity();
  for (const StrainMeasure measure : {StrainMeasure::jaumann, StrainMeasure::hencky}) {
    SoilParticles<3> points = one_point(*law, measure);
    points.volume[0] = 2.1;
    take_step(points, squeeze, *law, measure);
    EXPECT_EQ(stress_of(points).norm(), 0.0);
    points.volume[0] = 1.9;
    take_step(points, squeeze, *law, measure);
    EXPECT_LT(stress_of(points).trace(), -1e3);
    EXPECT_GT(stress_of(points).trace(), -20e3);
  }
}

}  // namespace
}  // namespace mudlark

// Strain measures: logarithms of tensors, large compression, rotation, simple shear.
#include "soil/kinematics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "materials/linear_elastic.hpp"

namespace mudlark {
namespace {

using Matrix = Eigen::Matrix3d;
constexpr double pi = 3.14159265358979323846;

Matrix to_matrix(const SymTensor& t) {
  Matrix m;
  m << t.xx, t.xy, t.zx, t.xy, t.yy, t.yz, t.zx, t.yz, t.zz;
  return m;
}
SymTensor to_tensor(const Matrix& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)};
}
Matrix rotation(double x, double y, double z) {
  return (Eigen::AngleAxisd(x, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(y, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(z, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}
double largest_difference(const Matrix& a, const Matrix& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(HalfLog, OfARotatedStretchIsTheRotatedLogarithm) {
  const Matrix r = rotation(0.3, -1.1, 2.0);
  const std::vector<Eigen::Vector3d> cases{
      {1.5, 0.7, 1.1},                  // far apart
      {1.2, 1.2, 0.8},                  // two equal
      {1.2, 1.2 + 1e-9, 0.8},           // two nearly equal
      {1.2, 1.2 + 1e-13, 1.2 - 1e-13},  // three nearly equal
      {1.0 + 1e-9, 1.0, 1.0 - 2e-9},    // nearly no stretch
      {1.0 + 4e-4, 1.0, 1.0 - 4e-4},    // both sides of the series' limit
      {1.0 + 6e-4, 1.0, 1.0 - 6e-4},
      {0.05, 1.0, 20.0}};
  for (const Eigen::Vector3d& stretch : cases) {
    const Eigen::Vector3d square = stretch.cwiseProduct(stretch);
    const Matrix b = r * square.asDiagonal() * r.transpose();
    const Matrix exact =
        r * Eigen::Vector3d(stretch.array().log().matrix()).asDiagonal() * r.transpose();
    EXPECT_LT(largest_difference(to_matrix(half_log(to_tensor(b))), exact),
              1e-14 * (1.0 + square.maxCoeff() / square.minCoeff()))
        << stretch.transpose();
  }
}

TEST(HalfLog, AndTwiceTheExponentialUndoEachOther) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double size : {1e-12, 1e-6, 3e-4, 1e-2, 0.5})
    for (int i = 0; i < 20; ++i) {
      SymTensor strain{unit(generator), unit(generator), unit(generator),
                       unit(generator), unit(generator), unit(generator)};
      strain = size * strain;
      const Matrix back = to_matrix(half_log(exp_twice(strain)));
      EXPECT_LT(largest_difference(back, to_matrix(strain)), 1e-14 * (1.0 + 100.0 * size));
    }
}

/// One point in a stress-free state; carries what the strain measure asks for.
template <int D>
SoilParticles<D> one_point(StrainMeasure measure, const SoilModel& law, const SymTensor& stress) {
  SoilParticles<D> points;
  points.carries_deformation = measure == StrainMeasure::small;
  points.resize(1);
  points.volume[0] = points.start_volume[0] = 2.0;
  set_tensor(points.stress, 0, stress);
  initialise_material_state(points, law, measure, 0.4);
  return points;
}

/// Takes the point through one step with gradient g (row-major, D x D).
template <int D>
void take_step(SoilParticles<D>& points, const Eigen::Matrix<double, D, D, Eigen::RowMajor>& g,
               const SoilModel& law, StrainMeasure measure) {
  points.volume[0] *= (Eigen::Matrix<double, D, D>::Identity() + g).determinant();
  const std::span<const double> gradient(g.data(), static_cast<std::size_t>(D * D));
  ASSERT_EQ(update_stress(points, gradient, law, measure, {1.0, 0.0, 1.0}).failed, 0u);
}

constexpr std::array<StrainMeasure, 5> every_measure{
    StrainMeasure::small, StrainMeasure::logarithmic, StrainMeasure::hencky,
    StrainMeasure::objective, StrainMeasure::jaumann};

/// Vertical stress over constrained modulus after confined compression to J, in closed form.
double confined_stress(StrainMeasure measure, double j) {
  switch (measure) {
    case StrainMeasure::small:
      return j - 1.0;
    case StrainMeasure::logarithmic:
    case StrainMeasure::jaumann:
      return std::log(j);
    case StrainMeasure::hencky:
      return std::log(j) / j;
    case StrainMeasure::objective:
      return 1.0 - 1.0 / j;
  }
  return 0.0;
}

template <int D>
void expect_confined_compression(StrainMeasure measure) {
  const LinearElastic law({1e6, 0.3});
  SoilParticles<D> points = one_point<D>(measure, law, {});
  const int steps = 3000;
  const double ratio = std::pow(0.7, 1.0 / steps), modulus = law.wave_modulus({}, {});
  Eigen::Matrix<double, D, D, Eigen::RowMajor> g;
  g.setZero();
  g(D - 1, D - 1) = ratio - 1.0;
  for (int i = 0; i < steps; ++i) take_step<D>(points, g, law, measure);
  EXPECT_NEAR(points.volume[0] / 2.0, 0.7, 1e-12);
  const double exact = modulus * confined_stress(measure, 0.7);
  // Also the rate form: its mid-step rule gives 1/J exactly, in any number of steps.
  // Jaumann's sums mid-step increments towards the logarithm, of second order in the step.
  const double tolerance = measure == StrainMeasure::jaumann ? 1e-8 : 1e-11;
  const SymTensor stress = get_tensor(points.stress, 0);
  EXPECT_NEAR(stress.zz / exact, 1.0, tolerance);
  EXPECT_NEAR(stress.zx, 0.0, 1e-6);
  if (measure != StrainMeasure::objective) {
    EXPECT_NEAR(stress.xx / (0.3 / 0.7 * exact), 1.0, tolerance);
    EXPECT_NEAR(stress.yy / (0.3 / 0.7 * exact), 1.0, tolerance);
  }
}

TEST(UpdateStress, FollowsTheClosedFormOfEachStrainMeasureInConfinedCompression) {
  for (const StrainMeasure measure : every_measure) {
    SCOPED_TRACE(static_cast<int>(measure));
    expect_confined_compression<2>(measure);
    expect_confined_compression<3>(measure);
  }
}

/// Turns a stressed point by 90 degrees about an axis in equal rotations.
template <int D>
void expect_rotation_carries_stress(StrainMeasure measure, const SymTensor& start,
                                    const Eigen::Vector3d& axis) {
  const LinearElastic law({1e6, 0.3});
  SoilParticles<D> points = one_point<D>(measure, law, start);
  const int steps = 400;
  const Matrix small = Eigen::AngleAxisd(0.5 * pi / steps, axis).toRotationMatrix();
  Eigen::Matrix<double, D, D, Eigen::RowMajor> g;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      g(i, j) = small(D == 2 ? 2 * i : i, D == 2 ? 2 * j : j) - (i == j ? 1.0 : 0.0);
  for (int i = 0; i < steps; ++i) take_step<D>(points, g, law, measure);
  const Matrix turned = Eigen::AngleAxisd(0.5 * pi, axis).toRotationMatrix();
  const Matrix exact = turned * to_matrix(start) * turned.transpose();
  const double scale = to_matrix(start).cwiseAbs().maxCoeff();
  EXPECT_LT(largest_difference(to_matrix(get_tensor(points.stress, 0)), exact), 1e-10 * scale);
}

TEST(UpdateStress, RigidRotationOnlyTurnsTheStress) {
  for (const StrainMeasure measure :
       {StrainMeasure::logarithmic, StrainMeasure::hencky, StrainMeasure::objective}) {
    SCOPED_TRACE(static_cast<int>(measure));
    // A stress of a tenth of the modulus: finite stretch, not only a small one.
    expect_rotation_carries_stress<2>(measure, {-1e5, -3e4, 5e4, 0, 0, 2e4},
                                      Eigen::Vector3d::UnitY());
    expect_rotation_carries_stress<3>(measure, {-1e5, -3e4, 5e4, 1e4, -3e4, 2e4},
                                      Eigen::Vector3d(1.0, -2.0, 0.5).normalized());
  }
}

TEST(UpdateStress, StartsFromTheInitialStress) {
  const LinearElastic law({1e6, 0.3});
  const SymTensor start{-1e5, -3e4, 5e4, 0, 0, 2e4};
  for (const StrainMeasure measure : every_measure) {
    SoilParticles<2> points = one_point<2>(measure, law, start);
    take_step<2>(points, Eigen::Matrix<double, 2, 2, Eigen::RowMajor>::Zero(), law, measure);
    const Matrix now = to_matrix(get_tensor(points.stress, 0));
    EXPECT_LT(largest_difference(now, to_matrix(start)), 1e-8) << static_cast<int>(measure);
  }
}

/// Simple shear F = [1 g; 0 1] (x along, z across) in `steps` equal increments.
SymTensor shear(StrainMeasure measure, double amount, int steps, const SoilModel& law) {
  SoilParticles<2> points = one_point<2>(measure, law, {});
  Eigen::Matrix<double, 2, 2, Eigen::RowMajor> g;
  g << 0.0, amount / steps, 0.0, 0.0;
  for (int i = 0; i < steps; ++i) take_step<2>(points, g, law, measure);
  return get_tensor(points.stress, 0);
}

TEST(UpdateStress, SimpleShearFollowsTheClosedForms) {
  const LinearElastic law({1e6, 0.3});
  const double shear_modulus = law.shear_modulus(), g = 1.2;
  // ln b of simple shear: eigenvalues exp(+-2 asinh(g/2)); 1/2 ln b = asinh(g/2)/sqrt(1+g^2/4)
  // [g/2 1; 1 -g/2].
  const double factor = std::asinh(g / 2) / std::sqrt(1 + g * g / 4);
  for (const StrainMeasure measure : {StrainMeasure::logarithmic, StrainMeasure::hencky}) {
    const SymTensor stress = shear(measure, g, 60, law);
    EXPECT_NEAR(stress.zx / shear_modulus, 2 * factor, 1e-10);
    EXPECT_NEAR(stress.xx / shear_modulus, factor * g, 1e-10);
    EXPECT_NEAR(stress.zz / shear_modulus, -factor * g, 1e-10);
    EXPECT_NEAR(stress.yy / shear_modulus, 0.0, 1e-10);
  }
  const SymTensor linear = shear(StrainMeasure::small, g, 60, law);
  EXPECT_NEAR(linear.zx / shear_modulus, g, 1e-10);
  EXPECT_NEAR(linear.xx / shear_modulus, 0.0, 1e-10);
}

TEST(UpdateStress, TheObjectiveRateTendsToJaumannsClosedFormInSimpleShear) {
  // Hill's rate without change of volume is Jaumann's: tau = G sin g, sigma_xx = G (1 - cos g).
  const LinearElastic law({1e6, 0.3});
  const double g = 1.2;
  std::vector<double> errors;
  for (const int steps : {1000, 2000, 4000}) {
    const SymTensor stress =
        (1.0 / law.shear_modulus()) * shear(StrainMeasure::objective, g, steps, law);
    errors.push_back(
        std::max({std::abs(stress.zx - std::sin(g)), std::abs(stress.xx - 1 + std::cos(g)),
                  std::abs(stress.zz + 1 - std::cos(g))}));
  }
  EXPECT_LT(errors[2], 2e-4);  // first order in the step
  EXPECT_GT(errors[0] / errors[1], 1.9);
  EXPECT_GT(errors[1] / errors[2], 1.9);
}

TEST(UpdateStress, PlaneStrainIn2DIsThreeDimensionsWithoutTheMiddleAxis) {
  const LinearElastic law({1e6, 0.3});
  const SymTensor start{-3e4, -2e4, -5e4, 0, 0, 1e4};
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> unit(-0.02, 0.02);
  for (const StrainMeasure measure : every_measure) {
    SoilParticles<2> plane = one_point<2>(measure, law, start);
    SoilParticles<3> space = one_point<3>(measure, law, start);
    for (int i = 0; i < 50; ++i) {
      Eigen::Matrix<double, 2, 2, Eigen::RowMajor> g2;
      g2 << unit(generator), unit(generator), unit(generator), unit(generator);
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor> g3;
      g3.setZero();
      g3(0, 0) = g2(0, 0), g3(0, 2) = g2(0, 1), g3(2, 0) = g2(1, 0), g3(2, 2) = g2(1, 1);
      take_step<2>(plane, g2, law, measure);
      take_step<3>(space, g3, law, measure);
    }
    const Matrix a = to_matrix(get_tensor(plane.stress, 0)),
                 b = to_matrix(get_tensor(space.stress, 0));
    EXPECT_LT(largest_difference(a, b), 1e-6) << static_cast<int>(measure);
  }
}

TEST(UpdateStress, GoesThroughAllPointsInBatches) {
  const LinearElastic law({1e6, 0.3});
  const std::size_t count = 301;  // more than two batches and a rest
  SoilParticles<2> points;
  points.resize(count);
  for (std::size_t p = 0; p < count; ++p) points.volume[p] = points.start_volume[p] = 1.0;
  initialise_material_state(points, law, StrainMeasure::logarithmic, 0.4);
  std::vector<double> gradient(count * 4, 0.0);
  for (std::size_t p = 0; p < count; ++p) gradient[3 * count + p] = 1e-4 * static_cast<double>(p);
  ASSERT_EQ(
      update_stress(points, gradient, law, StrainMeasure::logarithmic, {1.0, 0.0, 1.0}).failed, 0u);
  for (std::size_t p = 0; p < count; ++p) {
    const double e = 1e-4 * static_cast<double>(p);
    EXPECT_NEAR(points.stress[2][p], law.wave_modulus({}, {}) * std::log1p(e), 1e-6);
  }
}

/// Points whose strains are of like size share a rule for the logarithm; each size has its own.
TEST(UpdateStress, TakesTheSameLogarithmAsOnePointAtATime) {
  const LinearElastic law({1.0, 0.3});
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double size : {1e-12, 1e-4, 2.5e-4, 4e-3, 8e-3, 0.05, 0.08, 0.2, 0.6}) {
    SoilParticles<3> points;
    points.resize(21);
    std::vector<SymTensor> strain;
    for (std::size_t p = 0; p < points.size(); ++p) {
      SymTensor t{unit(generator), unit(generator), unit(generator),
                  unit(generator), unit(generator), unit(generator)};
      strain.push_back(size / std::sqrt(t.squared_norm()) * t);
      set_tensor(points.elastic, p, exp_twice(strain.back()));
    }
    const std::vector<double> gradient(points.size() * 9, 0.0);
    update_stress(points, gradient, law, StrainMeasure::logarithmic, {1.0, 0.0, 1.0});
    for (std::size_t p = 0; p < points.size(); ++p) {
      const SymTensor found = law.elastic_strain(get_tensor(points.stress, p));
      EXPECT_LT(largest_difference(to_matrix(found), to_matrix(strain[p])),
                2e-15 * (1.0 + 10.0 * size))
          << size;
    }
  }
}

}  // namespace
}  // namespace mudlark

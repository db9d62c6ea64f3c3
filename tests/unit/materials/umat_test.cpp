#include "materials/umat.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "materials/linear_elastic.hpp"
#include "materials/von_mises.hpp"
#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

constexpr double young = 2e7, poisson = 0.3;

std::string library(const std::string& name) {
  return std::string(MUDLARK_UMATS) + "/" + name + ".so";
}
UmatOptions options(const std::string& name, std::vector<double> properties, int states = 0) {
  return {library(name), std::move(properties), states, {}, "SAND"};
}
const SymTensor start{-1e5, -8e4, -1.2e5, 5e3, -4e3, 3e3};
const SymTensor turns[] = {{1e-4, -2e-4, -4e-4, 3e-5, -5e-5, 2e-4},
                           {-3e-4, 1e-4, 2e-4, -1e-4, 2e-4, 1e-4},
                           {2e-3, 1e-3, -4e-3, 1e-3, 2e-3, -3e-3}};

TEST(Umat, OfLinearElasticityInFortranAndInCEqualsTheNativeLaw) {
  const LinearElastic native({young, poisson});
  for (const char* name : {"elastic", "elastic_c"}) {
    const Umat law(options(name, {young, poisson}));
    EXPECT_NEAR(law.wave_modulus({}, {}), native.wave_modulus({}, {}), 1e-8 * young);
    EXPECT_NEAR(law.shear_modulus(), native.shear_modulus(), 1e-8 * young);
    EXPECT_NEAR(law.earth_pressure_at_rest(), poisson / (1.0 - poisson), 1e-12);
    TestPoint ours(law, start), theirs(native, start);
    for (const SymTensor& strain : turns) {
      ours.strain(strain, 10);
      theirs.strain(strain, 10);
      EXPECT_LT(largest_difference(ours.stress, theirs.stress), 1e-8 * 1e5);
    }
    EXPECT_NEAR(law.wave_modulus({&ours.stress, 1}, ours.history), native.wave_modulus({}, {}),
                1e-8 * young);
  }
}

TEST(Umat, OfVonMisesPlasticityInFortranEqualsTheNativeLaw) {
  const VonMises native({young, poisson, 3e4});
  const Umat law(options("von_mises", {young, poisson, 3e4}, 1));
  TestPoint ours(law, start), theirs(native, start);
  for (const SymTensor& strain : turns) {
    ours.strain(strain, 20);
    theirs.strain(strain, 20);
    EXPECT_LT(largest_difference(ours.stress, theirs.stress), 1e-8 * 1e5);
  }
  EXPECT_GT(theirs.history[0], 1e-3);
  EXPECT_NEAR(ours.history[0], theirs.history[0], 1e-8 * theirs.history[0]);
}

TEST(Umat, IsPassedWhatAbaqusPasses) {
  const Umat law(options("witness", {young, poisson}, 60));
  TestPoint point(law, start);
  const std::array<double, 6> strain{1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3};
  std::copy(strain.begin(), strain.end(), point.history.begin() + 60);
  const SymTensor increment{1e-5, 2e-5, 3e-5, 4e-5, 5e-5, 6e-5};
  const std::array<double, 9> rotation{1, 2, 3, 4, 5, 6, 7, 8, 9};
  MaterialPoints points{{&increment, 1}, {&point.stress, 1}, point.history};
  points.dt = 0.25, points.time = 2.0, points.length = 0.1;
  points.rotation = {&rotation, 1};
  ASSERT_EQ(law.update_stress(points), 0u);
  const std::vector<double> expected{
      // STRAN, DSTRAN: 11 22 33 12 13 23, shear doubled
      1e-3, 2e-3, 3e-3, 8e-3, 12e-3, 10e-3, 1e-5, 2e-5, 3e-5, 8e-5, 12e-5, 10e-5,
      // DROT column by column, DFGRD1 - DFGRD0
      1, 4, 7, 2, 5, 8, 3, 6, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0,
      // TIME, DTIME, CELENT, PNEWDT
      2.0, 2.0, 0.25, 0.1, 1.0,
      // NDI, NSHR, NTENS, NSTATV, NPROPS
      3, 3, 6, 60, 2,
      // NOEL, NPT, LAYER, KSPT, KSTEP, KINC
      1, 1, 1, 1, 1, 2,
      // TEMP, DTEMP, PREDEF, DPRED, COORDS
      0, 0, 0, 0, 0,
      // CMNAME
      'S', ' ', 80};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_DOUBLE_EQ(point.history[i], expected[i]) << i;
  // The strain that is kept has grown, in the order of this program.
  EXPECT_DOUBLE_EQ(point.history[64], 5e-3 + 5e-5);
}

TEST(Umat, StartsFromTheGivenStateAndTurnsItsStrainWithTheStress) {
  UmatOptions with = options("von_mises", {young, poisson, 3e4}, 1);
  with.initial_state = {0.7};
  const Umat law(with);
  EXPECT_DOUBLE_EQ(TestPoint(law, start).history[0], 0.7);
  ASSERT_EQ(law.history_tensors().size(), 1u);
  EXPECT_EQ(law.history_tensors()[0], 1u);
  EXPECT_EQ(law.history_names().size(), 8u);
  EXPECT_EQ(law.history_names()[0], "state variable 1 [-]");
}

TEST(Umat, ThatAsksForSmallerStepsGetsThem) {
  const LinearElastic native({young, poisson});
  const Umat law(options("careful", {young, poisson, 1.0}, 1));
  TestPoint ours(law, start), theirs(native, start);
  ours.strain(turns[2]);
  theirs.strain(turns[2]);
  EXPECT_LT(largest_difference(ours.stress, theirs.stress), 1e-8 * 1e5);
  EXPECT_GE(ours.history[0], 60.0);  // 6e-3 of engineering shear in steps of at most 1e-4
}

TEST(Umat, ThatGivesUpNamesThePoint) {
  const Umat law(options("careful", {young, poisson, 1.02e-3}, 1));
  TestPoint point(law, start);
  point.strain({0, 0, -1.05e-3, 0, 0, 0}, 21);  // it looks at the strain before the step
  const SymTensor held = point.stress, more{0, 0, -1e-5, 0, 0, 0};
  std::array<unsigned char, 1> failed{};
  MaterialPoints points{{&more, 1}, {&point.stress, 1}, point.history};
  points.failed = failed;
  EXPECT_EQ(law.update_stress(points), 1u);
  EXPECT_EQ(failed[0], 1);
  EXPECT_EQ(point.stress, held);
}

TEST(Umat, RefusesLibrariesThatItCannotUse) {
  EXPECT_THROW(Umat(options("no_such_file", {})), InputError);
  EXPECT_THROW(Umat(options("nothing", {})), InputError);
}

TEST(LargestWaveModulus, OfAnAnisotropicTangentIsThatOfItsStiffestDirection) {
  std::array<double, 36> d{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) d[i + 6 * j] = 1.0;
    d[7 * i] = 3.0, d[7 * (i + 3)] = 1.0;
  }
  d[7] = 8.0;  // stiffer along the second axis
  EXPECT_NEAR(largest_wave_modulus(d), 8.0, 1e-7);
}

}  // namespace
}  // namespace mudlark

// Principal values and directions against tensors that are built from them.
#include "materials/invariants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mudlark {
namespace {

double largest_entry(const SymTensor& t) {
  return std::max({std::abs(t.xx), std::abs(t.yy), std::abs(t.zz), std::abs(t.xy), std::abs(t.yz),
                   std::abs(t.zx)});
}
double difference(const SymTensor& a, const SymTensor& b) { return largest_entry(a + -1.0 * b); }

/// Values along the axes of a turned frame (Euler angles).
SymTensor turned(const PrincipalValues& v, double a, double b, double c) {
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b),
               cc = std::cos(c), sc = std::sin(c);
  const std::array<std::array<double, 3>, 3> n{
      {{ca * cb, sa * cb, -sb},
       {ca * sb * sc - sa * cc, sa * sb * sc + ca * cc, cb * sc},
       {ca * sb * cc + sa * sc, sa * sb * cc - ca * sc, cb * cc}}};
  SymTensor t;
  for (std::size_t i = 0; i < 3; ++i)
    t += v[i] * SymTensor{n[i][0] * n[i][0], n[i][1] * n[i][1], n[i][2] * n[i][2],
                          n[i][0] * n[i][1], n[i][1] * n[i][2], n[i][2] * n[i][0]};
  return t;
}

const std::array<PrincipalValues, 9> samples{{{3.0, 2.0, -4.0},
                                              {2.0, 2.0, -1.0},
                                              {5.0, -1.0, -1.0},
                                              {1.0, 1.0, 1.0},
                                              {1.0 + 1e-9, 1.0, 1.0 - 3e-9},
                                              {1.0 + 1e-13, 1.0, 0.5},
                                              {1e3, 1e-3, -1e-6},
                                              {0.0, 0.0, 0.0},
                                              {-1.0, -2.0, -300.0}}};

TEST(PrincipalAxes, FindTheValuesOfATurnedTensorAndItsWayBack) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  for (const PrincipalValues& v : samples)
    for (int i = 0; i < 50; ++i) {
      const SymTensor t = turned(v, angle(generator), angle(generator), angle(generator));
      const double tolerance = 2e-15 * (std::abs(v[0]) + std::abs(v[2]));
      const PrincipalAxes axes(t);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(axes.values()[k], v[k], 2.0 * tolerance);
      EXPECT_LE(difference(axes.tensor(axes.values()), t), 4.0 * tolerance);
      const PrincipalValues alone = principal_values(t);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(alone[k], v[k], tolerance + 3e-8 * (v[0] - v[2]));
    }
}

TEST(PrincipalAxes, InPlaneStrainKeepYApartWhereverItsValueLies) {
  for (const double yy : {-5.0, 0.3, 7.0}) {
    const SymTensor t{1.0, yy, -2.0, 0.0, 0.0, 1.5};
    const PrincipalAxes axes(t);
    PrincipalValues expected{-0.5 + std::hypot(1.5, 1.5), yy, -0.5 - std::hypot(1.5, 1.5)};
    std::sort(expected.rbegin(), expected.rend());
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(axes.values()[k], expected[k], 1e-14);
    EXPECT_LT(difference(axes.tensor(axes.values()), t), 1e-14);
    PrincipalValues other = axes.values();
    for (double& value : other) value *= -2.0;
    EXPECT_LT(difference(axes.tensor(other), -2.0 * t), 1e-14);
  }
}

TEST(PrincipalAxes, GiveThePlanesAnswerWhenASmallShearLeavesThePlane) {
  const SymTensor plane{1.0, -4.0, -2.0, 0.0, 0.0, 1.5}, space{1.0, -4.0, -2.0, 1e-14, 0.0, 1.5};
  const PrincipalAxes a(plane), b(space);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a.values()[k], b.values()[k], 1e-14);
  EXPECT_LT(difference(a.tensor({3.0, 2.0, 1.0}), b.tensor({3.0, 2.0, 1.0})), 1e-13);
}

TEST(Invariants, OfAKnownDeviator) {
  const SymTensor t = turned({7.0, 1.0, -2.0}, 0.4, 1.0, -2.0);  // deviator 5, -1, -4
  EXPECT_NEAR(mean_of(t), 2.0, 1e-14);
  EXPECT_NEAR(second_invariant(t), 21.0, 1e-13);
  EXPECT_NEAR(third_invariant(t), 20.0, 1e-12);
  EXPECT_NEAR(determinant(t), -14.0, 1e-12);
  EXPECT_NEAR(deviator_of(t).squared_norm(), 42.0, 1e-13);
}

}  // namespace
}  // namespace mudlark

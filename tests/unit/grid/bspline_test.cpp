#include "grid/bspline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mudlark {
namespace {

constexpr double round_off = 1e-14;

/// Places on the axis: nodes, midpoints, their neighbours in floating point, and random ones.
std::vector<double> places() {
  std::vector<double> all;
  for (const double x : {-2.0, -0.5, 0.0, 0.5, 1.0, 7.5, 12.0})
    for (const double nudge : {-1e-15, 0.0, 1e-15}) all.push_back(x + nudge);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> anywhere(-3.0, 20.0);
  for (int i = 0; i < 200; ++i) all.push_back(anywhere(generator));
  return all;
}

template <int Degree>
void expect_consistent_moments() {
  for (const double x : places()) {
    const BSpline<Degree> spline(x);
    double sum = 0.0, slopes = 0.0, first = 0.0, slope_moment = 0.0;
    for (std::size_t k = 0; k < spline.weight.size(); ++k) {
      const double distance = spline.first + static_cast<double>(k) - x;
      EXPECT_GE(spline.weight[k], -round_off);
      sum += spline.weight[k];
      slopes += spline.slope[k];
      first += spline.weight[k] * distance;
      slope_moment += spline.slope[k] * distance;
    }
    EXPECT_NEAR(sum, 1.0, round_off) << "at " << x;
    EXPECT_NEAR(slopes, 0.0, round_off) << "at " << x;
    EXPECT_NEAR(first, 0.0, round_off) << "at " << x;
    EXPECT_NEAR(slope_moment, 1.0, round_off) << "at " << x;
  }
}

TEST(BSpline, WeightsSumToOneAndReproduceThePlaceAndItsSlope) {
  expect_consistent_moments<1>();
  expect_consistent_moments<2>();
  expect_consistent_moments<3>();
}

/// Weight or slope of one node, zero beyond the reach.
template <int Degree>
double at_node(double x, int node, bool slope) {
  const BSpline<Degree> spline(x);
  const int k = node - spline.first;
  if (k < 0 || k > Degree) return 0.0;
  return slope ? spline.slope[static_cast<std::size_t>(k)]
               : spline.weight[static_cast<std::size_t>(k)];
}

TEST(BSpline, SlopeOfTheCubicIsTheDifferenceOfTwoQuadratics) {
  for (const double x : places())
    for (int node = static_cast<int>(x) - 5; node < x + 5; ++node) {
      const double quadratics = at_node<2>(x + 0.5, node, false) - at_node<2>(x - 0.5, node, false);
      EXPECT_NEAR(at_node<3>(x, node, true), quadratics, round_off) << "at " << x;
    }
}

/// The closed forms of NUMERICS C2, by distance.
double quadratic(double r) {
  r = std::abs(r);
  return r < 0.5 ? 0.75 - r * r : r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.0;
}
double cubic(double r) {
  r = std::abs(r);
  return r < 1.0   ? 2.0 / 3.0 - r * r + 0.5 * r * r * r
         : r < 2.0 ? (2.0 - r) * (2.0 - r) * (2.0 - r) / 6.0
                   : 0.0;
}

TEST(BSpline, WeightsAreTheKnownPolynomialsOfTheDistance) {
  for (const double x : places())
    for (int node = static_cast<int>(x) - 4; node < x + 4; ++node) {
      EXPECT_NEAR(at_node<1>(x, node, false), std::max(0.0, 1.0 - std::abs(x - node)), round_off);
      EXPECT_NEAR(at_node<2>(x, node, false), quadratic(x - node), round_off);
      EXPECT_NEAR(at_node<3>(x, node, false), cubic(x - node), round_off);
    }
}

TEST(BSpline, SecondMomentsAreAQuarterAndAThird) {  // the inertia that APIC divides by
  for (const double x : places()) {
    const BSpline<2> two(x);
    const BSpline<3> three(x);
    double second = 0.0, third = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      second += two.weight[k] * std::pow(two.first + static_cast<double>(k) - x, 2);
    for (std::size_t k = 0; k < 4; ++k)
      third += three.weight[k] * std::pow(three.first + static_cast<double>(k) - x, 2);
    EXPECT_NEAR(second, 0.25, round_off);
    EXPECT_NEAR(third, 1.0 / 3.0, round_off);
  }
}

}  // namespace
}  // namespace mudlark

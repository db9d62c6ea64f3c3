#include "grid/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Shape, BoxHoldsItsFacesAndItsFractionOfACellIsExact) {
  const Shape box{BoxShape{{0.0, -infinity, 0.0}, {1.0, infinity, 0.37}}};
  EXPECT_TRUE(box.contains({1.0, 0.0, 0.37}));
  EXPECT_FALSE(box.contains({1.0, 0.0, 0.3700001}));
  EXPECT_DOUBLE_EQ(fraction_inside(box, {0.9, 0, 0.3}, {1.1, 0, 0.4}, 2), 0.5 * 0.7);
  EXPECT_EQ(fraction_inside(box, {1.0, 0, 0.0}, {1.1, 0, 0.1}, 2), 0.0);
}

TEST(Shape, BoxFractionIn3DCountsAllThreeAxes) {
  const Shape box{BoxShape{{0, 0, 0}, {1, 1, 1}}};
  EXPECT_DOUBLE_EQ(fraction_inside(box, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, 3), 0.125);
}

TEST(Shape, PolygonWithANotchIsOutsideInItsNotch) {
  const Shape polygon{PolygonShape{{{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}}};
  EXPECT_TRUE(polygon.contains({2.0, 7.0, 0.9}));
  EXPECT_FALSE(polygon.contains({2.0, 7.0, 1.1}));
  EXPECT_TRUE(polygon.contains({0.5, 7.0, 2.0}));
}

TEST(Shape, APrismAlongYHasTheSharesOfThePlaneInSpace) {
  for (const Shape& prism : {Shape{PolygonShape{{{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}}},
                             Shape{BelowShape{{{0, 0.3}, {4, 2.1}}}}}) {
    const double plane = fraction_inside(prism, {1.7, 0, 1.0}, {2.1, 0, 1.3}, 2);
    EXPECT_GT(plane, 0.0);
    EXPECT_LT(plane, 1.0);
    EXPECT_EQ(fraction_inside(prism, {1.7, 0.1, 1.0}, {2.1, 0.4, 1.3}, 3), plane);
  }
}

TEST(Shape, HorizontalPolygonIsAPrismBetweenItsHeights) {
  const Shape polygon{PolygonShape{{{0, 0}, {1, 0}, {0, 1}}, false, 2.0, 3.0}};
  EXPECT_TRUE(polygon.contains({0.2, 0.2, 2.5}));
  EXPECT_FALSE(polygon.contains({0.2, 0.2, 3.5}));
  EXPECT_FALSE(polygon.contains({0.7, 0.7, 2.5}));
}

TEST(Shape, CircleFractionsSumToItsArea) {
  const Shape circle{SphereShape{{0, 0, 0}, 1.0, true}};
  double area = 0.0;
  for (int i = -10; i < 10; ++i)
    for (int k = -10; k < 10; ++k)
      area += 0.0121 * fraction_inside(circle, {0.11 * i, 0, 0.11 * k},
                                       {0.11 * (i + 1), 0, 0.11 * (k + 1)}, 2);
  EXPECT_NEAR(area, std::numbers::pi, 3e-3);
}

/// Share of a box by 16 samples per axis in the plane, 8 in space, all of them taken.
double counted(const Shape& shape, const Point3& lower, const Point3& upper, int dimension) {
  const int samples = dimension == 2 ? 16 : 8, across = dimension == 2 ? 1 : samples;
  int hits = 0;
  for (int k = 0; k < samples; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < samples; ++i) {
        const Point3 share{(i + 0.5) / samples, dimension == 2 ? 0.0 : (j + 0.5) / samples,
                           (k + 0.5) / samples};
        Point3 place{};
        for (std::size_t a = 0; a < 3; ++a) place[a] = lower[a] + (upper[a] - lower[a]) * share[a];
        if (shape.contains(place)) ++hits;
      }
  return static_cast<double>(hits) / (samples * across * samples);
}

TEST(Shape, BoxesThatNoSurfaceCrossesHaveTheShareThatCountingSamplesGives) {
  const Shape big{BoxShape{{-3, -3, -3}, {3, 3, 3}}}, ball{SphereShape{{0.3, 0, 0.2}, 1.4, false}};
  const Shape notched{PolygonShape{{{-2, -2}, {2, -2}, {2, 1}, {0.1, -1}, {-2, 1.7}}}};
  const Shape sliver{PolygonShape{{{-1.7, -1.7}, {1.9, 1.8}, {1.9, 1.83}}}};
  const Shape layer{PolygonShape{{{-2, -1}, {1.3, 0.4}, {-0.4, 2}}, false, -1.03, 0.71}};
  const Shape below{BelowShape{{{-1, 0.2}, {0, 1.1}, {0.05, -0.9}, {1.5, 0.4}}}};
  const Shape rod{CylinderShape{{-1, -1, -1}, {1, 1, 1.5}, 0.3}};
  for (const Shape& shape :
       {notched, sliver, below, layer, ball, rod, Shape{DifferenceShape{{big, ball, notched}}},
        Shape{UnionShape{{ball, layer, below}}}})
    for (int i = -6; i < 6; ++i)
      for (int j = -6; j < 6; ++j)
        for (int k = -6; k < 6; ++k) {
          const Point3 lower{0.5 * i, 0.5 * j, 0.5 * k};
          const Point3 upper{lower[0] + 0.5, lower[1] + 0.5, lower[2] + 0.5};
          const bool prism = shape.form.index() == below.form.index() ||
                             (shape.form.index() == notched.form.index() &&
                              std::get<PolygonShape>(shape.form).vertical_plane);
          EXPECT_EQ(fraction_inside(shape, lower, upper, 3),
                    counted(shape, lower, upper, prism ? 2 : 3))
              << shape.form.index() << " at " << i << ' ' << j << ' ' << k;
          if (j == 0) {
            EXPECT_EQ(fraction_inside(shape, {lower[0], 0, lower[2]}, {upper[0], 0, upper[2]}, 2),
                      counted(shape, {lower[0], 0, lower[2]}, {upper[0], 0, upper[2]}, 2));
          }
        }
}

TEST(Shape, SphereSeesTheYAxisAndACircleDoesNot) {
  EXPECT_FALSE((Shape{SphereShape{{0, 0, 0}, 1.0, false}}).contains({0, 2, 0}));
  EXPECT_TRUE((Shape{SphereShape{{0, 0, 0}, 1.0, true}}).contains({0, 2, 0}));
}

TEST(Shape, SlantedCylinderEndsAtItsDiscs) {
  const Shape cylinder{CylinderShape{{0, 0, 0}, {1, 1, 1}, 0.1}};
  EXPECT_TRUE(cylinder.contains({0.5, 0.5, 0.55}));
  EXPECT_FALSE(cylinder.contains({0.5, 0.5, 0.7}));
  EXPECT_FALSE(cylinder.contains({1.02, 1.02, 1.02}));
  EXPECT_NEAR(bounds(cylinder).upper[2], 1.0 + 0.1 * std::sqrt(2.0 / 3.0), 1e-12);
}

TEST(Shape, BelowALineIsLinearBetweenItsPointsAndLevelBeyond) {
  const Shape below{BelowShape{{{1, 0}, {3, 2}}}};
  EXPECT_TRUE(below.contains({2.0, 0.0, 0.99}));
  EXPECT_FALSE(below.contains({2.0, 0.0, 1.01}));
  EXPECT_FALSE(below.contains({-5.0, 0.0, 0.1}));
  EXPECT_TRUE(below.contains({9.0, 0.0, 1.9}));
  EXPECT_EQ(bounds(below).upper[2], 2.0);
  EXPECT_EQ(bounds(below).lower[0], -infinity);
}

TEST(Shape, DifferenceTakesEveryLaterPartFromTheFirstAndUnionAddsThem) {
  const Shape big{BoxShape{{0, -1, 0}, {4, 1, 4}}}, hole{SphereShape{{2, 0, 2}, 1.0, true}};
  const Shape difference{DifferenceShape{{big, hole}}};
  const Shape both{UnionShape{{hole, Shape{BoxShape{{5, -1, 0}, {6, 1, 1}}}}}};
  EXPECT_FALSE(difference.contains({2, 0, 2.5}));
  EXPECT_TRUE(difference.contains({2, 0, 3.5}));
  EXPECT_TRUE(both.contains({2, 0, 2.5}));
  EXPECT_TRUE(both.contains({5.5, 0, 0.5}));
  EXPECT_EQ(bounds(both).upper[0], 6.0);
}

}  // namespace
}  // namespace mudlark

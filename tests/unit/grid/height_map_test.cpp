#include "grid/height_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "grid/shape.hpp"
#include "grid/shape_distance.hpp"

namespace mudlark {
namespace {

/// Hills on a lattice with lines at uneven distances.
HeightMap hills() {
  const std::vector<double> x{0.0, 0.7, 1.5, 2.0, 3.2, 4.0}, y{-1.0, 0.0, 0.4, 1.5, 2.0};
  std::vector<double> heights;
  for (const double along_y : y)
    for (const double along_x : x)
      heights.push_back(1.0 + 0.4 * std::sin(2.0 * along_x) * std::cos(1.5 * along_y) +
                        0.1 * along_x);
  return {x, y, heights};
}

TEST(HeightMap, IsBilinearBetweenItsHeightsAndLevelBeyondItsEdges) {
  const HeightMap map({0.0, 2.0}, {0.0, 1.0}, {1.0, 3.0, 2.0, 8.0});
  EXPECT_DOUBLE_EQ(map.height_at(0.5, 0.25), 1.0 + 0.5 + 0.25 + 0.5 * 0.25 * 2.0);  // u v (d = 4)
  EXPECT_DOUBLE_EQ(map.height_at(2.0, 1.0), 8.0);
  EXPECT_DOUBLE_EQ(map.height_at(-5.0, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(map.height_at(1.0, 7.0), 5.0);
  EXPECT_DOUBLE_EQ(map.height_at(9.0, -9.0), 3.0);
}

TEST(HeightMap, CroppedIsTheSameGround) {
  const HeightMap map = hills();
  const Point3 lower{0.3, -2.0, 0.0}, upper{3.7, 1.7, 0.0};
  const HeightMap part = map.cropped(lower, upper);
  EXPECT_EQ(part.x().front(), 0.3);
  EXPECT_EQ(part.y().back(), 1.7);
  for (double x = 0.3; x <= 3.7; x += 0.11)
    for (double y = -2.0; y <= 1.7; y += 0.13)
      EXPECT_NEAR(part.height_at(x, y), map.height_at(x, y), 1e-14);
}

TEST(HeightMap, BoundsItsHeightsOverARectangle) {
  const HeightMap map = hills();
  const Point3 lower{0.9, -0.3, 0.0}, upper{2.6, 0.9, 0.0};
  const auto [low, high] = map.range(lower, upper);
  for (double x = lower[0]; x <= upper[0]; x += 0.05)
    for (double y = lower[1]; y <= upper[1]; y += 0.05) {
      EXPECT_GE(map.height_at(x, y), low);
      EXPECT_LE(map.height_at(x, y), high);
    }
  EXPECT_GE(low, 0.5);
  EXPECT_LE(high, 1.75);
}

/// The nearest of many places of the surface, then of many around it, and so on.
double searched_distance(const HeightMap& map, const Point3& p) {
  double x = p[0], y = p[1], best = 1e300;
  for (double reach = 3.0; reach > 1e-9; reach *= 0.4) {
    double next_x = x, next_y = y;
    for (int i = -12; i <= 12; ++i)
      for (int j = -12; j <= 12; ++j) {
        const double u = x + reach * i / 12.0, v = y + reach * j / 12.0;
        const double away = std::hypot(u - p[0], v - p[1], map.height_at(u, v) - p[2]);
        if (away < best) best = away, next_x = u, next_y = v;
      }
    x = next_x, y = next_y;
  }
  return best;
}

TEST(HeightMap, KnowsTheDistanceToItsSurfaceAndTheNormalThere) {
  const HeightMap map = hills();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(-1.5, 5.5), across(-2.5, 3.5), up(-0.5, 3.0);
  for (int i = 0; i < 400; ++i) {
    const Point3 p{along(random), across(random), up(random)};
    const SurfaceDistance found = map.distance_to(p);
    const bool below = p[2] < map.height_at(p[0], p[1]);
    EXPECT_EQ(found.distance < 0.0, below);
    EXPECT_NEAR(std::abs(found.distance), searched_distance(map, p), 2e-4)
        << p[0] << ' ' << p[1] << ' ' << p[2];
    EXPECT_LE(std::abs(found.distance), searched_distance(map, p) + 1e-12);
    double length2 = 0.0;
    Point3 foot{};
    for (std::size_t a = 0; a < 3; ++a) {
      length2 += found.normal[a] * found.normal[a];
      foot[a] = p[a] - found.distance * found.normal[a];
    }
    EXPECT_NEAR(length2, 1.0, 1e-12);
    EXPECT_NEAR(foot[2], map.height_at(foot[0], foot[1]), 1e-9) << "the foot lies on the surface";
  }
}

TEST(HeightMap, OfAPlaneHasThePlanesDistanceAndNormal) {
  const HeightMap plane({0.0, 10.0}, {0.0, 10.0}, {0.0, 5.0, 0.0, 5.0});  // z = x/2
  const double c = 1.0 / std::sqrt(1.25);
  for (const Point3& p : {Point3{4.0, 5.0, 3.0}, Point3{4.0, 5.0, 1.0}, Point3{4.0, 5.0, 2.0}}) {
    const SurfaceDistance found = plane.distance_to(p);
    EXPECT_NEAR(found.distance, c * (p[2] - 0.5 * p[0]), 1e-14);
    EXPECT_NEAR(found.normal[0], -0.5 * c, 1e-12);
    EXPECT_NEAR(found.normal[1], 0.0, 1e-12);
    EXPECT_NEAR(found.normal[2], c, 1e-12);
  }
}

TEST(HeightMap, FillsCellsAsItsSamplesSay) {
  const Shape ground{HeightMapShape{std::make_shared<const HeightMap>(hills())}};
  EXPECT_TRUE(ground.contains({1.0, 0.0, 0.2}));
  EXPECT_FALSE(ground.contains({1.0, 0.0, 2.0}));
  EXPECT_EQ(fraction_inside(ground, {1.0, 0.0, 0.0}, {1.2, 0.2, 0.2}, 3), 1.0);
  EXPECT_EQ(fraction_inside(ground, {1.0, 0.0, 1.9}, {1.2, 0.2, 2.1}, 3), 0.0);
  const double height = hills().height_at(1.1, 0.1);
  EXPECT_NEAR(fraction_inside(ground, {1.0, 0.0, height - 0.1}, {1.2, 0.2, height + 0.1}, 3), 0.5,
              0.1);
  EXPECT_EQ(bounds(ground).upper[2], hills().highest());
  EXPECT_EQ(distance_to(ground, {1.0, 0.5, 3.0}).distance,
            hills().distance_to({1.0, 0.5, 3.0}).distance);
}

}  // namespace
}  // namespace mudlark

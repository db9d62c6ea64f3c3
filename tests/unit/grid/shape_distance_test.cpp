#include "grid/shape_distance.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/errors.hpp"
#include "grid/triangle_mesh.hpp"

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Triangle> cube_of_triangles() {
  const auto corner = [](int i) {
    return Point3{static_cast<double>(i & 1), static_cast<double>((i >> 1) & 1),
                  static_cast<double>((i >> 2) & 1)};
  };
  std::vector<Triangle> triangles;
  for (const std::array<int, 4>& side : {std::array{0, 2, 3, 1},
                                         {4, 5, 7, 6},
                                         {0, 1, 5, 4},
                                         {2, 6, 7, 3},
                                         {0, 4, 6, 2},
                                         {1, 3, 7, 5}}) {
    triangles.push_back({corner(side[0]), corner(side[1]), corner(side[2])});
    triangles.push_back({corner(side[0]), corner(side[2]), corner(side[3])});
  }
  return triangles;
}

/// A unit sphere from squares of a grid on a cylinder around it.
std::vector<Triangle> sphere_of_triangles(int rows) {
  const auto place = [rows](int i, int k) {
    const double height = std::numbers::pi * k / rows, turn = std::numbers::pi * i / rows;
    if (k == 0 || k == rows) return Point3{0.0, 0.0, k == 0 ? 1.0 : -1.0};
    return Point3{std::sin(height) * std::cos(turn), std::sin(height) * std::sin(turn),
                  std::cos(height)};
  };
  std::vector<Triangle> triangles;
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < 2 * rows; ++i) {
      const int next = (i + 1) % (2 * rows);
      triangles.push_back({place(i, k), place(i, k + 1), place(next, k + 1)});
      triangles.push_back({place(i, k), place(next, k + 1), place(next, k)});
    }
  return triangles;
}

/// The normal is a unit vector, and the gradient of the distance.
void expect_gradient(const Shape& shape, const Point3& place, bool flat) {
  const SurfaceDistance here = distance_to(shape, place);
  double length2 = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    length2 += here.normal[a] * here.normal[a];
    if (flat && a == 1) continue;
    Point3 before = place, behind = place;
    constexpr double step = 1e-6;
    before[a] -= step, behind[a] += step;
    const double slope =
        (distance_to(shape, behind).distance - distance_to(shape, before).distance) / (2 * step);
    EXPECT_NEAR(slope, here.normal[a], 1e-4)
        << "axis " << a << " at " << place[0] << " " << place[1] << " " << place[2];
  }
  EXPECT_NEAR(length2, 1.0, 1e-9);
  EXPECT_EQ(here.distance <= 0.0, shape.contains(place));
}

TEST(ShapeDistance, OfABoxIsExactInsideOutsideAndAtItsCorner) {
  const Shape box{BoxShape{{0, -infinity, 0}, {2, infinity, 1}}};
  EXPECT_DOUBLE_EQ(distance_to(box, {1.0, 7.0, 0.9}).distance, -0.1);
  EXPECT_EQ(distance_to(box, {1.0, 7.0, 0.9}).normal, (Point3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(distance_to(box, {1.0, 0.0, -3.0}).distance, 3.0);
  EXPECT_EQ(distance_to(box, {1.0, 0.0, 0.0}).distance, 0.0);
  EXPECT_DOUBLE_EQ(distance_to(box, {5.0, 0.0, 5.0}).distance, 5.0);
  const Shape cube{BoxShape{{0, 0, 0}, {1, 1, 1}}};
  EXPECT_DOUBLE_EQ(distance_to(cube, {2, 3, 3}).distance, 3.0);
  EXPECT_DOUBLE_EQ(distance_to(cube, {2, 3, 3}).normal[1], 2.0 / 3.0);
}

TEST(ShapeDistance, OfEveryFormHasTheOutwardNormalAsGradientAndTheSignOfContains) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> random(-1.6, 1.6);
  const std::vector<std::pair<Shape, bool>> shapes{
      {Shape{BoxShape{{-1, -1, -0.5}, {1, 0.7, 1}}}, false},
      {Shape{SphereShape{{0.1, 0.2, 0.3}, 0.9, false}}, false},
      {Shape{SphereShape{{0.1, 0.2, 0.3}, 0.9, true}}, true},
      {Shape{CylinderShape{{-0.5, -0.4, -0.6}, {0.5, 0.6, 0.4}, 0.5}}, false},
      {Shape{PolygonShape{{{-1, -1}, {1, -1}, {1, 1}, {0, -0.3}, {-1, 1}}}}, true},
      {Shape{PolygonShape{{{-1, -1}, {-1, 1}, {1, 0}}, false, -0.5, 0.8}}, false},
      {Shape{BelowShape{{{-1, 0}, {0, 0.6}, {1, -0.2}}}}, true},
      {Shape{StlShape{std::make_shared<const TriangleMesh>(cube_of_triangles())}}, false}};
  for (const auto& [shape, flat] : shapes)
    for (int i = 0; i < 60; ++i)
      expect_gradient(shape, {random(generator), flat ? 0.0 : random(generator), random(generator)},
                      flat);
}

TEST(ShapeDistance, OfUnionAndDifferenceTakesTheNearestPartAndTheHole) {
  const Shape left{SphereShape{{0, 0, 0}, 1.0, true}}, right{SphereShape{{3, 0, 0}, 1.0, true}};
  const Shape both{UnionShape{{left, right}}};
  EXPECT_DOUBLE_EQ(distance_to(both, {1.4, 0, 0}).distance, 0.4);
  EXPECT_DOUBLE_EQ(distance_to(both, {1.7, 0, 0}).distance, 0.3);
  EXPECT_DOUBLE_EQ(distance_to(both, {1.7, 0, 0}).normal[0], -1.0);
  const Shape ring{DifferenceShape{{left, Shape{SphereShape{{0, 0, 0}, 0.5, true}}}}};
  EXPECT_DOUBLE_EQ(distance_to(ring, {0.6, 0, 0}).distance, -0.1);
  EXPECT_DOUBLE_EQ(distance_to(ring, {0.6, 0, 0}).normal[0], -1.0);
  EXPECT_DOUBLE_EQ(distance_to(ring, {0.3, 0, 0}).distance, 0.2);
}

TEST(TriangleMesh, OfACubeAgreesWithTheBoxAtItsCornersToo) {
  const TriangleMesh mesh(cube_of_triangles());
  const Shape box{BoxShape{{0, 0, 0}, {1, 1, 1}}};
  EXPECT_DOUBLE_EQ(mesh.volume(), 1.0);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> random(-0.7, 1.7);
  for (int i = 0; i < 2000; ++i) {
    const Point3 place{random(generator), random(generator), random(generator)};
    EXPECT_NEAR(mesh.distance_to(place).distance, distance_to(box, place).distance, 1e-14);
  }
}

TEST(TriangleMesh, ThatFacesInwardsIsTurned) {
  auto triangles = cube_of_triangles();
  for (Triangle& triangle : triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_TRUE(TriangleMesh(triangles).contains({0.5, 0.5, 0.5}));
  EXPECT_FALSE(TriangleMesh(triangles).contains({0.5, 0.5, 1.5}));
}

std::string problem_of(const std::vector<Triangle>& triangles) {
  try {
    const TriangleMesh mesh(triangles);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TriangleMesh, IsRefusedWithAHoleATurnedTriangleOrAnExtraWall) {
  auto triangles = cube_of_triangles();
  triangles.pop_back();
  EXPECT_NE(problem_of(triangles).find("3 edges of a hole"), std::string::npos);
  triangles = cube_of_triangles();
  std::swap(triangles[4][0], triangles[4][1]);
  EXPECT_NE(problem_of(triangles).find("3 edges whose two triangles face opposite sides"),
            std::string::npos);
  triangles = cube_of_triangles();
  triangles.push_back({Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{1, 1, 1}});
  EXPECT_NE(problem_of(triangles).find("more than two"), std::string::npos);
  EXPECT_NE(problem_of({}).find("no triangle"), std::string::npos);
}

// A sphere of 1.3e5 triangles, against the distance to the exact sphere and to a clock.
TEST(TriangleMesh, OfManyTrianglesFindsDistancesFast) {
  const int rows = 180;
  const TriangleMesh mesh(sphere_of_triangles(rows));
  EXPECT_GT(mesh.size(), 120000u);
  EXPECT_NEAR(mesh.volume(), 4.0 / 3.0 * std::numbers::pi, 2e-3);
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> random(-1.2, 1.2);
  const auto begin = std::chrono::steady_clock::now();
  const int count = 5000;
  for (int i = 0; i < count; ++i) {
    const Point3 place{random(generator), random(generator), random(generator)};
    const double radius = std::hypot(place[0], place[1], place[2]);
    if (radius < 0.3) continue;
    EXPECT_NEAR(mesh.distance_to(place).distance, radius - 1.0, 2e-4);
  }
  const double each =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / count;
  RecordProperty("microseconds", std::to_string(1e6 * each));
  EXPECT_LT(each, 1e-3) << "a search through all triangles takes longer";
}

}  // namespace
}  // namespace mudlark

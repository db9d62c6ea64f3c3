/// Rigid bodies by themselves: volume and inertia of shapes, given and free motion.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/errors.hpp"
#include "grid/solid.hpp"
#include "grid/triangle_mesh.hpp"

namespace mudlark {
namespace {

using Vector = Eigen::Vector3d;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

SolidOptions body_of(const Shape& shape) {
  SolidOptions options;
  options.name = "body";
  options.shape = shape;
  return options;
}

Varying of_time(std::function<double(double)> f) {
  return Varying([f](const Point3&, double t) { return f(t); }, "f(t)");
}

/// Twelve triangles around a box.
std::vector<Triangle> box_triangles(const Point3& lower, const Point3& upper) {
  const auto corner = [&](int i) {
    return Point3{i & 1 ? upper[0] : lower[0], i & 2 ? upper[1] : lower[1],
                  i & 4 ? upper[2] : lower[2]};
  };
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    triangles.push_back({corner(a), corner(b), corner(c)});
    triangles.push_back({corner(a), corner(c), corner(d)});
  }
  return triangles;
}

TEST(SolidVolume, OfBoxesAndTrianglesIsExact) {
  const Point3 lower{1, 2, 3}, upper{2, 4, 6};
  for (const Shape& shape :
       {Shape{BoxShape{lower, upper}},
        Shape{StlShape{std::make_shared<TriangleMesh>(box_triangles(lower, upper))}}}) {
    const SolidVolume solid = *volume_of(shape, 3);
    EXPECT_NEAR(solid.volume, 6.0, 1e-9);
    const Point3 middle{1.5, 3.0, 4.5}, size{1, 2, 3};
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(solid.centre[a], middle[a], 1e-9);
      for (std::size_t b = 0; b < 3; ++b)
        EXPECT_NEAR(solid.moments[a][b], a == b ? 6.0 * size[a] * size[a] / 12.0 : 0.0, 1e-8);
    }
  }
}

TEST(SolidVolume, OfRoundShapesIsCloseAndOfEndlessOnesThereIsNone) {
  const SolidVolume ball = *volume_of({SphereShape{{1, 2, 3}, 0.5}}, 3);
  EXPECT_NEAR(ball.volume, pi / 6.0, 1e-3);
  EXPECT_NEAR(ball.moments[0][0], pi / 6.0 * 0.05, 1e-4);
  const SolidVolume disc = *volume_of({SphereShape{{1, 0, 3}, 0.5, true}}, 2);
  EXPECT_NEAR(disc.volume, pi / 4.0, 1e-4);
  EXPECT_NEAR(disc.moments[2][2], pi / 64.0, 1e-5);
  EXPECT_NEAR(disc.centre[2], 3.0, 1e-9);
  EXPECT_FALSE(volume_of({BelowShape{{{0.0, 1.0}, {1.0, 1.0}}}}, 2));
  EXPECT_FALSE(volume_of({BoxShape{{0, -infinity, 0}, {1, infinity, 1}}}, 3));
  EXPECT_TRUE(volume_of({BoxShape{{0, -infinity, 0}, {1, infinity, 1}}}, 2));
}

TEST(Solid, FollowsGivenPlacesExactly) {
  SolidOptions options = body_of({BoxShape{{0, -infinity, 0}, {2, infinity, 1}}});
  PrescribedSolid motion;
  motion.by_displacement = motion.by_rotation = true;
  motion.translation[0] = of_time([](double t) { return std::sin(t); });
  motion.translation[2] = of_time([](double t) { return -t * t; });
  motion.rotation[1] = of_time([](double t) { return 7.0 * t; });  // several turns
  options.motion = motion;
  Solid solid(options, 2, {0, 0, -9.81}, 1.0);
  double time = 0.0;
  for (int i = 0; i < 100; ++i, time += 0.01) {
    solid.begin_step(time, 0.01, false);
    solid.move(0.01);
  }
  EXPECT_NEAR(solid.displacement()[0], std::sin(time), 1e-12);
  EXPECT_NEAR(solid.displacement()[2], -time * time, 1e-12);
  EXPECT_NEAR(solid.rotation()[1], -7.0 * time, 1e-12);
  // The corner that began at (2, 0, 1) has gone round the centre (1, 0, 0.5), counter-clockwise.
  const double angle = 7.0 * time, x = std::cos(angle) - 0.5 * std::sin(angle),
               z = std::sin(angle) + 0.5 * std::cos(angle);
  const SurfaceDistance corner =
      solid.distance({1.0 + std::sin(time) + 1.1 * x, 0.0, 0.5 - time * time + 1.1 * z});
  EXPECT_NEAR(corner.distance, 0.1 * std::hypot(1.0, 0.5), 1e-10);
  solid.begin_step(time, 0.01, true);  // waits
  EXPECT_EQ(solid.velocity().norm() + solid.spin().norm(), 0.0);
}

TEST(Solid, FollowsAGivenRotationVectorInSpace) {
  SolidOptions options = body_of({BoxShape{{-1, -1, -1}, {1, 1, 1}}});
  PrescribedSolid motion;
  motion.by_rotation = true;
  motion.rotation[0] = of_time([](double t) { return t; });
  motion.rotation[2] = of_time([](double t) { return 0.5 * t * t; });
  options.motion = motion;
  Solid solid(options, 3, {}, 1.0);
  for (int i = 0; i < 50; ++i) {
    solid.begin_step(0.02 * i, 0.02, false);
    solid.move(0.02);
  }
  EXPECT_NEAR((solid.rotation() - Vector(1.0, 0.0, 0.5)).norm(), 0.0, 1e-10);
}

TEST(Solid, FallsTurnsAndKeepsItsLocksAndItsAngularMomentum) {
  SolidOptions options = body_of({BoxShape{{0, 0, 0}, {1, 2, 3}}});
  FreeSolid motion;
  motion.density = 2.0;
  motion.velocity = {1, 0, 0};
  motion.angular_velocity = {0.3, 1.0, 0.1};
  motion.locked = {false, true, false};
  motion.force[1] = motion.force[0] = Varying(6.0);
  options.motion = motion;
  Solid solid(options, 3, {0, 0, -10}, 1.0);
  EXPECT_NEAR(solid.mass(), 12.0, 1e-9);
  const Vector inertia(12.0 / 12 * (4 + 9), 12.0 / 12 * (1 + 9), 12.0 / 12 * (1 + 4));
  const auto angular_momentum = [&] {
    const Eigen::Matrix3d turn = solid.turn().toRotationMatrix();
    return Vector(turn * inertia.asDiagonal() * turn.transpose() * solid.spin());
  };
  const Vector start = angular_momentum();
  for (int i = 0; i < 1000; ++i) {
    solid.begin_step(0.0, 1e-3, false);
    solid.move(1e-3);
  }
  EXPECT_NEAR((angular_momentum() - start).norm(), 0.0, 1e-8);
  EXPECT_NEAR((solid.velocity() - Vector(1.5, 0.0, -10.0)).norm(), 0.0, 1e-10);
  EXPECT_EQ(solid.displacement()[1], 0.0);
  solid.begin_step(0.0, 1e-3, false);
  solid.set_impulse({12, 12, 0}, Vector::Zero());
  EXPECT_NEAR(solid.velocity()[0], 1.5 + 6.0 / 12 * 1e-3 + 1.0, 1e-9);
  EXPECT_EQ(solid.velocity()[1], 0.0);
}

TEST(Solid, WithoutVolumeNeedsMassCentreAndInertia) {
  SolidOptions options = body_of({BelowShape{{{0.0, 1.0}, {1.0, 1.0}}}});
  EXPECT_NO_THROW(Solid(options, 2, {}, 1.0));  // fixed
  FreeSolid motion;
  motion.mass = 5.0;
  options.motion = motion;
  EXPECT_THROW(Solid(options, 2, {}, 1.0), InputError);
  motion.inertia = {1.0, 1.0, 1.0};
  options.motion = motion;
  options.centre = Point3{0.0, 0.0, 0.0};
  EXPECT_NO_THROW(Solid(options, 2, {}, 1.0));
}

}  // namespace
}  // namespace mudlark

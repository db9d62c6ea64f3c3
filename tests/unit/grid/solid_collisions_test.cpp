/// Rigid bodies against sides and each other, without water or soil.
#include "grid/solid_collisions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "grid/surface_places.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81;

template <int D>
DomainOptions room() {
  DomainOptions options;
  options.dimension = D;
  options.cells = {10, D == 2 ? 10 : 10, 10};
  options.upper = {10.0, 10.0, 10.0};
  return options;
}

SolidOptions body(const std::string& name, const Shape& shape, const FreeSolid& motion,
                  double friction = 0.0) {
  return {name, shape, {}, motion, friction};
}
FreeSolid heavy(double density) {
  FreeSolid motion;
  motion.density = density;
  return motion;
}
Shape box(double x, double z, double width, double height) {
  return {BoxShape{{x, -1e30, z}, {x + width, 1e30, z + height}}};
}

/// Bodies in an empty room.
template <int D>
struct Room {
  Grid<D> grid;
  std::vector<Solid> solids;
  std::optional<SolidCollisions> collisions;
  double time = 0.0;

  Room(const std::vector<SolidOptions>& options, const Point3& weight)
      : grid(room<D>(), MPI_COMM_SELF) {
    std::vector<RigidPose> start;
    for (const SolidOptions& one : options) {
      solids.emplace_back(one, D, weight, 1.0);
      start.push_back(solids.back().pose());
    }
    collisions.emplace(grid, false, start);
  }
  void run(double until, double dt) {
    for (; time < until - 0.5 * dt; time += dt) {
      for (Solid& solid : solids) solid.begin_outer_step(), solid.begin_step(time, dt, false);
      collisions->settle(solids, dt);
      for (Solid& solid : solids) solid.book(dt), solid.move(dt);
    }
  }
};

double corner_distance(const std::vector<SurfacePlace>& places, const Eigen::Vector3d& corner) {
  double nearest = 1e300;
  for (const SurfacePlace& one : places) nearest = std::min(nearest, (one.place - corner).norm());
  return nearest;
}

TEST(SurfacePlaces, HoldSharpCorners) {
  const BoxShape within{{-9.0, -9.0, -9.0}, {9.0, 9.0, 9.0}};
  const auto flat = surface_places({PolygonShape{{{0.0, 0.0}, {3.0, 0.2}, {2.9, 1.7}}}}, within, 2);
  for (const auto& [x, z] : {std::array{0.0, 0.0}, std::array{3.0, 0.2}, std::array{2.9, 1.7}})
    EXPECT_LT(corner_distance(flat, {x, 0.0, z}), 1e-12);
  const auto brick = surface_places({BoxShape{{0.0, 0.1, 0.2}, {1.0, 0.4, 0.9}}}, within, 3);
  for (int c = 0; c < 8; ++c)
    EXPECT_LT(corner_distance(brick, {c & 1 ? 1.0 : 0.0, c & 2 ? 0.4 : 0.1, c & 4 ? 0.9 : 0.2}),
              1e-12);
}

TEST(SolidCollisions, ABoxThatIsThrownAlongTheFloorStopsAfterItsBrakingDistance) {
  FreeSolid motion = heavy(2000.0);
  motion.velocity = {2.0, 0.0, 0.0};
  Room<2> room({body("box", box(1.0, 0.0, 1.0, 0.5), motion, 0.4)}, {0.0, 0.0, -gravity});
  room.run(0.3, 1e-3);
  EXPECT_NEAR(room.solids[0].collision_force()[2], 1000.0 * gravity, 1e-6 * 1000.0 * gravity);
  EXPECT_NEAR(room.solids[0].collision_force()[0], -400.0 * gravity, 1e-6 * 1000.0 * gravity);
  room.run(1.0, 1e-3);
  EXPECT_NEAR(room.solids[0].displacement()[0], 4.0 / (2.0 * 0.4 * gravity), 2e-3);
  EXPECT_NEAR(room.solids[0].displacement()[2], 0.0, 1e-9);
  EXPECT_LT(room.solids[0].velocity().norm() + room.solids[0].spin().norm(), 1e-9);
}

/// Weight at an angle of 20 degrees: tan 20 = 0.364 lies between the two coefficients.
TEST(SolidCollisions, ABrickStaysOrSlidesByTheLawOfCoulomb) {
  const double angle = std::acos(-1.0) / 9.0, s = std::sin(angle), c = std::cos(angle);
  for (const double friction : {0.38, 0.2}) {
    Shape brick{BoxShape{{1.0, 1.0, 0.0}, {2.0, 2.5, 0.4}}};
    Room<3> room({body("brick", brick, heavy(2500.0), friction)}, {gravity * s, 0.0, -gravity * c});
    room.run(0.5, 2e-3);
    const double exact = friction < s / c ? 0.5 * gravity * (s - friction * c) * 0.25 : 0.0;
    EXPECT_NEAR(room.solids[0].displacement()[0], exact, 0.005 * exact + 1e-9);
    EXPECT_LT(room.solids[0].spin().norm(), 1e-8);
  }
}

/// Through the air onto the floor, and no way through it.
TEST(SolidCollisions, ABallFallsOntoTheFloorAndStays) {
  Room<3> room({body("ball", {SphereShape{{5.0, 5.0, 2.0}, 0.5}}, heavy(1000.0))},
               {0.0, 0.0, -gravity});
  room.run(0.4, 2e-3);
  EXPECT_NEAR(room.solids[0].centre()[2], 2.0 - 0.5 * gravity * 0.16, 0.01);
  room.run(2.0, 2e-3);
  EXPECT_NEAR(room.solids[0].centre()[2], 0.5, 0.002);
  EXPECT_LT(room.solids[0].velocity().norm(), 1e-3);
}

/// Two boxes that meet go on together; the second hits a fixed wall and stops there.
TEST(SolidCollisions, BoxesThatMeetKeepTheirMomentum) {
  FreeSolid moving = heavy(3000.0);
  moving.velocity = {1.0, 0.0, 0.0};
  Room<2> room({body("fast", box(1.0, 5.0, 1.0, 1.0), moving),
                body("slow", box(2.5, 5.0, 0.5, 1.0), heavy(2000.0)),
                {"wall", box(4.0, 4.0, 1.0, 3.0), {}, FixedSolid{}, 0.0}},
               {0.0, 0.0, 0.0});
  room.run(0.9, 1e-3);
  for (int b = 0; b < 2; ++b)
    EXPECT_NEAR(room.solids[static_cast<std::size_t>(b)].velocity()[0], 0.75, 1e-9);
  room.run(4.0, 1e-3);
  EXPECT_NEAR(room.solids[1].centre()[0], 3.75, 1e-3);
  EXPECT_NEAR(room.solids[0].centre()[0], 3.0, 1e-3);
}

/// A box with its edge over a step tips about it: first acceleration g x / (x^2 + z^2 + k^2), where
/// x and z say where its centre is from the edge and k is its radius of inertia.
TEST(SolidCollisions, ABoxTipsOverAnEdge) {
  const double width = 1.0, height = 0.4, over = 0.2;
  Room<2> room({body("box", box(3.0 + over - 0.5 * width, 2.0, width, height), heavy(1000.0), 10.0),
                {"step", box(0.0, 0.0, 3.0, 2.0), {}, FixedSolid{}, 0.0}},
               {0.0, 0.0, -gravity});
  const double dt = 1e-3;
  room.run(10 * dt, dt);
  const double arm2 = over * over + 0.25 * height * height;
  const double exact = gravity * over / (arm2 + (width * width + height * height) / 12.0);
  EXPECT_NEAR(room.solids[0].spin()[1], exact * 10 * dt, 0.01 * exact * 10 * dt);
}

/// Along a slab that is much longer than the box, whose surface is known by places of its own.
TEST(SolidCollisions, ABoxThatIsThrownAlongASlabDoesNotTrip) {
  FreeSolid motion = heavy(2000.0);
  motion.velocity = {1.5, 0.0, 0.0};
  Room<2> room({body("box", box(1.0, 1.0, 0.3, 0.2), motion, 0.1),
                {"slab", box(0.0, 0.5, 8.0, 0.5), {}, FixedSolid{}, 0.0}},
               {0.0, 0.0, -gravity});
  room.run(1.6, 1e-3);
  EXPECT_NEAR(room.solids[0].displacement()[0], 1.5 * 1.5 / (2.0 * 0.1 * gravity), 5e-3);
  EXPECT_NEAR(room.solids[0].displacement()[2], 0.0, 1e-4);
  EXPECT_LT(room.solids[0].rotation().norm(), 1e-3);
}

/// What is cut out of a body up to its top is open.
TEST(SolidCollisions, ABallFallsIntoABasin) {
  const Shape basin{DifferenceShape{{box(0.0, 0.0, 10.0, 4.0), box(2.0, 1.0, 6.0, 3.0)}}};
  Room<2> room({body("ball", {SphereShape{{5.0, 0.0, 5.0}, 0.5, true}}, heavy(1000.0)),
                {"basin", basin, {}, FixedSolid{}, 0.0}},
               {0.0, 0.0, -gravity});
  room.run(2.0, 2e-3);
  EXPECT_NEAR(room.solids[0].centre()[2], 1.5, 0.01);
}

TEST(SolidCollisions, ABodyThatStartsInAWallMayStayThere) {
  Room<2> room({body("pier", box(-0.5, 4.0, 1.5, 1.0), heavy(1000.0))}, {0.0, 0.0, 0.0});
  room.run(0.1, 1e-2);
  EXPECT_EQ(room.solids[0].displacement().norm(), 0.0);
}

}  // namespace
}  // namespace mudlark

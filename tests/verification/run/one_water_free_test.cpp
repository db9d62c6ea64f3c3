// ranks: 1
// Rigid bodies that move freely in soil and water at once: at rest on a bed, pushed along it.
#include <gtest/gtest.h>

#include <cmath>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, water_density = 1000.0;
constexpr double width = 0.4, height = 0.2, density = 2000.0, friction = 0.4;
constexpr double weight =
    (density - water_density) * width * height * gravity;  ///< under water [N/m]

/// A block on a bed 0.3 m deep, under water 0.7 m deep.
CaseOptions block_on_bed(const Varying& push) {
  CaseOptions c = soil_in_water({BoxShape{{-9, -9, -9}, {9, 9, 0.3}}}, 0.7, 1e-2, 2e6);
  c.domain.dimension = 2;
  c.domain.upper = {1.2, 0.8, 1.0};
  c.domain.cells = {12, 8, 1};
  c.soil->bodies.front().initial_stress = GeostaticStress{};
  c.soil->damping = 0.2;
  FreeSolid motion;
  motion.density = density;
  motion.force[0] = push;
  motion.locked_rotation[1] = true;
  const Shape shape{BoxShape{{0.4, -9, 0.3}, {0.4 + width, 9, 0.3 + height}}};
  FlowSolid in_water{"block", shape, {}, motion, false};
  c.flow->solids = {in_water};
  SolidOptions in_soil{"block", shape, {}, motion};
  in_soil.friction = friction;
  c.soil->solids = {in_soil};
  return c;
}

std::vector<double> read(World<2>& world, GaugeQuantity quantity) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.of = "block";
  return read_gauge(world, gauge);
}

/// On the bed the soil carries what it weighs under water, the water the rest.
TEST(FreeBodiesInOneWater, ABlockSettlesOnABedAndStays) {
  World<2> world(block_on_bed(Varying(0.0)), MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.6);
  const double all = weight * density / (density - water_density);
  const Eigen::Vector3d contact = world.soil()->solids().front().force();
  const std::vector<double> force = read(world, GaugeQuantity::solid_force);
  EXPECT_NEAR(contact[2], weight, 0.005 * weight);
  EXPECT_NEAR(force[1], all, 0.001 * all);
  EXPECT_LT(std::abs(force[0]), 1e-4 * all);
  EXPECT_LT(std::hypot(read(world, GaugeQuantity::solid_velocity)[0],
                       read(world, GaugeQuantity::solid_velocity)[1]),
            1e-4);  // what is left of the first contact dies away
  expect_conservation(world);
}

/// A force along the bed moves it when it is more than friction times its weight under water.
TEST(FreeBodiesInOneWater, ABlockSlidesAboveItsFrictionOnly) {
  const auto way_under = [](double share) {
    const Varying push(
        [=](const Point3&, double t) {
          return share * friction * weight * std::clamp((t - 0.2) / 0.1, 0.0, 1.0);
        },
        "push");
    World<2> world(block_on_bed(push), MPI_COMM_WORLD);
    world.initialise();
    run_until(world, 0.3);
    const double before = read(world, GaugeQuantity::solid_displacement)[0];
    run_until(world, 0.7);
    const double way = read(world, GaugeQuantity::solid_displacement)[0] - before;
    return way;
  };
  EXPECT_LT(std::abs(way_under(0.95)), 5e-5);
  EXPECT_GT(way_under(1.05), 5e-4);
}

}  // namespace
}  // namespace mudlark

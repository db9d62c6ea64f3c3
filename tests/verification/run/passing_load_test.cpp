// ranks: 1 3
// A load that comes and goes between two steps that implicit soil would like to take.
#include <gtest/gtest.h>

#include <algorithm>

#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

constexpr double load = 1e3, stiffness = 1e6, height = 1.0;  // [Pa], [Pa], [m]
constexpr double rises = 1e5, full = 1.001e5, falls = 1.002e5, gone = 1.003e5, end = 4e5;  // [s]

/// Linear between the times above.
Varying pulse() {
  Varying varying(
      [](const Point3&, double t) {
        return load *
               std::clamp(std::min((t - rises) / (full - rises), (gone - t) / (gone - falls)), 0.0,
                          1.0);
      },
      "pulse");
  varying.in_space = false;
  varying.bends = {rises, full, falls, gone};
  return varying;
}

/// A dry elastic column without weight and without Poisson's effect.
CaseOptions column() {
  CaseOptions options;
  options.domain.cells = {9, 12, 1};
  options.domain.upper = {0.9, 1.2, 0.0};
  options.domain.gravity = {0.0, 0.0, 0.0};
  options.domain.walls[1] = {Wall::no_slip, Wall::open};
  options.time.end = end;
  SoilOptions soil;
  SoilBody body;
  body.name = "column";
  body.shape.form = BoxShape{{0.0, -1.0, 0.0}, {0.9, 1.0, height}};
  body.pore_water = PoreWater::none;
  body.law = LinearElasticOptions{stiffness, 0.0};
  soil.bodies.push_back(body);
  soil.method = TimeMethod::implicit_steps;
  soil.loads.push_back({"pulse", pulse()});
  options.soil = soil;
  return options;
}

TEST(ImplicitSteps, DoNotPassOverALoadThatComesAndGoes) {
  World<2> world(column(), MPI_COMM_WORLD);
  world.initialise();
  GaugeOptions top;
  top.quantity = GaugeQuantity::settlement;
  top.at = {0.45, 0.0, height};
  double under_load = 0.0, after = 0.0;
  while (!world.clock().finished()) {
    world.advance(world.clock().choose_step(world.stable_step()));
    const double settlement = read_gauge(world, top)[0];
    if (world.clock().time() == falls) under_load = settlement;
    after = settlement;
  }
  const double exact = load / stiffness * height;
  EXPECT_NEAR(under_load, exact, 0.01 * exact);
  EXPECT_NEAR(after, 0.0, 1e-3 * exact);
}

}  // namespace
}  // namespace mudlark

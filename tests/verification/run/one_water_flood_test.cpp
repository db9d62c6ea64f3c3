// ranks: 1 3
// Water that runs over ground, which lets through little, moves as over a floor: the ground ends
// sharply for its drag (docs/decisions/0101).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double h = 0.05;  // cell [m]

Shape box(double x0, double z0, double x1, double z1) {
  return Shape{BoxShape{{x0, -9, z0}, {x1, 9, z1}}};
}

/// A box of square cells with an open upper side.
CaseOptions flat(int columns, int rows) {
  CaseOptions c;
  c.domain.dimension = 2;
  c.domain.gravity = {0.0, -9.81, 0.0};
  c.domain.cells = {columns, rows, 1};
  c.domain.upper = {columns * h, rows * h, 0.0};
  c.domain.walls[1][1] = Wall::open;
  c.time.end = 1e4;
  FlowOptions flow;
  flow.density = 1000.0;
  c.flow = flow;
  return c;
}

/// The same with saturated ground up to `top` [m].
CaseOptions with_bed(int columns, int rows, double top, double conductivity) {
  CaseOptions c = soil_in_water(box(-9, -9, 9, top), top, conductivity, 1e6);
  c.domain = flat(columns, rows).domain;
  c.time.end = 1e4;
  c.soil->bodies[0].points_per_cell = 4;
  c.soil->bodies[0].initial_stress = GeostaticStress{};
  return c;
}

/// In steps that follow how fast the water runs, none of them much shorter than it has to be.
void run_on(World<2>& world, double time) {
  while (world.clock().time() < time - 1e-9) {
    const double left = time - world.clock().time();
    world.advance(left / std::ceil(left / world.stable_step()));
  }
}

/// Water over a height [m] in parts of the length 0.25 m wide: mean depth [m].
std::vector<double> depths(World<2>& world, double ground) {
  const Grid<2>& grid = world.grid();
  std::vector<double> found(static_cast<std::size_t>(grid.cells()[0] * h / 0.25));
  for_each(grid.owned(), [&](const Index<2>& cell) {
    const Vec<2> centre = grid.cell_centre(cell);
    if (centre[1] < ground) return;
    found[static_cast<std::size_t>(centre[0] / 0.25)] +=
        world.flow()->saturation()[cell] * world.flow()->porosity()[cell] * h * h / 0.25;
  });
  for (double& depth : found) depth = sum_over_ranks(grid, depth);
  return found;
}

/// A column 0.8 m wide and 0.4 m high. Drag of the kernel's rim, half a cell thick over the ground,
/// held the lowest row back: water ran over a layer of air, a fifth too deep behind.
TEST(OneWaterFlood, ADamBreaksOverABedAsOverAFloor) {
  const double top = 0.3, column = 0.4, width = 0.8;
  CaseOptions floor = flat(50, 12);
  floor.domain.walls[1][0] = Wall::slip;
  floor.flow->bodies.push_back({box(-9, -9, width, column), {}});
  CaseOptions bed = with_bed(50, 18, top, 1e-4);
  bed.flow->bodies.push_back({box(-9, top, width, top + column), {}});
  World<2> below(floor, MPI_COMM_WORLD), over(bed, MPI_COMM_WORLD);
  below.initialise(), over.initialise();
  for (const double time : {0.2, 0.4, 0.6}) {
    run_on(below, time), run_on(over, time);
    const std::vector<double> wanted = depths(below, 0.0), found = depths(over, top);
    double square = 0.0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      square += (found[i] - wanted[i]) * (found[i] - wanted[i]);
    EXPECT_LT(std::sqrt(square / static_cast<double>(wanted.size())), 0.02 * column) << time;
  }
  expect_conservation(over);
}

/// From a side that holds a level, over bare ground: the first thing that comes is a film thinner
/// than a cell. No row of cells stays behind as air, and in the end the water is level.
TEST(OneWaterFlood, WaterThatRisesFromASideFillsTheRowsOverTheGround) {
  const double top = 0.3;
  CaseOptions c = with_bed(20, 16, top, 1e-3);
  GroundSideOptions river;
  river.name = "river", river.axis = 0, river.side = 0;
  river.water = GroundSideWater::head;
  river.value = Varying(
      [](const Point3&, double t) { return 0.3 + 0.05 * std::clamp(t - 0.5, 0.0, 4.0); }, "river");
  c.flow->ground_sides.push_back(river);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_on(world, 1.8);  // 6.5 cm over the ground at the side
  EXPECT_GT(depths(world, top).front(), 0.6 * h);
  run_on(world, 3.0);
  EXPECT_GT(depths(world, top).back(), h);
  run_on(world, 6.0);
  const auto& water = world.flow()->saturation();
  double least = 1.0;
  const Grid<2>& grid = world.grid();
  for_each(grid.owned(), [&](const Index<2>& cell) {
    if (grid.cell_centre(cell)[1] < 0.4) least = std::min(least, water[cell]);
  });
  EXPECT_GT(-max_over_ranks(grid, -least), 0.99);
  expect_conservation(world);
}

}  // namespace
}  // namespace mudlark

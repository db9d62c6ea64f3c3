// ranks: 1
// Space one cell thick is the plane: a column of water falls against a porous block and a leaning
// body, over soil that shares its water; and water with air.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

constexpr double h = 0.025;

Shape box(double x0, double x1, double top) { return Shape{BoxShape{{x0, -9, -9}, {x1, 9, top}}}; }

using Change = std::function<void(CaseOptions&)>;

template <int D>
CaseOptions dam_break(const Change& change) {
  CaseOptions c;
  constexpr std::size_t up = D - 1;
  c.domain.dimension = D;
  c.domain.cells = {40, 1, 1};
  c.domain.upper = {40 * h, h, h};
  c.domain.cells[up] = 20;
  c.domain.upper[up] = 20 * h;
  c.domain.walls[up][0] = Wall::no_slip;
  c.domain.walls[up][1] = Wall::open;
  c.domain.gravity = {};
  c.domain.gravity[up] = -9.81;
  FlowOptions flow;
  flow.pressure_tolerance = 1e-12;
  flow.bodies.push_back({box(-9, 0.3, 0.3), {}});
  c.flow = flow;
  change(c);
  return c;
}

/// Kinetic energy per breadth in equal steps.
template <int D>
std::vector<double> energies(const Change& change, double dt, int steps) {
  World<D> world(dam_break<D>(change), MPI_COMM_WORLD);
  world.initialise();
  GaugeOptions gauge;
  gauge.quantity = GaugeQuantity::kinetic_energy;
  std::vector<double> all;
  for (int step = 0; step < steps; ++step) {
    world.advance(dt);
    all.push_back(read_gauge(world, gauge)[0] / (D == 3 ? h : 1.0));
  }
  return all;
}

void expect_the_same(const Change& change, double dt, int steps) {
  const std::vector<double> plane = energies<2>(change, dt, steps);
  const std::vector<double> space = energies<3>(change, dt, steps);
  const double largest = *std::max_element(plane.begin(), plane.end());
  EXPECT_GT(largest, 1.0);
  for (std::size_t i = 0; i < plane.size(); ++i)
    ASSERT_NEAR(space[i], plane[i], 1e-8 * largest) << "step " << i;
}

TEST(PlaneInSpace, IsTheSameDamBreakAgainstAPorousBlockAndABody) {
  expect_the_same(
      [](CaseOptions& c) {
        PorousGround block;
        block.name = "block";
        block.shape = box(0.5, 0.6, 0.2);
        block.drag = DragLaw::ergun;
        block.grain_size = 0.02;
        c.flow->porous.push_back(block);
        FlowSolid body;
        body.name = "body";
        body.shape = box(0.7131, 0.8317, 0.1123);
        c.flow->solids.push_back(body);
      },
      0.0015, 330);
}

TEST(PlaneInSpace, IsTheSameWithAir) {
  expect_the_same([](CaseOptions& c) { c.flow->gas.emplace(); }, 0.001, 60);
}

void add_sand_in_one_water(CaseOptions& c) {
  SoilBody sand;
  sand.name = "sand";
  sand.shape = box(-9, 0.3, 0.1);
  sand.pore_water = PoreWater::unified;
  sand.intrinsic_permeability = 1e-9;
  sand.points_per_cell = c.domain.dimension == 2 ? 4 : 8;
  sand.law = MohrCoulombOptions{1e6, 0.3, 0.54, 10.0};
  sand.initial_stress = GeostaticStress{};
  SoilOptions soil;
  soil.bodies.push_back(sand);
  soil.flooded.push_back(c.flow->bodies.front().shape);
  c.soil = soil;
  c.coupling.mode = CouplingMode::unified;
}

TEST(PlaneInSpace, IsTheSameOverSoilWithOneWater) {
  expect_the_same(add_sand_in_one_water, 2e-4, 500);
}

TEST(PlaneInSpace, IsTheSameBesideASideThatLetsWaterThroughUnderRain) {
  expect_the_same(
      [](CaseOptions& c) {
        add_sand_in_one_water(c);
        GroundSideOptions side;
        side.name = "river", side.axis = 0, side.side = 0;
        side.water = GroundSideWater::head, side.value = Varying(0.5);
        c.flow->ground_sides.push_back(side);
        RainOptions rain;
        rain.name = "rain", rain.intensity = Varying(1e-3);
        c.flow->rains.push_back(rain);
      },
      2e-4, 300);
}

}  // namespace
}  // namespace mudlark

// ranks: 1
// Sides that hold the grains and let the one water through (docs/methods/coupling.md): levels,
// drains, given fluxes, and rain.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, weight = 1000.0 * gravity, porosity = 0.4;

Shape box(double x0, double z0, double x1, double z1) {
  return Shape{BoxShape{{x0, -9, z0}, {x1, 9, z1}}};
}

/// Soil up to `top` in a box of square cells, water up to a level.
CaseOptions soil_box(int columns, int rows, double h, double top, double level, double k,
                     double modulus) {
  CaseOptions c = soil_in_water(box(-9, -9, 9, top), level, k, modulus);
  c.domain.dimension = 2;
  c.domain.cells = {columns, rows, 1};
  c.domain.upper = {columns * h, rows * h, 0.0};
  c.domain.walls[1][1] = Wall::slip;
  c.time.end = 1e4;
  c.soil->bodies[0].points_per_cell = 4;
  c.soil->bodies[0].law = LinearElasticOptions{modulus, 0.0};
  c.soil->bodies[0].strain = StrainMeasure::small;
  c.soil->bodies[0].initial_stress = GeostaticStress{};
  return c;
}

void add_side(CaseOptions& c, const char* name, int axis, int side, GroundSideWater water,
              double value) {
  GroundSideOptions part;
  part.name = name, part.axis = axis, part.side = side;
  part.water = water, part.value = Varying(value);
  c.flow->ground_sides.push_back(part);
}

double read(World<2>& world, GaugeQuantity quantity, double x, double z) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.at = {x, 0.0, z};
  return read_gauge(world, gauge)[0];
}

TEST(OneWaterSides, ConfinedSoilLetsThroughWhatDarcySays) {
  const double h = 0.05, k = 1e-3, left = 1.0, right = 0.6;
  CaseOptions c = soil_box(12, 9, h, 9, 9, k, 1e7);
  c.soil->mass_scaling = 100.0;
  add_side(c, "left", 0, 0, GroundSideWater::head, left);
  add_side(c, "right", 0, 1, GroundSideWater::head, right);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 3.0);
  const double exact = k * (left - right) / (12 * h) * 9 * h;
  EXPECT_NEAR(-world.flow()->ground_discharge("left"), exact, 1e-3 * exact);
  EXPECT_NEAR(world.flow()->ground_discharge("right"), exact, 1e-3 * exact);
  for (const double x : {0.125, 0.325, 0.475}) {
    const double head = left + (right - left) * x / (12 * h);
    EXPECT_NEAR(read(world, GaugeQuantity::pressure, x, 0.225), weight * (head - 0.225),
                1e-3 * weight * (left - right));
  }
  expect_conservation(world);
}

/// Charny (1951): q = k (h1^2 - h2^2)/(2 L) holds exactly between vertical faces, the seepage face
/// over the lower level included.
TEST(OneWaterSides, ADamLetsThroughWhatDupuitSays) {
  const double h = 0.04, k = 1e-2, first = 10 * h, second = 4 * h, length = 18 * h;
  CaseOptions c = soil_box(18, 12, h, 11 * h, 0.0, k, 1e6);
  c.flow->bodies.clear();
  for (int i = 0; i < 18; ++i) {
    const double way = (i + 0.5) / 18.0;
    const double level = std::sqrt(first * first + way * (second * second - first * first));
    c.flow->bodies.push_back({box(i * h, -9, (i + 1) * h, level), {}});
  }
  c.soil->flooded.clear();
  for (const WaterBody& body : c.flow->bodies) c.soil->flooded.push_back(body.shape);
  c.soil->mass_scaling = 1000.0;
  add_side(c, "reservoir", 0, 0, GroundSideWater::head, first);
  add_side(c, "tailwater", 0, 1, GroundSideWater::head, second);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 25.0);
  double in = 0.0, out = 0.0;
  const double begin = world.clock().time();
  while (world.clock().time() < 30.0) {
    const double before = world.clock().time();
    world.advance(world.stable_step());
    in -= world.flow()->ground_discharge("reservoir") * (world.clock().time() - before);
    out += world.flow()->ground_discharge("tailwater") * (world.clock().time() - before);
  }
  const double time = world.clock().time() - begin;
  const double exact = k * (first * first - second * second) / (2.0 * length);
  EXPECT_NEAR(in / time, exact, 0.01 * exact);
  EXPECT_NEAR(out / time, exact, 0.01 * exact);
  expect_conservation(world);
}

/// Discharge, pressure and effective stress in the middle of a bed that a pressure below drives
/// water through.
struct Upward {
  double discharge, pressure, stress;
};
Upward seep_upwards(double gradient) {
  const double h = 0.05, top = 16 * h, level = 1.0, k = 1e-4;
  CaseOptions c = soil_box(1, 24, h, top, level, k, 1e7);
  c.soil->mass_scaling = 1000.0;
  c.soil->damping = 0.1;
  add_side(c, "filter", 1, 0, GroundSideWater::pressure, weight * (level + gradient * top));
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 30.0);
  expect_conservation(world);
  GaugeOptions stress;
  stress.quantity = GaugeQuantity::effective_stress;
  stress.at = {0.5 * h, 0.0, 0.5 * top};
  return {-world.flow()->ground_discharge("filter") / h / k,
          read(world, GaugeQuantity::pressure, 0.5 * h, 0.5 * top) / weight,
          read_gauge(world, stress)[2]};
}

TEST(OneWaterSides, APressureBelowLiftsABedAtTheCriticalGradient) {
  const double critical = 0.6 * 1.65;
  const Upward below = seep_upwards(0.9 * critical), above = seep_upwards(1.1 * critical);
  EXPECT_NEAR(below.discharge, 0.9 * critical, 0.01 * critical);
  EXPECT_NEAR(below.pressure, 0.6 + 0.9 * critical * 0.4, 0.005);
  EXPECT_LT(below.stress, 0.0);
  EXPECT_GT(above.stress, 0.0);
  const double found = critical * (0.9 + 0.2 * below.stress / (below.stress - above.stress));
  EXPECT_NEAR(found, critical, 0.02 * critical);
}

/// Terzaghi's column with a drained top and a drained floor.
double settled_share(double T) {
  double left = 0.0;
  for (int m = 0; m < 200; ++m) {
    const double M = (m + 0.5) * std::numbers::pi;
    left += 2.0 / (M * M) * std::exp(-M * M * T);
  }
  return 1.0 - left;
}

TEST(OneWaterSides, AColumnConsolidatesOverADrainedFloor) {
  const double h = 0.05, k = 1e-5, modulus = 1e6, load = 1000.0, level = 1.1;
  CaseOptions c = soil_box(1, 24, h, 1.0, level, k, modulus);
  c.soil->mass_scaling = 1000.0;
  c.soil->loads.push_back({"plate", Varying(load)});
  add_side(c, "filter", 1, 0, GroundSideWater::head, level);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double coefficient = k * modulus / weight;
  for (const double T : {0.1, 0.2, 0.5}) {
    run_until(world, T * 0.25 / coefficient);
    const double share = read(world, GaugeQuantity::settlement, 0.5 * h, 0.99) * modulus / load;
    // Above the topmost point pores have no excess any more.
    EXPECT_NEAR(share, settled_share(T) - 0.25 * h, 0.01) << "T = " << T;
  }
  expect_conservation(world);
}

/// Sides with the level of the water inside change nothing, wherever it cuts a cell.
TEST(OneWaterSides, SoilBetweenEqualLevelsStaysAtRest) {
  const double h = 0.05;
  for (const double level : {8 * h, 8.3 * h}) {
    std::array<double, 2> settled{};
    for (const bool open : {false, true}) {
      CaseOptions c = soil_box(9, 12, h, 11 * h, level, 1e-3, 1e7);
      if (open) {
        add_side(c, "left", 0, 0, GroundSideWater::head, level);
        add_side(c, "right", 0, 1, GroundSideWater::head, level);
      }
      World<2> world(c, MPI_COMM_WORLD);
      world.initialise();
      run_until(world, 0.2);
      if (level == 8 * h) {
        EXPECT_LT(world.flow()->max_speed().speed, 1e-6);
      }
      EXPECT_LT(std::abs(world.flow()->ground_discharge("left")), 1e-8);
      settled[open ? 1 : 0] = read(world, GaugeQuantity::settlement, 4.5 * h, 10.5 * h);
      expect_conservation(world);
    }
    // Where the level cuts a cell the start is not quite in balance, and grains move water.
    const double weight_under_water = 0.6 * 1650.0 * gravity * 0.5 * 11 * h * 11 * h / 1e7;
    EXPECT_NEAR(settled[1], settled[0], level == 8 * h ? 1e-8 : 1e-3 * weight_under_water);
  }
}

/// Rain of q < k falls through dry ground that holds S, k S^3 = q, and the table rises by what is
/// left to fill: q/(n (1 - S)).
TEST(OneWaterSides, RainRaisesTheTableInTheGround) {
  const double h = 0.04, k = 1e-2, share = 0.4, q = k * share * share * share;
  CaseOptions c = soil_box(1, 15, h, 13 * h, 4 * h, k, 1e6);
  c.soil->mass_scaling = 100.0;
  c.soil->bodies[0].filling.at_start = share;
  c.flow->rains.push_back({"rain", {}, {}, Varying(q)});
  c.flow->rains[0].from = {-9, -9, -9}, c.flow->rains[0].to = {9, 9, 9};
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 35.0);
  const double first = read(world, GaugeQuantity::water_level, 0.5 * h, 0.0);
  const double whole_cells = 3 * h * porosity * (1.0 - share) / q;  // the gauge counts in cells
  run_until(world, 35.0 + whole_cells);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.5 * h, 0.0) - first, 3 * h, 0.02 * 3 * h);
  const double fallen = world.clock().time() * q * h;
  EXPECT_NEAR(-world.flow()->ledger().outflow, fallen, 1e-9 * fallen);
  expect_conservation(world);
}

/// Over ground that is full and shut off below rain stands: the pond rises by q.
TEST(OneWaterSides, RainOnWaterRaisesItsLevel) {
  const double h = 0.04, q = 1e-3;
  CaseOptions c = soil_box(9, 9, h, 4 * h, 5.2 * h, 1e-6, 1e6);
  c.flow->rains.push_back({"rain", {}, {}, Varying(q)});
  c.flow->rains[0].from = {-9, -9, -9}, c.flow->rains[0].to = {9, 9, 9};
  c.soil->mass_scaling = 1000.0;
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 20.0);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 4.5 * h, 0.0), 5.2 * h + 20.0 * q, 1e-3 * h);
  expect_conservation(world);
}

TEST(OneWaterSides, AFluxThroughTheFloorFillsThePores) {
  const double h = 0.04, q = 1e-3;
  CaseOptions c = soil_box(1, 24, h, 22 * h, 4 * h, 1e-2, 1e6);
  c.soil->mass_scaling = 1000.0;
  add_side(c, "filter", 1, 0, GroundSideWater::inflow, q);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 40.0);
  EXPECT_NEAR(-world.flow()->ground_discharge("filter"), q * h, 1e-9 * q);
  EXPECT_NEAR(-world.flow()->ledger().outflow, q * h * 40.0, 0.001 * q * h * 40.0);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.5 * h, 0.0), 4 * h + q * 40.0 / porosity,
              0.3 * h);
  expect_conservation(world);
}

/// Green & Ampt's front without suction, upwards: n dL/dt = k (H - L)/L.
TEST(OneWaterSides, DrySoilFillsFromAPressureBelow) {
  const double h = 0.04, k = 1e-2, head = 0.8;
  CaseOptions c = soil_box(1, 24, h, 23 * h, 0.0, k, 1e6);
  c.flow->bodies.clear();
  c.soil->flooded.clear();
  c.flow->bodies.push_back({box(0, 0, h, 0.01), {}});
  c.soil->mass_scaling = 100.0;
  add_side(c, "filter", 1, 0, GroundSideWater::head, head);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double depth = 0.4;  // n L dL = k (H - L) dt
  run_until(world, porosity / k * (-depth - head * std::log(1.0 - depth / head)));
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.5 * h, 0.0), depth, 0.02);
  expect_conservation(world);
}

}  // namespace
}  // namespace mudlark

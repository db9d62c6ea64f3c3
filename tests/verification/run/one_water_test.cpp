// ranks: 1
// Free and pore water as one (NUMERICS C2): rest, consolidation, undrained loading, conservation.
#include "verification/run/one_water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/gauges.hpp"

namespace mudlark {
namespace {

constexpr double grain_density = 2650.0, porosity = 0.4, gravity = 9.81, viscosity = 1e-3;

/// A bed of 1 m (height of the cells h) under 0.2 m of water.
template <int D>
CaseOptions bed(double h, double conductivity, double modulus) {
  CaseOptions c;
  const int n = static_cast<int>(std::lround(1.3 / h));
  constexpr std::size_t up = D - 1;
  c.domain.dimension = D;
  c.domain.cells = {3, 3, 3};
  c.domain.upper = {3 * h, 3 * h, 3 * h};
  c.domain.cells[up] = n;
  c.domain.upper[up] = n * h;
  c.domain.gravity = {};
  c.domain.gravity[up] = -gravity;
  c.time.end = 0.5;
  FlowOptions flow;
  flow.viscosity = viscosity;
  flow.bodies.push_back({Shape{BoxShape{{-9, -9, -9}, {9, 9, 1.2}}}, {}});
  c.flow = flow;
  SoilBody body;
  body.name = "bed";
  body.shape.form = BoxShape{{-9, -9, -9}, {9, 9, 1.0}};
  body.pore_water = PoreWater::unified;
  body.intrinsic_permeability = conductivity * viscosity / (1000.0 * gravity);
  body.points_per_cell = D == 2 ? 4 : 8;
  body.law = LinearElasticOptions{modulus, 0.0};
  body.strain = StrainMeasure::small;
  body.initial_stress = GeostaticStress{};
  SoilOptions soil;
  soil.bodies.push_back(body);
  soil.flooded.push_back(flow.bodies.front().shape);
  c.soil = soil;
  c.coupling.mode = CouplingMode::unified;
  return c;
}

template <int D>
double read(World<D>& world, GaugeQuantity quantity, double height) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  const double middle = 1.5 * world.grid().spacing()[0];
  gauge.at = {middle, D == 3 ? middle : 0.0, height};
  return read_gauge(world, gauge)[0];
}

template <int D>
void stays_at_rest(GrainShare share, double settled, double speed) {
  CaseOptions options = bed<D>(0.05, 1e-3, 1e6);
  options.coupling.grain_share = share;
  World<D> world(options, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.25);
  const double self_weight = 0.5 * (1.0 - porosity) * (grain_density - 1000.0) * gravity / 1e6;
  EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, 0.98)), settled * self_weight);
  EXPECT_LT(read(world, GaugeQuantity::max_speed, 0.0), speed);
  EXPECT_NEAR(read(world, GaugeQuantity::pressure, 0.3), 1000.0 * gravity * 0.9, 1.0);
  expect_conservation(world);
}
TEST(OneWater, ASubmergedBedStaysAtRest) { stays_at_rest<2>(GrainShare::points, 1e-4, 1e-6); }
/// It moves, slowly, until what the points and what the cells have of it agree.
TEST(OneWater, ASubmergedBedHardlyMovesWithTheSharesOfCells) {
  stays_at_rest<2>(GrainShare::cells, 1e-3, 1e-5);
}
TEST(OneWater, ASubmergedBedStaysAtRestIn3D) { stays_at_rest<3>(GrainShare::points, 1e-4, 1e-6); }

/// Pore pressure at the base over the load (Terzaghi 1943).
double isochrone_at_the_base(double T) {
  double sum = 0.0;
  for (int m = 0; m < 200; ++m) {
    const double M = (m + 0.5) * std::numbers::pi;
    sum += 2.0 * (m % 2 == 0 ? 1.0 : -1.0) / M * std::exp(-M * M * T);
  }
  return sum;
}

TEST(OneWater, ConsolidatesAsTerzaghiSays) {
  const double load = 1000.0, k = 1e-3, modulus = 2e6;
  CaseOptions c = bed<2>(0.05, k, modulus);
  c.soil->loads.push_back({"plate", Varying(load)});
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double base = 0.0125;
  const double at_rest = read(world, GaugeQuantity::pore_pressure, base);
  const double coefficient = k * modulus / (1000.0 * gravity);
  for (const double T : {0.1, 0.2, 0.4}) {
    run_until(world, T / coefficient);
    const double excess = read(world, GaugeQuantity::pore_pressure, base) - at_rest;
    EXPECT_NEAR(excess / load, isochrone_at_the_base(T), 0.01) << "T = " << T;
  }
  expect_conservation(world);
}

/// However little the soil lets through, the step is the same, and water carries the load at first.
TEST(OneWater, TakesTheWholeLoadInSoilThatLetsNothingThrough) {
  std::vector<double> steps;
  for (const double k : {1e-5, 1e-9}) {
    CaseOptions c = bed<2>(0.05, k, 1e6);
    c.soil->loads.push_back({"plate", Varying(1000.0)});
    World<2> world(c, MPI_COMM_WORLD);
    world.initialise();
    const double at_rest = read(world, GaugeQuantity::pore_pressure, 0.3);
    run_until(world, 0.05);
    EXPECT_NEAR(read(world, GaugeQuantity::pore_pressure, 0.3) - at_rest, 1000.0, 5.0) << k;
    steps.push_back(world.stable_step());
    EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, 0.98)), 1e-5) << k;
  }
  EXPECT_NEAR(steps[0], steps[1], 0.01 * steps[0]);
}

/// Grains of a closed box that are thrown up fall through the water they stir, and nothing is lost.
TEST(OneWater, KeepsWaterAndGrainsWhenABedIsThrownUp) {
  CaseOptions c = bed<2>(0.05, 1e-2, 1e5);
  c.domain.cells[0] = 12;
  c.domain.upper[0] = 0.6;
  c.soil->bodies[0].shape.form = BoxShape{{-9, -9, -9}, {0.3, 9, 0.8}};
  c.soil->bodies[0].law = MuIOptions{1e5, 0.2, 2650.0, 0.38, 0.64, 0.28, 1e-3};
  c.soil->bodies[0].strain = StrainMeasure::jaumann;
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.4);
  EXPECT_GT(read(world, GaugeQuantity::max_speed, 0.0), 0.1);
  expect_conservation(world);
}

}  // namespace
}  // namespace mudlark

// ranks: 1
// Columns of soil in one water (NUMERICS C2): large strain with permeability that follows the
// porosity, scaled inertia, damping, grains of two densities, water that gives way, seepage from
// below.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double porosity = 0.4, gravity = 9.81, viscosity = 1e-3;

/// A column of 1 m in cells of 5 cm, under water of 1.2 m.
CaseOptions column(double conductivity, double modulus) {
  CaseOptions c;
  constexpr double h = 0.05;
  c.domain.dimension = 2;
  c.domain.cells = {1, 26, 1};
  c.domain.upper = {h, 26 * h, 1.0};
  c.domain.gravity = {0.0, -gravity, 0.0};
  FlowOptions flow;
  flow.viscosity = viscosity;
  flow.bodies.push_back({Shape{BoxShape{{-9, -9, -9}, {9, 9, 1.2}}}, {}});
  c.flow = flow;
  SoilBody body;
  body.name = "column";
  body.shape.form = BoxShape{{-9, -9, -9}, {9, 9, 1.0}};
  body.pore_water = PoreWater::unified;
  body.intrinsic_permeability = conductivity * viscosity / (1000.0 * gravity);
  body.points_per_cell = 4;
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

double read(World<2>& world, GaugeQuantity quantity, double height) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.at = {0.025, 0.0, height};
  return read_gauge(world, gauge)[0];
}

/// Table 1 of the paper with k0 = 1e-3 m/s: 400 kPa, constrained modulus 1346 kPa, Kirchhoff stress
/// linear in logarithmic strain. Settlements of the column after 1 and 4 s: finite volumes in the
/// material coordinate (200 cells, Radau).
void expect_large_strain(PermeabilityLaw law, double after_one, double after_four) {
  CaseOptions c = column(1e-3, 1e6);
  c.soil->bodies[0].permeability_law = law;
  c.soil->bodies[0].law = LinearElasticOptions{1e6, 0.3};
  c.soil->bodies[0].strain = StrainMeasure::hencky;
  c.soil->loads.push_back({"plate", Varying(400e3)});
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 1.0);
  EXPECT_NEAR(read(world, GaugeQuantity::settlement, 1.0), after_one, 0.01 * 0.2094);
  run_until(world, 4.0);
  EXPECT_NEAR(read(world, GaugeQuantity::settlement, 1.0), after_four, 0.01 * 0.2094);
}
TEST(OneWaterColumn, SettlesFarAtConstantPermeability) {
  expect_large_strain(PermeabilityLaw::constant, 0.11755, 0.19953);
}
TEST(OneWaterColumn, SettlesSlowlyWhereItsPoresLetLessThrough) {
  expect_large_strain(PermeabilityLaw::kozeny_carman, 0.06722, 0.13067);
}

/// Pore pressure at the base over the load (Terzaghi 1943).
double isochrone_at_the_base(double T) {
  double sum = 0.0;
  for (int m = 0; m < 200; ++m) {
    const double M = (m + 0.5) * std::numbers::pi;
    sum += 2.0 * (m % 2 == 0 ? 1.0 : -1.0) / M * std::exp(-M * M * T);
  }
  return sum;
}

TEST(OneWaterColumn, ConsolidatesInLongStepsWithScaledInertia) {
  const double load = 1000.0, k = 1e-5, modulus = 1e6;
  CaseOptions c = column(k, modulus);
  c.soil->mass_scaling = 1000.0;
  c.soil->loads.push_back({"plate", Varying(load)});
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  EXPECT_GT(world.stable_step(), 0.02);  // thirty times that of its own inertia
  const double at_rest = read(world, GaugeQuantity::pore_pressure, 0.0125);
  const double coefficient = k * modulus / (1000.0 * gravity);
  for (const double T : {0.1, 0.2}) {
    run_until(world, T / coefficient);
    const double excess = read(world, GaugeQuantity::pore_pressure, 0.0125) - at_rest;
    EXPECT_NEAR(excess / load, isochrone_at_the_base(T), 0.01) << "T = " << T;
  }
}

/// Amplitude of the top of a dry column after a period, over the one before, by its own mode.
double amplitude_left(double damping) {
  CaseOptions c = column(1e-2, 1e6);
  c.flow->bodies.clear();
  c.soil->flooded.clear();
  c.soil->damping = damping;
  c.soil->flip_fraction = 1.0;
  c.soil->bodies[0].initial_velocity[2] = Varying(
      [](const Point3& x, double) { return 0.01 * std::sin(0.5 * std::numbers::pi * x[2]); },
      "0.01 * sin(pi * z / 2)");
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double period = 4.0 / std::sqrt(1e6 / ((1.0 - porosity) * 2650.0));
  double first = 0.0, second = 0.0;
  while (world.clock().time() < 1.5 * period) {
    world.advance(world.stable_step());
    const double up = -read(world, GaugeQuantity::settlement, 0.98);
    (world.clock().time() < 0.5 * period ? first : second) =
        std::max(up, world.clock().time() < 0.5 * period ? first : second);
  }
  return second / first;
}

/// Under F = -k x the damping a|F| against the motion leaves x^2 (1 + a) of the way out and x^2 (1
/// - a) of the way back: (1 - a)/(1 + a) of the amplitude per period.
TEST(OneWaterColumn, LosesTheAmplitudeThatLocalDampingTakes) {
  const double undamped = amplitude_left(0.0);
  EXPECT_NEAR(undamped, 1.0, 0.01);
  for (const double damping : {0.05, 0.3})
    EXPECT_NEAR(amplitude_left(damping) / undamped, (1.0 - damping) / (1.0 + damping), 0.015);
}

TEST(OneWaterColumn, StaysAtRestWithHeavyGrainsOnLightOnes) {
  CaseOptions c = column(1e-3, 1e6);
  c.soil->bodies.push_back(c.soil->bodies[0]);
  c.soil->bodies[0].grain_density = 2000.0;
  c.soil->bodies[0].shape.form = BoxShape{{-9, -9, -9}, {9, 9, 0.5}};
  c.soil->bodies[1].name = "ballast";
  c.soil->bodies[1].grain_density = 4000.0;
  c.soil->bodies[1].shape.form = BoxShape{{-9, -9, 0.5}, {9, 9, 1.0}};
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.25);
  const double self_weight =  // grains under water: 1000 kg/m3 below, 3000 kg/m3 above
      (1.0 - porosity) * gravity * (3000.0 * 0.5 * 0.75 + 1000.0 * 0.125) / 1e6;
  EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, 0.98)), 1e-4 * self_weight);
  EXPECT_LT(read(world, GaugeQuantity::max_speed, 0.0), 1e-5);
}

/// Water and skeleton share a load as their stiffnesses K/n and M are, and its storage slows
/// consolidation: c_v = k/(gamma_w (1/M + n/K)).
TEST(OneWaterColumn, WaterThatGivesWayCarriesItsShareOfALoad) {
  const double modulus = 1e6, bulk = porosity * modulus, load = 1000.0, k = 3e-3;
  CaseOptions c = column(k, modulus);
  c.soil->water_bulk_modulus = bulk;
  c.soil->damping = 0.5;
  c.soil->loads.push_back({"plate", Varying(load)});
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double at_rest = read(world, GaugeQuantity::pore_pressure, 0.0125);
  const double coefficient = k / (1000.0 * gravity * (1.0 / modulus + porosity / bulk));
  for (const double T : {0.2, 0.4}) {
    run_until(world, T / coefficient);
    const double excess = read(world, GaugeQuantity::pore_pressure, 0.0125) - at_rest;
    EXPECT_NEAR(excess / load, 0.5 * isochrone_at_the_base(T), 0.01) << "T = " << T;
  }
  EXPECT_LT(conservation_errors(world)[0].second, 1e-12);
}

TEST(OneWaterColumn, StaysAtRestOverASourceThatGivesNothing) {
  CaseOptions c = column(1e-3, 1e6);
  FlowSideOptions source;
  source.axis = 1, source.side = 0;
  c.flow->sides.push_back(source);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.1);
  const double self_weight = 0.5 * (1.0 - porosity) * 1650.0 * gravity / 1e6;
  EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, 0.98)), 1e-4 * self_weight);
}

/// Water from below through a closed wall: the gradient of Darcy's law takes that much of the
/// weight from the grains at the base.
TEST(OneWaterColumn, WaterFromBelowCarriesGrainsByItsGradient) {
  const double k = 1e-2, gradient = 0.5, modulus = 1e6;
  CaseOptions c = column(k, modulus);
  FlowSideOptions source;
  source.name = "source";
  source.axis = 1, source.side = 0;
  source.value = Varying(gradient * k / porosity);
  c.flow->sides.push_back(source);
  c.domain.walls[1][1] = Wall::open;
  c.soil->damping = 0.3;
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 1.5);
  const double depth = read(world, GaugeQuantity::water_level, 0.0) - 0.1;
  const double excess = read(world, GaugeQuantity::pore_pressure, 0.1) - 1000.0 * gravity * depth;
  EXPECT_NEAR(excess / (1000.0 * gravity * 0.9), gradient, 0.01);
  const double heave = 1000.0 * gravity * gradient * 0.5 / modulus;
  EXPECT_NEAR(-read(world, GaugeQuantity::settlement, 0.9875), heave, 0.02 * heave);
  EXPECT_LT(conservation_errors(world)[0].second, 1e-12);
}

/// Soil and water between two rough plates under a weight along them: grains carry all of it once
/// water seeps steadily, u = rho g (b^2 - z^2)/(2 G).
TEST(OneWaterColumn, HangsBetweenFixedPlates) {
  const double modulus = 1e6, push = 0.5;
  CaseOptions c = column(1e-4, modulus);
  c.domain.cells = {3, 10, 1};
  c.domain.upper = {0.15, 0.5, 1.0};
  c.domain.gravity = {push, 0.0, 0.0};
  c.domain.walls[0] = {Wall::periodic, Wall::periodic};
  c.soil->bodies[0].initial_stress = SymTensor{};
  c.soil->damping = 0.6;
  for (const int side : {0, 1}) {
    SoilBoundary plate;
    plate.name = side == 0 ? "below" : "above";
    plate.axis = 1, plate.side = side;
    plate.for_grains = true;
    plate.grains = GrainSide::fixed;
    c.soil->boundaries.push_back(plate);
  }
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.6);
  GaugeOptions gauge;
  gauge.quantity = GaugeQuantity::displacement;
  gauge.at = {0.0875, 0.0, 0.2625};
  const double density = porosity * 1000.0 + (1.0 - porosity) * 2650.0;
  const double sag = density * push * (0.0625 - 0.0125 * 0.0125) / (2.0 * 0.5 * modulus);
  EXPECT_NEAR(read_gauge(world, gauge)[0], sag, 0.02 * sag);
}

/// A stage takes the load away: elastic soil comes back as far as it went.
TEST(OneWaterColumn, ComesBackWhenAStageTakesTheLoadAway) {
  CaseOptions c = column(1e-2, 1e6);
  c.soil->damping = 0.5;
  c.soil->mass_scaling = 4.0;
  c.soil->loads.push_back({"plate", Varying(1000.0)});
  c.soil->stages.resize(2);
  c.soil->stages[1].loads = std::vector<bool>{false};
  c.time.stage_ends = {2.0, 4.0};
  c.time.end = 4.0;
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 2.0);
  EXPECT_NEAR(read(world, GaugeQuantity::settlement, 0.9875), 0.9875e-3, 1.5e-5);
  world.begin_next_stage();
  run_until(world, 4.0);
  EXPECT_NEAR(read(world, GaugeQuantity::settlement, 0.9875), 0.0, 1.5e-5);
}

}  // namespace
}  // namespace mudlark

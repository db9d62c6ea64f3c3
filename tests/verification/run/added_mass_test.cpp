// A soft bed rocks under deep water: loose coupling diverges when the step is too short for the
// water's added mass, the relaxed one does not (NUMERICS C3).
#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A bed 2 m wide and 0.5 m deep, set rocking with half a wave over its width, under 10 m of water.
CaseOptions rocking_bed(double added_mass_factor, double step) {
  CaseOptions c;
  c.domain.cells = {20, 110, 1};
  c.domain.upper = {2.0, 11.0, 0.0};
  c.domain.gravity = {0.0, -9.81, 0.0};
  c.domain.walls[1][1] = Wall::open;
  c.time.end = 0.4;
  c.time.step = step;
  FlowOptions flow;
  flow.bodies.push_back({Shape{BoxShape{{0, -1, 0}, {2, 1, 10.5}}}, {}});
  c.flow = flow;
  SoilBody body;
  body.name = "bed";
  body.shape.form = BoxShape{{0, -1, 0}, {2, 1, 0.5}};
  body.intrinsic_permeability = 1e-6 * 1.002e-3 / 9810.0;
  body.law = LinearElasticOptions{1e5, 0.3};
  body.strain = StrainMeasure::hencky;
  body.initial_stress = GeostaticStress{};
  body.initial_velocity[2] = Varying(
      [](const Point3& x, double) { return 0.01 * std::cos(pi * x[0] / 2.0) * x[2]; }, "rocking");
  SoilOptions soil;
  soil.bodies.push_back(body);
  soil.water_bulk_modulus = 2.15e7;
  c.soil = soil;
  c.coupling.mode = CouplingMode::surface;
  c.coupling.mudline = Mudline::consistent;
  c.coupling.added_mass_factor = added_mass_factor;
  return c;
}

/// Kinetic energy of the soil at the end over that at the start; infinite when the run diverged.
double energy_growth(double added_mass_factor, double step) {
  World<2> world(rocking_bed(added_mass_factor, step), MPI_COMM_WORLD);
  world.initialise();
  const double start = world.soil()->totals().kinetic_energy;
  try {
    while (!world.clock().finished()) world.advance(world.clock().choose_step(1.0));
  } catch (const DivergenceError&) {
    return HUGE_VAL;
  }
  std::printf("added mass: a = %.2f, factor %g: energy grew %.3g times\n", world.added_mass(step),
              added_mass_factor, world.soil()->totals().kinetic_energy / start);
  return world.soil()->totals().kinetic_energy / start;
}

/// A column 0.1 m wide that gives way evenly: all of the 39 m of water above it moves.
CaseOptions narrow_column(double added_mass_factor) {
  CaseOptions c = rocking_bed(added_mass_factor, 0.004);
  c.domain.cells = {1, 400, 1};
  c.domain.upper = {0.1, 40.0, 0.0};
  c.time.end = 0.6;
  c.flow->bodies[0].shape.form = BoxShape{{0, -1, 0}, {0.1, 1, 39.8}};
  SoilBody& body = c.soil->bodies[0];
  body.shape.form = BoxShape{{0, -1, 0}, {0.1, 1, 1.0}};
  body.intrinsic_permeability = 1e-4 * 1.002e-3 / 9810.0;
  body.law = LinearElasticOptions{1e6, 0.3};
  body.initial_velocity[2] = {};
  c.coupling.mudline = Mudline::load_only;
  c.coupling.ramp = 0.036;
  return c;
}

/// Largest speed of the soil at the end [m/s]; infinite when the run diverged.
double speed_at_end(const CaseOptions& options) {
  World<2> world(options, MPI_COMM_WORLD);
  world.initialise();
  try {
    while (!world.clock().finished()) world.advance(world.clock().choose_step(1.0));
  } catch (const DivergenceError&) {
    return HUGE_VAL;
  }
  return std::sqrt(2.0 * world.soil()->totals().kinetic_energy);
}

TEST(AddedMass, OfAllTheWaterMovesWhereTheWholeBedGivesWay) {
  const double waves_only = 0.1 / pi / 38.8;  // what a wave of the bed would move
  const double short_of_mass = speed_at_end(narrow_column(waves_only));
  const double held = speed_at_end(narrow_column(1.0));
  std::printf("narrow column: sqrt(2 E_kin) = %.3g with L/pi, %.3g with all of the water\n",
              short_of_mass, held);
  EXPECT_GT(short_of_mass, 100.0 * held);
  EXPECT_LT(held, 1.0);
}

TEST(AddedMass, MakesLooseCouplingDivergeAtShortSteps) {
  EXPECT_GT(energy_growth(0.0, 0.005), 100.0);
}

TEST(AddedMass, IsHandledByRelaxingTheBedsVelocityAtAnyStep) {
  EXPECT_LT(energy_growth(1.0, 0.02), 2.0);
  EXPECT_LT(energy_growth(1.0, 0.005), 2.0);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
/// Rigid bodies in implicit steps: forces that are known, and bodies that stand by them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/errors.hpp"
#include "verification/soil/side_runs.hpp"

namespace mudlark {
namespace {

using soil_runs::constrained_modulus;

constexpr double infinity = std::numeric_limits<double>::infinity();

SolidOptions make_solid(const Shape& shape) {
  SolidOptions solid;
  solid.name = "body";
  solid.shape = shape;
  return solid;
}

SoilOptions make_soil(int dimension, const Point3& lower, const Point3& upper, bool wet,
                      LinearSolver solver) {
  SoilOptions soil = soil_runs::make_soil(dimension, lower, upper, wet);
  soil.method = TimeMethod::implicit_steps;
  soil.step_tolerance = 1.0;
  soil.linear_solver = solver;
  return soil;
}

template <int D>
void run(SoilSolver<D>& soil, int steps, double dt) {
  for (int step = 0; step < steps; ++step) {
    soil.begin_step(step * dt, dt, nullptr);
    soil.advance(dt);
  }
}

constexpr std::array<LinearSolver, 2> both_solvers{LinearSolver::direct, LinearSolver::iterative};

/// What takes long is left to one rank.
bool on_one_rank() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks == 1;
}

/// A plate that is pushed into a confined column, 4 cells wide.
PrescribedSolid push_down(double by) {
  PrescribedSolid motion;
  motion.by_displacement = true;
  motion.translation[2] =
      Varying([=](const Point3&, double t) { return -by * std::min(1.0, t); }, "-by t");
  return motion;
}

TEST(ImplicitSolid, PressesAConfinedColumnWithItsModulusTimesTheStrain) {
  for (const LinearSolver solver : both_solvers)
    for (const double top : {1.0, 0.975}) {  // at faces of the grid, and between them
      const Grid<2> grid = soil_runs::make_grid<2>({4, 24, 1}, 0.05, "sssn", 0.0, MPI_COMM_WORLD);
      SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, top}, false, solver);
      SolidOptions plate = make_solid({BoxShape{{-1, -infinity, top}, {2, infinity, 1.2}}});
      const double strain = 0.01;
      plate.motion = push_down(strain * top);
      options.solids.push_back(plate);
      SoilSolver<2> soil(grid, options);
      soil.initialise();
      run(soil, 4, 0.25);
      const Solid& body = soil.solids()[0];
      const double exact =
          -constrained_modulus(1e6, 0.3) * std::log(1.0 - strain) / (1.0 - strain) * 0.2;
      std::printf("plate at %g: force %.6g, exact %.6g (%+.3f %%)\n", top, body.force()[2], exact,
                  100 * (body.force()[2] / exact - 1));
      EXPECT_NEAR(body.displacement()[2], -strain * top, 1e-12);
      EXPECT_NEAR(body.force()[2], exact, 0.02 * exact);
      EXPECT_NEAR(body.force()[0], 0.0, 1e-6 * exact);
    }
}

// Consolidation under a plate that nothing but its load moves. It is sealed: water leaves at the
// base (Terzaghi 1943, one-way drainage: U = sqrt(4 T / pi) up to T = 0.2).
TEST(ImplicitSolid, SettlesOnWetSoilAsTerzaghiHasIt) {
  for (const LinearSolver solver : both_solvers) {
    if (solver == LinearSolver::iterative && !on_one_rank()) continue;
    const Grid<2> grid = soil_runs::make_grid<2>({4, 24, 1}, 0.05, "sssn", 0.0, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, 1.0}, true, solver);
    options.water_bulk_modulus = 2e9;
    options.bodies[0].strain = StrainMeasure::small;
    options.bodies[0].intrinsic_permeability = 1e-6 * 1.002e-3 / 9810.0;
    options.step_tolerance = 1e-3;
    options.boundaries.push_back(soil_runs::water_side(1, 0, WaterSide::pressure, Varying(0.0)));
    SolidOptions plate = make_solid({BoxShape{{-1, -infinity, 1.0}, {2, infinity, 1.2}}});
    FreeSolid motion;
    motion.mass = 10.0, motion.inertia = {1, 1, 1};
    motion.force[2] = Varying(-1000.0);
    motion.locked[0] = true;
    plate.motion = motion;
    plate.centre = Point3{0.1, 0.0, 1.1};
    options.solids.push_back(plate);
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    double time = 0.0;
    const double modulus = constrained_modulus(1e6, 0.3), diffusivity = 1e-6 * modulus / 9810.0;
    const double end = 0.15 / diffusivity;
    while (time < end) {
      const double dt = std::min(soil.outer_step(), end - time);
      soil.begin_step(time, dt, nullptr);
      soil.advance(dt);
      time += dt;
    }
    const Solid& body = soil.solids()[0];
    const double exact = 5000.0 / modulus * std::sqrt(4.0 * 0.15 / std::numbers::pi);
    std::printf("settlement %.6g m, exact %.6g (%+.2f %%), force %.9g N, turn %.2e\n",
                -body.displacement()[2], exact, 100 * (-body.displacement()[2] / exact - 1),
                body.force()[2], body.rotation()[1]);
    EXPECT_NEAR(-body.displacement()[2], exact, 0.015 * exact);
    EXPECT_NEAR(body.force()[2], 1000.0, 1e-4);
    EXPECT_NEAR(body.rotation()[1], 0.0, 1e-6);
  }
}

/// A block on tilted ground, its way after four steps.
double way_on_slope(double friction, LinearSolver solver) {
  DomainOptions domain;
  domain.dimension = 2;
  domain.cells = {30, 9, 1};
  domain.upper = {1.5, 0.45, 0.0};
  domain.walls = {{{Wall::slip, Wall::slip}, {Wall::no_slip, Wall::open}, {}}};
  const double angle = 25.0 / 180.0 * std::numbers::pi, g = 9.81;
  domain.gravity = {g * std::sin(angle), -g * std::cos(angle), 0.0};
  const Grid<2> grid(domain, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {0, -1, 0}, {2, 1, 0.1}, false, solver);
  options.bodies[0].law = LinearElasticOptions{1e7, 0.3};
  SolidOptions block = make_solid({BoxShape{{0.5, -infinity, 0.1}, {0.9, infinity, 0.3}}});
  FreeSolid motion;
  motion.density = 2000.0;
  block.motion = motion;
  block.friction = friction;
  options.solids.push_back(block);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  run(soil, 4, 1.0);
  const Solid& body = soil.solids()[0];
  const double weight = body.mass() * g;
  EXPECT_NEAR(body.force()[0], -weight * std::sin(angle), 1e-6 * weight);
  EXPECT_NEAR(body.force()[2], weight * std::cos(angle), 1e-6 * weight);
  return body.displacement().norm();
}

TEST(ImplicitSolid, StandsOnASlopeOrFindsNoHold) {
  for (const LinearSolver solver : both_solvers) {
    EXPECT_LT(way_on_slope(0.6, solver), 2e-3);  // tan 25 degrees = 0.466
    if (on_one_rank()) {
      EXPECT_THROW(way_on_slope(0.4, solver), DivergenceError);
    }
  }
}

/// Force, moment and turn of a footing that is loaded beside its middle, and of one that is pushed
/// and turned; the same in the plane and in space.
template <int D>
std::array<double, 4> eccentric(bool wet, LinearSolver solver) {
  const Grid<D> grid = soil_runs::make_grid<D>(
      D == 2 ? std::array<int, 3>{12, 10, 1} : std::array<int, 3>{12, 1, 10}, 0.05,
      D == 2 ? "ssno" : "ssssno", 9.81, MPI_COMM_WORLD);
  SoilOptions options = make_soil(D, {0, 0, 0}, {1, 1, 0.3}, wet, solver);
  options.water_bulk_modulus = 1e8;
  SolidOptions block = make_solid({BoxShape{{0.2, 0.0, 0.3}, {0.45, 0.05, 0.4}}});
  FreeSolid motion;
  motion.density = 2000.0;
  const double thickness = D == 2 ? 1.0 : 0.05;
  motion.force[2] = Varying(-200.0 * thickness);
  motion.moment[1] = Varying((D == 2 ? 1.0 : -1.0) * 5.0 * thickness);
  motion.locked = {false, true, false};
  motion.locked_rotation = {true, false, true};
  block.motion = motion;
  block.friction = 0.3;
  options.solids.push_back(block);
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  run(soil, 3, 10.0);
  const Solid& body = soil.solids()[0];
  return {body.displacement()[2], body.rotation()[1], body.force()[2] / thickness,
          body.moment()[1] / thickness};
}

TEST(ImplicitSolid, DoesTheSameInSpaceAndWithBothSolvers) {
  for (const bool wet : {false, true}) {
    if (wet && !on_one_rank()) continue;
    const auto plane = eccentric<2>(wet, LinearSolver::direct);
    std::printf("settlement %.6g m, turn %.6g, force %.9g N, moment %.9g N m\n", -plane[0],
                plane[1], plane[2], plane[3]);
    EXPECT_NEAR(plane[2], 200.0 + 2000.0 * 9.81 * 0.025, 1e-4);
    EXPECT_NEAR(std::abs(plane[3]), 5.0, 1e-4);
    EXPECT_GT(std::abs(plane[1]), 1e-4);
    const auto space = eccentric<3>(wet, LinearSolver::direct);
    const auto iterative = eccentric<2>(wet, LinearSolver::iterative);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(space[i], plane[i], 1e-3 * std::abs(plane[i])) << i;
      EXPECT_NEAR(iterative[i], plane[i], 0.01 * std::abs(plane[i])) << i;
    }
  }
}

/// Way of a footing in two steps that stands on soil without stress, or that has found its rest
/// before time zero.
double way_under_weight(bool at_rest) {
  const Grid<2> grid = soil_runs::make_grid<2>({12, 10, 1}, 0.05, "ssno", 9.81, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, 0.3}, false, LinearSolver::direct);
  if (at_rest) options.start_in_equilibrium = EquilibriumStart{};
  SolidOptions block = make_solid({BoxShape{{0.2, -infinity, 0.3}, {0.4, infinity, 0.4}}});
  FreeSolid motion;
  motion.density = 2000.0;
  block.motion = motion;
  options.solids.push_back(block);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  soil.find_equilibrium();
  run(soil, 2, 1.0);
  const double weight = 2000.0 * 9.81 * 0.02;
  EXPECT_NEAR(soil.solids()[0].force()[2], weight, 1e-3 * weight);
  return soil.solids()[0].displacement().norm();
}

TEST(ImplicitSolid, StartsInEquilibriumUnderItsWeight) {
  const double sinks = way_under_weight(false);
  EXPECT_GT(sinks, 1e-4);
  EXPECT_LT(way_under_weight(true), 2e-3 * sinks);
}

}  // namespace
}  // namespace mudlark

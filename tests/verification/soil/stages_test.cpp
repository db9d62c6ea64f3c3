// ranks: 1 3
// Stages: settings of their own, soil that is taken out and placed, and books that close.
#include <gtest/gtest.h>

#include "soil/placing.hpp"
#include "soil/seeding.hpp"
#include "verification/soil/side_runs.hpp"

namespace mudlark {
namespace {

constexpr double h = 0.25, young = 2e7, poisson = 0.3, unit_weight = 0.6 * 2650.0 * 9.81;

template <int D>
Grid<D> column_grid() {
  return soil_runs::make_grid<D>({3, D == 2 ? 14 : 3, 14}, h, D == 2 ? "ssso" : "ssssso", 9.81,
                                 MPI_COMM_WORLD);
}

/// A column of 3 m under its own weight; a second body of 1 m fits on it where the upper metre has
/// been dug.
template <int D>
SoilOptions column() {
  SoilOptions soil = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 3.0}, false);
  SoilBody& body = soil.bodies[0];
  body.law = LinearElasticOptions{young, poisson};
  body.strain = StrainMeasure::logarithmic;
  body.initial_stress = GeostaticStress{};
  soil.damping = 0.7;
  return soil;
}

template <int D>
void run_until(SoilSolver<D>& soil, double& time, double end) {
  while (time < end - 1e-12) {
    const double dt = std::min(soil.outer_step(), end - time);
    const int steps =
        soil.is_implicit() ? 1 : static_cast<int>(std::ceil(dt / soil.stable_step() - 1e-9));
    soil.begin_step(time, dt, nullptr);
    for (int i = 0; i < steps; ++i) soil.advance(dt / steps);
    time += dt;
  }
}

/// Mean settlement of the points that started within half a cell below a height [m].
template <int D>
double settlement_below(const SoilSolver<D>& soil, double height, double cell = h) {
  std::array<double, 2> mine{}, all{};
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double start = points.start[D - 1][p];
    if (start > height || start < height - 0.5 * cell) continue;
    mine[0] += start - points.position[D - 1][p], mine[1] += 1.0;
  }
  MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all[0] / all[1];
}

/// Relief by gamma d on what is left, of height z: heave gamma d z/M, M the constrained modulus.
template <int D>
void expect_heave(TimeMethod method) {
  const Grid<D> grid = column_grid<D>();
  SoilOptions options = column<D>();
  options.stages.resize(2);
  options.stages[1].name = "dig";
  options.stages[1].remove = Shape{BoxShape{{-1, -1, 2.0}, {9, 9, 9}}};
  options.stages[1].method = method;
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  run_until(soil, time, 0.02);
  EXPECT_NEAR(settlement_below(soil, 2.0), 0.0, 1e-6) << "the geostatic start is at rest";
  const auto before = soil.totals();
  soil.begin_stage(1);
  const auto after = soil.totals();
  EXPECT_NEAR(after.excavated_grain_mass, before.grain_mass / 3.0, 1e-12 * before.grain_mass);
  EXPECT_NEAR(after.grain_mass + after.excavated_grain_mass, before.grain_mass,
              1e-13 * before.grain_mass);
  EXPECT_EQ(after.points, before.points * 2 / 3);
  run_until(soil, time, 0.5);
  const double modulus = soil_runs::constrained_modulus(young, poisson);
  const double place = 2.0 - 0.25 * h;  // mean place of the points measured
  const double heave = unit_weight * 1.0 * place / modulus;
  EXPECT_NEAR(settlement_below(soil, 2.0), -heave, 0.005 * heave);
}

TEST(Stages, ReliefByDiggingHeavesTheGroundAsTheoryHasIt) {
  expect_heave<2>(TimeMethod::explicit_steps);
  expect_heave<2>(TimeMethod::implicit_steps);
  expect_heave<3>(TimeMethod::explicit_steps);
}

/// What was dug is placed again; it takes only the space that is free, and brings the ground back.
template <int D>
void expect_refill() {
  const Grid<D> grid = column_grid<D>();
  SoilOptions options = column<D>();
  options.stages.resize(3);
  options.stages[1].remove = Shape{BoxShape{{-1, -1, 2.0}, {9, 9, 9}}};
  options.bodies.push_back(options.bodies[0]);
  SoilBody& fill = options.bodies[1];
  fill.name = "fill", fill.stage = 2;
  fill.shape.form = BoxShape{{-1, -1, 1.0}, {9, 9, 3.0}};  // half of it is taken
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  EXPECT_EQ(soil.points(1).size(), 0u);
  const auto start = soil.totals();
  double time = 0.0;
  run_until(soil, time, 0.02);
  soil.begin_stage(1);
  run_until(soil, time, 0.4);
  soil.begin_stage(2);
  const auto filled = soil.totals();
  EXPECT_NEAR(filled.placed_grain_mass, start.grain_mass / 3.0, 1e-12 * start.grain_mass);
  EXPECT_NEAR(filled.grain_mass, start.grain_mass, 1e-12 * start.grain_mass);
  const auto& fresh = soil.points(1);
  for (std::size_t p = 0; p < fresh.size(); ++p) {
    EXPECT_GT(fresh.position[D - 1][p], 2.0);
    // Geostatic within the fill alone.
    const double depth = 3.0 - fresh.position[D - 1][p];
    EXPECT_NEAR(fresh.stress[2][p], -unit_weight * depth, 1e-6 * unit_weight);
  }
  run_until(soil, time, 0.8);
  const double modulus = soil_runs::constrained_modulus(young, poisson);
  EXPECT_NEAR(settlement_below(soil, 2.0), 0.0, 0.01 * unit_weight * 2.0 / modulus);
}

TEST(Stages, FillTakesTheFreeSpaceAndBringsTheGroundBack) {
  expect_refill<2>();
  expect_refill<3>();
}

/// Degree of consolidation of a column drained at one end (Terzaghi, 1925) at the time factor c_v
/// t/H2.
double consolidated(double time_factor) {
  double left = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double m = (i + 0.5) * M_PI;
    left += 2.0 / (m * m) * std::exp(-m * m * time_factor);
  }
  return 1.0 - left;
}

/// Under water that stands to the ground's surface: digging in explicit steps is undrained, and
/// what heaves in the end is the submerged weight; fill brings ground and pore pressure back.
TEST(Stages, OfWetGroundEndInTheStatesOfSubmergedWeight) {
  constexpr double submerged = 0.6 * (2650.0 - 1000.0) * 9.81, water = 1000.0 * 9.81;
  const Grid<2> grid = column_grid<2>();
  SoilOptions options = column<2>();
  options.bodies[0].pore_water = PoreWater::two_phase;
  options.water_bulk_modulus = 2e9;
  options.step_tolerance = 2e-3;
  options.bodies.push_back(options.bodies[0]);
  options.bodies[1].stage = 3;
  options.bodies[1].initial_stress = SymTensor{};
  options.stages.resize(4);
  options.stages[1].remove = Shape{BoxShape{{-1, -1, 2.0}, {9, 9, 9}}};
  options.stages[2].method = options.stages[3].method = TimeMethod::implicit_steps;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double place = 2.0 - 0.25 * h;
  const double heave = submerged * place / soil_runs::constrained_modulus(young, poisson);
  const auto expect_hydrostatic = [&](double surface) {
    double worst = 0.0;
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t p = 0; p < soil.points(b).size(); ++p)
        worst = std::max(worst, std::abs(soil.points(b).pore_pressure[p] -
                                         water * (surface - soil.points(b).position[1][p])));
    // A front that starts as a jump leaves a ripple from point to point that cells do not see.
    EXPECT_LT(worst, 0.03 * water);
  };
  double time = 0.0;
  run_until(soil, time, 0.005);
  soil.begin_stage(1);
  run_until(soil, time, 0.03);
  // Excess pressure of minus the submerged weight dug off, which dissipates as in consolidation.
  const double rate = options.bodies[0].intrinsic_permeability / options.water_viscosity *
                      soil_runs::constrained_modulus(young, poisson);
  const double early = (2.0 * consolidated(rate * 0.025 / 4.0) - (2.0 - place)) / place * heave;
  EXPECT_NEAR(settlement_below(soil, 2.0), -early, 0.02 * heave);
  soil.begin_stage(2);
  run_until(soil, time, 20.0);
  EXPECT_NEAR(settlement_below(soil, 2.0), -heave, 0.01 * heave);
  expect_hydrostatic(2.0 + heave);
  soil.begin_stage(3);
  EXPECT_NEAR(soil.totals().placed_grain_mass, soil.totals().excavated_grain_mass, 1e-9);
  run_until(soil, time, 40.0);
  EXPECT_NEAR(settlement_below(soil, 2.0), 0.0, 0.02 * heave);
  expect_hydrostatic(3.0);
}

TEST(Stages, HaveLoadsAndSettingsOfTheirOwnAndThoseOfTheSolverOtherwise) {
  const Grid<2> grid = column_grid<2>();
  SoilOptions options = column<2>();
  options.loads.push_back({"a", Varying(1000.0)});
  options.loads.push_back({"b", Varying(200.0), LoadedPhase::skeleton});
  options.stop_when_static = RestCriterion{};
  options.stages.resize(3);
  options.stages[0].loads = std::vector<bool>{false, false};
  options.stages[1].damping = 0.2, options.stages[1].mass_scaling = 9.0;
  options.stages[1].loads = std::vector<bool>{true, false};
  options.stages[2].method = TimeMethod::implicit_steps;
  options.stages[2].reset_displacements = true;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  EXPECT_EQ(soil.options().damping, 0.7);
  const double step = soil.stable_step();
  double time = 0.0;
  run_until(soil, time, 0.01);
  EXPECT_LT(soil.statics()->unbalanced_force, 0.01);  // the loads would be a tenth
  soil.begin_stage(1);
  EXPECT_EQ(soil.options().damping, 0.2);
  EXPECT_NEAR(soil.stable_step(), 3.0 * step, 1e-2 * step);
  EXPECT_TRUE(soil.options().stop_when_static);
  run_until(soil, time, 1.5);
  const double modulus = soil_runs::constrained_modulus(young, poisson);
  const double place = 2.0 - 0.25 * h;
  EXPECT_NEAR(settlement_below(soil, 2.0), 1000.0 * place / modulus, 2e-2 * 1000.0 * 2.0 / modulus);
  soil.begin_stage(2);
  EXPECT_TRUE(soil.is_implicit());
  EXPECT_FALSE(soil.options().stop_when_static);
  EXPECT_EQ(soil.largest_displacement(), 0.0);
  run_until(soil, time, 2.0);
  EXPECT_NEAR(settlement_below(soil, 2.0), 200.0 * place / modulus, 2e-2 * 1000.0 * 2.0 / modulus);
}

/// Loaded within milliseconds in explicit steps, consolidating in implicit ones, and going on in
/// explicit ones without damping: no jump where one kind of steps takes over from the other.
TEST(Stages, GoFromWavesToConsolidationAndBack) {
  constexpr double load = 1000.0, size = 0.1, height = 1.0;
  const Grid<2> grid = soil_runs::make_grid<2>({3, 12, 1}, size, "ssso", 0.0, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {9, 9, height}, true);
  options.bodies[0].strain = StrainMeasure::logarithmic;
  options.loads.push_back({"q", Varying(load)});
  options.stages.resize(3);
  options.stages[0].damping = 0.5;
  options.step_tolerance = 1e-3;
  options.stages[1].method = TimeMethod::implicit_steps;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double modulus = soil_runs::constrained_modulus(1e6, 0.3);
  const double undrained = modulus + options.water_bulk_modulus / options.bodies[0].porosity;
  // c_v = kappa/(mu (1/M + n/K_w)), p_0 = q (1 - M/M_u).
  const double rate = options.bodies[0].intrinsic_permeability / options.water_viscosity * modulus *
                      (1.0 - modulus / undrained);
  const double place = height - 0.25 * size;  // of the points measured, where drained soil is
  const auto expect_settlement = [&](double time) {
    const double exact =
        load * height / undrained +
        load * height * (1.0 / modulus - 1.0 / undrained) * consolidated(rate * time) -
        load / modulus * (height - place);
    EXPECT_NEAR(settlement_below(soil, height, size), exact, 0.01 * load * height / modulus)
        << "at " << time << " s";
  };
  double time = 0.0;
  run_until(soil, time, 0.02);
  expect_settlement(time);
  soil.begin_stage(1);
  for (const double end : {0.2, 1.0, 3.0}) {
    run_until(soil, time, end);
    expect_settlement(time);
  }
  soil.begin_stage(2);
  EXPECT_FALSE(soil.is_implicit());
  for (const double end : {3.002, 3.005, 3.02}) {
    run_until(soil, time, end);
    expect_settlement(time);
  }
}

/// An implicit step may be as short as it likes: what it moves by has no inertia afterwards.
TEST(Stages, StartFromRestAfterImplicitSteps) {
  const Grid<2> grid = column_grid<2>();
  SoilOptions options = column<2>();
  options.damping = 0.0;
  options.loads.push_back({"q", Varying(1000.0)});
  options.stages.resize(2);
  options.stages[0].method = TimeMethod::implicit_steps;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  run_until(soil, time, 1e-5);
  const double exact = 1000.0 * (3.0 - 0.25 * h) / soil_runs::constrained_modulus(young, poisson);
  EXPECT_NEAR(settlement_below(soil, 3.0), exact, 0.01 * exact);
  soil.begin_stage(1);
  for (const double end : {0.01, 0.02, 0.04, 0.08}) {
    run_until(soil, time, end);
    EXPECT_NEAR(settlement_below(soil, 3.0), exact, 0.01 * exact);
  }
}

// Water seeps from side to side through stages of explicit, implicit and explicit steps: the same
// flow in all of them once it is steady, q = k (p_1 - p_2)/(rho g L).
TEST(Stages, SidesWithAPressureHoldItThroughAChangeOfMethod) {
  constexpr double conductivity = 0.01, width = 0.1;
  const Grid<2> grid = soil_runs::make_grid<2>({10, 3, 1}, width, "ssss", 0.0, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::filled(2, conductivity);
  options.step_tolerance = 1e-2;
  options.boundaries.push_back(soil_runs::water_side(0, 0, WaterSide::pressure, Varying(2000.0)));
  options.boundaries.push_back(soil_runs::water_side(0, 1, WaterSide::pressure, Varying(500.0)));
  options.stages.resize(3);
  options.stages[1].method = TimeMethod::implicit_steps;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double exact = conductivity * 1500.0 / 9810.0 * 3 * width;
  double time = 0.0;
  for (std::size_t stage = 0; stage < 3; ++stage) {
    if (stage > 0) soil.begin_stage(stage);
    run_until(soil, time, time + (stage == 1 ? 100.0 : 0.15));
    EXPECT_NEAR(-soil.discharge("00"), exact, 0.01 * exact) << "stage " << stage;
    EXPECT_NEAR(soil.discharge("01"), exact, 0.01 * exact) << "stage " << stage;
    EXPECT_LT(soil_runs::worst_pressure(soil, 0, 2000.0, -1500.0), 15.0) << "stage " << stage;
  }
}

/// A lattice of another number of points, over points that have moved and changed their volume.
TEST(Stages, SitesAreTakenWhereAPointsShareOfSpaceReaches) {
  const Grid<2> grid = soil_runs::make_grid<2>({12, 8, 1}, 1.0, "ppss", 0.0, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {20, 1, 4.0}, false);
  SoilParticles<2> ground = seed_points(grid, options.bodies[0], 0, Transfer::flip);
  for (std::size_t p = 0; p < ground.size(); ++p) ground.position[1][p] += 0.26;  // to 4.26
  SoilBody fill = options.bodies[0];
  fill.points_per_cell = 16;
  fill.shape.form = BoxShape{{-1, -1, 3.0}, {20, 1, 6.0}};
  SoilParticles<2> fresh = seed_points(grid, fill, 1, Transfer::flip);
  TakenSites<2> taken(grid, 4);
  taken.add(ground);
  taken.gather();
  taken.clear(fresh);
  const double count = sum_over_ranks(grid, static_cast<double>(fresh.size()));
  EXPECT_EQ(count, 12 * 4 * 7);  // rows from 4.375 to 5.875
  for (std::size_t p = 0; p < fresh.size(); ++p) EXPECT_GT(fresh.position[1][p], 4.26);
}

}  // namespace
}  // namespace mudlark

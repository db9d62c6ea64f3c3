// ranks: 1 3
/// Local damping of each phase, scaled inertia, and how far from rest soil is.
#include "soil/statics.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "base/errors.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

// A block that falls freely: each phase gets its own share of its weight. Nothing else acts: no
// drag, no stress.
TEST(Damping, TakesItsOwnShareFromGrainsAndWater) {
  const Grid<2> grid = make_grid<2>({10, 24, 1}, 0.1, "oooo", 9.81, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {0.3, -1, 1.6}, {0.6, 1, 1.9}, true);
  options.bodies[0].intrinsic_permeability = 1e3;
  for (const bool apart : {true, false}) {
    options.damping = 0.2;
    if (apart)
      options.water_damping = 0.5;
    else
      options.water_damping.reset();
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    set_velocity(soil,
                 [](int axis, const Vec<2>&, std::int64_t) { return axis == 1 ? -1.0 : 0.0; });
    double time = 0.0;
    run(soil, time, 100, 1e-4);
    for (const double v : soil.points(0).velocity[1])
      EXPECT_NEAR(v, -1.0 - 0.8 * 9.81 * 0.01, 1e-8);
    for (const double v : soil.points(0).water_velocity[1])
      EXPECT_NEAR(v, -1.0 - (apart ? 0.5 : 0.8) * 9.81 * 0.01, 1e-8);
  }
}

// Inertia times 9 makes the bar swing three times as slowly, at steps three times as long, and
// keeps its energy.
TEST(MassScaling, SlowsAnElasticBarByItsSquareRoot) {
  const Grid<2> grid = make_grid<2>({32, 8, 1}, 1.0 / 32, "ssss", 0.0, MPI_COMM_WORLD);
  for (const bool wet : {false, true}) {
    SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, 0.25}, wet);
    options.flip_fraction = 1.0;
    options.bodies[0].law = LinearElasticOptions{1e7, 0.0};
    SoilSolver<2> plain(grid, options);
    plain.initialise();
    options.mass_scaling = 9.0;
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    EXPECT_NEAR(soil.stable_step() / plain.stable_step(), 3.0, 1e-12);
    if (wet) continue;
    set_velocity(soil, [](int axis, const Vec<2>& x, std::int64_t) {
      return axis == 0 ? 5e-3 * std::sin(std::numbers::pi * x[0]) : 0.0;
    });
    const double start = soil.totals().kinetic_energy;
    EXPECT_NEAR(start, 9.0 * 0.5 * 0.6 * 2650.0 * 25e-6 * 0.5 * 0.25, 1e-2 * start);
    const double period = 3.0 * 2.0 / std::sqrt(1e7 / (0.6 * 2650.0));
    const double length = 1.25 * period;
    const int steps = static_cast<int>(std::ceil(length / (0.2 * soil.stable_step())));
    double time = 0.0;
    run(soil, time, steps, length / steps);
    const double kinetic = soil.totals().kinetic_energy;
    EXPECT_LT(kinetic, 1e-3 * start);  // a quarter past: all in stress
    EXPECT_NEAR(soil.energy().internal + kinetic, start, 1e-3 * start);
  }
}

struct Rest {
  double settlement, stress_error, scheme;
  Statics statics;
  int steps;
};

/// A dry column of 1 m under its own weight, damped until it is at rest.
Rest settle(double mass_scaling) {
  const Grid<2> grid = make_grid<2>({4, 24, 1}, 0.05, "sssn", 9.81, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, 1}, false);
  options.damping = 0.7;
  options.mass_scaling = mass_scaling;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  EXPECT_FALSE(soil.statics().has_value());
  const double dt = soil.stable_step();
  double time = 0.0;
  run(soil, time, 1, 1e-3 * dt);
  EXPECT_NEAR(soil.statics()->unbalanced_force, 1.0, 1e-2);  // the weight, and nothing under it
  Rest rest{};
  const RestCriterion criterion{1e-4, 1e-6, 0.0};
  do {
    run(soil, time, 50, dt);
    rest.steps += 50;
    rest.statics = *soil.statics();
  } while (!rest.statics.at_rest(criterion) && rest.steps < 5000);
  const auto& points = soil.points(0);
  std::array<double, 3> mine{}, all{};
  for (std::size_t p = 0; p < points.size(); ++p) {
    mine[0] += points.start[1][p] - points.position[1][p];
    mine[1] += 1.0;
    // The weight above a place is that of the material that started above it.
    const double exact = -9.81 * 0.6 * 2650.0 * (1.0 - points.start[1][p]);
    mine[2] += std::abs(points.stress[2][p] - exact) / (9.81 * 0.6 * 2650.0);
  }
  MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  rest.settlement = all[0] / all[1], rest.stress_error = all[2] / all[1];
  const SoilEnergy energy = soil.energy();
  rest.scheme =
      (energy.external - energy.internal - energy.damping - soil.totals().kinetic_energy) /
      energy.external;
  return rest;
}

// The end does not know of the inertia on the way: mean settlement rho g H^2 / (3 M) to first order
// in the strain (1.2 %).
TEST(Statics, TellWhenAColumnRestsWithAnyInertia) {
  const double modulus = constrained_modulus(1e6, 0.3);
  const double exact = 9.81 * 0.6 * 2650.0 / (3.0 * modulus);
  for (const double scaling : {1.0, 100.0}) {
    const Rest rest = settle(scaling);
    std::printf(
        "mass scaling %g: %d steps, mean settlement %.6e m (small strain %.6e), stress error "
        "%.2e, unbalanced %.2e, kinetic %.2e, scheme %.2e\n",
        scaling, rest.steps, rest.settlement, exact, rest.stress_error,
        rest.statics.unbalanced_force, rest.statics.kinetic_energy, rest.scheme);
    EXPECT_LT(rest.steps, 5000);
    EXPECT_NEAR(rest.settlement, exact, 1.5e-2 * exact);
    EXPECT_LT(rest.stress_error, 1e-2);
    EXPECT_LT(std::abs(rest.scheme), 1e-2);
  }
}

// A slope is not at rest under the stress of its columns; it is after the search, and then stays,
// whatever its damping. Its settlement on the way is forgotten or kept.
TEST(Equilibrium, OfASlopeIsFoundAndStays) {
  for (const bool reset : {true, false}) {
    const Grid<2> grid = make_grid<2>({24, 12, 1}, 0.1, "ssnn", 9.81, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {}, {}, false);
    options.bodies[0].shape.form = BelowShape{{{0.0, 1.0}, {0.8, 1.0}, {1.8, 0.4}}};
    options.bodies[0].initial_stress = GeostaticStress{};
    options.start_in_equilibrium = EquilibriumStart{{1e-4, 1e-6, 0.0}, 0.7, 60.0, reset};
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    double time = 0.0;
    SoilSolver<2> plain = [&] {
      SoilOptions without = options;
      without.start_in_equilibrium.reset();
      return SoilSolver<2>(grid, without);
    }();
    plain.initialise();
    plain.find_equilibrium();
    const double dt = plain.stable_step();
    run(plain, time, 200, dt);
    const double unsettled = plain.totals().kinetic_energy;
    soil.find_equilibrium();
    EXPECT_EQ(soil.totals().kinetic_energy, 0.0);
    EXPECT_FALSE(soil.statics().has_value());
    const auto largest_displacement = [&] {
      double largest = 0.0, all = 0.0;
      const auto& points = soil.points(0);
      for (std::size_t p = 0; p < points.size(); ++p)
        for (int a = 0; a < 2; ++a)
          largest = std::max(largest, std::abs(points.position[a][p] - points.start[a][p]));
      MPI_Allreduce(&largest, &all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
      return all;
    };
    const double before = largest_displacement();
    time = 0.0;
    run(soil, time, 200, dt);
    std::printf(
        "slope: displacement %.2e m, then %.2e m; kinetic energy %.2e J, not settled %.2e J\n",
        before, largest_displacement(), soil.totals().kinetic_energy, unsettled);
    if (reset) {
      EXPECT_EQ(before, 0.0);
      EXPECT_LT(largest_displacement(), 1e-5);
    } else {
      EXPECT_GT(before, 1e-4);
    }
    EXPECT_LT(soil.totals().kinetic_energy, 1e-4 * unsettled);
  }
}

TEST(Equilibrium, OfABlockInTheAirDoesNotExist) {
  const Grid<2> grid = make_grid<2>({8, 40, 1}, 0.1, "ssnn", 9.81, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {0.2, -1, 3}, {0.5, 1, 3.3}, false);
  options.start_in_equilibrium = EquilibriumStart{{}, 0.7, 0.1, true};
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  EXPECT_THROW(soil.find_equilibrium(), InputError);
}

TEST(Statics, AreZeroForSoilThatStartsInEquilibrium) {
  const Grid<2> grid = make_grid<2>({4, 24, 1}, 0.05, "sssn", 9.81, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, 1}, true);
  options.bodies[0].initial_stress = GeostaticStress{};
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  run(soil, time, 1, 1e-3 * soil.stable_step());
  EXPECT_LT(soil.statics()->unbalanced_force, 0.05);  // the rim of the kernel at the top
}

}  // namespace
}  // namespace mudlark

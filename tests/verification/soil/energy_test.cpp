// ranks: 1 3
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

struct Balance {
  double kinetic, scheme;
  SoilEnergy energy;
};

Balance balance_of(SoilSolver<2>& soil) {
  const SoilEnergy& energy = soil.energy();
  const double kinetic = soil.totals().kinetic_energy;
  return {kinetic,
          energy.external - energy.internal - energy.drag - energy.damping -
              (kinetic - energy.start_kinetic),
          energy};
}

SoilOptions bar(bool wet, double flip_fraction) {
  SoilOptions soil = make_soil(2, {0, -1, 0}, {1, 1, 0.25}, wet);
  soil.flip_fraction = flip_fraction;
  soil.bodies[0].law = LinearElasticOptions{1e7, 0.0};
  return soil;
}

/// A bar between two slip walls in its first mode along x, 5 mm/s.
void swing(SoilSolver<2>& soil) {
  set_velocity(soil, [](int axis, const Vec<2>& x, std::int64_t) {
    return axis == 0 ? 5e-3 * std::sin(std::numbers::pi * x[0]) : 0.0;
  });
}

// Energy goes back and forth between motion and stress for five periods; the exact bar keeps it.
TEST(Energy, OfASwingingElasticBarIsKeptByFlipAndLostByPic) {
  for (const double flip : {1.0, 0.0}) {
    const Grid<2> grid = make_grid<2>({32, 8, 1}, 1.0 / 32, "ssss", 0.0, MPI_COMM_WORLD);
    SoilSolver<2> soil(grid, bar(false, flip));
    soil.initialise();
    swing(soil);
    const double start = soil.totals().kinetic_energy;
    const double speed = std::sqrt(1e7 / (0.6 * 2650.0)), period = 2.0 / speed;
    double time = 0.0;
    const double dt = 0.2 * soil.stable_step();
    run(soil, time, static_cast<int>(5.25 * period / dt), dt);  // ends at rest, all in stress
    const Balance end = balance_of(soil);
    std::printf("flip %g: start %.3e, kinetic %.3e, internal %.3e, external %.3e J\n", flip, start,
                end.kinetic, end.energy.internal, end.energy.external);
    EXPECT_NEAR(end.energy.external, 0.0, 1e-12);
    EXPECT_NEAR(end.energy.damping, 0.0, 1e-12);
    if (flip == 1.0)
      EXPECT_NEAR(end.energy.internal + end.kinetic, start, 1e-3 * start);
    else
      EXPECT_LT(end.energy.internal + end.kinetic, 0.8 * start);
  }
}

// A column that settles under its own weight: the weight's work is known from the points.
TEST(Energy, GivenByGravityIsTheWeightTimesTheWayDown) {
  for (const bool wet : {false, true}) {
    const Grid<2> grid = make_grid<2>({4, 40, 1}, 1.0 / 40, "sssn", 9.81, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, 0.75}, wet);
    options.damping = 0.3;
    options.flip_fraction = 1.0;
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    double time = 0.0;
    run(soil, time, 800, 0.5 * soil.stable_step());
    double work = 0.0;  // of the grains, and of pore water that moves with them
    const auto& points = soil.points(0);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double grains = points.grain_mass[p];
      if (wet) continue;
      work += 9.81 * grains * (points.start[1][p] - points.position[1][p]);
    }
    double all = 0.0;
    MPI_Allreduce(&work, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const Balance end = balance_of(soil);
    std::printf(
        "column: external %.4e, by the points %.4e, internal %.4e, drag %.3e, damping %.3e, "
        "kinetic %.3e, scheme %.3e J\n",
        end.energy.external, all, end.energy.internal, end.energy.drag, end.energy.damping,
        end.kinetic, end.scheme);
    if (!wet) {
      EXPECT_NEAR(end.energy.external, all, 1e-6 * all);
    }
    EXPECT_GT(end.energy.damping, 0.0);
    EXPECT_EQ(end.energy.drag > 0.0, wet);
    EXPECT_LT(std::abs(end.scheme), 1e-3 * end.energy.external);
  }
}

}  // namespace
}  // namespace mudlark

// Grains and water on the faces of a step.
#include "flow/moving_grains.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

Grid<2> box() {
  DomainOptions options;
  options.cells = {6, 6, 1};
  options.upper = {1.0, 1.0, 1.0};
  return Grid<2>(options, MPI_COMM_WORLD);
}

struct Speeds {
  double grains, water;  ///< [m/s]
};

/// On a face in the middle of sand that falls at 3 m/s, in pores that hold `water` per volume,
/// which has fallen at 1.4 m/s so far.
Speeds after_a_step(double water) {
  constexpr double dt = 0.01;
  const Grid<2> grid = box();
  MovingGrains<2> grains(grid);
  CellField<2> held(grid, "water", "1", water), porosity(grid, "porosity", "1", 0.4);
  CellField<2> unknown(grid, "unknown", "1");
  FaceVector<2> capacity(grid, "capacity", "1", 0.4), reach(grid, "reach", "1");
  FaceVector<2> velocity(grid, "velocity", "m/s"), mobility(grid, "mobility", "m2 s/kg", dt / 1e3);
  for (int a = 0; a < 2; ++a) {
    grains.inertia[a].fill(0.6 * 2650.0);
    grains.share[a].fill(0.6);
    grains.resistance[a].fill(9.81e6);  // k = 1e-3 m/s
  }
  grains.velocity[1].fill(-3.0);
  velocity[1].fill(-1.4);
  GrainsInWater<2>(grid).couple(capacity, held, porosity, unknown, reach, nullptr, dt, velocity,
                                mobility, grains);
  return {grains.velocity[1][{3, 3}], velocity[1][{3, 3}]};
}

/// Where one run is left with nothing, another may be with 1e-20 of it, by round-off.
TEST(GrainsInWater, TakeNextToNoWaterAlongAsTheyTakeNone) {
  for (const double water : {0.0, 1e-30, 1e-20, 1e-12, 1e-7}) {
    const Speeds after = after_a_step(water);
    EXPECT_NEAR(after.grains, -3.0, 1e-6) << water;
    EXPECT_NEAR(after.water, -3.0, 1e-3) << water;
  }
}

}  // namespace
}  // namespace mudlark

// ranks: 1
// One water where loose coupling fails: a soft bed that rocks under deep water.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

/// The bed of added_mass_test.cpp: loose coupling diverges below 5 ms, here every step will do.
TEST(OneWaterAddedMass, ABedRocksUnderDeepWaterAtAnyStep) {
  for (const double step : {4e-3, 1e-3, 2.5e-4, 5e-5}) {
    CaseOptions c = soil_in_water(Shape{BoxShape{{-9, -9, -9}, {9, 9, 0.5}}}, 10.5, 1e-6, 1e5);
    c.domain.cells = {10, 55, 1};
    c.domain.upper = {2.0, 11.0, 0.0};
    SoilBody& bed = c.soil->bodies.front();
    bed.initial_stress = GeostaticStress{};
    bed.points_per_cell = 4;
    bed.initial_velocity[2] =
        Varying([](const Point3& x,
                   double) { return 0.01 * std::cos(std::numbers::pi * x[0] / 2.0) * x[2]; },
                "rocking");
    World<2> world(c, MPI_COMM_WORLD);
    world.initialise();
    const double start = world.soil()->totals().kinetic_energy;
    double largest = 0.0;
    for (int i = 0; i < 100; ++i) {
      world.advance(step);
      largest = std::max(largest, world.soil()->totals().kinetic_energy);
    }
    EXPECT_LT(largest, 1.05 * start) << step;
  }
}

}  // namespace
}  // namespace mudlark

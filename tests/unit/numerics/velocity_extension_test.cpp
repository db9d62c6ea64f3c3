#include "numerics/velocity_extension.hpp"

#include <gtest/gtest.h>

#include "numerics/near_water.hpp"

namespace mudlark {
namespace {

/// Speed on a face over a cell that stands on a body and holds `dust`, when water falls through the
/// face at 1 m/s.
double falling_through(double dust) {
  DomainOptions options;
  options.cells = {8, 8, 1};
  options.upper = {1.0, 1.0, 1.0};
  const Grid<2> grid(options, MPI_COMM_WORLD);
  const NearWater<2> near(grid);
  CellField<2> unknown(grid, "unknown", "1"), water(grid, "water", "1");
  CellField<2> porosity(grid, "porosity", "1", 1.0), drains(grid, "drains", "1");
  FaceVector<2> capacity(grid, "capacity", "1", 1.0), velocity(grid, "velocity", "m/s");
  for (int i = 0; i < 8; ++i) capacity[1][{i, 3}] = 0.0;  // top of the body
  water[{3, 3}] = dust, water[{3, 4}] = 0.3;
  velocity[1][{3, 4}] = -1.0;
  VelocityExtension<2>(grid, near.cells())
      .extend(unknown, water, porosity, capacity, drains, velocity);
  return velocity[1][{3, 4}];
}

/// A film on a body lies still where no water with pressure is near; dust is no film, or round-off
/// would hold up what falls.
TEST(VelocityExtension, TakesDustOnABodyForNoFilm) {
  EXPECT_EQ(falling_through(0.0), -1.0);
  EXPECT_EQ(falling_through(1e-20), -1.0);
  EXPECT_EQ(falling_through(1e-3), 0.0);
}

}  // namespace
}  // namespace mudlark

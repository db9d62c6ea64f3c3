// ranks: 1 3
#include "numerics/near_water.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

Grid<2> grid_of(int cells, Wall wall) {
  DomainOptions options;
  options.cells = {cells, 24, 1};
  options.upper = {1.0, 1.0, 1.0};
  for (auto& axis : options.walls) axis = {wall, wall};
  return Grid<2>(options, MPI_COMM_WORLD);
}

struct State {
  explicit State(const Grid<2>& grid)
      : water(grid, "W", "1"), porosity(grid, "theta", "1", 1.0), velocity(grid, "v", "m/s") {}
  CellField<2> water, porosity;
  FaceVector<2> velocity;

  void update(const Grid<2>& grid) {
    Ghosts<2> ghosts(grid);
    ghosts.update(water);
    ghosts.update(porosity);
    ghosts.update_velocity(velocity);
  }
};

/// Cells of all ranks that are near.
double near_cells(const Grid<2>& grid, const CellRuns<2>& near) {
  double count = 0.0;
  for_each_offset(near, grid.owned(), [&](std::ptrdiff_t) { count += 1.0; });
  return sum_over_ranks(grid, count);
}

template <class Expected>
void expect_near(const Grid<2>& grid, const CellRuns<2>& near, Expected&& expected) {
  CellField<2> found(grid, "found", "1");
  for_each_place(near, grid.owned(),
                 [&](std::ptrdiff_t at, const Index<2>&) { found.data()[at] += 1.0; });
  for_each(grid.owned(), [&](const Index<2>& cell) {
    EXPECT_EQ(found[cell], expected(cell) ? 1.0 : 0.0) << cell[0] << " " << cell[1];
  });
}

TEST(NearWater, IsEverywhereAtFirst) {
  const Grid<2> grid = grid_of(40, Wall::slip);
  EXPECT_EQ(near_cells(grid, NearWater<2>(grid).cells()), 40.0 * 24.0);
}

TEST(NearWater, ReachesFiveCellsFromWaterAndTwoFromAVelocity) {
  const Grid<2> grid = grid_of(40, Wall::slip);
  State state(grid);
  const auto set = [&](CellField<2>& field, Index<2> cell, double value) {
    if (grid.owned().contains(cell)) field[cell] = value;
  };
  set(state.water, {{13, 11}}, 1e-3);
  set(state.water, {{33, 3}}, 1e-8);  // dust
  if (grid.owned().contains({{27, 18}})) state.velocity[1][{{27, 18}}] = 0.1;
  state.update(grid);
  NearWater<2> near(grid);
  near.find(state.water, state.porosity, state.velocity, false);
  const auto within = [](const Index<2>& cell, int i, int j, int reach) {
    return std::abs(cell[0] - i) <= reach && std::abs(cell[1] - j) <= reach;
  };
  expect_near(grid, near.cells(), [&](const Index<2>& cell) {
    return within(cell, 13, 11, 5) || within(cell, 27, 18, 2);
  });
  // Water that vanished counts once more; ground only where it is asked for.
  set(state.water, {{13, 11}}, 0.0);
  set(state.porosity, {{35, 12}}, 0.4);
  state.velocity.fill(0.0);
  state.update(grid);
  near.find(state.water, state.porosity, state.velocity, false);
  expect_near(grid, near.cells(), [&](const Index<2>& cell) { return within(cell, 13, 11, 5); });
  near.find(state.water, state.porosity, state.velocity, true);
  expect_near(grid, near.cells(), [&](const Index<2>& cell) { return within(cell, 35, 12, 5); });
}

TEST(NearWater, GoesOnAcrossAPeriodicSeam) {
  const Grid<2> grid = grid_of(40, Wall::periodic);
  State state(grid);
  if (grid.owned().contains({{1, 12}})) state.water[{{1, 12}}] = 1.0;
  state.update(grid);
  NearWater<2> near(grid);
  near.find(state.water, state.porosity, state.velocity, false);
  expect_near(grid, near.cells(), [&](const Index<2>& cell) {
    return (cell[0] <= 6 || cell[0] >= 36) && std::abs(cell[1] - 12) <= 5;
  });
  near.take_all();
  EXPECT_EQ(near_cells(grid, near.cells()), 40.0 * 24.0);
}

TEST(NearWater, LooksWhereItWasNearIfNothingElseChanges) {
  const Grid<2> grid = grid_of(40, Wall::slip);
  State state(grid);
  const auto set = [&](Index<2> cell, double value) {
    if (grid.owned().contains(cell)) state.water[cell] = value;
  };
  set({{13, 11}}, 1.0);
  state.update(grid);
  NearWater<2> near(grid);
  near.find(state.water, state.porosity, state.velocity, false);
  set({{15, 11}}, 1.0);  // within the near cells: found
  set({{30, 11}}, 1.0);  // beyond them: not looked for
  state.update(grid);
  near.find(state.water, state.porosity, state.velocity, false, false);
  expect_near(grid, near.cells(), [&](const Index<2>& cell) {
    return cell[0] >= 8 && cell[0] <= 20 && std::abs(cell[1] - 11) <= 5;
  });
}

TEST(NearWater, BesideTheWaterIsWithinOneCellIfNothingElseChanges) {
  const Grid<2> grid = grid_of(40, Wall::slip);
  State state(grid);
  const auto set = [&](Index<2> cell, double value) {
    if (grid.owned().contains(cell)) state.water[cell] = value;
  };
  const auto beside = [](const Index<2>& cell, int i) {
    return std::abs(cell[0] - i) <= 1 && std::abs(cell[1] - 11) <= 1;
  };
  set({{13, 11}}, 1.0);
  state.update(grid);
  NearWater<2> near(grid);
  near.find(state.water, state.porosity, state.velocity, false);  // anything may have changed
  expect_near(grid, near.beside(), [&](const Index<2>& cell) {
    return std::abs(cell[0] - 13) <= 5 && std::abs(cell[1] - 11) <= 5;
  });
  near.find(state.water, state.porosity, state.velocity, false, false);
  expect_near(grid, near.beside(), [&](const Index<2>& cell) { return beside(cell, 13); });
  set({{13, 11}}, 0.0);  // what it left counts once more
  set({{14, 11}}, 1.0);
  state.update(grid);
  near.find(state.water, state.porosity, state.velocity, false, false);
  expect_near(grid, near.beside(),
              [&](const Index<2>& cell) { return beside(cell, 13) || beside(cell, 14); });
  near.find(state.water, state.porosity, state.velocity, false, false);
  expect_near(grid, near.beside(), [&](const Index<2>& cell) { return beside(cell, 14); });
  near.take_all();
  EXPECT_EQ(near_cells(grid, near.beside()), 40.0 * 24.0);
}

/// Water and velocity in two opposite corners: behind walls of a kind their ghosts near the water
/// are the same as if all had been updated.
void expect_same_ghosts(const Grid<2>& grid) {
  State all(grid), some(grid);
  for_each(grid.owned(), [&](const Index<2>& cell) {
    const int from_lower = std::max(cell[0], cell[1]);
    const int from_upper = std::max(grid.cells()[0] - 1 - cell[0], grid.cells()[1] - 1 - cell[1]);
    const int away = std::min(from_lower, from_upper);
    if (away < 4) all.water[cell] = some.water[cell] = 0.1 + 0.01 * cell[0] + 0.02 * cell[1];
    for (int a = 0; a < 2; ++a)
      if (away < 7)
        all.velocity[a][cell] = some.velocity[a][cell] = 1.0 + cell[0] + 0.1 * cell[1] + 0.3 * a;
  });
  all.update(grid);
  NearWater<2> near(grid);
  near.find(all.water, all.porosity, all.velocity, false);
  ASSERT_LT(near_cells(grid, near.cells()), 40.0 * 24.0);
  Ghosts<2> ghosts(grid);
  ghosts.update(some.water, near.cells());
  ghosts.update_velocity(some.velocity, near.cells());
  for_each(grid.local(), [&](const Index<2>& cell) {
    EXPECT_EQ(some.water[cell], all.water[cell]) << cell[0] << " " << cell[1];
    for (int a = 0; a < 2; ++a)
      EXPECT_EQ(some.velocity[a][cell], all.velocity[a][cell]) << a << cell[0] << " " << cell[1];
  });
}

TEST(NearWater, GhostsNearTheWaterAreThoseOfAll) {
  expect_same_ghosts(grid_of(40, Wall::slip));
  expect_same_ghosts(grid_of(40, Wall::no_slip));
  expect_same_ghosts(grid_of(40, Wall::open));
}

}  // namespace
}  // namespace mudlark

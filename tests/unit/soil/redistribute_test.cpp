// ranks: 1 3 4
#include "soil/redistribute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "grid/halo.hpp"
#include "unit/soil/soil_setup.hpp"

namespace mudlark {
namespace {

using namespace soil_test;

/// A point for each cell of the domain that this rank owns, every value a function of id and name.
template <int D>
SoilParticles<D> one_point_per_cell(const Grid<D>& grid) {
  SoilParticles<D> points = make_cloud(grid, grid.owned(), 1, 0.0);
  points.carries_deformation = true;
  points.resize(points.size());
  std::size_t p = 0;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    std::int64_t number = 0;
    for (int a = D - 1; a >= 0; --a) number = number * grid.cells()[a] + cell[a];
    points.id[p++] = number + (std::int64_t{1} << 60);  // more digits than a double has
  });
  double array_number = 0.0;
  points.for_each_quantity(
      [&](const std::string& name, const char*, int components, std::vector<double>* arrays) {
        for (int c = 0; c < components; ++c, ++array_number) {
          if (name == "position" || name == "initial position") continue;
          for (std::size_t k = 0; k < points.size(); ++k)
            arrays[c][k] = array_number + 1e-4 * static_cast<double>(points.id[k] % 10000);
        }
      });
  return points;
}

template <int D>
void expect_values_came_along(SoilParticles<D>& points) {
  double array_number = 0.0;
  points.for_each_quantity([&](const std::string& name, const char*, int components,
                               std::vector<double>* arrays) {
    for (int c = 0; c < components; ++c, ++array_number) {
      ASSERT_EQ(arrays[c].size(), points.size());
      if (name == "position" || name == "initial position") continue;
      for (std::size_t k = 0; k < points.size(); ++k)
        ASSERT_EQ(arrays[c][k], array_number + 1e-4 * static_cast<double>(points.id[k] % 10000));
    }
  });
}

template <int D>
double count_everywhere(const Grid<D>& grid, const SoilParticles<D>& points) {
  return sum_over_ranks(grid, static_cast<double>(points.size()));
}

/// Every point lies in this rank's box, up to round-off.
template <int D>
void expect_all_owned(const Grid<D>& grid, const SoilParticles<D>& points) {
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int a = 0; a < D; ++a) {
      const double cells = (points.position[a][p] - grid.lower()[a]) / grid.spacing()[a];
      EXPECT_GE(cells, grid.owned().lower[a] - 1e-12);
      EXPECT_LE(cells, grid.owned().upper[a] + 1e-12);
    }
}

template <int D>
double cells_of(const Grid<D>& grid) {
  double cells = 1.0;
  for (int a = 0; a < D; ++a) cells *= grid.cells()[a];
  return cells;
}

/// Moves all points diagonally round a periodic box, by `cells` cells per axis at a time.
template <int D>
void expect_round_trip(double cells) {
  const Grid<D> grid = make_grid<D>({10, 11, 12}, Wall::periodic, MPI_COMM_WORLD);
  SoilParticles<D> points = one_point_per_cell(grid);
  const int moves = 9;
  double ids_before = 0.0, ids_after = 0.0;
  for (const std::int64_t id : points.id) ids_before += static_cast<double>(id % 100000);
  for (int i = 0; i < moves; ++i) {
    for (int a = 0; a < D; ++a)
      for (double& x : points.position[a]) x += cells * grid.spacing()[a];
    EXPECT_EQ(migrate(grid, points), 0.0);
    expect_all_owned(grid, points);
    EXPECT_EQ(count_everywhere(grid, points), cells_of(grid));
  }
  expect_values_came_along(points);
  for (std::size_t p = 0; p < points.size(); ++p) {
    ids_after += static_cast<double>(points.id[p] % 100000);
    for (int a = 0; a < D; ++a)  // displacement does not notice the seam
      EXPECT_NEAR(points.position[a][p] - points.start[a][p], moves * cells * grid.spacing()[a],
                  1e-12);
  }
  EXPECT_EQ(sum_over_ranks(grid, ids_after), sum_over_ranks(grid, ids_before));
}

TEST(Migrate, CarriesPointsAcrossRanksAndPeriodicSeamsWithAllTheyHave) {
  expect_round_trip<2>(0.75);
  expect_round_trip<2>(-1.3);
  expect_round_trip<2>(4.6);  // further than a neighbour
  expect_round_trip<3>(0.75);
  expect_round_trip<3>(-3.9);
}

TEST(Migrate, FindsAnOwnerForPointsWithinRoundOffOfAWallOrASeam) {
  for (const Wall wall : {Wall::periodic, Wall::slip}) {
    const Grid<2> grid = make_grid<2>({10, 11, 1}, wall, MPI_COMM_WORLD);
    SoilParticles<2> points = one_point_per_cell(grid);
    const double left = grid.lower()[0], right = grid.upper()[0];
    for (std::size_t p = 0; p < points.size(); ++p) {
      double& x = points.position[0][p];
      const bool low = p % 2 == 0;
      x = low ? left : std::nextafter(right, left);
      if (wall == Wall::periodic && low) x = std::nextafter(left, left - 1.0);
      if (wall == Wall::periodic && p % 3 == 0) x = right;
    }
    migrate(grid, points);
    sort_by_cell(grid, points);
    EXPECT_EQ(count_everywhere(grid, points), cells_of(grid));
    for (std::size_t p = 0; p < points.size(); ++p) {
      EXPECT_GE(points.position[0][p], left);
      EXPECT_LE(points.position[0][p], right);
    }
  }
}

TEST(Migrate, RemovesAndWeighsWhatLeavesThroughAnOpenSide) {
  const Grid<2> grid = make_grid<2>({10, 12, 1}, Wall::open, MPI_COMM_WORLD);
  SoilParticles<2> points = one_point_per_cell(grid);
  for (double& mass : points.grain_mass) mass = 2.5;
  for (double& x : points.position[0]) x += 3.0 * grid.spacing()[0];
  for (double& z : points.position[1]) z -= 2.0 * grid.spacing()[1];
  const double removed = sum_over_ranks(grid, migrate(grid, points));
  EXPECT_EQ(count_everywhere(grid, points), 7.0 * 10.0);
  EXPECT_EQ(removed, 2.5 * (120.0 - 70.0));
  expect_all_owned(grid, points);
}

TEST(Migrate, StopsAllRanksWhenOnePointIsBehindAClosedWall) {
  for (const Wall wall : {Wall::slip, Wall::no_slip}) {
    const Grid<2> grid = make_grid<2>({10, 12, 1}, wall, MPI_COMM_WORLD);
    SoilParticles<2> points = one_point_per_cell(grid);
    if (grid.rank() == grid.ranks() - 1)
      points.position[1][0] = grid.lower()[1] - 0.1 * grid.spacing()[1];
    try {
      migrate(grid, points);
      FAIL() << "went through the wall unnoticed";
    } catch (const DivergenceError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("closed wall on the lower side of axis z at ("), std::string::npos)
          << text;
    }
  }
}

template <int D>
void expect_sorted(const Grid<D>& grid) {
  SoilParticles<D> points = one_point_per_cell(grid);
  // Reverse, then give each cell a second point: the order within a cell must stay.
  for (int a = 0; a < D; ++a) std::reverse(points.position[a].begin(), points.position[a].end());
  points.for_each_quantity(
      [&](const char*, const char*, int components, std::vector<double>* arrays) {
        for (int c = 0; c < components; ++c)
          arrays[c].insert(arrays[c].end(), arrays[c].begin(), arrays[c].end());
      });
  const std::size_t half = points.id.size();
  for (std::size_t p = 0; p < half; ++p) points.id.push_back(points.id[p]);
  sort_by_cell(grid, points);
  std::set<std::int64_t> ids;
  std::ptrdiff_t last = -1;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const std::ptrdiff_t cell = grid.offset(grid.cell_at(points.position_of(p)));
    EXPECT_GE(cell, last);
    last = cell;
    ids.insert(points.id[p]);
  }
  EXPECT_EQ(ids.size(), half);
  expect_values_came_along(points);
}

TEST(SortByCell, OrdersPointsByCellAndKeepsTheirValues) {
  expect_sorted(make_grid<2>({10, 12, 1}, Wall::slip, MPI_COMM_WORLD));
  expect_sorted(make_grid<3>({9, 7, 6}, Wall::periodic, MPI_COMM_WORLD));
}

}  // namespace
}  // namespace mudlark

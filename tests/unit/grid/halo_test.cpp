// ranks: 1 3 4
#include "grid/halo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace mudlark {
namespace {

template <int D>
Grid<D> make_grid(const std::array<int, 3>& cells, const std::array<bool, 3>& periodic) {
  DomainOptions options;
  options.cells = cells;
  options.upper = {1.0, 1.0, 1.0};
  for (std::size_t a = 0; a < 3; ++a)
    if (periodic[a]) options.walls[a] = {Wall::periodic, Wall::periodic};
  return Grid<D>(options, MPI_COMM_WORLD);
}

/// What this rank answers for: its cells, and the layers behind the walls that it touches.
template <int D>
IndexBox<D> answered_for(const Grid<D>& grid) {
  IndexBox<D> box = grid.owned();
  for (int a = 0; a < D; ++a) {
    if (grid.touches(a, 0)) box.lower[a] -= ghost_layers;
    if (grid.touches(a, 1)) box.upper[a] += ghost_layers;
  }
  return box;
}

/// A different number for every index of the domain; the same one for periodic images.
template <int D>
double number_of(const Grid<D>& grid, Index<D> index, int axis) {
  double number = axis + 1.0;
  for (int a = 0; a < D; ++a) {
    const int n = grid.cells()[a];
    if (grid.periodic(a)) index[a] = (index[a] % n + n) % n;
    number = 1000.0 * number + index[a] + ghost_layers;
  }
  return number;
}

template <int D>
void expect_exchange_fills_every_ghost(const Grid<D>& grid) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  CellField<D> cells(grid, "cells", "1", nothing);
  FaceVector<D> faces(grid, "faces", "1", nothing);
  for_each(answered_for(grid), [&](const Index<D>& i) {
    cells[i] = number_of(grid, i, -1);
    for (int a = 0; a < D; ++a) faces[a][i] = number_of(grid, i, a);
  });
  Halo<D> halo(grid);
  halo.exchange(cells);
  halo.exchange(faces);
  for_each(grid.local(), [&](const Index<D>& i) {
    ASSERT_EQ(cells[i], number_of(grid, i, -1)) << "rank " << grid.rank();
    for (int a = 0; a < D; ++a) ASSERT_EQ(faces[a][i], number_of(grid, i, a)) << "axis " << a;
  });
}

TEST(Halo, FillsGhostsEdgesCornersAndLayersBehindWalls) {
  expect_exchange_fills_every_ghost(make_grid<2>({11, 9, 1}, {}));
  expect_exchange_fills_every_ghost(make_grid<2>({2, 12, 1}, {}));
  expect_exchange_fills_every_ghost(make_grid<3>({7, 6, 9}, {}));
}

TEST(Halo, FillsGhostsAroundPeriodicAxes) {
  expect_exchange_fills_every_ghost(make_grid<2>({11, 9, 1}, {true, true, false}));
  expect_exchange_fills_every_ghost(make_grid<2>({3, 12, 1}, {true, false, false}));
  expect_exchange_fills_every_ghost(make_grid<3>({7, 6, 9}, {false, true, false}));
  expect_exchange_fills_every_ghost(make_grid<3>({7, 6, 9}, {true, true, true}));
}

TEST(Halo, CarriesTheClosingFaceOfAWallToTheRanksBesideIt) {
  const Grid<2> grid = make_grid<2>({12, 6, 1}, {});
  FaceVector<2> faces(grid, "faces", "1", -1.0);
  const int top = grid.cells()[1];
  if (grid.touches(1, 1))
    for (int i = grid.owned().lower[0]; i < grid.owned().upper[0]; ++i) faces[1][{{i, top}}] = i;
  Halo<2>(grid).exchange(faces);
  if (!grid.touches(1, 1)) return;
  for (int i = std::max(0, grid.local().lower[0]); i < std::min(12, grid.local().upper[0]); ++i)
    EXPECT_EQ((faces[1][{{i, top}}]), i);
}

template <int D>
void fill_with_noise(CellField<D>& field, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  for_each(field.local(), [&](const Index<D>& i) { field[i] = noise(generator); });
}

template <int D>
double dot_over(const IndexBox<D>& box, const CellField<D>& left, const CellField<D>& right) {
  double sum = 0.0;
  for_each(box, [&](const Index<D>& i) { sum += left[i] * right[i]; });
  return sum;
}

/// <E x, y> over all local arrays = <x, A y> over what each rank answers for, with E the exchange
/// and A the addition to owners: what grid-to-particle spreads, particle-to-grid collects with the
/// same weights.
template <int D>
void expect_adding_is_the_transpose(const Grid<D>& grid) {
  const auto rank = static_cast<unsigned>(grid.rank());
  CellField<D> x(grid, "x", "1"), y(grid, "y", "1");
  fill_with_noise(x, 10 + rank);
  fill_with_noise(y, 100 + rank);
  CellField<D> exchanged = x.copy(), added = y.copy();
  Halo<D> halo(grid);
  halo.exchange(exchanged);
  const std::array<double*, 1> field{added.data()};
  halo.add_to_owners(field);
  const double left = sum_over_ranks(grid, dot_over(grid.local(), exchanged, y));
  const double right = sum_over_ranks(grid, dot_over(answered_for(grid), x, added));
  EXPECT_NEAR(left, right, 1e-11);
}

TEST(Halo, AddingToOwnersIsTheTransposeOfTheExchange) {
  for (const bool first : {false, true})
    for (const bool second : {false, true}) {
      expect_adding_is_the_transpose(make_grid<2>({11, 9, 1}, {first, second, false}));
      expect_adding_is_the_transpose(make_grid<3>({7, 6, 9}, {first, second, !first}));
    }
}

TEST(Halo, AddsOneShareFromEveryRankThatSeesACell) {
  const Grid<2> grid = make_grid<2>({12, 12, 1}, {});
  CellField<2> shares(grid, "shares", "1", 1.0);
  Halo<2> halo(grid);
  const std::array<double*, 1> field{shares.data()};
  halo.add_to_owners(field);
  double mine = 0.0;
  for_each(answered_for(grid), [&](const Index<2>& i) { mine += shares[i]; });
  EXPECT_EQ(sum_over_ranks(grid, mine),
            sum_over_ranks(grid, static_cast<double>(grid.local_size())));
}

TEST(Halo, MovesSeveralFieldsInOneCallWithoutMixingThem) {
  const Grid<3> grid = make_grid<3>({7, 6, 9}, {true, false, false});
  CellField<3> first(grid, "first", "1"), second(grid, "second", "1");
  for_each(answered_for(grid), [&](const Index<3>& i) {
    first[i] = number_of(grid, i, 0);
    second[i] = number_of(grid, i, 1);
  });
  const std::array<double*, 2> both{first.data(), second.data()};
  Halo<3>(grid).exchange(both);
  for_each(grid.local(), [&](const Index<3>& i) {
    ASSERT_EQ(first[i], number_of(grid, i, 0));
    ASSERT_EQ(second[i], number_of(grid, i, 1));
  });
}

TEST(Halo, KeepsTheComponentsOfAnIndexTogether) {
  const Grid<2> grid = make_grid<2>({11, 9, 1}, {true, false, false});
  std::vector<double> pairs(2 * grid.local_size(), 0.0);
  const auto at = [&](const Index<2>& i) { return 2 * static_cast<std::size_t>(grid.offset(i)); };
  for_each(answered_for(grid), [&](const Index<2>& i) {
    pairs[at(i)] = number_of(grid, i, 0);
    pairs[at(i) + 1] = number_of(grid, i, 1);
  });
  const std::array<double*, 1> field{pairs.data()};
  Halo<2>(grid).exchange(field, 2);
  for_each(grid.local(), [&](const Index<2>& i) {
    ASSERT_EQ(pairs[at(i)], number_of(grid, i, 0));
    ASSERT_EQ(pairs[at(i) + 1], number_of(grid, i, 1));
  });
}

}  // namespace
}  // namespace mudlark

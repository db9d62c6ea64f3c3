#include "numerics/packed_cells.hpp"

#include <gtest/gtest.h>

namespace {
using namespace mudlark;

/// Two rows that hardly overlap and a single cell far away, in a large box of one process.
PackedCells<2> scattered(std::array<int, 2> around_first_axis = {MPI_PROC_NULL, MPI_PROC_NULL}) {
  Partition<2> partition;
  partition.comm = MPI_COMM_WORLD;
  partition.owned = {{{0, 0}}, {{1000, 1000}}};
  partition.neighbour = {around_first_axis, std::array<int, 2>{MPI_PROC_NULL, MPI_PROC_NULL}};
  PackedCells<2> cells(partition);
  cells.store({{{{0, 5}}, 4}, {{{3, 6}}, 2}, {{{999, 5}}, 1}, {{{500, 800}}, 1}});
  return cells;
}

TEST(PackedCells, NeighboursOfEveryCellAreStoredAndFarOnesAreNot) {
  const PackedCells<2> cells = scattered();
  cells.for_each([&](std::ptrdiff_t at, const PackedCells<2>::Run& run) {
    const Index<2> cell = run.first.shifted(0, static_cast<int>(at - run.at));
    EXPECT_EQ(cells.at(cell), at);
    for (int a = 0; a < 2; ++a) {
      const auto u = static_cast<std::size_t>(a);
      EXPECT_EQ(cells.find(cell.shifted(a, -1)), at + run.below[u]);
      EXPECT_EQ(cells.find(cell.shifted(a, 1)), at + run.above[u]);
      for (int b = 0; b < 2; ++b)
        EXPECT_GE(cells.find(cell.shifted(a, 1).shifted(b, -1)), 0);  // corners too
    }
  });
  EXPECT_EQ(cells.find({{500, 500}}), -1);
  EXPECT_EQ(cells.find({{20, 800}}), -1);
}

TEST(PackedCells, NoPlaceIsUsedTwice) {
  const PackedCells<2> cells = scattered();
  std::vector<int> used(cells.size());
  for (int j = -1; j <= 1000; ++j)
    for (int i = -1; i <= 1000; ++i)
      if (const std::ptrdiff_t at = cells.find({{i, j}}); at >= 0)
        ++used[static_cast<std::size_t>(at)];
  for (const int times : used) EXPECT_EQ(times, 1);
}

TEST(PackedCells, AskedBlocksGetRoomToo) {
  PackedCells<2> cells = scattered();
  cells.store({{{{0, 5}}, 4}}, {{{{40, 40}}, {{42, 41}}}});
  EXPECT_GE(cells.find({{41, 40}}), 0);
  EXPECT_EQ(cells.find({{500, 800}}), -1);
  EXPECT_EQ(cells.runs().size(), 1u);
}

TEST(PackedCells, AroundAPeriodGhostsAreTheOtherEnd) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  PackedCells<2> cells = scattered({rank, rank});
  PackedCells<2>::Values values(cells.size());
  const auto value_at = [&](int i, int j) -> double& {
    return values[static_cast<std::size_t>(cells.at({{i, j}}))];
  };
  value_at(0, 5) = 3.0, value_at(999, 5) = 7.0;
  cells.exchange(values);
  EXPECT_EQ(value_at(-1, 5), 7.0);
  EXPECT_EQ(value_at(1000, 5), 3.0);
}

}  // namespace

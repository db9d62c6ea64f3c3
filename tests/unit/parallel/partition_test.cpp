// ranks: 1 3 4
#include "parallel/partition.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/errors.hpp"

namespace mudlark {
namespace {

constexpr int minimum_width = 3;

template <int D>
Partition<D> partition(const Index<D>& cells, const std::array<bool, D>& periodic) {
  return make_partition<D>(MPI_COMM_WORLD, cells, periodic, minimum_width);
}

/// The owned boxes of all ranks.
template <int D>
std::vector<IndexBox<D>> boxes_of_all_ranks(const Partition<D>& part) {
  std::vector<IndexBox<D>> boxes(static_cast<std::size_t>(part.size));
  MPI_Allgather(&part.owned, sizeof(IndexBox<D>), MPI_BYTE, boxes.data(), sizeof(IndexBox<D>),
                MPI_BYTE, part.comm);
  return boxes;
}

template <int D>
void expect_every_cell_has_one_owner(const Index<D>& cells) {
  const auto boxes = boxes_of_all_ranks(partition<D>(cells, {}));
  for_each(IndexBox<D>{{}, cells}, [&](const Index<D>& cell) {
    int owners = 0;
    for (const auto& box : boxes) owners += box.contains(cell);
    ASSERT_EQ(owners, 1);
  });
}

TEST(Partition, GivesEveryCellExactlyOneOwnerIn2DAnd3D) {
  expect_every_cell_has_one_owner<2>({{17, 13}});
  expect_every_cell_has_one_owner<2>({{2, 25}});
  expect_every_cell_has_one_owner<3>({{7, 12, 9}});
}

TEST(Partition, GivesEveryRankTheAskedWidthAlongSplitAxes) {
  const Index<3> cells{{5, 13, 7}};
  const auto part = partition<3>(cells, {});
  for (int a = 0; a < 3; ++a) {
    const int width = part.owned.upper[a] - part.owned.lower[a];
    EXPECT_TRUE(part.processes[a] == 1 || width >= minimum_width) << "axis " << a;
  }
}

TEST(Partition, SplitsALongChannelAlongItsLengthOnly) {
  const auto part = partition<2>({{400, 10}}, {});
  EXPECT_EQ(part.processes, (Index<2>{{part.size, 1}}));
}

TEST(Partition, CutsTheVerticalOnlyWhereNothingElseIsWideEnough) {
  EXPECT_EQ(partition<2>({{40, 40}}, {}).processes[1], 1);
  EXPECT_EQ(partition<3>({{40, 40, 40}}, {}).processes[2], 1);
  const auto column = partition<2>({{2, 400}}, {});
  EXPECT_EQ(column.processes, (Index<2>{{1, column.size}}));
}

/// The box above mine begins where mine ends (or at 0 around a periodic axis), and spans the same
/// rows.
template <int D>
void expect_neighbours_touch(const Index<D>& cells, const std::array<bool, D>& periodic) {
  const auto part = partition<D>(cells, periodic);
  const auto boxes = boxes_of_all_ranks(part);
  for (int a = 0; a < D; ++a) {
    const auto [below, above] = part.neighbour[static_cast<std::size_t>(a)];
    const bool wraps = periodic[static_cast<std::size_t>(a)];
    const bool last = part.owned.upper[a] == cells[a];
    EXPECT_EQ(above == MPI_PROC_NULL, last && !wraps);
    EXPECT_EQ(below == MPI_PROC_NULL, part.owned.lower[a] == 0 && !wraps);
    if (above == MPI_PROC_NULL) continue;
    IndexBox<D> expected = boxes[static_cast<std::size_t>(above)];
    EXPECT_EQ(expected.lower[a], last ? 0 : part.owned.upper[a]);
    expected.lower[a] = part.owned.lower[a], expected.upper[a] = part.owned.upper[a];
    EXPECT_EQ(expected, part.owned);
  }
}

TEST(Partition, NeighboursTouchAcrossInnerAndPeriodicSides) {
  expect_neighbours_touch<2>({{20, 18}}, {false, false});
  expect_neighbours_touch<2>({{20, 18}}, {true, true});
  expect_neighbours_touch<3>({{9, 8, 14}}, {false, true, false});
}

TEST(Partition, RefusesMoreRanksThanTheGridCanUseAndSaysHowMany) {
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) {
    EXPECT_NO_THROW(partition<2>({{2, 2}}, {}));
    return;
  }
  try {
    partition<2>({{5, 5}}, {});
    FAIL() << "5 x 5 cells cannot be split";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(ranks) + " ranks"), std::string::npos);
  }
}

TEST(Partition, RefusesAPeriodicAxisNarrowerThanItsGhostLayers) {
  EXPECT_THROW(partition<2>({{2, 60}}, {true, false}), InputError);
  EXPECT_NO_THROW(partition<2>({{3, 60}}, {true, false}));
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
#include "output/checkpoint.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>

#include <algorithm>
#include <numeric>

#include "base/errors.hpp"
#include "output_support.hpp"

namespace mudlark {
namespace {

using testing_support::small_grid;
using testing_support::TemporaryFolder;
using testing_support::text_of;

/// One of everything that a solver may store.
template <int D>
struct State {
  double time = 0.0;
  std::int64_t step = 0;
  CellField<D> water;
  FaceVector<D> velocity;
  std::vector<double> position;
  std::vector<std::int64_t> ids;

  explicit State(const Grid<D>& grid)
      : water(grid, "water fraction", "1"), velocity(grid, "velocity", "m/s") {}

  void fill(const Grid<D>& grid, double seed) {
    time = seed / 3.0;
    step = static_cast<std::int64_t>(1000 * seed);
    for_each(grid.owned(),
             [&](const Index<D>& cell) { water[cell] = value_at(grid.cell_centre(cell), seed); });
    for (int a = 0; a < D; ++a)
      for_each(grid.owned_faces(a), [&](const Index<D>& face) {
        velocity[a][face] = (a + 1) * value_at(grid.face_centre(a, face), seed);
      });
    const int mine = 4 + 3 * grid.rank();
    for (int p = 0; p < mine; ++p) {
      ids.push_back(1000 * grid.rank() + p);
      for (int a = 0; a < D; ++a) position.push_back(seed / (p + 1.0) + a + 100.0 * grid.rank());
    }
  }
  static double value_at(const Vec<D>& x, double seed) {
    double value = seed;
    for (int a = 0; a < D; ++a) value = 3.0 * value + std::sin(x[a]);
    return value;
  }
  template <class Archive>
  void archive(Archive& a) {
    a.number("time", time);
    a.integer("step", step);
    a.cells("water fraction", water);
    a.faces("velocity", velocity);
    a.points("soil/position", position, D);
    a.point_ids("soil/id", ids);
  }
};

template <int D>
void save(const Grid<D>& grid, const std::filesystem::path& folder, double seed,
          const std::string& text = "case") {
  State<D> state(grid);
  state.fill(grid, seed);
  CheckpointWriter<D> writer(grid, folder, text, static_cast<std::int64_t>(seed), seed);
  state.archive(writer);
  writer.commit();
}

template <int D>
void expect_loaded(const Grid<D>& grid, const State<D>& loaded, double seed) {
  State<D> expected(grid);
  expected.fill(grid, seed);
  EXPECT_EQ(loaded.time, expected.time);
  EXPECT_EQ(loaded.step, expected.step);
  for_each(grid.owned(),
           [&](const Index<D>& cell) { ASSERT_EQ(loaded.water[cell], expected.water[cell]); });
  for (int a = 0; a < D; ++a)
    for_each(grid.owned_faces(a), [&](const Index<D>& face) {
      ASSERT_EQ(loaded.velocity[a][face], expected.velocity[a][face]);
    });
  EXPECT_EQ(loaded.position, expected.position);
  EXPECT_EQ(loaded.ids, expected.ids);
}

template <int D>
void check_round_trip(bool periodic) {
  const TemporaryFolder folder;
  const Grid<D> grid = small_grid<D>(periodic);
  save(grid, folder.path(), 7.0);
  CheckpointReader<D> reader(grid, folder.path(), "case");
  EXPECT_EQ(reader.step(), 7);
  EXPECT_EQ(reader.time(), 7.0);
  State<D> state(grid);
  state.archive(reader);
  reader.finish();
  expect_loaded(grid, state, 7.0);
}

TEST(Checkpoint, GivesBackEveryBitIn2DAnd3DWithWallsAndPeriodic) {
  for (const bool periodic : {false, true}) {
    check_round_trip<2>(periodic);
    check_round_trip<3>(periodic);
  }
}

TEST(Checkpoint, KeepsTheLastTwoStatesAndLoadsTheNewest) {
  const TemporaryFolder folder;
  const Grid<2> grid = small_grid<2>();
  for (const double seed : {1.0, 2.0, 3.0}) save(grid, folder.path(), seed);
  EXPECT_EQ(CheckpointReader<2>(grid, folder.path(), "case").step(), 3);
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(files, 2);
}

/// Changes one byte, or cuts the file to a share of its length.
void damage(const std::filesystem::path& file, double place, bool cut) {
  const auto length = static_cast<double>(std::filesystem::file_size(file));
  const auto at = static_cast<std::streamoff>(place * length);
  if (cut) return std::filesystem::resize_file(file, static_cast<std::uintmax_t>(at));
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(at);
  const auto byte = static_cast<char>(stream.get() ^ 0x10);
  stream.seekp(at);
  stream.put(byte);
}

TEST(Checkpoint, FallsBackToTheOlderStateWhenTheNewestIsCutShort) {
  for (const double place : {0.0, 0.01, 0.5, 0.99}) {
    const TemporaryFolder folder;
    const Grid<2> grid = small_grid<2>();
    save(grid, folder.path(), 1.0);
    save(grid, folder.path(), 2.0);
    if (folder.first_rank()) damage(folder.path() / "state-B.h5", place, true);
    MPI_Barrier(MPI_COMM_WORLD);
    std::string note;
    CheckpointReader<2> reader(grid, folder.path(), "case",
                               [&](const std::string& text) { note = text; });
    State<2> state(grid);
    state.archive(reader);
    reader.finish();
    expect_loaded(grid, state, 1.0);
    if (folder.first_rank()) {
      EXPECT_NE(note.find("state-B.h5 is damaged"), std::string::npos) << note;
    }
    // The next state must not push out the good one that is left.
    save(grid, folder.path(), 3.0);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "state-A.h5"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "state-B.h5"));
  }
}

TEST(Checkpoint, NeverLoadsAStateInWhichAnyByteThatCountsWasChanged) {
  // Bytes that carry nothing (gaps in the file) may change unseen; what is loaded must be right all
  // the same.
  const Grid<2> grid = small_grid<2>();
  int refused = 0;
  const int places = 40;
  for (int i = 0; i < places; ++i) {
    const TemporaryFolder folder;
    save(grid, folder.path(), 1.0);
    save(grid, folder.path(), 2.0);
    if (folder.first_rank()) damage(folder.path() / "state-B.h5", (i + 0.5) / places, false);
    MPI_Barrier(MPI_COMM_WORLD);
    CheckpointReader<2> reader(grid, folder.path(), "case");
    State<2> state(grid);
    state.archive(reader);
    reader.finish();
    expect_loaded(grid, state, static_cast<double>(reader.step()));
    refused += reader.step() == 1;
  }
  EXPECT_GE(refused, places / 2);
}

TEST(Checkpoint, SaysWhatToDoWhenNoGoodStateIsThere) {
  const TemporaryFolder folder;
  const Grid<2> grid = small_grid<2>();
  const auto message = [&] {
    try {
      CheckpointReader<2> reader(grid, folder.path(), "case");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  EXPECT_NE(message().find("without --resume"), std::string::npos) << message();
  save(grid, folder.path(), 1.0);
  save(grid, folder.path(), 2.0);
  if (folder.first_rank()) {
    damage(folder.path() / "state-A.h5", 0.3, true);
    std::ofstream(folder.path() / "state-B.h5") << "not HDF5";
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_NE(message().find("without --resume"), std::string::npos) << message();
}

TEST(Checkpoint, RefusesAnotherCaseAndAnotherGrid) {
  const TemporaryFolder folder;
  const Grid<2> grid = small_grid<2>();
  save(grid, folder.path(), 1.0);
  EXPECT_THROW(CheckpointReader<2>(grid, folder.path(), "changed case"), InputError);
  const Grid<2> periodic = small_grid<2>(true);
  EXPECT_THROW(CheckpointReader<2>(periodic, folder.path(), "case"), InputError);
}

TEST(Checkpoint, LeavesTheEarlierStateAloneWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  // A disk of 64 kB, filled up after the first state.
  int mounted = folder.first_rank() &&
                mount("mudlark-test", folder.path().c_str(), "tmpfs", 0, "size=64k") == 0;
  MPI_Bcast(&mounted, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (!mounted) GTEST_SKIP() << "only root can make a small disk";
  const Grid<2> grid = small_grid<2>();
  save(grid, folder.path(), 1.0);
  if (folder.first_rank()) std::ofstream(folder.path() / "filler") << std::string(65536, 'x');
  MPI_Barrier(MPI_COMM_WORLD);
  std::string message;
  try {
    save(grid, folder.path(), 2.0);
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("No space left on device"), std::string::npos) << message;
  EXPECT_EQ(CheckpointReader<2>(grid, folder.path(), "case").step(), 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "state-B.h5.part"));
  MPI_Barrier(MPI_COMM_WORLD);
  if (folder.first_rank()) umount(folder.path().c_str());
}

TEST(Checkpoint, FitsAnotherNumberOfRanks) {
  const TemporaryFolder folder;
  const Grid<3> together = small_grid<3>(), alone = small_grid<3>(false, MPI_COMM_SELF);
  save(together, folder.path() / "all", 4.0);
  if (folder.first_rank()) save(alone, folder.path() / "one", 4.0);
  MPI_Barrier(MPI_COMM_WORLD);
  const auto load = [&](const Grid<3>& grid, const char* name) {
    CheckpointReader<3> reader(grid, folder.path() / name, "case");
    State<3> state(grid);
    state.archive(reader);
    reader.finish();
    return state;
  };
  const State<3> whole = load(alone, "all"), part = load(together, "one");
  for_each(alone.owned(), [&](const Index<3>& cell) {
    ASSERT_EQ(whole.water[cell], State<3>::value_at(alone.cell_centre(cell), 4.0));
  });
  for_each(together.owned_faces(2), [&](const Index<3>& face) {
    ASSERT_EQ(part.velocity[2][face], 3.0 * State<3>::value_at(together.face_centre(2, face), 4.0));
  });
  // All points, in the order of the ranks that saved them; shared out evenly when more ranks load.
  std::size_t saved = 0;
  for (int rank = 0; rank < together.ranks(); ++rank)
    saved += static_cast<std::size_t>(4 + 3 * rank);
  EXPECT_EQ(whole.ids.size(), saved);
  EXPECT_TRUE(std::is_sorted(whole.ids.begin(), whole.ids.end()));
  EXPECT_EQ(whole.position.size(), 3 * saved);
  long long mine = static_cast<long long>(part.ids.size()), total = 0;
  MPI_Allreduce(&mine, &total, 1, MPI_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(total, 4);
  EXPECT_LE(mine, (4 + together.ranks() - 1) / together.ranks());
}

TEST(Checkpoint, TellsWhenAskedForWhatItDoesNotHold) {
  const TemporaryFolder folder;
  const Grid<2> grid = small_grid<2>();
  save(grid, folder.path(), 1.0);
  CheckpointReader<2> reader(grid, folder.path(), "case");
  double value = 0.0;
  reader.number("mass of the moon", value);
  EXPECT_THROW(reader.finish(), std::runtime_error);
}

}  // namespace
}  // namespace mudlark

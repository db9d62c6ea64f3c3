// ranks: 1 3
#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.hpp"
#include "output/field_writer.hpp"
#include "output/point_writer.hpp"
#include "output_support.hpp"

namespace mudlark {
namespace {

using testing_support::small_grid;
using testing_support::TemporaryFolder;
using testing_support::text_of;

/// Whole dataset, read by each rank on its own.
std::vector<double> dataset(const std::filesystem::path& path, const std::string& name) {
  Hdf5File file(path, Hdf5File::Mode::read, MPI_COMM_SELF);
  Slab slab;
  slab.extent = slab.count = file.extent_of(name);
  slab.start.assign(slab.extent.size(), 0);
  std::vector<double> values(slab.size());
  file.read(name, slab, values.data());
  file.close();
  return values;
}

int occurrences(const std::string& text, const std::string& word) {
  int n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

template <int D>
void check_fields_round_trip() {
  const TemporaryFolder folder;
  const Grid<D> grid = small_grid<D>();
  CellField<D> cell_number(grid, "cell number", "1");
  FaceVector<D> velocity(grid, "water velocity", "m/s");
  const auto number_of = [&](const Index<D>& cell) {
    double number = 0.0;
    for (int a = D - 1; a >= 0; --a) number = number * grid.cells()[a] + cell[a];
    return number;
  };
  for_each(grid.owned(), [&](const Index<D>& cell) { cell_number[cell] = number_of(cell); });
  // Linear in space, so the average over a cell's faces is the exact value at its centre.
  for (int a = 0; a < D; ++a)
    for_each(grid.owned_faces(a), [&](const Index<D>& face) {
      velocity[a][face] = (a + 2.0) * grid.face_centre(a, face)[a];
    });
  FieldWriter<D> writer(grid, folder.path());
  const std::array<const CellField<D>*, 1> cells{&cell_number};
  const std::array<const FaceVector<D>*, 1> faces{&velocity};
  writer.write(0.0, 0, cells, faces);
  writer.write(0.5, 7, cells, faces);

  const auto numbers = dataset(folder.path() / "fields.h5", "/000001/cell_number");
  const auto velocities = dataset(folder.path() / "fields.h5", "/000001/water_velocity");
  std::size_t at = 0;
  for_each(grid.global(), [&](const Index<D>& cell) {
    ASSERT_EQ(numbers.at(at), static_cast<double>(at));
    const Vec<D> centre = grid.cell_centre(cell);
    for (int a = 0; a < D; ++a) {
      const auto component = static_cast<std::size_t>(a == D - 1 ? 2 : a);
      ASSERT_NEAR(velocities.at(3 * at + component), (a + 2.0) * centre[a], 1e-13);
    }
    if (D == 2) {
      ASSERT_EQ(velocities.at(3 * at + 1), 0.0);
    }
    ++at;
  });
  Hdf5File file(folder.path() / "fields.h5", Hdf5File::Mode::read, MPI_COMM_SELF);
  EXPECT_EQ(file.text("/000001/water_velocity", "unit"), "m/s");
  EXPECT_EQ(file.text("/000001/cell_number", "name"), "cell number");
  EXPECT_EQ(file.number("/000001", "time"), 0.5);
  EXPECT_EQ(file.integer("/000001", "step"), 7);
  file.close();
  const std::string xdmf = text_of(folder.path() / "fields.xdmf");
  EXPECT_EQ(occurrences(xdmf, "<Time "), 2);
  EXPECT_EQ(occurrences(xdmf, "AttributeType=\"Vector\""), 2);
}

TEST(FieldWriter, WritesCellValuesAndFaceAveragesAtTheirPlaceIn2DAnd3D) {
  check_fields_round_trip<2>();
  check_fields_round_trip<3>();
}

TEST(FieldWriter, DropsWhatIsLaterThanTheResumedTimeAndGoesOn) {
  const TemporaryFolder folder;
  const Grid<2> grid = small_grid<2>();
  CellField<2> field(grid, "f", "Pa");
  const std::array<const CellField<2>*, 1> cells{&field};
  {
    FieldWriter<2> writer(grid, folder.path());
    for (int i = 0; i < 4; ++i) field.fill(i), writer.write(i, i, cells, {});
  }
  FieldWriter<2> resumed(grid, folder.path(), 1.5);
  ASSERT_EQ(resumed.outputs().size(), 2u);
  field.fill(20.0);
  resumed.write(2.0, 20, cells, {});
  ASSERT_EQ(resumed.outputs().size(), 3u);
  EXPECT_EQ(resumed.outputs()[1].step, 1);
  EXPECT_EQ(resumed.outputs()[2].step, 20);
  EXPECT_EQ(dataset(folder.path() / "fields.h5", resumed.outputs()[2].group + "/f").at(5), 20.0);
  EXPECT_EQ(dataset(folder.path() / "fields.h5", resumed.outputs()[1].group + "/f").at(5), 1.0);
  EXPECT_EQ(occurrences(text_of(folder.path() / "fields.xdmf"), "<Time "), 3);
}

TEST(FieldWriter, ReplacesAnOutputOfTheSameTime) {
  const TemporaryFolder folder;
  const Grid<2> grid = small_grid<2>();
  CellField<2> field(grid, "f", "Pa", 1.0);
  const std::array<const CellField<2>*, 1> cells{&field};
  FieldWriter<2> writer(grid, folder.path());
  writer.write(1.0, 1, cells, {});
  field.fill(2.0);
  writer.write(1.0, 1, cells, {});
  ASSERT_EQ(writer.outputs().size(), 1u);
  EXPECT_EQ(dataset(folder.path() / "fields.h5", writer.outputs()[0].group + "/f").at(0), 2.0);
}

TEST(FieldWriter, SetsADamagedFileAsideWhenResuming) {
  const TemporaryFolder folder;
  const Grid<2> grid = small_grid<2>();
  if (folder.first_rank()) std::ofstream(folder.path() / "fields.h5") << "no HDF5 file";
  MPI_Barrier(MPI_COMM_WORLD);
  FieldWriter<2> writer(grid, folder.path(), 1.0);
  CellField<2> field(grid, "f", "Pa", 3.0);
  const std::array<const CellField<2>*, 1> cells{&field};
  writer.write(2.0, 1, cells, {});
  EXPECT_EQ(text_of(folder.path() / "fields-damaged.h5"), "no HDF5 file");
  EXPECT_EQ(dataset(folder.path() / "fields.h5", "/000000/f").at(0), 3.0);
}

TEST(FieldWriter, RefusesAFolderThatCannotBeMade) {
  const TemporaryFolder folder;
  if (folder.first_rank()) std::ofstream(folder.path() / "file") << "x";
  MPI_Barrier(MPI_COMM_WORLD);
  const Grid<2> grid = small_grid<2>();
  EXPECT_THROW(FieldWriter<2>(grid, folder.path() / "file" / "results"), InputError);
}

TEST(PointWriter, WritesChangingNumbersOfPointsOfAllRanks) {
  const TemporaryFolder folder;
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  PointWriter writer(MPI_COMM_WORLD, folder.path());
  for (int output = 0; output < 2; ++output) {
    const int mine = rank == 1 ? 0 : 3 + output;  // one rank without points
    std::vector<std::int64_t> ids;
    std::vector<double> x, z, pressure;
    std::array<std::vector<double>, 6> stress;
    for (int p = 0; p < mine; ++p) {
      ids.push_back(100 * rank + p);
      x.push_back(rank + 0.25);
      z.push_back(p + 0.5);
      pressure.push_back(1000.0 * rank + p);
      for (std::size_t c = 0; c < 6; ++c) stress[c].push_back(10.0 * p + static_cast<double>(c));
    }
    PointArray tensor{"effective stress", "Pa", {}};
    for (const auto& component : stress) tensor.components.push_back(component.data());
    const std::array<PointArray, 3> arrays{PointArray{"position", "m", {x.data(), z.data()}},
                                           PointArray{"pore pressure", "Pa", {pressure.data()}},
                                           tensor};
    writer.write(output, output, ids, arrays);
  }
  const std::size_t per_rank = 4,
                    expected = per_rank * static_cast<std::size_t>(ranks == 1 ? 1 : ranks - 1);
  const auto position = dataset(folder.path() / "points.h5", "/000001/position");
  const auto ids = dataset(folder.path() / "points.h5", "/000001/id");
  const auto pressure = dataset(folder.path() / "points.h5", "/000001/pore_pressure");
  const auto stress = dataset(folder.path() / "points.h5", "/000001/effective_stress");
  ASSERT_EQ(ids.size(), expected);
  ASSERT_EQ(stress.size(), 6 * expected);
  for (std::size_t i = 0; i < expected; ++i) {
    const double from = std::floor(ids[i] / 100.0), point = ids[i] - 100.0 * from;
    EXPECT_EQ(position[3 * i], from + 0.25);
    EXPECT_EQ(position[3 * i + 1], 0.0);
    EXPECT_EQ(position[3 * i + 2], point + 0.5);
    EXPECT_EQ(pressure[i], 1000.0 * from + point);
    EXPECT_EQ(stress[6 * i + 4], 10.0 * point + 4.0);
  }
  EXPECT_EQ(occurrences(text_of(folder.path() / "points.xdmf"), "effective stress zx [Pa]"), 2);
}

TEST(PointWriter, AcceptsNoPointsAtAll) {
  const TemporaryFolder folder;
  PointWriter writer(MPI_COMM_WORLD, folder.path());
  const std::array<PointArray, 1> arrays{PointArray{"position", "m", {nullptr, nullptr}}};
  writer.write(0.0, 0, {}, arrays);
  EXPECT_TRUE(dataset(folder.path() / "points.h5", "/000000/position").empty());
}

}  // namespace
}  // namespace mudlark

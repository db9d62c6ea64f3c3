#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "../../unit/output/output_support.hpp"
#include "output/field_writer.hpp"
#include "output/gauge_writer.hpp"
#include "output/point_writer.hpp"
#include "output/summary.hpp"

namespace mudlark {
namespace {

using testing_support::small_grid;
using testing_support::TemporaryFolder;

/// What check_results.py expects: see there.
template <int D>
void write_results(const std::filesystem::path& folder) {
  const Grid<D> grid = small_grid<D>();
  CellField<D> saturation(grid, "saturation", "1"), porosity(grid, "porosity", "1", 1.0);
  FaceVector<D> velocity(grid, "velocity", "m/s");
  for_each(grid.owned(), [&](const Index<D>& cell) {
    saturation[cell] = grid.cell_centre(cell)[D - 1] < 2.0 ? 1.0 : 0.0;
  });
  for (int a = 0; a < D; ++a)
    for_each(grid.owned_faces(a),
             [&](const Index<D>& face) { velocity[a][face] = grid.face_centre(a, face)[a]; });
  FieldWriter<D> fields(grid, folder);
  PointWriter points(MPI_COMM_WORLD, folder);
  GaugeWriter gauge(MPI_COMM_WORLD, folder, "top", {"settlement [m]", "pore pressure [Pa]"});
  const std::array<const CellField<D>*, 2> cells{&saturation, &porosity};
  const std::array<const FaceVector<D>*, 1> faces{&velocity};
  for (int i = 0; i < 3; ++i) {
    const double time = 0.5 * i;
    fields.write(time, i, cells, faces);
    const std::array<std::int64_t, 3> ids{30, 10, 20};
    const std::array<double, 3> x{0.3, 0.1, 0.2}, y{1.0, 1.0, 1.0}, z{2.7 - 0.1 * i, 2.5, 2.6},
        volume{0.01, 0.01, 0.01}, pressure{3e3, 1e3 + i, 2e3};
    PointArray position{"position", "m", {x.data(), z.data()}};
    if (D == 3) position.components = {x.data(), y.data(), z.data()};
    const std::array<PointArray, 3> arrays{position, PointArray{"volume", "m2", {volume.data()}},
                                           PointArray{"pore pressure", "Pa", {pressure.data()}}};
    points.write(time, i, ids, arrays);
    gauge.sample(time, std::array<double, 2>{0.1 * i, -1e3 * i});
  }
  gauge.flush();
  Summary summary;
  summary.title = "a title";
  write_summary(folder, summary, MPI_COMM_WORLD);
}

int python(const std::string& arguments) {
  const std::string source = MUDLARK_SOURCE_DIR;
  return std::system(("PYTHONPATH='" + source + "/python' /usr/bin/python3 " + arguments).c_str());
}

TEST(PythonPackage, ReadsAndDrawsWhatTheProgramWritesIn2DAnd3D) {
  const std::string script =
      std::string(MUDLARK_SOURCE_DIR) + "/tests/regression/output/check_results.py";
  const TemporaryFolder flat, deep;
  write_results<2>(flat.path());
  write_results<3>(deep.path());
  EXPECT_EQ(python(script + " 2 " + flat.path().string()), 0);
  EXPECT_EQ(python(script + " 3 " + deep.path().string()), 0);
}

TEST(PythonPackage, HasReferenceCurvesThatAgreeWithTheirSources) {
  EXPECT_EQ(
      python(std::string(MUDLARK_SOURCE_DIR) + "/tests/regression/output/check_references.py"), 0);
}

TEST(PythonPackage, SplitsWavesIntoIncidentAndReflectedOnes) {
  EXPECT_EQ(
      python(std::string(MUDLARK_SOURCE_DIR) + "/tests/regression/output/check_reflection.py"), 0);
}

}  // namespace
}  // namespace mudlark

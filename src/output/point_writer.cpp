#include "output/point_writer.hpp"

#include "output/xdmf.hpp"

namespace mudlark {
namespace {

/// Point after point; a vector of two components becomes (x, 0, z).
std::vector<double> interleaved(const PointArray& array, std::size_t points) {
  const std::size_t given = array.components.size(), width = given == 2 ? 3 : given;
  std::vector<double> rows(width * points, 0.0);
  for (std::size_t c = 0; c < given; ++c) {
    const std::size_t to = given == 2 && c == 1 ? 2 : c;
    for (std::size_t p = 0; p < points; ++p) rows[width * p + to] = array.components[c][p];
  }
  return rows;
}

}  // namespace

PointWriter::PointWriter(MPI_Comm comm, const std::filesystem::path& folder,
                         std::optional<double> resumed_at)
    : comm_(comm),
      series_(folder, "points", comm, resumed_at, [](const std::vector<StoredOutput>& outputs) {
        return xdmf_of_points("points.h5", outputs);
      }) {}

void PointWriter::write(double time, std::int64_t step, std::span<const std::int64_t> ids,
                        std::span<const PointArray> arrays) {
  const auto mine = static_cast<std::int64_t>(ids.size());
  std::int64_t first = 0, total = 0;
  MPI_Exscan(&mine, &first, 1, MPI_INT64_T, MPI_SUM, comm_);
  MPI_Allreduce(&mine, &total, 1, MPI_INT64_T, MPI_SUM, comm_);
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  if (rank == 0) first = 0;  // MPI_Exscan leaves it undefined there
  series_.write(time, step, [&](Hdf5File& file, StoredOutput& output) {
    output.count = total;
    store_array(file, output, {"", "id", "1", 1, true}, Slab::rows(total, first, mine), ids.data());
    for (const PointArray& array : arrays) {
      const auto given = static_cast<int>(array.components.size());
      const int width = given == 2 ? 3 : given;
      store_array(file, output, {"", array.name, array.unit, width, false},
                  Slab::rows(total, first, mine, width), interleaved(array, ids.size()).data());
    }
  });
}

}  // namespace mudlark

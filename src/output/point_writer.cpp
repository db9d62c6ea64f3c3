#include "output/point_writer.hpp"

#include "output/xdmf.hpp"

namespace mudlark {
namespace {

std::vector<double> with_zero_y(const double* values, std::size_t points) {
  std::vector<double> widened(3 * points, 0.0);
  for (std::size_t p = 0; p < points; ++p) {
    widened[3 * p] = values[2 * p];
    widened[3 * p + 2] = values[2 * p + 1];
  }
  return widened;
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
      std::vector<double> widened;
      if (array.components == 2) widened = with_zero_y(array.values, ids.size());
      const int components = array.components == 2 ? 3 : array.components;
      store_array(file, output, {"", array.name, array.unit, components, false},
                  Slab::rows(total, first, mine, components),
                  array.components == 2 ? widened.data() : array.values);
    }
  });
}

}  // namespace mudlark

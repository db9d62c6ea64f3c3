#include "parallel/partition.hpp"

#include <fmt/format.h>
#include <petscdmda.h>

#include <vector>

#include "base/errors.hpp"
#include "parallel/process_grid.hpp"

namespace mudlark {
namespace {

void check(PetscErrorCode code, const char* what) {
  if (code) throw std::runtime_error(fmt::format("PETSc failed to {} (error {})", what, code));
}

/// Water and soil lie at the bottom: a cut across the vertical gives some ranks the air. It counts
/// as this many others of the same area.
constexpr double vertical_cut = 2.0;

}  // namespace

template <int D>
Index<D> choose_processes(int size, const Index<D>& cells, int minimum_width) {
  Index<D> best{};
  double best_surface = -1.0;
  const auto consider = [&](const Index<D>& count) {
    double surface = 0.0;
    for (int a = 0; a < D; ++a) {
      if (count[a] > 1 && cells[a] / count[a] < minimum_width) return;
      double area = count[a] == 1 ? 0.0 : a == D - 1 ? vertical_cut : 1.0;
      for (int b = 0; b < D; ++b)
        if (b != a) area *= static_cast<double>(cells[b]) / count[b];
      surface += area;
    }
    if (best_surface < 0.0 || surface < best_surface) best = count, best_surface = surface;
  };
  for (int i = 1; i <= size; ++i) {
    if (size % i) continue;
    if constexpr (D == 2) {
      consider(Index<2>{{i, size / i}});
    } else {
      for (int j = 1; j <= size / i; ++j)
        if ((size / i) % j == 0) consider(Index<3>{{i, j, size / i / j}});
    }
  }
  if (best_surface < 0.0)
    throw InputError(fmt::format(
        "{} ranks are too many for this grid (each rank needs {} cells along every axis that is "
        "split). Use fewer ranks (-n) or more cells.",
        size, minimum_width));
  return best;
}

template <int D>
Partition<D> make_partition(MPI_Comm comm, const Index<D>& cells,
                            const std::array<bool, D>& periodic, int minimum_width) {
  for (int a = 0; a < D; ++a)
    if (periodic[static_cast<std::size_t>(a)] && cells[a] < minimum_width)
      throw InputError(
          fmt::format("Axis {} is periodic with {} cells, but its ends see {} cells of each other. "
                      "Use at least "
                      "{} cells along it.",
                      "xyz"[D == 2 && a == 1 ? 2 : a], cells[a], minimum_width, minimum_width));
  Partition<D> part;
  part.comm = comm;
  MPI_Comm_rank(comm, &part.rank);
  MPI_Comm_size(comm, &part.size);
  part.processes = choose_processes<D>(part.size, cells, minimum_width);

  DM da = nullptr;
  const auto edge = [&](int a) {
    return periodic[static_cast<std::size_t>(a)] ? DM_BOUNDARY_PERIODIC : DM_BOUNDARY_NONE;
  };
  if constexpr (D == 2) {
    check(DMDACreate2d(comm, edge(0), edge(1), DMDA_STENCIL_BOX, cells[0], cells[1],
                       part.processes[0], part.processes[1], 1, 1, nullptr, nullptr, &da),
          "create the grid");
  } else {
    check(DMDACreate3d(comm, edge(0), edge(1), edge(2), DMDA_STENCIL_BOX, cells[0], cells[1],
                       cells[2], part.processes[0], part.processes[1], part.processes[2], 1, 1,
                       nullptr, nullptr, nullptr, &da),
          "create the grid");
  }
  check(DMSetUp(da), "partition the grid");
  PetscInt start[3] = {0, 0, 0}, width[3] = {1, 1, 1};
  check(DMDAGetCorners(da, &start[0], &start[1], &start[2], &width[0], &width[1], &width[2]),
        "partition the grid");
  check(DMDestroy(&da), "release the grid");

  int stride = 1;
  for (int a = 0; a < D; ++a) {
    part.owned.lower[a] = static_cast<int>(start[a]);
    part.owned.upper[a] = static_cast<int>(start[a] + width[a]);
    part.place[a] = (part.rank / stride) % part.processes[a];
    const int count = part.processes[a];
    const bool wraps = periodic[static_cast<std::size_t>(a)];
    auto& [below, above] = part.neighbour[static_cast<std::size_t>(a)];
    const int base = part.rank - part.place[a] * stride;
    below = part.place[a] > 0 ? part.rank - stride
            : wraps           ? base + (count - 1) * stride
                              : MPI_PROC_NULL;
    above = part.place[a] + 1 < count ? part.rank + stride : wraps ? base : MPI_PROC_NULL;
    stride *= count;
  }
  return part;
}

template Index<2> choose_processes<2>(int, const Index<2>&, int);
template Index<3> choose_processes<3>(int, const Index<3>&, int);
template Partition<2> make_partition<2>(MPI_Comm, const Index<2>&, const std::array<bool, 2>&, int);
template Partition<3> make_partition<3>(MPI_Comm, const Index<3>&, const std::array<bool, 3>&, int);

}  // namespace mudlark

#pragma once
/// Which rank owns which cells, and who its neighbours are. PETSc's DMDA chooses the process grid.
#include <mpi.h>

#include <array>

#include "base/vec.hpp"

namespace mudlark {

template <int D>
struct Partition {
  MPI_Comm comm = MPI_COMM_SELF;
  int rank = 0, size = 1;
  Index<D> processes;  ///< ranks per axis
  Index<D> place;      ///< this rank's place among them
  IndexBox<D> owned;   ///< cells of this rank
  std::array<std::array<int, 2>, D>
      neighbour{};  ///< rank below/above per axis, MPI_PROC_NULL at a wall
};

/// Splits the cells of a D-dimensional grid over the ranks of a communicator.
/// Every rank gets at least `minimum_width` cells along each axis that is split, otherwise an
/// InputError says how many ranks this grid can use. A periodic axis may be split too; its ends are
/// neighbours.
template <int D>
Partition<D> make_partition(MPI_Comm comm, const Index<D>& cells,
                            const std::array<bool, D>& periodic, int minimum_width);

}  // namespace mudlark

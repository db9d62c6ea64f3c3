#include "numerics/packed_cells.hpp"

namespace mudlark {

template <int D>
void PackedCells<D>::store(const std::vector<RowPart<D>>& cells,
                           const std::vector<IndexBox<D>>& asked) {
  rows_.clear(owned());
  for (const RowPart<D>& run : cells) {
    IndexBox<D> block{run.first, run.first};
    for (int a = 0; a < D; ++a) block.upper[a] += a == 0 ? run.cells : 1;
    rows_.cover(block);
  }
  for (const IndexBox<D>& block : asked) rows_.cover(block);
  rows_.place();
  runs_.clear();
  for (const RowPart<D>& cell : cells) {
    Run run{cell, rows_.at(cell.first), {}, {}, 0};
    int sum = 0;
    for (int a = 0; a < D; ++a) {
      const auto u = static_cast<std::size_t>(a);
      run.below[u] = rows_.at(cell.first.shifted(a, -1)) - run.at;
      run.above[u] = rows_.at(cell.first.shifted(a, 1)) - run.at;
      sum += cell.first[a];
    }
    run.colour = sum & 1;
    runs_.push_back(run);
  }
  list_layers();
}

/// Layer of cells at a side along an axis, this rank's or the ghosts beyond; across with ghosts.
template <int D>
IndexBox<D> PackedCells<D>::layer(int axis, int side, bool ghost) const {
  IndexBox<D> box = owned().grown(1);
  const int inside = side == 0 ? owned().lower[axis] : owned().upper[axis] - 1;
  box.lower[axis] = ghost ? inside + (side == 0 ? -1 : 1) : inside;
  box.upper[axis] = box.lower[axis] + 1;
  return box;
}

/// Places of what is sent and received, for all exchanges until the unknowns change.
template <int D>
void PackedCells<D>::list_layers() {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto n = static_cast<std::size_t>(2 * axis + side);
      sent_[n].clear(), received_[n].clear();
      if (partition_.neighbour[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] ==
          MPI_PROC_NULL)
        continue;
      mudlark::for_each(layer(axis, side, false),
                        [&](const Index<D>& cell) { sent_[n].push_back(rows_.find(cell)); });
      mudlark::for_each(layer(axis, side, true),
                        [&](const Index<D>& cell) { received_[n].push_back(rows_.find(cell)); });
    }
}

/// Messages to and from all neighbours along some axes at a time: none of them waits for another.
template <int D>
void PackedCells<D>::exchange_along(int first, int last, Values& values) {
  std::array<MPI_Request, 4 * D> requests;
  int count = 0;
  for (int axis = first; axis < last; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto n = static_cast<std::size_t>(2 * axis + side);
      const int neighbour =
          partition_.neighbour[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
      if (neighbour == MPI_PROC_NULL) continue;
      send_[n].clear();
      for (const std::ptrdiff_t at : sent_[n])
        send_[n].push_back(at < 0 ? 0.0 : values[static_cast<std::size_t>(at)]);
      receive_[n].resize(send_[n].size());
      const int length = static_cast<int>(send_[n].size());
      // What leaves at one side arrives at the other: the tag says which, two ranks may share both.
      MPI_Irecv(receive_[n].data(), length, MPI_DOUBLE, neighbour, 2 * axis + 1 - side,
                partition_.comm, &requests[static_cast<std::size_t>(count++)]);
      MPI_Isend(send_[n].data(), length, MPI_DOUBLE, neighbour, 2 * axis + side, partition_.comm,
                &requests[static_cast<std::size_t>(count++)]);
    }
  if (count == 0) return;
  MPI_Waitall(count, requests.data(), MPI_STATUSES_IGNORE);
  for (int axis = first; axis < last; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto n = static_cast<std::size_t>(2 * axis + side);
      for (std::size_t k = 0; k < received_[n].size(); ++k)
        if (received_[n][k] >= 0)
          values[static_cast<std::size_t>(received_[n][k])] = receive_[n][k];
    }
}

template <int D>
void PackedCells<D>::exchange(Values& values) {
  exchange_along(0, D, values);
}

template <int D>
void PackedCells<D>::exchange_with_corners(Values& values) {
  for (int axis = 0; axis < D; ++axis) exchange_along(axis, axis + 1, values);
}

template class PackedCells<2>;
template class PackedCells<3>;

}  // namespace mudlark

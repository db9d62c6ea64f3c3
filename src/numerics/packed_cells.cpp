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

/// Messages to and from all neighbours along some axes at a time: none of them waits for another.
/// What arrives has the length that `receive` has been given.
template <int D>
template <class T>
void PackedCells<D>::swap_layers(int first, int last, const BySide<T>& send, MPI_Datatype type,
                                 BySide<T>& receive) const {
  std::array<MPI_Request, 4 * D> requests;
  int count = 0;
  for_each_neighbour(first, last, [&](int axis, int side, std::size_t n) {
    const int neighbour =
        partition_.neighbour[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
    // What leaves at one side arrives at the other: the tag says which, two ranks may share both.
    MPI_Irecv(receive[n].data(), static_cast<int>(receive[n].size()), type, neighbour,
              2 * axis + 1 - side, partition_.comm, &requests[static_cast<std::size_t>(count++)]);
    MPI_Isend(send[n].data(), static_cast<int>(send[n].size()), type, neighbour, 2 * axis + side,
              partition_.comm, &requests[static_cast<std::size_t>(count++)]);
  });
  MPI_Waitall(count, requests.data(), MPI_STATUSES_IGNORE);
}

/// Places of what is sent and received, for all exchanges until the cells change: of a layer only
/// what the receiver stores.
template <int D>
void PackedCells<D>::list_layers() {
  BySide<unsigned char> wanted, asked;
  for_each_neighbour(0, D, [&](int axis, int side, std::size_t n) {
    received_[n].clear();
    mudlark::for_each(layer(axis, side, true), [&](const Index<D>& cell) {
      const std::ptrdiff_t at = rows_.find(cell);
      wanted[n].push_back(at >= 0);
      if (at >= 0) received_[n].push_back(at);
    });
    asked[n].resize(wanted[n].size());
  });
  swap_layers(0, D, wanted, MPI_UNSIGNED_CHAR, asked);
  for_each_neighbour(0, D, [&](int axis, int side, std::size_t n) {
    sent_[n].clear();
    auto next = asked[n].begin();
    mudlark::for_each(layer(axis, side, false), [&](const Index<D>& cell) {
      if (*next++ != 0) sent_[n].push_back(rows_.find(cell));
    });
  });
}

template <int D>
void PackedCells<D>::exchange_along(int first, int last, Values& values) {
  for_each_neighbour(first, last, [&](int, int, std::size_t n) {
    send_[n].clear();
    for (const std::ptrdiff_t at : sent_[n])
      send_[n].push_back(at < 0 ? 0.0 : values[static_cast<std::size_t>(at)]);
    receive_[n].resize(received_[n].size());
  });
  swap_layers(first, last, send_, MPI_DOUBLE, receive_);
  for_each_neighbour(first, last, [&](int, int, std::size_t n) {
    for (std::size_t k = 0; k < received_[n].size(); ++k)
      values[static_cast<std::size_t>(received_[n][k])] = receive_[n][k];
  });
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

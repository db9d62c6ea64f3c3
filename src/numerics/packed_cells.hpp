#pragma once
/// The cells of this rank that have an unknown: where their values are stored, and the exchange of
/// ghosts between ranks.
#include <array>
#include <vector>

#include "numerics/packed_rows.hpp"
#include "parallel/partition.hpp"

namespace mudlark {

/// Values are kept in arrays of the owner, `size()` long: those of the cells and of what is around
/// them, ghosts among it, in packed rows. Where there is no unknown they shall be zero.
template <int D>
class PackedCells {
 public:
  using Values = std::vector<double>;
  /// Neighbouring cells of a row, and where they and what is beside them are stored.
  struct Run : RowPart<D> {
    std::ptrdiff_t at;                           ///< of the first cell
    std::array<std::ptrdiff_t, D> below, above;  ///< from a cell to its neighbours along the axes
    int colour;  ///< of the first cell: is the sum of its indices odd?
  };

  explicit PackedCells(const Partition<D>& partition) : partition_(partition) {}

  /// Takes other cells, and makes room for blocks that somebody asks for. Collective.
  void store(const std::vector<RowPart<D>>& cells, const std::vector<IndexBox<D>>& asked = {});

  const Partition<D>& partition() const { return partition_; }
  const IndexBox<D>& owned() const { return partition_.owned; }
  const std::vector<Run>& runs() const { return runs_; }
  std::size_t size() const { return rows_.size(); }
  std::ptrdiff_t at(const Index<D>& cell) const { return rows_.at(cell); }
  /// The same, or -1 for a cell that is not stored.
  std::ptrdiff_t find(const Index<D>& cell) const { return rows_.find(cell); }

  /// Calls body(place, run) for every cell.
  template <class Body>
  void for_each(Body&& body) const {
    for (const Run& run : runs_)
      for (std::ptrdiff_t at = run.at; at < run.at + run.cells; ++at) body(at, run);
  }

  void exchange(Values& values);  ///< ghosts beyond faces; corners are left. Collective.
  void exchange_with_corners(Values& values);

 private:
  template <class T>
  using BySide = std::array<std::vector<T>, static_cast<std::size_t>(2 * D)>;

  void list_layers();
  void exchange_along(int first, int last, Values& values);
  template <class T>
  void swap_layers(int first, int last, const BySide<T>& send, MPI_Datatype type,
                   BySide<T>& receive) const;
  IndexBox<D> layer(int axis, int side, bool ghost) const;
  /// Calls body(axis, side, their number) for every side with a neighbour.
  template <class Body>
  void for_each_neighbour(int first, int last, Body&& body) const {
    for (int axis = first; axis < last; ++axis)
      for (int side = 0; side < 2; ++side)
        if (partition_.neighbour[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] !=
            MPI_PROC_NULL)
          body(axis, side, static_cast<std::size_t>(2 * axis + side));
  }

  Partition<D> partition_;
  PackedRows<D> rows_;
  std::vector<Run> runs_;
  BySide<std::ptrdiff_t> sent_, received_;  ///< places, -1: not stored here
  BySide<double> send_, receive_;
};

extern template class PackedCells<2>;
extern template class PackedCells<3>;

}  // namespace mudlark

#pragma once
/// Storage for values of a few cells of a box, row after row without gaps: what lies beside one
/// another in the box lies near in memory, however large the box is.
#include <cstddef>
#include <vector>

#include "base/vec.hpp"

namespace mudlark {

/// Neighbouring cells of one row along the first axis.
template <int D>
struct RowPart {
  Index<D> first;
  int cells;
  friend bool operator==(const RowPart&, const RowPart&) = default;
};

/// Of each row (cells that differ in their first index only) one interval is stored.
template <int D>
class PackedRows {
 public:
  /// Starts anew, for cells of a box and one layer around it.
  void clear(const IndexBox<D>& box);
  /// Stores the cells of a block, and those beside them, over edges and corners too.
  void cover(const IndexBox<D>& block);
  /// After all of them: now places are known.
  void place();

  std::size_t size() const { return size_; }
  /// Of a cell that is stored. Neighbours along the first axis differ by one.
  std::ptrdiff_t at(const Index<D>& cell) const { return rows_[row(cell)].start + cell[0]; }
  /// The same, or -1 for a cell that is not.
  std::ptrdiff_t find(const Index<D>& cell) const {
    const Row& r = rows_[row(cell)];
    return cell[0] >= r.lower && cell[0] < r.upper ? r.start + cell[0] : -1;
  }

 private:
  struct Row {
    int lower, upper;      ///< stored are lower ... upper - 1
    std::ptrdiff_t start;  ///< place of a cell less its index
  };

  std::size_t row(const Index<D>& cell) const {
    std::ptrdiff_t number = cell[D - 1] - box_.lower[D - 1];
    if constexpr (D == 3)
      number = number * (box_.upper[1] - box_.lower[1]) + cell[1] - box_.lower[1];
    return static_cast<std::size_t>(number);
  }

  IndexBox<D> box_;  ///< with the layer
  std::vector<Row> rows_;
  std::size_t size_ = 0;
};

extern template class PackedRows<2>;
extern template class PackedRows<3>;

}  // namespace mudlark

#include "numerics/packed_rows.hpp"

#include <algorithm>
#include <limits>

namespace mudlark {

template <int D>
void PackedRows<D>::clear(const IndexBox<D>& box) {
  box_ = box.grown(1);
  std::size_t count = 1;
  for (int a = 1; a < D; ++a) count *= static_cast<std::size_t>(box_.upper[a] - box_.lower[a]);
  rows_.assign(count, {std::numeric_limits<int>::max(), std::numeric_limits<int>::min(), 0});
  size_ = 0;
}

template <int D>
void PackedRows<D>::cover(const IndexBox<D>& block) {
  const IndexBox<D> around = block.grown(1).intersected(box_);
  IndexBox<D> first = around;
  first.upper[0] = first.lower[0] + 1;
  for_each(first, [&](const Index<D>& cell) {
    Row& r = rows_[row(cell)];
    r.lower = std::min(r.lower, around.lower[0]);
    r.upper = std::max(r.upper, around.upper[0]);
  });
}

template <int D>
void PackedRows<D>::place() {
  std::ptrdiff_t next = 0;
  for (Row& r : rows_) {
    if (r.lower >= r.upper) continue;
    r.start = next - r.lower;
    next += r.upper - r.lower;
  }
  size_ = static_cast<std::size_t>(next);
}

template class PackedRows<2>;
template class PackedRows<3>;

}  // namespace mudlark

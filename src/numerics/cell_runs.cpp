#include "numerics/cell_runs.hpp"

namespace mudlark {

template <int D>
CellRuns<D>::CellRuns(const Grid<D>& grid) : grid_(&grid) {
  find(Field<std::uint8_t, AtCell, D>(grid, "all", "1", 1));
}

template <int D>
void CellRuns<D>::find(const Field<std::uint8_t, AtCell, D>& marks) {
  runs_.clear();
  row_starts_.assign(1, 0);
  IndexBox<D> rows = grid_->local();
  const int first = rows.lower[0], end = rows.upper[0];
  rows.upper[0] = first + 1;
  const auto length = static_cast<std::size_t>(end - first);
  for_each(rows, [&](Index<D> index) {
    const std::ptrdiff_t start = grid_->offset(index);
    const std::uint8_t *row = marks.data() + start, *last = row + length, *mark = row;
    while ((mark = std::find(mark, last, std::uint8_t{1})) != last) {
      const std::uint8_t* after = std::find(mark, last, std::uint8_t{0});
      index[0] = first + static_cast<int>(mark - row);
      runs_.push_back({index, first + static_cast<int>(after - row), start + (mark - row)});
      mark = after;
    }
    row_starts_.push_back(runs_.size());
  });
}

template class CellRuns<2>;
template class CellRuns<3>;

}  // namespace mudlark

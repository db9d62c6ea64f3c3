#pragma once
/// Cells of the local arrays, row by row: what loops go over where not all of a box matters.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/field.hpp"
#include "numerics/spans.hpp"

namespace mudlark {

template <int D>
class CellRuns {
 public:
  /// Cells of one row along the first axis, `end` being the first beyond; `at` is the place of the
  /// first in the local arrays.
  struct Run {
    Index<D> first;
    int end;
    std::ptrdiff_t at;
  };

  /// All cells.
  explicit CellRuns(const Grid<D>& grid);

  /// The marked cells, ghosts included.
  void find(const Field<std::uint8_t, AtCell, D>& marks);

  /// Those of the rows `lower` to `upper` - 1 along the second axis, in space in one plane.
  std::span<const Run> runs(int lower, int upper, int plane) const {
    const IndexBox<D>& local = grid_->local();
    std::ptrdiff_t row = lower - local.lower[1];
    if (D == 3) row += (plane - local.lower[D - 1]) * (local.upper[1] - local.lower[1]);
    const auto* start = row_starts_.data() + row;
    return {runs_.data() + *start, runs_.data() + *(start + upper - lower)};
  }
  const Run& last() const { return runs_.back(); }

 private:
  const Grid<D>* grid_;
  std::vector<Run> runs_;                ///< of this rank's cells and ghosts, row after row
  std::vector<std::size_t> row_starts_;  ///< the first run of each row, and the end of the last
};

/// Has the values of a run fetched into the cache while others are worked on. Short rows of a large
/// box lie far from one another: a loop would wait for the first value of each, as the processor
/// itself fetches ahead only along a row.
template <class T>
inline void fetch(const T* values, std::ptrdiff_t at, int cells) {
  constexpr int line = 64 / sizeof(T), most = 128;
  const T* first = values + at;
  for (int i = 0; i < std::min(cells, most); i += line) __builtin_prefetch(first + i);
}
template <class T, std::size_t N>
inline void fetch(const std::array<const T*, N>& axes, std::ptrdiff_t at, int cells) {
  for (const T* values : axes) fetch(values, at, cells);
}

/// Calls body(run, at, first, end) for the piece of every run that lies in the box. Its cells along
/// the first axis are first ... end - 1, and `at` is the place of the first. What comes after the
/// body are local arrays that it reads: they are fetched some rows ahead.
template <int D, class Body, class... T>
inline void for_each_piece(const CellRuns<D>& cells, const IndexBox<D>& box, Body&& body,
                           const T&... ahead) {
  constexpr std::ptrdiff_t rows = 4;
  if (box.empty()) return;
  const int first_plane = D == 3 ? box.lower[D - 1] : 0;
  const int end_plane = D == 3 ? box.upper[D - 1] : 1;
  for (int plane = first_plane; plane < end_plane; ++plane)
    for (const auto& run : cells.runs(box.lower[1], box.upper[1], plane)) {
      if constexpr (sizeof...(T) > 0)
        if (&cells.last() - &run > rows) {
          const auto& later = *(&run + rows);
          (fetch(ahead, later.at, later.end - later.first[0]), ...);
        }
      const int first = std::max(run.first[0], box.lower[0]);
      const int end = std::min(run.end, box.upper[0]);
      if (first < end) body(run, run.at + (first - run.first[0]), first, end);
    }
}

/// As the loops over boxes (numerics/loops.hpp), but over these cells only.
template <int D, class Body, class... T>
inline void for_each_offset(const CellRuns<D>& cells, const IndexBox<D>& box, Body&& body,
                            const T&... ahead) {
  for_each_piece(
      cells, box,
      [&](const auto&, std::ptrdiff_t at, int first, int end) {
        for (const std::ptrdiff_t last = at + (end - first); at < last; ++at) body(at);
      },
      ahead...);
}
/// The same where the body reads nothing that it writes at another place: the compiler need not ask
/// for each row whether arrays overlap.
template <int D, class Body, class... T>
inline void for_each_apart(const CellRuns<D>& cells, const IndexBox<D>& box, Body&& body,
                           const T&... ahead) {
  for_each_piece(
      cells, box,
      [&](const auto&, std::ptrdiff_t start, int first, int end) {
        const std::ptrdiff_t last = start + (end - first);
#pragma GCC ivdep
        for (std::ptrdiff_t at = start; at < last; ++at) body(at);
      },
      ahead...);
}
template <int D, class Body, class... T>
inline void for_each_place(const CellRuns<D>& cells, const IndexBox<D>& box, Body&& body,
                           const T&... ahead) {
  for_each_piece(
      cells, box,
      [&](const auto& run, std::ptrdiff_t at, int first, int end) {
        Index<D> index = run.first;
        for (index[0] = first; index[0] < end; ++index[0], ++at) body(at, std::as_const(index));
      },
      ahead...);
}

template <int D, class Taken>
void find_spans(const CellRuns<D>& cells, const IndexBox<D>& box, Taken&& taken, Spans& spans) {
  spans.clear();
  for_each_piece(cells, box, [&](const auto&, std::ptrdiff_t at, int first, int end) {
    add_spans(at, at + (end - first), taken, spans);
  });
}

extern template class CellRuns<2>;
extern template class CellRuns<3>;

}  // namespace mudlark

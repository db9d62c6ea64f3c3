#pragma once
/// Loops over boxes of the local arrays by position: the inner loop is plain and can be vectorised.
#include <cstddef>
#include <utility>

#include "grid/grid.hpp"

namespace mudlark {

/// Calls body(at) with the position `at` in the local arrays for every index of the box; a
/// neighbour along an axis lies at `at + layout.stride(axis)`. The layout is a grid's, or any other
/// with the first axis fastest.
template <class Layout, int D, class Body>
inline void for_each_offset(const Layout& layout, const IndexBox<D>& box, Body&& body) {
  if (box.empty()) return;
  const std::ptrdiff_t count = box.upper[0] - box.lower[0];
  const auto row = [&](const Index<D>& first) {
    const std::ptrdiff_t start = layout.offset(first);
    for (std::ptrdiff_t at = start; at < start + count; ++at) body(at);
  };
  if constexpr (D == 2) {
    for (int j = box.lower[1]; j < box.upper[1]; ++j) row(Index<2>{{box.lower[0], j}});
  } else {
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j) row(Index<3>{{box.lower[0], j, k}});
  }
}

/// The same with body(at, index).
template <int D, class Body>
inline void for_each_place(const Grid<D>& grid, const IndexBox<D>& box, Body&& body) {
  for (IndexBox<D> row = box; !box.empty();) {
    Index<D> index = row.lower;
    std::ptrdiff_t at = grid.offset(index);
    for (; index[0] < box.upper[0]; ++index[0], ++at) body(at, std::as_const(index));
    int axis = 1;  // the next row
    while (axis < D && ++row.lower[axis] == box.upper[axis]) {
      row.lower[axis] = box.lower[axis];
      ++axis;
    }
    if (axis == D) return;
  }
}

/// Faces of an axis that bound this rank's cells: the owned ones and the upper one of the last
/// cell.
template <int D>
IndexBox<D> bounding_faces(const Grid<D>& grid, int axis) {
  return grid.owned().extended(axis, 1);
}

}  // namespace mudlark

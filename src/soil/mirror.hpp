#pragma once
/// Places behind closed walls and their mirror images in the domain.
#include "grid/grid.hpp"

namespace mudlark {

inline bool closed(Wall wall) {
  return wall == Wall::slip || wall == Wall::no_slip || wall == Wall::friction;
}

/// Calls f(behind, before) for each pair of mirrored places at a wall. On the wall's own axis faces
/// mirror about the wall's face, cells and faces of other axes about the wall between two of them.
template <int D, class F>
void for_each_mirror_pair(const Grid<D>& grid, const IndexBox<D>& box, int axis, int side,
                          bool faces_of_axis, F&& f) {
  const int wall = side == 0 ? 0 : grid.cells()[axis];
  const int outwards = side == 0 ? -1 : 1;
  const int depth = faces_of_axis && side == 1 ? ghost_layers - 1 : ghost_layers;
  for (int layer = 1; layer <= depth; ++layer) {
    int behind = wall + outwards * layer, before = wall - outwards * layer;
    if (!faces_of_axis) {  // cell `wall` lies on the upper side of face `wall`
      behind = side == 0 ? wall - layer : wall + layer - 1;
      before = side == 0 ? wall + layer - 1 : wall - layer;
    }
    const bool seen = before >= box.lower[axis] && before < box.upper[axis] &&
                      behind >= box.lower[axis] && behind < box.upper[axis];
    if (!seen) continue;
    IndexBox<D> rows = box;
    rows.lower[axis] = behind;
    rows.upper[axis] = behind + 1;
    for_each(rows, [&](const Index<D>& index) { f(index, index.shifted(axis, before - behind)); });
  }
}

/// Visits (axis, side, kind) of the closed walls that this rank touches.
template <int D, class F>
void for_each_closed_wall(const Grid<D>& grid, F&& f) {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      if (grid.touches(axis, side) && closed(grid.wall(axis, side)))
        f(axis, side, grid.wall(axis, side));
}

/// Sign of a vector component of the grains behind a wall. Pore water seeps along any wall: it
/// takes that of Wall::slip.
inline double parity(int component, int axis, Wall wall) {
  return component == axis || wall == Wall::no_slip ? -1.0 : 1.0;
}

}  // namespace mudlark

#include "soil/walls.hpp"

namespace mudlark {
namespace {

bool closed(Wall wall) { return wall == Wall::slip || wall == Wall::no_slip; }

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

/// Sign of a vector component behind a wall.
double parity(int component, int axis, Wall wall) {
  return component == axis || wall == Wall::no_slip ? -1.0 : 1.0;
}

}  // namespace

template <int D>
void fold_into_domain(const Grid<D>& grid, const IndexBox<D>& box, NodeField<NodeSums, D>& nodes) {
  for_each_closed_wall(grid, [&](int axis, int side, Wall wall) {
    for (int d = 0; d < D; ++d) {
      auto& field = nodes[static_cast<std::size_t>(d)];
      const double sign = parity(d, axis, wall);
      for_each_mirror_pair(grid, box, axis, side, d == axis,
                           [&](const Index<D>& behind, const Index<D>& before) {
                             NodeSums& from = field[behind];
                             NodeSums& to = field[before];
                             to.grain_mass += from.grain_mass;
                             to.water_mass += from.water_mass;
                             to.volume += from.volume;
                             to.drag += from.drag;
                             to.grain_momentum += sign * from.grain_momentum;
                             to.water_momentum += sign * from.water_momentum;
                             to.mixture_force += sign * from.mixture_force;
                             to.water_force += sign * from.water_force;
                           });
    }
  });
}

template <int D>
void mirror_motion(const Grid<D>& grid, const IndexBox<D>& box, NodeField<NodeMotion, D>& nodes) {
  // All walls come to rest before any is mirrored: in a domain one cell wide they see each other.
  for_each_closed_wall(grid, [&](int axis, int side, Wall) {
    IndexBox<D> face = box;
    face.lower[axis] = side == 0 ? 0 : grid.cells()[axis];
    face.upper[axis] = face.lower[axis] + 1;
    face = face.intersected(box);
    auto& field = nodes[static_cast<std::size_t>(axis)];
    for_each(face, [&](const Index<D>& index) { field[index] = NodeMotion{}; });
  });
  for_each_closed_wall(grid, [&](int axis, int side, Wall wall) {
    for (int d = 0; d < D; ++d) {
      auto& field = nodes[static_cast<std::size_t>(d)];
      const double sign = parity(d, axis, wall);
      for_each_mirror_pair(grid, box, axis, side, d == axis,
                           [&](const Index<D>& behind, const Index<D>& before) {
                             const NodeMotion& from = field[before];
                             field[behind] = {sign * from.grain_velocity, sign * from.grain_change,
                                              sign * from.water_velocity, sign * from.water_change,
                                              sign * from.total_flux};
                           });
    }
  });
}

template <int D>
void fold_cells(const Grid<D>& grid, const IndexBox<D>& box, CellField<D>& field) {
  for_each_closed_wall(grid, [&](int axis, int side, Wall) {
    for_each_mirror_pair(
        grid, box, axis, side, false,
        [&](const Index<D>& behind, const Index<D>& before) { field[before] += field[behind]; });
  });
}

template void fold_into_domain(const Grid<2>&, const IndexBox<2>&, NodeField<NodeSums, 2>&);
template void fold_into_domain(const Grid<3>&, const IndexBox<3>&, NodeField<NodeSums, 3>&);
template void mirror_motion(const Grid<2>&, const IndexBox<2>&, NodeField<NodeMotion, 2>&);
template void mirror_motion(const Grid<3>&, const IndexBox<3>&, NodeField<NodeMotion, 3>&);
template void fold_cells(const Grid<2>&, const IndexBox<2>&, CellField<2>&);
template void fold_cells(const Grid<3>&, const IndexBox<3>&, CellField<3>&);

}  // namespace mudlark

#include "soil/walls.hpp"

#include "soil/mirror.hpp"

namespace mudlark {

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

template <int D>
IndexBox<D> solved_faces(const Grid<D>& grid, int axis) {
  IndexBox<D> faces = grid.owned_faces(axis);
  for (int a = 0; a < D; ++a) {
    if (grid.touches(a, 0) && grid.wall(a, 0) == Wall::open) faces.lower[a] = grid.local().lower[a];
    if (grid.touches(a, 1) && grid.wall(a, 1) == Wall::open) faces.upper[a] = grid.local().upper[a];
  }
  return faces;
}

template IndexBox<2> solved_faces(const Grid<2>&, int);
template IndexBox<3> solved_faces(const Grid<3>&, int);
template void fold_into_domain(const Grid<2>&, const IndexBox<2>&, NodeField<NodeSums, 2>&);
template void fold_into_domain(const Grid<3>&, const IndexBox<3>&, NodeField<NodeSums, 3>&);
template void mirror_motion(const Grid<2>&, const IndexBox<2>&, NodeField<NodeMotion, 2>&);
template void mirror_motion(const Grid<3>&, const IndexBox<3>&, NodeField<NodeMotion, 3>&);
template void fold_cells(const Grid<2>&, const IndexBox<2>&, CellField<2>&);
template void fold_cells(const Grid<3>&, const IndexBox<3>&, CellField<3>&);

}  // namespace mudlark

#include "soil/wall_contact.hpp"

#include <algorithm>
#include <cmath>

#include "soil/mirror.hpp"

namespace mudlark {
namespace {

/// The cells, or faces along the wall, next to one side of the domain.
template <int D>
IndexBox<D> row_at_wall(const Grid<D>& grid, IndexBox<D> box, int axis, int side) {
  box.lower[axis] = side == 0 ? 0 : grid.cells()[axis] - 1;
  box.upper[axis] = box.lower[axis] + 1;
  return box;
}

/// Owned cells and what lies behind closed walls beside them.
template <int D>
IndexBox<D> with_mirrors(const Grid<D>& grid) {
  IndexBox<D> box = grid.owned();
  for_each_closed_wall(grid, [&](int axis, int side, Wall) {
    (side == 0 ? box.lower : box.upper)[axis] += side == 0 ? -ghost_layers : ghost_layers;
  });
  return box;
}

/// Adds the images at the other closed walls.
template <int D>
void fold_beside(const Grid<D>& grid, const IndexBox<D>& box, int axis, CellField<D>& field) {
  for_each_closed_wall(grid, [&](int other, int side, Wall kind) {
    if (other == axis) return;
    const double sign = parity(axis, other, kind);
    for_each_mirror_pair(grid, box, other, side, false,
                         [&](const Index<D>& behind, const Index<D>& before) {
                           field[before] += sign * field[behind];
                         });
  });
}

}  // namespace

template <int D>
WallContact<D>::WallContact(const Grid<D>& grid) : grid_(&grid), halo_(grid) {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      if (grid.wall(axis, side) == Wall::friction)
        walls_.push_back({axis, side, grid.wall_friction(axis, side),
                          CellField<D>(grid, "wall reaction", "N"),
                          CellField<D>(grid, "wall reaction impulse", "kg m/s")});
}

/// Images change what the domain sees by minus twice what points leave behind the wall, and the
/// wall's own face is emptied: this is what the wall gives.
template <int D>
void WallContact<D>::measure(const NodeField<NodeSums, D>& sums) {
  const Grid<D>& grid = *grid_;
  for (Side& wall : walls_) {
    wall.force.fill(0.0);
    wall.momentum.fill(0.0);
    if (grid.touches(wall.axis, wall.side)) {
      const auto& normal = sums[static_cast<std::size_t>(wall.axis)];
      const int outwards = wall.side == 0 ? -1 : 1;
      const int depth = wall.side == 0 ? ghost_layers : ghost_layers - 1;
      const int face = wall.side == 0 ? 0 : grid.cells()[wall.axis];
      const IndexBox<D> row = row_at_wall(grid, with_mirrors(grid), wall.axis, wall.side);
      for_each(row, [&](const Index<D>& cell) {
        double force = 0.0, momentum = 0.0;
        for (int layer = 0; layer <= depth; ++layer) {
          Index<D> at = cell;
          at[wall.axis] = face + outwards * layer;
          const double share = layer == 0 ? 1.0 : 2.0;
          const NodeSums& node = normal[at];
          // Grains under effective stress and buoyant weight: without the water's push.
          force += share * (node.mixture_force - node.water_force);
          momentum += share * node.grain_momentum;
        }
        wall.force[cell] = outwards * force;
        wall.momentum[cell] = outwards * momentum;
      });
      fold_beside(grid, row, wall.axis, wall.force);
      fold_beside(grid, row, wall.axis, wall.momentum);
    }
    const std::array<double*, 2> both{wall.force.data(), wall.momentum.data()};
    halo_.exchange(both);
  }
}

template <int D>
void WallContact<D>::apply(double dt, const NodeField<NodeSums, D>& sums,
                           NodeField<NodeMotion, D>& motion) const {
  const Grid<D>& grid = *grid_;
  for (const Side& wall : walls_) {
    if (!grid.touches(wall.axis, wall.side)) continue;
    for (int d = 0; d < D; ++d) {
      if (d == wall.axis) continue;
      const auto u = static_cast<std::size_t>(d);
      const IndexBox<D> row = row_at_wall(grid, grid.owned_faces(d), wall.axis, wall.side);
      for_each(row, [&](const Index<D>& face) {
        NodeMotion& node = motion[u][face];
        const double mass = sums[u][face].grain_mass;
        if (mass <= 0.0) return;
        const Index<D> below = face.shifted(d, -1);
        const double pressed = std::max(0.0, 0.5 * (dt * (wall.force[face] + wall.force[below]) +
                                                    wall.momentum[face] + wall.momentum[below]));
        double speed2 = node.grain_velocity * node.grain_velocity;
        for (int other = 0; other < D; ++other) {  // the second component along the wall, in 3D
          if (other == d || other == wall.axis) continue;
          const auto& field = motion[static_cast<std::size_t>(other)];
          const double mean = 0.25 * (field[face].grain_velocity + field[below].grain_velocity +
                                      field[face.shifted(other, 1)].grain_velocity +
                                      field[below.shifted(other, 1)].grain_velocity);
          speed2 += mean * mean;
        }
        const double largest = wall.coefficient * pressed / mass;
        const double speed = std::sqrt(speed2);
        const double share = speed > 0.0 ? std::min(1.0, largest / speed) : 0.0;
        const double loss = share * node.grain_velocity;
        node.grain_velocity -= loss;
        node.grain_change -= loss;
        node.total_flux -= loss;
      });
    }
  }
}

template class WallContact<2>;
template class WallContact<3>;

}  // namespace mudlark

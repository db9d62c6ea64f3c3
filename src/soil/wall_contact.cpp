#include "soil/wall_contact.hpp"

#include <algorithm>
#include <cmath>

#include "soil/mirror.hpp"

namespace mudlark {
namespace {

/// Share of a wall's debt that is left after a step. A wave crosses a cell in about two steps:
/// debts outlive some swings (4 H/c) of a layer of 25 cells.
constexpr double debt_kept = 1.0 - 1.0 / 1000.0;

/// The cells, or faces along the wall, next to one side of the domain.
template <int D>
IndexBox<D> row_at_wall(const Grid<D>& grid, IndexBox<D> box, int axis, int side) {
  box.lower[axis] = side == 0 ? 0 : grid.cells()[axis] - 1;
  box.upper[axis] = box.lower[axis] + 1;
  return box;
}

}  // namespace

template <int D>
WallContact<D>::WallContact(const SoilSides<D>& sides) : grid_(&sides.grid()), halo_(sides.grid()) {
  const Grid<D>& grid = *grid_;
  const auto rough = [&](int axis, int side) {
    return grid.wall(axis, side) == Wall::friction ||
           std::any_of(sides.boundaries().begin(), sides.boundaries().end(),
                       [&](const SoilBoundary& part) {
                         return part.axis == axis && part.side == side && part.for_grains &&
                                part.grains == GrainSide::friction;
                       });
  };
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      if (rough(axis, side))
        walls_.push_back({axis, side, CellField<D>(grid, "impulse of the wall", "kg m/s"),
                          CellField<D>(grid, "pull of the wall", "kg m/s")});
}

/// What moved the grains of a face beside the forces of the points' sums, per mass [m/s].
template <int D>
double WallContact<D>::unsummed_push(const NodeSums& sum, const NodeMotion& node,
                                     const Change& change) {
  if (sum.grain_mass <= 0.0) return 0.0;
  return change.inertia * node.grain_change - change.dt * sum.mixture_force / sum.grain_mass;
}

/// Points near the wall own a share of the faces behind it. By the law of action and reaction what
/// the wall gives them is the change of their momentum less the forces on them; in the domain the
/// folded faces balance, and what is left is, behind the wall and with m, p, F the points' own sums
/// there,  2 {m [f dv + (1-f) v] + (1-f) p + F dt - D dt u},  f the share of FLIP, v, dv the motion
/// of the face in front, u the water's motion past its grains. On the wall's face, which does not
/// move, it is half of that. A mirrored motion that merely goes on, as in soil that spreads and
/// sinks, gives none: m v = -p. A pressure that only the faces know is in dv; grains on the wall's
/// face, which does not move, are pushed by it like those of the first face before it.
template <int D>
void WallContact<D>::measure(const SoilSides<D>& sides, const Change& change,
                             const NodeField<NodeSums, D>& sums,
                             const NodeField<NodeMotion, D>& motion) {
  const Grid<D>& grid = *grid_;
  const double flip = change.flip, rest = 1.0 - flip;
  for (Side& wall : walls_) {
    wall.impulse.fill(0.0);
    if (grid.touches(wall.axis, wall.side)) {
      const auto u = static_cast<std::size_t>(wall.axis);
      const int outwards = wall.side == 0 ? -1 : 1;
      const int depth = wall.side == 0 ? ghost_layers : ghost_layers - 1;
      const int face = wall.side == 0 ? 0 : grid.cells()[wall.axis];
      const IndexBox<D> row = row_at_wall(grid, grid.owned(), wall.axis, wall.side);
      for_each(row, [&](const Index<D>& cell) {
        const double coefficient = sides.friction(wall.axis, wall.side, cell);
        if (coefficient == 0.0) return;
        double given = 0.0;
        for (int layer = 0; layer <= depth; ++layer) {
          Index<D> behind = cell, before = cell;
          behind[wall.axis] = face + outwards * layer;
          before[wall.axis] = face - outwards * layer;
          const NodeSums& own = sums[u][behind];
          // Grains under effective stress and buoyant weight: without the water's push.
          double left = change.inertia * rest * own.grain_momentum +
                        change.dt * (own.mixture_force - own.water_force);
          if (layer > 0) {
            const NodeMotion& image = motion[u][before];
            left += change.inertia * own.grain_mass *
                        (flip * image.grain_change + rest * image.grain_velocity) -
                    change.dt * own.drag * (image.water_velocity - image.grain_velocity);
          }
          if (layer == 0 && change.lifted) {
            Index<D> first = cell;
            first[wall.axis] = face - outwards;
            left += own.grain_mass * unsummed_push(sums[u][first], motion[u][first], change);
          }
          given += (layer == 0 ? 1.0 : 2.0) * left;
        }
        const double pressed = coefficient * outwards * given - debt_kept * wall.owed[cell];
        wall.impulse[cell] = std::max(0.0, pressed);
        wall.owed[cell] = std::max(0.0, -pressed);
      });
    }
    halo_.exchange(wall.impulse);
  }
}

template <int D>
void WallContact<D>::apply(const SoilSides<D>& sides, const Change& change,
                           const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion) {
  const Grid<D>& grid = *grid_;
  measure(sides, change, sums, motion);
  for (const Side& wall : walls_) {
    if (!grid.touches(wall.axis, wall.side)) continue;
    for (int d = 0; d < D; ++d) {
      if (d == wall.axis) continue;
      const auto u = static_cast<std::size_t>(d);
      const IndexBox<D> row = row_at_wall(grid, grid.owned_faces(d), wall.axis, wall.side);
      for_each(row, [&](const Index<D>& face) {
        NodeMotion& node = motion[u][face];
        const double mass = change.inertia * sums[u][face].grain_mass;
        if (mass <= 0.0) return;
        const Index<D> below = face.shifted(d, -1);
        const double held = 0.5 * (wall.impulse[face] + wall.impulse[below]);
        double speed2 = node.grain_velocity * node.grain_velocity;
        for (int other = 0; other < D; ++other) {  // the second component along the wall, in 3D
          if (other == d || other == wall.axis) continue;
          const auto& field = motion[static_cast<std::size_t>(other)];
          const double mean = 0.25 * (field[face].grain_velocity + field[below].grain_velocity +
                                      field[face.shifted(other, 1)].grain_velocity +
                                      field[below.shifted(other, 1)].grain_velocity);
          speed2 += mean * mean;
        }
        const double largest = held / mass;
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

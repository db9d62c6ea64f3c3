#include "numerics/ghosts.hpp"

#include <algorithm>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Layer `layer` (1, 2, 3) behind a wall takes `factor` times the value of its mirror cell inside.
template <int D>
void mirror(const Grid<D>& grid, double* values, int axis, int side, double factor) {
  const IndexBox<D>& owned = grid.owned();
  const int width = owned.upper[axis] - owned.lower[axis];
  // Across the first axis the layers of a row lie close together: row after row, all its layers.
  for (int first = 1; first <= ghost_layers; first += axis == 0 ? ghost_layers : 1) {
    IndexBox<D> box = grid.local();
    box.lower[axis] = side == 0 ? owned.lower[axis] - first : owned.upper[axis] + first - 1;
    box.upper[axis] = box.lower[axis] + 1;
    if (axis == 0) {
      const std::ptrdiff_t outward = side == 0 ? -1 : 1;
      for_each_offset(grid, box, [&](std::ptrdiff_t at) {
        for (int layer = 1; layer <= ghost_layers; ++layer)
          values[at + outward * (layer - 1)] =
              factor * values[at - outward * std::min(layer, width)];
      });
      continue;
    }
    const int inside = std::min(first, width);
    const int source = side == 0 ? owned.lower[axis] + inside - 1 : owned.upper[axis] - inside;
    const std::ptrdiff_t shift = (source - box.lower[axis]) * grid.stride(axis);
    for_each_offset(grid, box,
                    [&](std::ptrdiff_t at) { values[at] = factor * values[at + shift]; });
  }
}

}  // namespace

template <int D>
void Ghosts<D>::mirror_cells(double* values, int axis, int side) const {
  mirror(*grid_, values, axis, side, 1.0);
}

template <int D>
void Ghosts<D>::fill_tangential(double* values, int axis, int side) const {
  mirror(*grid_, values, axis, side, grid_->wall(axis, side) == Wall::no_slip ? -1.0 : 1.0);
}

/// The wall face itself is kept at an open wall and set to zero at a closed one.
template <int D>
void Ghosts<D>::fill_normal(double* values, int axis, int side) const {
  const Grid<D>& grid = *grid_;
  const bool open = grid.wall(axis, side) == Wall::open;
  const int wall_face = side == 0 ? grid.owned().lower[axis] : grid.owned().upper[axis];
  const int width = grid.owned().upper[axis] - grid.owned().lower[axis];
  const int outward = side == 0 ? -1 : 1;
  const int layers =
      side == 0 ? ghost_layers : ghost_layers - 1;  // the closing face is a ghost itself
  for (int layer = 0; layer <= layers; ++layer) {
    IndexBox<D> box = grid.local();
    box.lower[axis] = wall_face + outward * layer;
    box.upper[axis] = box.lower[axis] + 1;
    const int source = open ? wall_face : wall_face - outward * std::min(layer, width);
    const std::ptrdiff_t shift = (source - box.lower[axis]) * grid.stride(axis);
    const double factor = open ? 1.0 : layer == 0 ? 0.0 : -1.0;
    for_each(box, [&](const Index<D>& index) {
      const std::ptrdiff_t at = grid.offset(index);
      values[at] = factor * values[at + shift];
    });
  }
}

template <int D>
void Ghosts<D>::update(CellField<D>& field) {
  halo_.exchange(field);
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      if (grid_->touches(axis, side)) mirror_cells(field.data(), axis, side);
}

template <int D>
void Ghosts<D>::update_velocity(FaceVector<D>& velocity) {
  halo_.exchange(velocity);
  for (int component = 0; component < D; ++component)
    for (int axis = 0; axis < D; ++axis)
      for (int side = 0; side < 2; ++side) {
        if (!grid_->touches(axis, side)) continue;
        if (axis == component)
          fill_normal(velocity[component].data(), axis, side);
        else
          fill_tangential(velocity[component].data(), axis, side);
      }
}

template class Ghosts<2>;
template class Ghosts<3>;

}  // namespace mudlark

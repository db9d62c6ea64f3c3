#include "numerics/ghosts.hpp"

#include <algorithm>

#include "numerics/cell_runs.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Calls body(at) for the places with an index `behind` along the axis.
template <int D, class Body>
void for_each_behind(const Grid<D>& grid, const Grid<D>&, int axis, int behind, Body&& body) {
  IndexBox<D> box = grid.local();
  box.lower[axis] = behind;
  box.upper[axis] = behind + 1;
  for_each_offset(grid, box, body);
}

/// The same near the water. Across the first axis those are the rows with near cells so close to
/// the wall that they have a mirror cell.
template <int D, class Body>
void for_each_behind(const Grid<D>& grid, const CellRuns<D>& near, int axis, int behind,
                     Body&& body) {
  IndexBox<D> box = grid.local();
  if (axis > 0) {
    box.lower[axis] = behind;
    box.upper[axis] = behind + 1;
    for_each_offset(near, box, body);
    return;
  }
  const bool lower = behind <= grid.owned().lower[0];
  const int reach = ghost_layers + 1;  // of faces one more than of cells
  (lower ? box.upper : box.lower)[0] =
      lower ? grid.owned().lower[0] + reach : grid.owned().upper[0] - reach;
  for_each_piece(near, box, [&](const auto& run, std::ptrdiff_t, int, int) {
    body(run.at + (behind - run.first[0]));
  });
}

/// Layer `layer` (1, 2, 3) behind a wall takes `factor` times the value of its mirror cell inside.
template <int D, class Where, class T>
void mirror(const Grid<D>& grid, const Where& where, T* values, int axis, int side, T factor) {
  const IndexBox<D>& owned = grid.owned();
  const int width = owned.upper[axis] - owned.lower[axis];
  const int behind = side == 0 ? owned.lower[axis] - 1 : owned.upper[axis];
  if (axis == 0) {  // the layers of a row lie close together: row after row, all its layers
    const std::ptrdiff_t outward = side == 0 ? -1 : 1;
    for_each_behind(grid, where, axis, behind, [&](std::ptrdiff_t at) {
      for (int layer = 1; layer <= ghost_layers; ++layer)
        values[at + outward * (layer - 1)] =
            static_cast<T>(factor * values[at - outward * std::min(layer, width)]);
    });
    return;
  }
  for (int layer = 1; layer <= ghost_layers; ++layer) {
    const int place = side == 0 ? behind - (layer - 1) : behind + (layer - 1);
    const int inside = std::min(layer, width);
    const int source = side == 0 ? owned.lower[axis] + inside - 1 : owned.upper[axis] - inside;
    const std::ptrdiff_t shift = (source - place) * grid.stride(axis);
    for_each_behind(grid, where, axis, place, [&](std::ptrdiff_t at) {
      values[at] = static_cast<T>(factor * values[at + shift]);
    });
  }
}

}  // namespace

template <int D>
template <class Where, class T>
void Ghosts<D>::mirror_cells(const Where& where, T* values) const {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      if (grid_->touches(axis, side)) mirror(*grid_, where, values, axis, side, T{1});
}

/// The wall face itself is kept at an open wall and set to zero at a closed one.
template <int D>
template <class Where>
void Ghosts<D>::fill_normal(const Where& where, double* values, int axis, int side) const {
  const Grid<D>& grid = *grid_;
  const bool open = grid.wall(axis, side) == Wall::open;
  const int wall_face = side == 0 ? grid.owned().lower[axis] : grid.owned().upper[axis];
  const int width = grid.owned().upper[axis] - grid.owned().lower[axis];
  const int outward = side == 0 ? -1 : 1;
  const int layers =
      side == 0 ? ghost_layers : ghost_layers - 1;  // the closing face is a ghost itself
  for (int layer = 0; layer <= layers; ++layer) {
    const int place = wall_face + outward * layer;
    const int source = open ? wall_face : wall_face - outward * std::min(layer, width);
    const std::ptrdiff_t shift = (source - place) * grid.stride(axis);
    const double factor = open ? 1.0 : layer == 0 ? 0.0 : -1.0;
    for_each_behind(grid, where, axis, place,
                    [&](std::ptrdiff_t at) { values[at] = factor * values[at + shift]; });
  }
}

template <int D>
template <class Where>
void Ghosts<D>::fill_behind_walls(const Where& where, FaceVector<D>& velocity) const {
  for (int component = 0; component < D; ++component)
    for (int axis = 0; axis < D; ++axis)
      for (int side = 0; side < 2; ++side) {
        if (!grid_->touches(axis, side)) continue;
        double* values = velocity[component].data();
        const double factor = grid_->wall(axis, side) == Wall::no_slip ? -1.0 : 1.0;
        if (axis == component)
          fill_normal(where, values, axis, side);
        else
          mirror(*grid_, where, values, axis, side, factor);
      }
}

template <int D>
void Ghosts<D>::update(CellField<D>& field) {
  halo_.exchange(field);
  mirror_cells(*grid_, field.data());
}

template <int D>
void Ghosts<D>::update(Field<std::uint8_t, AtCell, D>& marks) {
  halo_.exchange(marks);
  mirror_cells(*grid_, marks.data());
}

template <int D>
void Ghosts<D>::update(CellField<D>& field, const CellRuns<D>& near) {
  halo_.exchange(field);
  mirror_cells(near, field.data());
}

template <int D>
void Ghosts<D>::update_velocity(FaceVector<D>& velocity) {
  halo_.exchange(velocity);
  fill_behind_walls(*grid_, velocity);
}

template <int D>
void Ghosts<D>::update_velocity(FaceVector<D>& velocity, const CellRuns<D>& near) {
  halo_.exchange(velocity);
  fill_behind_walls(near, velocity);
}

template class Ghosts<2>;
template class Ghosts<3>;

}  // namespace mudlark

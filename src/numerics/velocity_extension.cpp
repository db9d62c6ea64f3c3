#include "numerics/velocity_extension.hpp"

#include <algorithm>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

// States of a face: negative ones wait for a value; a layer's number says when a face got it.
constexpr double film =
    -3.0;  ///< water without pressure on a body: extended where any layer reaches it, else still
constexpr double empty = -2.0;  ///< no water: to be extended
constexpr double free_fly =
    -1.0;  ///< water without pressure: extended next to governed faces, else kept
/// Governed faces hold this times the share of water in their two cells: above 0 and at most 1/2.
constexpr double governed = 0.5;
constexpr double flying = 10.0;
constexpr double closed =
    20.0;  ///< closed wall: known, but no source: water may leave a ceiling or a wall

/// A face flies freely from this share of water on; less is dust that goes with its surroundings,
/// because the velocity of next to nothing is mostly round-off.
constexpr double dust = 1e-6;
/// Water that fills more than this of both cells of a face in the ground goes by its own drag up to
/// the surface: what seeps down arrives there.
constexpr double seeps = 0.1;

/// Is all of a face of an axis in the ground, or all of it outside? Asked of a neighbour of a face
/// outside, the first looks at the cell that they share first: the other may lie beyond the arrays.
bool in_ground(const double* drains, std::ptrdiff_t at, std::ptrdiff_t stride) {
  return drains[at] > 0.0 && drains[at - stride] > 0.0;
}
bool outside_ground(const double* drains, std::ptrdiff_t at, std::ptrdiff_t stride) {
  return drains[at] == 0.0 && drains[at - stride] == 0.0;
}

/// Does water on its way through half empty pores pass a face of an axis?
bool passes_ground(const double* water, const double* porosity, const double* drains,
                   std::ptrdiff_t at, std::ptrdiff_t stride) {
  for (const std::ptrdiff_t cell : {at, at - stride})
    if (drains[cell] == 0.0 || !(water[cell] > seeps * porosity[cell])) return false;
  return true;
}

}  // namespace

template <int D>
VelocityExtension<D>::VelocityExtension(const Grid<D>& grid, const CellRuns<D>& near)
    : grid_(&grid),
      near_(&near),
      ghosts_(grid),
      state_(grid, "extension state", "1", empty),
      squeeze_(grid, "squeeze", "m/s") {}

template <int D>
void VelocityExtension<D>::mark(int component, const CellField<D>& unknown,
                                const CellField<D>& water, const CellField<D>& porosity,
                                const FaceVector<D>& capacity) {
  const Grid<D>& grid = *grid_;
  IndexBox<D> box = grid.local();
  box.lower[component] += 1;
  const std::ptrdiff_t s = grid.stride(component);
  const double* inside = unknown.data();
  const double* w = water.data();
  const double* theta = porosity.data();
  double* state = state_[component].data();
  const double* below = capacity[D - 1].data();
  const auto on_body = [&](std::ptrdiff_t cell) {
    return w[cell] > dust * theta[cell] && below[cell] == 0.0;
  };
  const double* open = capacity[component].data();
  for_each_offset(
      *near_, box,
      [&](std::ptrdiff_t at) {
        const double held = w[at] + w[at - s], room = theta[at] + theta[at - s];
        if (open[at] == 0.0)
          state[at] = closed;
        else if (inside[at] + inside[at - s] > 0.0)
          state[at] = governed * std::min(held / room, 1.0);
        else if (held <= dust * room)
          state[at] = empty;
        else
          state[at] = on_body(at) || on_body(at - s) ? film : free_fly;
      },
      w, theta, inside, open, state);
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(component, side) || grid.wall(component, side) == Wall::open) continue;
    IndexBox<D> wall = grid.local();
    wall.lower[component] =
        side == 0 ? grid.owned().lower[component] : grid.owned().upper[component];
    wall.upper[component] = wall.lower[component] + 1;
    for_each_offset(grid, wall, [&](std::ptrdiff_t at) { state[at] = closed; });
  }
}

/// Lists the faces of a component that wait for a value, in a box in which all neighbours are
/// valid.
template <int D>
void VelocityExtension<D>::find_waiting(int component) {
  const double* state = state_[component].data();
  waiting_.clear();
  for_each_offset(
      *near_, grid_->owned().grown(ghost_layers - 1),
      [&](std::ptrdiff_t at) {
        if (state[at] < 0.0) waiting_.push_back(at);
      },
      state);
}

/// Faces next to governed ones: n . grad v = 0 with the upwind differences along the axes in which
/// the water gets more, n being the gradient of its share. A plain mean of the neighbours would
/// take part of the velocity from along the surface, on a wave always from the side of the crest:
/// that drives a current (decision 0080).
template <int D>
void VelocityExtension<D>::grow_along_normal(int component, const CellField<D>& water,
                                             const CellField<D>& porosity,
                                             const CellField<D>& drains, double* velocity) {
  const Grid<D>& grid = *grid_;
  double* state = state_[component].data();
  const double* w = water.data();
  const double* theta = porosity.data();
  const std::ptrdiff_t sc = grid.stride(component);
  auto& flies = flies_[static_cast<std::size_t>(component)];
  std::erase_if(waiting_, [&](std::ptrdiff_t at) {
    if (state[at] == free_fly && passes_ground(w, theta, drains.data(), at, sc)) {
      state[at] = flying;
      flies.push_back(at);
      return true;
    }
    const double room = theta[at] + theta[at - sc];
    const double held = room > 0.0 ? (w[at] + w[at - sc]) / room : 0.0;
    // Water over the ground does not move as that in it.
    const bool over = outside_ground(drains.data(), at, sc);
    double sum = 0.0, weights = 0.0, mean = 0.0, count = 0.0;
    for (int axis = 0; axis < D; ++axis) {
      const std::ptrdiff_t s = grid.stride(axis);
      for (const std::ptrdiff_t other : {at - s, at + s}) {
        if (state[other] <= 0.0 || state[other] > governed) continue;
        if (over && in_ground(drains.data(), other, sc)) continue;
        const double h = grid.width_at(axis, at);
        const double weight = std::max(state[other] / governed - held, 0.0) / (h * h);
        sum += weight * velocity[other], weights += weight;
        mean += velocity[other], count += 1.0;
      }
    }
    if (count == 0.0) return false;
    velocity[at] = weights > 0.0 ? sum / weights : mean / count;
    state[at] = 1.0;
    return true;
  });
}

/// Faces with water that no governed one is next to.
template <int D>
void VelocityExtension<D>::let_fly(int component) {
  double* state = state_[component].data();
  auto& flies = flies_[static_cast<std::size_t>(component)];
  std::erase_if(waiting_, [&](std::ptrdiff_t at) {
    if (state[at] != free_fly) return false;
    state[at] = flying;
    flies.push_back(at);
    return true;
  });
}

/// Farther faces still without a value take the mean of the neighbours that had one before this
/// layer.
template <int D>
void VelocityExtension<D>::grow_layer(int component, int layer, const double* drains,
                                      double* velocity) {
  const Grid<D>& grid = *grid_;
  double* state = state_[component].data();
  const std::ptrdiff_t sc = grid.stride(component);
  const double mine = static_cast<double>(layer);
  std::erase_if(waiting_, [&](std::ptrdiff_t at) {
    const bool over = outside_ground(drains, at, sc);
    double sum = 0.0, count = 0.0;
    for (int axis = 0; axis < D; ++axis) {
      const std::ptrdiff_t s = grid.stride(axis);
      for (const std::ptrdiff_t other : {at - s, at + s}) {
        if (state[other] <= 0.0 || (state[other] >= mine && state[other] != flying)) continue;
        if (over && in_ground(drains, other, sc)) continue;
        sum += velocity[other], count += 1.0;
      }
    }
    if (count == 0.0) return false;
    velocity[at] = sum / count;
    state[at] = mine;
    return true;
  });
}

template <int D>
void VelocityExtension<D>::extend(const CellField<D>& unknown, const CellField<D>& water,
                                  const CellField<D>& porosity, const FaceVector<D>& capacity,
                                  const CellField<D>& drains, FaceVector<D>& velocity) {
  for (int component = 0; component < D; ++component)
    mark(component, unknown, water, porosity, capacity);
  ghosts_.exchange(state_);  // the lowest ghost face of a rank lacks one of its cells there
  for (int component = 0; component < D; ++component) {
    double* v = velocity[component].data();
    find_waiting(component);
    flies_[static_cast<std::size_t>(component)].clear();
    grow_along_normal(component, water, porosity, drains, v);
    let_fly(component);
    for (int layer = 2; layer <= ghost_layers; ++layer)
      grow_layer(component, layer, drains.data(), v);
    for (const std::ptrdiff_t at : waiting_) v[at] = 0.0;
  }
  ghosts_.update_velocity(velocity, *near_);
  keep_from_closing(unknown, water, porosity, drains, velocity);
}

/// Lists the cells beside faces that fly that may open but not close.
template <int D>
void VelocityExtension<D>::find_cells_to_keep(const double* unknown, const double* water,
                                              const double* porosity, const double* drains) {
  const Grid<D>& grid = *grid_;
  keeps_open_.clear();
  for_each_offset(*near_, grid.owned(), [&](std::ptrdiff_t at) {
    if (unknown[at] > 0.0 || drains[at] > 0.0 || water[at] <= dust * porosity[at]) return;
    bool free = false;
    for (int axis = 0; axis < D; ++axis) {
      const double* state = state_[axis].data();
      free = free || state[at] == flying || state[at + grid.stride(axis)] == flying;
    }
    if (free) keeps_open_.push_back(at);
  });
}

/// Speed by which each free face of a closing cell has to move outwards so that the cell keeps its
/// volume.
template <int D>
double VelocityExtension<D>::squeeze(std::ptrdiff_t at, const FaceVector<D>& velocity) const {
  const Grid<D>& grid = *grid_;
  double opening = 0.0, free_sides = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    const double* v = velocity[axis].data();
    const double* state = state_[axis].data();
    const std::ptrdiff_t s = grid.stride(axis);
    const double inverse = 1.0 / grid.width_at(axis, at);
    opening += (v[at + s] - v[at]) * inverse;
    free_sides +=
        inverse * ((state[at] == flying ? 1.0 : 0.0) + (state[at + s] == flying ? 1.0 : 0.0));
  }
  return opening < 0.0 && free_sides > 0.0 ? -opening / free_sides : 0.0;
}

template <int D>
void VelocityExtension<D>::keep_from_closing(const CellField<D>& unknown, const CellField<D>& water,
                                             const CellField<D>& porosity,
                                             const CellField<D>& drains, FaceVector<D>& velocity) {
  const Grid<D>& grid = *grid_;
  const bool none = std::ranges::all_of(flies_, [](const auto& faces) { return faces.empty(); });
  if (max_over_ranks(grid, none ? 0.0 : 1.0) == 0.0) return;
  ghosts_.exchange(state_);
  find_cells_to_keep(unknown.data(), water.data(), porosity.data(), drains.data());
  double* squeezed = squeeze_.data();
  for_each_offset(*near_, grid.local(), [&](std::ptrdiff_t at) { squeezed[at] = 0.0; });
  for (int pass = 0; pass < 3; ++pass) {
    for (const std::ptrdiff_t at : keeps_open_) squeezed[at] = squeeze(at, velocity);
    ghosts_.update(squeeze_, *near_);
    for (int axis = 0; axis < D; ++axis) {
      double* v = velocity[axis].data();
      const std::ptrdiff_t s = grid.stride(axis);
      for (const std::ptrdiff_t at : flies_[static_cast<std::size_t>(axis)])
        v[at] += squeezed[at - s] - squeezed[at];
    }
    ghosts_.update_velocity(velocity, *near_);
  }
}

template class VelocityExtension<2>;
template class VelocityExtension<3>;

}  // namespace mudlark

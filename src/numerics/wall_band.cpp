#include "numerics/wall_band.hpp"

#include <algorithm>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// A cell with this share of water counts as wet for what lies under it (and with so little air as
/// full for what lies above it); less counts in proportion.
constexpr double film = 1e-6;

}  // namespace

template <int D>
WallBand<D>::WallBand(const Grid<D>& grid)
    : grid_(&grid), ghosts_(grid), known_(grid, "known", "1"), layer_(grid, "layer", "1") {}

/// In the order in which values become known: beside open cells on the same level; above and below
/// them; the rest around.
template <int D>
void WallBand<D>::find_cells(const Space<D>& space) {
  const Grid<D>& grid = *grid_;
  const IndexBox<D> box = grid.local().grown(-1);
  const double* volume = space.volume.data();
  double* known = known_.data();
  for (auto& pass : passes_) pass.clear();
  empty_ = true;
  for_each_offset(grid, grid.local(), [&](std::ptrdiff_t at) {
    known[at] = volume[at] > 0.0 ? 1.0 : 0.0;
    empty_ = empty_ && volume[at] > 0.0;
  });
  empty_ = max_over_ranks(grid, empty_ ? 0.0 : 1.0) == 0.0;  // exchanges wait for all ranks
  if (empty_) return;
  const auto beside = [&](std::ptrdiff_t at, double until) {
    for (int a = 0; a < D - 1; ++a)
      for (const std::ptrdiff_t other : {at - grid.stride(a), at + grid.stride(a)})
        if (known[other] > 0.0 && known[other] <= until) return true;
    return false;
  };
  const auto take = [&](std::size_t pass, std::ptrdiff_t at, From from) {
    passes_[pass].push_back({at, from});
    known[at] = static_cast<double>(pass) + 2.0;
  };
  const std::ptrdiff_t up = grid.stride(D - 1);
  for_each_offset(grid, box, [&](std::ptrdiff_t at) {
    if (known[at] == 0.0 && beside(at, 1.0)) take(0, at, From::beside);
  });
  for_each_offset(grid, box, [&](std::ptrdiff_t at) {
    if (known[at] != 0.0) return;
    if (known[at + up] == 1.0)
      take(1, at, From::below);
    else if (known[at - up] == 1.0)
      take(1, at, From::above);
  });
  for_each_offset(grid, box, [&](std::ptrdiff_t at) {
    if (known[at] != 0.0) return;
    bool near = beside(at, 3.0);
    for (int a = 0; a < D; ++a)
      near = near || (known[at - grid.stride(a)] > 0.0 && known[at - grid.stride(a)] < 4.0) ||
             (known[at + grid.stride(a)] > 0.0 && known[at + grid.stride(a)] < 4.0);
    if (near) take(2, at, beside(at, 3.0) ? From::beside : From::around);
  });
}

template <int D>
void WallBand<D>::extend_saturation(const CellField<D>& porosity, CellField<D>& saturation) const {
  const Grid<D>& grid = *grid_;
  const double* known = known_.data();
  double* alpha = saturation.data();
  const std::ptrdiff_t up = grid.stride(D - 1);
  for (const SmallCell& small : small_) alpha[small.at] = alpha[small.host];
  double mine = 2.0;
  for (const auto& pass : passes_) {
    for (const Cell& cell : pass) {
      if (porosity.data()[cell.at] > 0.0) continue;  // closes in this step, and holds its own yet
      if (cell.from == From::below) {
        alpha[cell.at] = std::clamp(alpha[cell.at + up] / film, 0.0, 1.0);
      } else if (cell.from == From::above) {
        alpha[cell.at] = std::clamp(1.0 - (1.0 - alpha[cell.at - up]) / film, 0.0, 1.0);
      } else {
        double sum = 0.0, count = 0.0;
        for (int a = 0; a < (cell.from == From::beside ? D - 1 : D); ++a)
          for (const std::ptrdiff_t other : {cell.at - grid.stride(a), cell.at + grid.stride(a)})
            if (known[other] > 0.0 && known[other] < mine) sum += alpha[other], count += 1.0;
        alpha[cell.at] = sum / count;
      }
    }
    mine += 1.0;
  }
}

template <int D>
void WallBand<D>::mark_faces(const Space<D>& space) {
  const Grid<D>& grid = *grid_;
  for (auto& layer : layers_) layer.clear();
  if (empty_) {
    layer_.fill(0.0);
    return;
  }
  for (int axis = 0; axis < D; ++axis) {
    const double* aperture = space.aperture[axis].data();
    double* layer = layer_[axis].data();
    for_each_offset(grid, grid.local(),
                    [&](std::ptrdiff_t at) { layer[at] = aperture[at] > 0.0 ? 0.0 : -1.0; });
    for (int number = 0; number < 2; ++number)
      for_each_offset(grid, grid.local().grown(-1 - number), [&](std::ptrdiff_t at) {
        if (layer[at] >= 0.0) return;
        for (int a = 0; a < D; ++a)
          for (const std::ptrdiff_t other : {at - grid.stride(a), at + grid.stride(a)})
            if (layer[other] == number) layer[at] = number + 1.0;
        if (layer[at] > 0.0) layers_[static_cast<std::size_t>(number)].emplace_back(axis, at);
      });
  }
}

/// Velocity at the centre of a face: its own component, and the means of the four nearest of
/// others.
template <int D>
Vec<D> WallBand<D>::velocity_at(const FaceVector<D>& velocity, const WallFace<D>& wall) const {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t at = grid.offset(wall.face), own = grid.stride(wall.axis);
  Vec<D> v;
  for (int a = 0; a < D; ++a) {
    const double* values = velocity[a].data();
    const std::ptrdiff_t s = grid.stride(a);
    if (a == wall.axis) {
      v[a] = values[at];
      continue;
    }
    double sum = 0.0, count = 0.0;
    const double* layer = layer_[a].data();
    for (const std::ptrdiff_t other : {at, at + s, at - own, at + s - own})
      if (layer[other] >= 0.0) sum += values[other], count += 1.0;
    v[a] = count > 0.0 ? sum / count : 0.0;
  }
  return v;
}

template <int D>
void WallBand<D>::extend_velocity(FaceVector<D>& velocity) {
  if (empty_) return;
  const Grid<D>& grid = *grid_;
  for (std::size_t number = 0; number < layers_.size(); ++number)
    for (const auto& [axis, at] : layers_[number]) {
      double* v = velocity[axis].data();
      const double* layer = layer_[axis].data();
      double sum = 0.0, count = 0.0;
      for (int a = 0; a < D; ++a)
        for (const std::ptrdiff_t other : {at - grid.stride(a), at + grid.stride(a)})
          if (layer[other] == static_cast<double>(number)) sum += v[other], count += 1.0;
      v[at] = sum / count;
    }
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const WallFace<D>& wall = walls_[i];
    const Vec<D> v = velocity_at(velocity, wall);
    moved_[i] = v[wall.axis] - wall.normal[wall.axis] * dot(wall.normal, v - wall.velocity);
  }
  for (std::size_t i = 0; i < walls_.size(); ++i)
    velocity[walls_[i].axis][walls_[i].face] = moved_[i];
  ghosts_.update_velocity(velocity);
}

template class WallBand<2>;
template class WallBand<3>;

}  // namespace mudlark

#include "numerics/near_water.hpp"

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Share of the pores below which water is dust that no velocity is looked for around: half of what
/// makes a face fly (numerics/velocity_extension.cpp).
constexpr double dust = 0.5e-6;
/// What transport may leave of the porosity of open space.
constexpr double round_off = 1e-9;

}  // namespace

template <int D>
NearWater<D>::NearWater(const Grid<D>& grid)
    : grid_(&grid),
      ghosts_(grid),
      near_(grid, "near water", "1"),
      wider_(grid, "near water", "1"),
      wet_(grid, "wet", "1") {
  take_all();
}

template <int D>
void NearWater<D>::take_all() {
  if (all_) return;
  near_.fill(1.0);
  find_runs();
  all_ = true;
}

/// Grows the marked cells by up to as many cells as there are ghost layers along every axis. Valid
/// on the owned cells of all ranks first, then with ghosts.
template <int D>
template <int Cells>
void NearWater<D>::dilate() {
  static_assert(Cells <= ghost_layers);
  const Grid<D>& grid = *grid_;
  IndexBox<D> box = grid.local();
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    box.lower[axis] = grid.owned().lower[axis];
    box.upper[axis] = grid.owned().upper[axis];
    const double* mark = near_.data();
    double* out = wider_.data();
    for_each_offset(grid, box, [&](std::ptrdiff_t at) {
      double largest = mark[at];
      for (int n = 1; n <= Cells; ++n)
        largest = std::max(largest, std::max(mark[at - n * s], mark[at + n * s]));
      out[at] = largest;
    });
    near_.swap(wider_);
  }
  ghosts_.update(near_);
}

template <int D>
void NearWater<D>::find(const CellField<D>& water, const CellField<D>& porosity,
                        const FaceVector<D>& velocity, bool ground) {
  const double *w = water.data(), *theta = porosity.data();
  double *mark = near_.data(), *wet = wet_.data();
  for_each_offset(*grid_, grid_->local(), [&](std::ptrdiff_t at) {
    const bool grains = ground && theta[at] < 1.0 - round_off;
    const double now = w[at] > dust * theta[at] || grains ? 1.0 : 0.0;
    mark[at] = std::max(now, wet[at]);
    wet[at] = now;
  });
  dilate<3>();
  mark = near_.data();
  for (int a = 0; a < D; ++a) {
    const double* v = velocity[a].data();
    for_each_offset(*grid_, grid_->local(),
                    [&](std::ptrdiff_t at) { mark[at] = v[at] != 0.0 ? 1.0 : mark[at]; });
  }
  dilate<2>();
  find_runs();
  all_ = false;
}

template <int D>
void NearWater<D>::find_runs() {
  runs_.clear();
  IndexBox<D> rows = grid_->local();
  const int first = rows.lower[0], end = rows.upper[0];
  rows.upper[0] = first + 1;
  const double* mark = near_.data();
  for_each(rows, [&](Index<D> index) {
    std::ptrdiff_t at = grid_->offset(index);
    for (int& i = index[0]; i < end; ++i, ++at) {
      if (mark[at] == 0.0) continue;
      const Run run{index, 0, at};
      while (i < end && mark[at] > 0.0) ++i, ++at;
      runs_.push_back(run);
      runs_.back().end = i;
    }
  });
}

template class NearWater<2>;
template class NearWater<3>;

}  // namespace mudlark

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
      wet_(grid, "wet", "1"),
      cells_(grid),
      beside_(grid) {
  take_all();
}

template <int D>
void NearWater<D>::take_all() {
  if (all_) return;
  near_.fill(1);
  cells_.find(near_);
  beside_.find(near_);
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
    const std::uint8_t* mark = near_.data();
    std::uint8_t* out = wider_.data();
    for_each_offset(grid, box, [&](std::ptrdiff_t at) {
      std::uint8_t any = mark[at];
      for (int n = 1; n <= Cells; ++n)
        any = static_cast<std::uint8_t>(any | mark[at - n * s] | mark[at + n * s]);
      out[at] = any;
    });
    near_.swap(wider_);
  }
  ghosts_.update(near_);
}

template <int D>
template <class Body>
void NearWater<D>::for_each_candidate(bool anywhere, Body&& body) const {
  if (anywhere)
    for_each_offset(*grid_, grid_->local(), body);
  else
    for_each_offset(cells_, grid_->local(), body);
}

template <int D>
void NearWater<D>::find(const CellField<D>& water, const CellField<D>& porosity,
                        const FaceVector<D>& velocity, bool ground, bool anywhere) {
  const double *w = water.data(), *theta = porosity.data();
  std::uint8_t *mark = near_.data(), *wet = wet_.data();
  near_.fill(0);
  for_each_candidate(anywhere, [&](std::ptrdiff_t at) {
    const bool grains = ground && theta[at] < 1.0 - round_off;
    const bool now = w[at] > dust * theta[at] || grains;
    mark[at] = now || wet[at] ? 1 : 0;
    wet[at] = now ? 1 : 0;
  });
  dilate<1>();
  if (!anywhere) beside_.find(near_);
  dilate<2>();
  mark = near_.data();
  for (int a = 0; a < D; ++a) {
    const double* v = velocity[a].data();
    for_each_candidate(anywhere, [&](std::ptrdiff_t at) {
      if (v[at] != 0.0) mark[at] = 1;
    });
  }
  dilate<2>();
  cells_.find(near_);
  if (anywhere) beside_.find(near_);
  all_ = false;
}

template class NearWater<2>;
template class NearWater<3>;

}  // namespace mudlark

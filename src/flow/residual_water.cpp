#include "flow/residual_water.hpp"

#include <algorithm>

#include "flow/flow_checks.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Where grains were pressed together some of the room is left to water that moves.
constexpr double most_of_pores = 0.95;

}  // namespace

template <int D>
ResidualWater<D>::ResidualWater(const Grid<D>& grid, const FlowOptions& options)
    : grid_(&grid),
      ghosts_(grid),
      acceleration_(grid, options),
      density_(options.density),
      held_(grid, "held water", "1"),
      free_(grid, "free water", "1"),
      room_(grid, "free room", "1", 1.0),
      moved_(grid, "free room", "1", 1.0),
      mass_(grid, "held mass", "kg/m3"),
      weight_(grid, "held weight", "N/m3"),
      free_share_(grid, "free share of pores", "1", 1.0),
      passed_(grid, "held water through faces", "1") {}

template <int D>
void ResidualWater<D>::hold(const CellField<D>& water, const CellField<D>& porosity,
                            const PorousMedium<D>& medium) {
  const double *w = water.data(), *theta = porosity.data();
  const double *volume = medium.space.volume.data(), *most = medium.residual.data();
  double* held = held_.data();
  for_each_offset(*grid_, grid_->local(), [&](std::ptrdiff_t at) {
    const double can = std::min(volume[at] * most[at], most_of_pores * theta[at]);
    held[at] = std::clamp(can, 0.0, std::max(w[at], 0.0));
  });
  release(water, porosity);
}

template <int D>
void ResidualWater<D>::release(const CellField<D>& water, const CellField<D>& porosity) {
  const double *w = water.data(), *theta = porosity.data(), *held = held_.data();
  double *free = free_.data(), *room = room_.data();
  for_each_offset(*grid_, grid_->local(), [&](std::ptrdiff_t at) {
    free[at] = w[at] - held[at];
    room[at] = theta[at] - held[at];
  });
}

/// Above the surface a face has the mean of its cells. Water below it has its own weight, held or
/// not, so at the surface only what lies beyond counts.
template <int D>
void ResidualWater<D>::hang(const CellField<D>& unknown, const FaceVector<D>& reach, double time) {
  const double *governed = unknown.data(), *held = held_.data(), *room = room_.data();
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid_->stride(axis);
    const double* surface = reach[axis].data();
    double *mass = mass_[axis].data(), *weight = weight_[axis].data();
    double* share = free_share_[axis].data();
    weight_[axis].fill(grid_->gravity()[axis]);
    if (acceleration_.given()) acceleration_.add(axis, time, weight_[axis]);
    for_each_offset(*grid_, bounding_faces(*grid_, axis), [&](std::ptrdiff_t at) {
      const bool above = governed[at] > 0.0, below = governed[at - s] > 0.0;
      if (above && below)
        mass[at] = 0.0;
      else if (!above && !below)
        mass[at] = 0.5 * density_ * (held[at] + held[at - s]);
      else
        mass[at] = density_ * held[above ? at - s : at] * (1.0 - std::clamp(surface[at], 0.0, 1.0));
      weight[at] *= mass[at];
      const double free = room[at] + room[at - s], all = free + held[at] + held[at - s];
      share[at] = all > 0.0 ? free / all : 1.0;
    });
  }
}

/// What the grains hold is a share of the pores, so it goes through a face as that share of what
/// the face lets through at their velocity.
template <int D>
void ResidualWater<D>::go_with_grains(const FaceVector<D>* grain_velocity,
                                      const FaceVector<D>& capacity, double dt,
                                      FaceVector<D>& flux) {
  for (int axis = 0; axis < D; ++axis) passed_[axis].fill(0.0);
  if (!grain_velocity) return;
  const double* room = room_.data();
  double* held = held_.data();
  for (int axis = 0; axis < D; ++axis) {
    passed_[axis].copy_values_from((*grain_velocity)[axis]);
    for (int side = 0; side < 2; ++side)
      if (grid_->touches(axis, side) && grid_->wall(axis, side) != Wall::open)
        zero_wall(*grid_, axis, side, passed_[axis]);
    const std::ptrdiff_t s = grid_->stride(axis);
    const double courant = dt / grid_->spacing()[axis];
    const double* theta = capacity[axis].data();
    double *u = flux[axis].data(), *passed = passed_[axis].data();
    for_each_offset(*grid_, bounding_faces(*grid_, axis), [&](std::ptrdiff_t at) {
      const std::ptrdiff_t donor = passed[at] > 0.0 ? at - s : at;
      const double share = held[donor] > 0.0 ? held[donor] / (held[donor] + room[donor]) : 0.0;
      const double gone = share * theta[at] * passed[at];
      u[at] -= gone;
      passed[at] = gone * courant;
    });
  }
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid_->stride(axis);
    const double* passed = passed_[axis].data();
    for_each_offset(*grid_, grid_->owned(),
                    [&](std::ptrdiff_t at) { held[at] += passed[at] - passed[at + s]; });
  }
}

template <int D>
void ResidualWater<D>::join(CellField<D>& water) const {
  const double *free = free_.data(), *held = held_.data();
  double* w = water.data();
  for_each_offset(*grid_, grid_->owned(), [&](std::ptrdiff_t at) { w[at] = free[at] + held[at]; });
}

template <int D>
void ResidualWater<D>::follow_porosity(const CellRuns<D>& where,
                                       const InterfaceAdvection<D>& interface,
                                       const CellField<D>& moved, CellField<D>& water,
                                       CellField<D>& porosity) {
  const double *all = moved.data(), *held = held_.data();
  double *room = moved_.data(), *theta = porosity.data();
  for_each_offset(*grid_, grid_->owned(), [&](std::ptrdiff_t at) {
    room[at] = all[at] - held[at];
    theta[at] = all[at];
  });
  interface.follow_porosity(where, free_, room_, moved_);
  join(water);
}

template <int D>
void ResidualWater<D>::add_passed(FaceVector<D>& carried) const {
  for (int axis = 0; axis < D; ++axis) {
    const double* passed = passed_[axis].data();
    double* all = carried[axis].data();
    for_each_offset(*grid_, bounding_faces(*grid_, axis),
                    [&](std::ptrdiff_t at) { all[at] += passed[at]; });
  }
}

template class ResidualWater<2>;
template class ResidualWater<3>;

}  // namespace mudlark

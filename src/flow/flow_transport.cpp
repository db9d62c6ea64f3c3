/// How a step moves the water: fluxes, sweeps, books.
#include <algorithm>

#include "flow/flow_checks.hpp"
#include "flow/flow_solver.hpp"
#include "numerics/loops.hpp"
#include "parallel/stopwatch.hpp"

namespace mudlark {

template <int D>
void FlowSolver<D>::find_flux() {
  for (int a = 0; a < D; ++a) {
    const double* theta = capacity_[a].data();
    const double* v = velocity_[a].data();
    double* u = flux_[a].data();
    for_each_apart(
        near_.cells(), bounding_faces(*grid_, a),
        [&](std::ptrdiff_t at) { u[at] = theta[at] * v[at]; }, theta, v, u);
  }
}

/// Cells whose contents may change their volume. In the others porosity moves with what passes.
template <int D>
void FlowSolver<D>::find_loose(const CellRuns<D>& where) {
  const double *w = free_water().data(), *theta = free_room().data();
  double* loose = loose_.data();
  const bool all_keep = gas_ && !gas_->compressible();
  for_each_apart(where, grid_->owned(), [&](std::ptrdiff_t at) {
    loose[at] = all_keep || InterfaceAdvection<D>::dilates(w[at], theta[at]) ? 0.0 : 1.0;
  });
}

/// The water before the step, ghosts included.
template <int D>
void FlowSolver<D>::keep_old_water(const CellRuns<D>& where) {
  const double* w = water_.data();
  double* old = old_water_.data();
  for_each_apart(
      where, grid_->local(), [&](std::ptrdiff_t at) { old[at] = w[at]; }, w, old);
}

/// What the sweeps carried.
template <int D>
void FlowSolver<D>::keep_carried(const CellRuns<D>& where) {
  for (int a = 0; a < D; ++a) {
    const double* passed = interface_.water_flux()[a].data();
    double* carried = carried_[a].data();
    for_each_apart(
        where, bounding_faces(*grid_, a), [&](std::ptrdiff_t at) { carried[at] = passed[at]; },
        passed, carried);
  }
}

/// Water and porosity over dt with the present velocity. Cells that may change their
/// volume (void, or gas that gives way) take the medium's porosity as it is, or what their water
/// needs until a pressure can push it out: there the dilation term is zero, so nothing is lost or
/// gained.
template <int D>
void FlowSolver<D>::move_water(const PorousMedium<D>& medium, double dt,
                               const FaceVector<D>* grain_velocity) {
  const Stopwatch watch(effort_.interface);
  const Grid<D>& grid = *grid_;
  const CellRuns<D>& where = changing(medium);
  find_flux();
  keep_old_water(where);
  if (gas_) gas_->begin(water_, porosity_);
  find_loose(where);
  move_porosity(grid, where, porosity_, flux_, dt, new_porosity_);
  if (residual_) residual_->go_with_grains(grain_velocity, capacity_, dt, flux_);
  CellField<D>& moving = residual_ ? residual_->free() : water_;
  // Spray in gas keeps its planes: mixed, it would spread through the gas as mist.
  if (ground_sides_) ground_sides_->add_inflow(sides_.inflow());
  interface_.sweep(moving, free_room(), flux_, dt, step_, gas_ ? Spray::sharp : Spray::mixed,
                   &solids_.walls(), sides_.empty() && !ground_sides_ ? nullptr : &sides_.inflow());
  if (residual_) residual_->join(water_);
  const double* theta = porosity_.data();
  const double* given = medium.porosity.data();
  const double* volume = medium.space.volume.data();
  const double* now = water_.data();
  const double* loose = loose_.data();
  double* moved = new_porosity_.data();
  for_each_apart(where, grid.owned(), [&](std::ptrdiff_t at) {
    if (loose[at] > 0.0)
      moved[at] = solids_.moving() ? theta[at] : std::max(volume[at] * given[at], now[at]);
  });
  if (!sources_.empty())
    outflow_ -= sum_over_ranks(grid, sources_.refill(time_, dt, loose_, new_porosity_));
  if (residual_)
    residual_->follow_porosity(where, interface_, new_porosity_, water_, porosity_);
  else
    interface_.follow_porosity(where, water_, porosity_, new_porosity_);
  keep_carried(where);
  if (residual_) residual_->add_passed(carried_);
  if (solids_.moving()) follow_solids(medium);
  check_bounds(where);
  add_outflow();
  if (ground_sides_) ground_sides_->count(carried_, dt);
  ghosts_.update(water_, where);
  ghosts_.update(porosity_, where);
  find_capacity(medium);
  ghosts_.exchange(carried_);
}

template <int D>
void FlowSolver<D>::add_outflow() {
  const Grid<D>& grid = *grid_;
  double volume = 0.0;
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(axis, side)) continue;
      const double* through = carried_[axis].data();
      for_each_offset(grid, wall_faces(grid, axis, side),
                      [&](std::ptrdiff_t at) { volume += side == 0 ? -through[at] : through[at]; });
    }
  outflow_ += sum_over_ranks(grid, volume) * grid.cell_volume();
}

template void FlowSolver<2>::find_flux();
template void FlowSolver<2>::find_loose(const CellRuns<2>&);
template void FlowSolver<2>::keep_old_water(const CellRuns<2>&);
template void FlowSolver<2>::keep_carried(const CellRuns<2>&);
template void FlowSolver<2>::add_outflow();
template void FlowSolver<2>::move_water(const PorousMedium<2>&, double, const FaceVector<2>*);
template void FlowSolver<3>::find_flux();
template void FlowSolver<3>::find_loose(const CellRuns<3>&);
template void FlowSolver<3>::keep_old_water(const CellRuns<3>&);
template void FlowSolver<3>::keep_carried(const CellRuns<3>&);
template void FlowSolver<3>::add_outflow();
template void FlowSolver<3>::move_water(const PorousMedium<3>&, double, const FaceVector<3>*);

}  // namespace mudlark

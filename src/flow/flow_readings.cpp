/// What the flow tells of itself: books, extremes, values at places.
#include "flow/flow_checks.hpp"
#include "flow/flow_solver.hpp"
#include "numerics/loops.hpp"

namespace mudlark {

template <int D>
WaterLedger FlowSolver<D>::ledger() const {
  double volume = 0.0;
  const double* w = water_.data();
  for_each_offset(*grid_, grid_->owned(), [&](std::ptrdiff_t at) { volume += w[at]; });
  return {initial_volume_, outflow_, sum_over_ranks(*grid_, volume) * grid_->cell_volume()};
}

template <int D>
double FlowSolver<D>::kinetic_energy() const {
  return mudlark::kinetic_energy(*grid_, water_, velocity_, options_.density);
}
template <int D>
Vec<D> FlowSolver<D>::momentum() const {
  return mudlark::momentum(*grid_, water_, velocity_, options_.density);
}
template <int D>
FastestPlace<D> FlowSolver<D>::max_speed() const {
  Vec<D> position;
  const double speed = fastest_water(*grid_, water_, velocity_, position);
  return {speed, position};
}
template <int D>
double FlowSolver<D>::surface_height(const Vec<D>& position) const {
  return mudlark::surface_height(*grid_, saturation_, position);
}
template <int D>
double FlowSolver<D>::front() const {
  return water_front(*grid_, saturation_);
}
template <int D>
Vec<D> FlowSolver<D>::velocity_at(const Vec<D>& position) const {
  Vec<D> v;
  for (int a = 0; a < D; ++a) v[a] = interpolate(*grid_, velocity_[a].data(), a, position);
  return v;
}

template WaterLedger FlowSolver<2>::ledger() const;
template WaterLedger FlowSolver<3>::ledger() const;
template double FlowSolver<2>::kinetic_energy() const;
template double FlowSolver<3>::kinetic_energy() const;
template Vec<2> FlowSolver<2>::momentum() const;
template Vec<3> FlowSolver<3>::momentum() const;
template FastestPlace<2> FlowSolver<2>::max_speed() const;
template FastestPlace<3> FlowSolver<3>::max_speed() const;
template double FlowSolver<2>::surface_height(const Vec<2>&) const;
template double FlowSolver<3>::surface_height(const Vec<3>&) const;
template double FlowSolver<2>::front() const;
template double FlowSolver<3>::front() const;
template Vec<2> FlowSolver<2>::velocity_at(const Vec<2>&) const;
template Vec<3> FlowSolver<3>::velocity_at(const Vec<3>&) const;

}  // namespace mudlark

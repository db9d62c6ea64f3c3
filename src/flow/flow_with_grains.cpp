/// The step of water that shares its pressure with grains (NUMERICS C2), and pressures that are
/// given.
#include "flow/flow_solver.hpp"
#include "flow/grains_at_surface.hpp"
#include "numerics/loops.hpp"

namespace mudlark {

/// What pressures on open sides and suction of the ground do to the water's velocity; the pressure
/// solve takes them for zero.
template <int D>
void FlowSolver<D>::push_given(const PorousMedium<D>& medium) {
  sides_.push(mobility_, projection_.unknown(), velocity_);
  if (ground_sides_) ground_sides_->push(mobility_, projection_.unknown(), velocity_);
  if (!gas_) projection_.pull(mobility_, medium.suction, velocity_);
}

/// What else hangs on the grains goes with the menisci.
template <int D>
void FlowSolver<D>::push_on_grains(const PorousMedium<D>& medium, const FaceVector<D>& share,
                                   FaceVector<D>& per_share, FaceVector<D>& menisci) {
  for (int a = 0; a < D; ++a) {
    per_share[a].fill(0.0), menisci[a].fill(0.0);
    mobility_[a].fill(1.0);
  }
  find_part_under_water(*grid_, projection_.unknown(), projection_.reach(), share, mobility_);
  projection_.push(mobility_, pressure_, per_share);
  projection_.pull(mobility_, medium.suction, per_share);
  projection_.hang(medium.suction, menisci);
  ghosts_.add_to_owners(menisci);
  if (!residual_) return;
  for (int a = 0; a < D; ++a) {
    const double* weight = residual_->weight()[a].data();
    double* force = menisci[a].data();
    for_each_offset(*grid_, grid_->owned_faces(a),
                    [&](std::ptrdiff_t at) { force[at] += weight[at]; });
  }
}

/// One pressure makes the flux of water and grains together free of divergence and moves both.
template <int D>
void FlowSolver<D>::project_with_grains(const PorousMedium<D>& medium, const CellField<D>& give_way,
                                        double dt, MovingGrains<D>& grains) {
  if (!with_grains_) with_grains_.emplace(*grid_);
  GrainsInWater<D>& both = *with_grains_;
  if (grains.hold_water) {
    for (int a = 0; a < D; ++a) both.menisci()[a].fill(0.0);
    projection_.hang(medium.suction, both.menisci());
    ghosts_.add_to_owners(both.menisci());
    for (int a = 0; a < D; ++a)
      for_each_offset(*grid_, bounding_faces(*grid_, a), [&](std::ptrdiff_t at) {
        grains.force[a].data()[at] += both.menisci()[a].data()[at];
      });
  }
  if (ground_sides_) ground_sides_->note_mobility(mobility_);
  both.couple(capacity_, free_water(), free_room(), projection_.unknown(), projection_.reach(),
              residual_ ? &*residual_ : nullptr, dt, velocity_, mobility_, grains);
  hold_sides();
  if (ground_sides_)
    ground_sides_->move({dt, capacity_, grains.resistance, free_water(), free_room(),
                         projection_.unknown(), grains.filling, velocity_, mobility_,
                         both.flux_mobility(), both.water_share(), grains.velocity,
                         both.grain_mobility()});
  push_given(medium);
  sides_.push(both.grain_mobility(), projection_.unknown(), grains.velocity);
  projection_.pull(both.grain_mobility(), medium.suction, grains.velocity);
  both.find_flux(velocity_, grains);
  const CellField<D>& gives_way =
      storage_ ? storage_->with_water(give_way, water_, pressure_, dt) : give_way;
  last_solve_ = projection_.project(both.whole(), both.flux_mobility(), target_, gives_way,
                                    pressure_, both.flux(), options_.pressure_tolerance / dt);
  if (storage_) storage_->count(water_, projection_.unknown(), pressure_);
  projection_.push(mobility_, pressure_, velocity_);
  projection_.push(both.grain_mobility(), pressure_, grains.velocity);
  ghosts_.exchange(both.rims());
  ghosts_.exchange(grains.velocity);
  carry_rims(*grid_, both.rims(), grains.velocity);
  if (ground_sides_) ground_sides_->note_velocity(velocity_);
}

template void FlowSolver<2>::push_on_grains(const PorousMedium<2>&, const FaceVector<2>&,
                                            FaceVector<2>&, FaceVector<2>&);
template void FlowSolver<3>::push_on_grains(const PorousMedium<3>&, const FaceVector<3>&,
                                            FaceVector<3>&, FaceVector<3>&);
template void FlowSolver<2>::push_given(const PorousMedium<2>&);
template void FlowSolver<3>::push_given(const PorousMedium<3>&);
template void FlowSolver<2>::project_with_grains(const PorousMedium<2>&, const CellField<2>&,
                                                 double, MovingGrains<2>&);
template void FlowSolver<3>::project_with_grains(const PorousMedium<3>&, const CellField<3>&,
                                                 double, MovingGrains<3>&);

}  // namespace mudlark

/// Steps of the soil whose pore water is the flow's: its faces are solved by the coupling.
#include <algorithm>
#include <array>

#include "soil/soil_solver.hpp"
#include "soil/transfer.hpp"
#include "soil/walls.hpp"

namespace mudlark {

template <int D>
void SoilSolver<D>::move_with(const FaceVector<D>& velocity, const FaceVector<D>& change,
                              double dt) {
  sides_.update(time_, dt);
  for (int d = 0; d < D; ++d) {
    auto& motion = motion_[static_cast<std::size_t>(d)];
    for_each(solved_faces(sides_, d).intersected(active_), [&](const Index<D>& face) {
      const double v = velocity[d][face], dv = change[d][face];
      motion[face] = {v, dv, v, dv, v};
    });
  }
  mirror_motion(sides_, active_, sums_, motion_);
  if (exchanges_halos(*grid_)) halo_.exchange(as_doubles<NodeMotion, D>(motion_), node_motions);
  update_points(dt);
  for (Solid& solid : solids_) {
    if (!solid.free())
      solid.begin_step(time_, dt, solids_wait_);  // free ones wait for the water's load
    solid.move(dt);
  }
  time_ += dt;
  settle_sums();
  redistribute();
}

template <int D>
const NodeField<NodeSums, D>& SoilSolver<D>::load_faces(double dt) {
  length_ = step_ = dt;
  surface_.begin_step(time_, dt, nullptr, active_);
  sides_.update(time_, dt);
  gather_nodes(time_ - 0.5 * dt);  // that of the water, in the middle of the step
  if (solid_contact_) {
    for (Solid& solid : solids_) solid.begin_step(time_, dt, solids_wait_);
    solid_contact_->lean(dt, constants_, active_, solids_, points_, sums_);
  }
  return sums_;
}

template <int D>
void SoilSolver<D>::put_solids_in_water(double density) {
  const BoxShape domain{to_point3(grid_->lower()), to_point3(grid_->upper())};
  for (Solid& solid : solids_) solid.put_in_water(density, domain);
  watch_collisions(true);
}

template <int D>
void SoilSolver<D>::press_solids(FaceVector<D>& velocity, double dt) {
  if (!solid_contact_) return;
  solid_contact_->settle(dt, solids_, points_, velocity);
  if (collisions_) collisions_->settle(solids_, dt);
  for (Solid& solid : solids_) solid.begin_outer_step(), solid.book(dt);
}

template <int D>
void SoilSolver<D>::rub_walls(const FaceVector<D>& before, double dt, FaceVector<D>& velocity) {
  if (wall_contact_.empty()) return;
  for (int d = 0; d < D; ++d) {
    auto& motion = motion_[static_cast<std::size_t>(d)];
    for_each(active_, [&](const Index<D>& face) { motion[face] = {}; });
    for_each(grid_->owned_faces(d).intersected(active_), [&](const Index<D>& face) {
      const double v = velocity[d][face];
      motion[face] = {v, v - before[d][face], v, 0.0, v};
    });
  }
  if (exchanges_halos(*grid_)) halo_.exchange(as_doubles<NodeMotion, D>(motion_), node_motions);
  const double flip = options_.transfer == Transfer::apic ? 0.0 : options_.flip_fraction;
  wall_contact_.apply(sides_, {dt, flip, options_.mass_scaling, true}, sums_, motion_);
  for (int d = 0; d < D; ++d)
    for_each(grid_->owned_faces(d).intersected(active_), [&](const Index<D>& face) {
      velocity[d][face] = motion_[static_cast<std::size_t>(d)][face].grain_velocity;
    });
}

template <int D>
void SoilSolver<D>::spread_over_grains(double (*value)(const SoilBody&), CellField<D>& field) {
  field.fill(0.0);
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const double weight = value(options_.bodies[b]) / (1.0 - constants_[b].start_porosity);
    if (weight > 0.0)
      add_solid_fraction(*grid_, points_[b], constants_[b].grain_density, options_.kernel, weight,
                         field);
  }
  const std::array<double*, 1> one{field.data()};
  halo_.add_to_owners(one);
  fold_cells(sides_, active_, field);
  halo_.exchange(one);
}

template void SoilSolver<2>::spread_over_grains(double (*)(const SoilBody&), CellField<2>&);
template void SoilSolver<3>::spread_over_grains(double (*)(const SoilBody&), CellField<3>&);
template void SoilSolver<2>::move_with(const FaceVector<2>&, const FaceVector<2>&, double);
template void SoilSolver<3>::move_with(const FaceVector<3>&, const FaceVector<3>&, double);
template void SoilSolver<2>::put_solids_in_water(double);
template void SoilSolver<3>::put_solids_in_water(double);
template void SoilSolver<2>::press_solids(FaceVector<2>&, double);
template void SoilSolver<3>::press_solids(FaceVector<3>&, double);
template void SoilSolver<2>::rub_walls(const FaceVector<2>&, double, FaceVector<2>&);
template void SoilSolver<3>::rub_walls(const FaceVector<3>&, double, FaceVector<3>&);
template const NodeField<NodeSums, 2>& SoilSolver<2>::load_faces(double);
template const NodeField<NodeSums, 3>& SoilSolver<3>::load_faces(double);

}  // namespace mudlark

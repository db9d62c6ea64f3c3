/// Stages of a run: settings, soil that is taken out, soil that is placed.
#include <algorithm>
#include <cmath>

#include "soil/placing.hpp"
#include "soil/seeding.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {
namespace {

/// Velocities of implicit steps are displacements over a step of any length, not motion with
/// inertia.
template <int D>
void stop(SoilParticles<D>& points) {
  const auto set_zero = [](auto& quantity, int components) {
    for (int c = 0; c < components; ++c) std::fill(quantity[c].begin(), quantity[c].end(), 0.0);
  };
  set_zero(points.velocity, D), set_zero(points.water_velocity, D);
  set_zero(points.affine, D * D), set_zero(points.water_affine, D * D);
}

}  // namespace

template <int D>
void SoilSolver<D>::apply_stage(std::size_t stage) {
  if (options_.stages.empty()) return;
  const SoilStage& own = options_.stages.at(stage);
  options_.damping = own.damping.value_or(*defaults_.damping);
  options_.water_damping = own.water_damping;
  if (!own.water_damping && !own.damping) options_.water_damping = defaults_.water_damping;
  options_.mass_scaling = own.mass_scaling.value_or(*defaults_.mass_scaling);
  sides_.set_inertia(options_.mass_scaling);
  options_.method = own.method.value_or(*defaults_.method);
  options_.stop_when_static =
      own.stop_when_static ? own.stop_when_static : defaults_.stop_when_static;
  if (is_implicit()) options_.stop_when_static.reset();
  surface_.set_active(own.loads);
}

template <int D>
void SoilSolver<D>::begin_stage(std::size_t stage) {
  const Totals before = totals();
  const bool was_implicit = is_implicit();
  apply_stage(stage);
  if (was_implicit && !is_implicit()) {
    for (auto& points : points_) stop(points);
    for (Solid& solid : solids_) solid.stop();
  }
  next_step_ = 0.0;  // what the last stage's steps recommended is past
  const SoilStage& own = options_.stages.at(stage);
  if (own.remove)
    for (auto& points : points_)
      remove_where(points, [&](const Point3& place) { return own.remove->contains(place); });
  const Totals between = totals();
  place_bodies(stage);
  const Totals after = totals();
  excavated_grain_mass_ += before.grain_mass - between.grain_mass;
  placed_grain_mass_ += after.grain_mass - between.grain_mass;
  energy_.start_kinetic += after.kinetic_energy - before.kinetic_energy;
  if (own.reset_displacements)
    for (auto& points : points_) points.start = points.position;
  redistribute();
}

/// Seeds the bodies of a stage where no soil is.
template <int D>
void SoilSolver<D>::place_bodies(std::size_t stage) {
  std::vector<SoilParticles<D>> fresh(points_.size());
  bool any = false;
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const SoilBody& body = options_.bodies[b];
    if (body.stage != stage) continue;
    any = true;
    TakenSites<D> taken(*grid_,
                        static_cast<int>(std::lround(std::pow(body.points_per_cell, 1.0 / D))));
    for (const auto& points : points_) taken.add(points);
    taken.gather();
    fresh[b] = seed_points(*grid_, body, b, options_.transfer,
                           options_.split_stretched || !options_.solids.empty());
    taken.clear(fresh[b]);
    fresh[b].carries_contact = !solids_.empty();
    fresh[b].resize(fresh[b].size());
    for (const Solid& solid : solids_)
      remove_where(fresh[b], [&](const Point3& place) {
        return solid.near(place, 0.0) && solid.distance(place).distance < 0.0;
      });
  }
  if (!any) return;
  set_initial_stress(*grid_, options_, stage, fresh);
  for (std::size_t b = 0; b < points_.size(); ++b) {
    if (options_.bodies[b].stage != stage) continue;
    initialise_material_state(fresh[b], *laws_[b], options_.bodies[b].strain,
                              options_.bodies[b].porosity);
    points_[b] = std::move(fresh[b]);
  }
}

template <int D>
bool SoilSolver<D>::keeps_energy() const {
  return *defaults_.method == TimeMethod::explicit_steps && !options_.bodies.empty() &&
         options_.bodies.front().pore_water != PoreWater::unified &&
         std::none_of(options_.stages.begin(), options_.stages.end(), [](const SoilStage& stage) {
           return stage.method == TimeMethod::implicit_steps;
         });
}

template void SoilSolver<2>::apply_stage(std::size_t);
template void SoilSolver<3>::apply_stage(std::size_t);
template void SoilSolver<2>::begin_stage(std::size_t);
template void SoilSolver<3>::begin_stage(std::size_t);
template void SoilSolver<2>::place_bodies(std::size_t);
template void SoilSolver<3>::place_bodies(std::size_t);
template bool SoilSolver<2>::keeps_energy() const;
template bool SoilSolver<3>::keeps_energy() const;

}  // namespace mudlark

/// The state of rest from which a case with one water may start, and how far from rest one is.
#include <array>
#include <cmath>

#include "coupling/unified_coupling.hpp"
#include "flow/flow_checks.hpp"

namespace mudlark {
namespace {

/// Steps between looks at how far the soil is from rest.
constexpr int steps_between = 50;

}  // namespace

/// Of this rank's faces: squares of the force that still moves grains (damping included) and of
/// weight and water [(N/m3)^2], kinetic energy, and work of weight and water over a step [J/m3].
template <int D>
struct UnifiedCoupling<D>::Balance {
  double unbalanced = 0.0, external = 0.0, kinetic = 0.0, work = 0.0;
};

/// Water stands still and keeps its pressure: grains alone move, under their weight, stress and
/// that pressure, damped as the options of the soil say for now.
template <int D>
auto UnifiedCoupling<D>::step_towards_rest(const Push& push, const FlowSolver<D>& flow,
                                           const Space<D>& space, SoilSolver<D>& soil, double dt)
    -> Balance {
  soil.stop_clock();
  soil.move_with(grains_.velocity, change_, dt);
  soil.stop_clock();
  load_grains(flow, space, soil, dt);
  const double scaled = soil.options().mass_scaling;
  Balance now;
  for (int a = 0; a < D; ++a) {
    const double weight = grid_->gravity()[a] / scaled;
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      const double inertia = grains_.inertia[a][face];
      if (inertia <= 0.0) return;
      double& velocity = grains_.velocity[a][face];
      const double water = grains_.share[a][face] * push.per_share[a][face] + push.menisci[a][face];
      const double force = grains_.force[a][face] + water, given = inertia * weight + water;
      velocity += dt * force / inertia;
      now.external += given * given;
    });
    for (int side = 0; side < 2; ++side)
      if (grid_->touches(a, side) && grid_->wall(a, side) != Wall::open)
        zero_wall(*grid_, a, side, grains_.velocity[a]);
  }
  soil.press_solids(grains_.velocity, dt);
  soil.rub_walls(before_, dt, grains_.velocity);
  for (int a = 0; a < D; ++a)
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      const double velocity = grains_.velocity[a][face], inertia = grains_.inertia[a][face];
      const double change = velocity - before_[a][face], force = inertia * change / dt;
      change_[a][face] = change;
      now.unbalanced += force * force;
      now.kinetic += 0.5 * inertia * velocity * velocity;
      now.work += dt * velocity *
                  (inertia * grid_->gravity()[a] / scaled +
                   grains_.share[a][face] * push.per_share[a][face] + push.menisci[a][face]);
    });
  return now;
}

template <int D>
void UnifiedCoupling<D>::find_equilibrium(FlowSolver<D>& flow, const PorousMedium<D>& medium,
                                          SoilSolver<D>& soil) {
  const EquilibriumStart& start = *soil.options().start_in_equilibrium;
  Push push{FaceVector<D>(*grid_, "push of the water", "N/m3"),
            FaceVector<D>(*grid_, "pull of menisci", "N/m3")};
  flow.push_on_grains(medium, grains_.share, push.per_share, push.menisci);
  const auto given = soil.seek_rest();
  Statics statics;
  double elapsed = 0.0, work = 0.0;
  do {
    soil.check_search(elapsed, statics);
    const double dt = soil.stable_step();
    Balance sum;
    for (int i = 0; i < steps_between; ++i) {
      sum = step_towards_rest(push, flow, medium.space, soil, dt);
      work += sum.work;
    }
    elapsed += steps_between * dt;
    const auto over_ranks = [&](double value) { return sum_over_ranks(*grid_, value); };
    statics.unbalanced_force =
        share_of(std::sqrt(over_ranks(sum.unbalanced)), std::sqrt(over_ranks(sum.external)));
    statics.kinetic_energy = share_of(over_ranks(sum.kinetic), std::abs(over_ranks(work)));
  } while (!statics.at_rest(start.rest));
  soil.begin_at_rest(given);
}

template <int D>
void UnifiedCoupling<D>::add_work(const FlowSolver<D>& flow, const SoilSolver<D>& soil, double dt) {
  const Vec<D> grains = grain_momentum(), water = flow.momentum();
  for (int a = 0; a < D; ++a)
    work_ += dt * grid_->gravity()[a] * (grains[a] / soil.options().mass_scaling + water[a]);
}

/// What is not in balance is what moved the grains in the last step: their inertia times the change
/// of their velocity, damping apart.
template <int D>
std::optional<Statics> UnifiedCoupling<D>::statics(FlowSolver<D>& flow,
                                                   const PorousMedium<D>& medium,
                                                   const SoilSolver<D>& soil) {
  if (last_step_ <= 0.0) return {};
  if (!push_)
    push_.emplace(Push{FaceVector<D>(*grid_, "push of the water", "N/m3"),
                       FaceVector<D>(*grid_, "pull of menisci", "N/m3")});
  flow.push_on_grains(medium, grains_.share, push_->per_share, push_->menisci);
  const double damping = soil.options().damping, scaled = soil.options().mass_scaling;
  std::array<double, 3> mine{}, all{};  // unbalanced, external, kinetic
  for (int a = 0; a < D; ++a)
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      const double inertia = grains_.inertia[a][face], velocity = grains_.velocity[a][face];
      if (inertia <= 0.0) return;
      const double given = inertia * grid_->gravity()[a] / scaled +
                           grains_.share[a][face] * push_->per_share[a][face] +
                           push_->menisci[a][face];
      const double force = unbalanced_force(a, face, damping);
      mine[0] += force * force;
      mine[1] += given * given;
      mine[2] += 0.5 * inertia * velocity * velocity * grid_->cell_volume();
    });
  MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, grid_->comm());
  return Statics{share_of(std::sqrt(all[0]), std::sqrt(all[1])),
                 share_of(all[2] + flow.kinetic_energy(), std::abs(work_))};
}

template void UnifiedCoupling<2>::add_work(const FlowSolver<2>&, const SoilSolver<2>&, double);
template void UnifiedCoupling<3>::add_work(const FlowSolver<3>&, const SoilSolver<3>&, double);
template std::optional<Statics> UnifiedCoupling<2>::statics(FlowSolver<2>&, const PorousMedium<2>&,
                                                            const SoilSolver<2>&);
template std::optional<Statics> UnifiedCoupling<3>::statics(FlowSolver<3>&, const PorousMedium<3>&,
                                                            const SoilSolver<3>&);
template UnifiedCoupling<2>::Balance UnifiedCoupling<2>::step_towards_rest(const Push&,
                                                                           const FlowSolver<2>&,
                                                                           const Space<2>&,
                                                                           SoilSolver<2>&, double);
template UnifiedCoupling<3>::Balance UnifiedCoupling<3>::step_towards_rest(const Push&,
                                                                           const FlowSolver<3>&,
                                                                           const Space<3>&,
                                                                           SoilSolver<3>&, double);
template void UnifiedCoupling<2>::find_equilibrium(FlowSolver<2>&, const PorousMedium<2>&,
                                                   SoilSolver<2>&);
template void UnifiedCoupling<3>::find_equilibrium(FlowSolver<3>&, const PorousMedium<3>&,
                                                   SoilSolver<3>&);

}  // namespace mudlark

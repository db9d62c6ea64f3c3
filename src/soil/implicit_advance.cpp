/// Implicit steps of the soil solver: their length, and what happens when one fails.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "soil/implicit_step.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {
namespace {

/// Without flow the outer step of explicit soil says how often points are sorted and loads sampled.
constexpr double explicit_steps_per_outer_step = 50.0;
/// The first implicit step, in explicit ones.
constexpr double first_step = 10.0;
/// A step is repeated in halves when its error exceeds the tolerance by this factor.
constexpr double largest_excess = 5.0;
constexpr int most_cuts = 12;
/// Steps in which a body moves further are halved [cells].
constexpr double longest_leap = 0.2;
/// Strain of a step up to which the flow of water in its start's shape is good enough [-].
constexpr double largest_strain = 0.02;
/// Seepage faces are switched so many times in a step.
constexpr int most_reviews = 20;

}  // namespace

template <int D>
double SoilSolver<D>::outer_step() const {
  if (!is_implicit()) return explicit_steps_per_outer_step * stable_step();
  double step = next_step_ > 0.0 ? next_step_ : first_step * stable_step();
  if (options_.max_step) step = std::min(step, *options_.max_step);
  return step;
}

/// What sides and pore water on them do in a step of this length.
template <int D>
void SoilSolver<D>::begin_implicit_step(double dt) {
  step_ = dt;
  sides_.update(time_, dt);
  gather_nodes();
  if (exchanges_halos(*grid_)) halo_.exchange(as_doubles<NodeSums, D>(sums_), node_sums);
  side_water_.begin_implicit_step(sides_, halo_, options_.kernel, points_);
  for (Solid& solid : solids_) solid.begin_static_step(time_, dt, solids_wait_);
}

/// With the loads of the time `loads_of` [s].
template <int D>
ImplicitProblem<D> SoilSolver<D>::implicit_problem(const ImplicitSides<D>& sides, double loads_of,
                                                   double dt) {
  return {*grid_, options_, constants_, laws_,   points_, sides, surface_.at(loads_of),
          time_,  dt,       nullptr,    nullptr, &solids_};
}

/// Solves a step, again as often as it takes seepage faces to be on the right side.
template <int D>
ImplicitOutcome SoilSolver<D>::solve_implicitly(ImplicitProblem<D> problem) {
  const double dt = problem.dt;
  int reviews = 0;
  problem.accepts = [&](const ImplicitFields<D>& state) {
    if (reviews++ < most_reviews && !side_water_.review(sides_, halo_, state.water, state.pressure))
      return false;
    side_water_.end_implicit_step(sides_, state.pressure);
    side_water_.account(
        sides_, dt, [&](int axis, const Index<D>& face) { return state.water[axis][face] / dt; },
        [&](int axis, const Index<D>& face) {
          return sums_[static_cast<std::size_t>(axis)][face].volume;
        });
    return true;
  };
  ImplicitOutcome outcome;
  do {
    outcome = solve_implicit_step(problem);
    implicit_effort_.newton_iterations += outcome.iterations;
    implicit_effort_.linear_iterations += outcome.linear_iterations;
  } while (outcome.converged && !outcome.accepted);
  return outcome;
}

template <int D>
void SoilSolver<D>::advance_in_halves(double dt, int cuts) {
  advance_implicitly(0.5 * dt, cuts + 1);
  advance_implicitly(0.5 * dt, cuts + 1);
}

/// Does a body move further in a step than its contacts are watched?
template <int D>
bool SoilSolver<D>::solids_leap(double dt) const {
  const BoxShape domain{to_point3(grid_->lower()), to_point3(grid_->upper())};
  return std::any_of(solids_.begin(), solids_.end(), [&](const Solid& solid) {
    return dt * solid.largest_speed(domain) > longest_leap * grid_->smallest_spacing();
  });
}

/// Solves a step; in two halves when it does not converge or is not accurate enough.
template <int D>
void SoilSolver<D>::advance_implicitly(double dt, int cuts) {
  for (Solid& solid : solids_) solid.begin_static_step(time_, dt, solids_wait_);
  if (cuts < most_cuts && solids_leap(dt)) return advance_in_halves(dt, cuts);  // as given
  redistribute();
  surface_.resample(active_);
  std::vector<SoilParticles<D>> before = points_;
  const auto side_water = side_water_.state();
  begin_implicit_step(dt);
  const ImplicitSides<D> sides(sides_, side_water_, sums_, dt);
  const ImplicitOutcome outcome = solve_implicitly(implicit_problem(sides, time_ + dt, dt));
  // At rest contacts leave ways of their own, which no shorter step makes smaller.
  const double tolerance = std::max(
      options_.step_tolerance * std::max(outcome.largest_way, 1e-9 * grid_->smallest_spacing()),
      outcome.left_by_contacts);
  // Backward Euler: half the change of velocity times the step.
  const double error = 0.5 * dt * outcome.largest_change;
  const bool moving = next_step_ > 0.0;  // the first step has nothing to compare with
  const bool coarse = (moving && error > largest_excess * tolerance) || solids_leap(dt);
  if (!outcome.converged || (coarse && cuts < most_cuts)) {
    if (cuts == most_cuts)
      throw DivergenceError(fmt::format("soil: implicit step of {:.3g} s at t = {:.6g} s: {}", dt,
                                        time_, outcome.problem));
    ++implicit_effort_.repeated;
    points_ = std::move(before);
    side_water_.restore(side_water, sides_, halo_);
    return advance_in_halves(dt, cuts);
  }
  ++implicit_effort_.steps;
  for (Solid& solid : solids_) solid.book(dt), solid.move(dt);
  time_ += dt;
  double factor = std::clamp(0.9 * std::sqrt(tolerance / std::max(error, 1e-300)), 0.3, 2.0);
  factor = std::min(factor, largest_strain / std::max(outcome.largest_strain, 1e-300));
  // A step cut short by an output says nothing against the longer one before it.
  next_step_ = factor >= 1.0 ? std::max(next_step_, factor * dt) : factor * dt;
}

template void SoilSolver<2>::begin_implicit_step(double);
template void SoilSolver<3>::begin_implicit_step(double);
template ImplicitProblem<2> SoilSolver<2>::implicit_problem(const ImplicitSides<2>&, double,
                                                            double);
template ImplicitProblem<3> SoilSolver<3>::implicit_problem(const ImplicitSides<3>&, double,
                                                            double);
template ImplicitOutcome SoilSolver<2>::solve_implicitly(ImplicitProblem<2>);
template ImplicitOutcome SoilSolver<3>::solve_implicitly(ImplicitProblem<3>);
template double SoilSolver<2>::outer_step() const;
template double SoilSolver<3>::outer_step() const;
template bool SoilSolver<2>::solids_leap(double) const;
template bool SoilSolver<3>::solids_leap(double) const;
template void SoilSolver<2>::advance_in_halves(double, int);
template void SoilSolver<3>::advance_in_halves(double, int);
template void SoilSolver<2>::advance_implicitly(double, int);
template void SoilSolver<3>::advance_implicitly(double, int);

}  // namespace mudlark

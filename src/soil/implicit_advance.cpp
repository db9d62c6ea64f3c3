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
/// Strain of a step up to which the flow of water in its start's shape is good enough [-].
constexpr double largest_strain = 0.02;

}  // namespace

template <int D>
double SoilSolver<D>::outer_step() const {
  if (!is_implicit()) return explicit_steps_per_outer_step * stable_step();
  double step = next_step_ > 0.0 ? next_step_ : first_step * stable_step();
  if (options_.max_step) step = std::min(step, *options_.max_step);
  return step;
}

/// Solves a step; in two halves when it does not converge or is not accurate enough.
template <int D>
void SoilSolver<D>::advance_implicitly(double dt, int cuts) {
  redistribute();
  surface_.resample(active_);
  std::vector<SoilParticles<D>> before = points_;
  const ImplicitProblem<D> problem{
      *grid_, options_, constants_, laws_, points_, surface_.at(time_ + dt), time_, dt};
  const ImplicitOutcome outcome = solve_implicit_step(problem);
  const double tolerance =
      options_.step_tolerance * std::max(outcome.largest_way, 1e-9 * grid_->smallest_spacing());
  // Backward Euler: half the change of velocity times the step.
  const double error = 0.5 * dt * outcome.largest_change;
  const bool moving = next_step_ > 0.0;  // the first step has nothing to compare with
  if (!outcome.converged || (moving && error > largest_excess * tolerance && cuts < most_cuts)) {
    if (cuts == most_cuts)
      throw DivergenceError(fmt::format("soil: implicit step of {:.3g} s at t = {:.6g} s: {}", dt,
                                        time_, outcome.problem));
    points_ = std::move(before);
    advance_implicitly(0.5 * dt, cuts + 1);
    advance_implicitly(0.5 * dt, cuts + 1);
    return;
  }
  time_ += dt;
  double factor = std::clamp(0.9 * std::sqrt(tolerance / std::max(error, 1e-300)), 0.3, 2.0);
  factor = std::min(factor, largest_strain / std::max(outcome.largest_strain, 1e-300));
  // A step cut short by an output says nothing against the longer one before it.
  next_step_ = factor >= 1.0 ? std::max(next_step_, factor * dt) : factor * dt;
}

template double SoilSolver<2>::outer_step() const;
template double SoilSolver<3>::outer_step() const;
template void SoilSolver<2>::advance_implicitly(double, int);
template void SoilSolver<3>::advance_implicitly(double, int);

}  // namespace mudlark

/// The state of rest from which a case with implicit steps may start.
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "soil/implicit_step.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {
namespace {

/// What is out of balance at first comes on in shares: as much of it at once, and at least.
constexpr double first_share = 0.25, smallest_share = 1e-3;
/// Shares that stretch or turn a point by more than this are halved [-].
constexpr double largest_strain = 0.1;
/// The search lasts as many times the time in which pore water drains over the domain's size.
constexpr double drainage_times = 100.0;

}  // namespace

/// Time after which no excess pore pressure is left in the largest body of water [s].
template <int D>
double SoilSolver<D>::drainage_time() const {
  double longest = 1.0, size2 = 0.0;
  for (int a = 0; a < D; ++a) {
    const double size = grid_->spacing()[a] * grid_->cells()[a];
    size2 = std::max(size2, size * size);
  }
  for (std::size_t b = 0; b < points_.size(); ++b) {
    if (!(constants_[b].water_density > 0.0)) continue;
    const double diffusivity = constants_[b].intrinsic_permeability /
                               constants_[b].water_viscosity * laws_[b]->wave_modulus({}, {});
    longest = std::max(longest, drainage_times * size2 / diffusivity);
  }
  return longest;
}

/// Quasi-static steps at time zero. The forces that the first guess leaves out of balance are held
/// back and let go in shares, so that laws that yield follow a path of growing load. Pore water
/// drains meanwhile, as long as the case says or until nothing is left to drain.
template <int D>
void SoilSolver<D>::find_equilibrium_implicitly() {
  const EquilibriumStart& start = *options_.start_in_equilibrium;
  const double length = start.longest > 0.0 ? start.longest : drainage_time();
  FaceVector<D> first(*grid_, "force out of balance", "N"), held_back(*grid_, "force", "N");
  begin_step(0.0, 1.0, nullptr);  // loads are those of its begin
  double balanced = 0.0, share = first_share;
  while (balanced < 1.0) {
    share = std::min(share, 1.0 - balanced);
    redistribute();
    surface_.resample(active_);
    std::vector<SoilParticles<D>> before = points_;
    const auto side_water = side_water_.state();
    begin_implicit_step(share * length);
    const ImplicitSides<D> sides(sides_, side_water_, sums_, share * length);
    ImplicitProblem<D> problem = implicit_problem(sides, 0.0, share * length);
    problem.held_back = &held_back;
    if (balanced == 0.0) {
      held_back.fill(0.0);
      unbalanced_forces(problem, first);
    }
    for (int d = 0; d < D; ++d)
      for (std::size_t i = 0; i < grid_->local_size(); ++i)
        held_back[d].data()[i] = (1.0 - balanced - share) * first[d].data()[i];
    const ImplicitOutcome outcome = solve_implicitly(problem);
    if (outcome.converged && outcome.largest_strain < largest_strain) {
      for (Solid& solid : solids_) solid.move(share * length);
      balanced += share;
      share *= 2.0;
      continue;
    }
    ++implicit_effort_.repeated;
    points_ = std::move(before);
    side_water_.restore(side_water, sides_, halo_);
    share *= 0.5;
    if (share < smallest_share)
      throw InputError(fmt::format(
          "soil_solver.start_in_equilibrium: there is no equilibrium beyond {:.3g} % of what the "
          "start leaves out of balance ({}). Either the soil does not stand, or it needs a first "
          "guess of its stress (initial_stress).",
          100.0 * balanced,
          outcome.converged ? fmt::format("it strains by {:.2g}", outcome.largest_strain)
                            : outcome.problem));
  }
  time_ = 0.0;
}

template double SoilSolver<2>::drainage_time() const;
template double SoilSolver<3>::drainage_time() const;
template void SoilSolver<2>::find_equilibrium_implicitly();
template void SoilSolver<3>::find_equilibrium_implicitly();

}  // namespace mudlark

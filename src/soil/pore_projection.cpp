#include "soil/pore_projection.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"
#include "parallel/collective_error.hpp"
#include "soil/face_balance.hpp"
#include "soil/mirror.hpp"
#include "soil/pore_cells.hpp"
#include "soil/walls.hpp"

namespace mudlark {
namespace {

/// Cells with less soil than this share have no pore pressure of their own: they touch the
/// outermost points only.
constexpr double least_filling = 1e-4;
/// Residual that the solver leaves, as a share of the largest right side. What it leaves is lost
/// volume, step by step.
constexpr double tolerance = 1e-10;
/// Multigrid is built anew when it takes so many iterations more than at first.
constexpr int more_iterations = 4;
/// A residual above this share is no solution.
constexpr double largest_residual = 1e-6;

}  // namespace

template <int D>
PoreProjection<D>::PoreProjection(const SoilSides<D>& sides, const SoilOptions& options)
    : sides_(&sides),
      grid_(&sides.grid()),
      options_(&options),
      halo_(*grid_),
      ghosts_(*grid_),
      centred_(options.formulation == Formulation::u_p),
      alone_(!exchanges_halos(*grid_)),
      filling_(*grid_, "filling", "1"),
      pores_(*grid_, "pores", "1"),
      pull_(*grid_, "pull of pore pressure", "Pa"),
      rise_(*grid_, "rise of pore pressure", "Pa"),
      last_rate_(*grid_, "rate of pore pressure", "Pa/s"),
      flux_(*grid_, "flux", "m/s"),
      system_(*grid_),
      solver_(*grid_) {}

template <int D>
void PoreProjection<D>::cover(const IndexBox<D>& active) {
  // What lies outside the new box is neither written nor read as anything but zero.
  pull_.fill(0.0);
  rise_.fill(0.0);
  system_.diagonal.fill(0.0);
  active_ = active;
  box_ = active.intersected(grid_->owned());
  hierarchy_ = Hierarchy::fresh;  // so that a resumed run takes the same steps
  if (centred_) ghosts_.update(last_rate_);
}

template <int D>
void PoreProjection<D>::measure(const std::vector<SoilParticles<D>>& bodies,
                                const std::vector<BodyConstants>& constants) {
  for_each(active_, [&](const Index<D>& cell) { filling_[cell] = pores_[cell] = 0.0; });
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (constants[b].water_density > 0.0)
      add_filling(*grid_, bodies[b], constants[b], options_->kernel, filling_, pores_);
  const std::array<double*, 2> both{filling_.data(), pores_.data()};
  if (!alone_) halo_.add_to_owners(both);
  fold_cells(*sides_, active_, filling_);
  fold_cells(*sides_, active_, pores_);
  if (!alone_) halo_.exchange(both);
}

/// Is the face one of the domain's sides?
template <int D>
bool PoreProjection<D>::at_side(int axis, const Index<D>& face) const {
  return !grid_->periodic(axis) && (face[axis] == 0 || face[axis] == grid_->cells()[axis]);
}

/// Is it one that grains do not go through?
template <int D>
bool PoreProjection<D>::held(int axis, const Index<D>& face) const {
  return at_side(axis, face) && sides_->node(axis, face[axis] == 0 ? 0 : 1, axis, face).mirrored;
}

template <int D>
bool PoreProjection<D>::has_unknown(const Index<D>& cell) const {
  for (int a = 0; a < D; ++a)
    if (!grid_->periodic(a) && (cell[a] < 0 || cell[a] >= grid_->cells()[a])) return false;
  return filling_[cell] > least_filling;
}

/// Slope of a field of the cells with soil at a face [Pa/m]; zero where there is no soil.
template <int D>
double PoreProjection<D>::slope(const CellField<D>& field, int axis, const Index<D>& face) const {
  const Index<D> below = face.shifted(axis, -1);
  const double high = has_unknown(face) ? field[face] : 0.0;
  const double low = has_unknown(below) ? field[below] : 0.0;
  return (high - low) / grid_->spacing()[axis];
}

template <int D>
void PoreProjection<D>::add_last_rise(double dt, NodeField<NodeSums, D>& sums) const {
  if (!centred_) return;
  for (int d = 0; d < D; ++d)
    for_each(faces(d), [&](const Index<D>& face) {
      if (held(d, face)) return;
      sums[static_cast<std::size_t>(d)][face].mixture_force +=
          centred_rise * dt * grid_->cell_volume() * slope(last_rate_, d, face);
    });
}

/// Flux of the predicted motion and what pressure does to it, on the faces around owned cells.
template <int D>
void PoreProjection<D>::set_up_faces(double dt, bool sealed, const NodeField<NodeSums, D>& sums,
                                     const NodeField<NodeMotion, D>& motion) {
  const double volume = grid_->cell_volume();
  for (int d = 0; d < D; ++d) {
    const auto u = static_cast<std::size_t>(d);
    const double per_area = dt * volume / (grid_->spacing()[d] * grid_->spacing()[d]);
    for_each(faces(d), [&](const Index<D>& face) {
      const NodeSums& node = sums[u][face];
      flux_[d][face] = system_.coupling[d][face] = 0.0;
      if (held(d, face) || !carries_motion(node, volume)) return;
      const FaceBalance balance(node, *options_, dt, tied(sealed, node, volume));
      flux_[d][face] = motion[u][face].total_flux;
      system_.coupling[d][face] = per_area * balance.flux(balance.answer());
    });
  }
  if (alone_) return;
  halo_.exchange(flux_);
  halo_.exchange(system_.coupling);
}

template <int D>
void PoreProjection<D>::set_up_cells(double dt) {
  for_each(box_, [&](const Index<D>& cell) {
    double diagonal = 0.0, divergence = 0.0;
    if (has_unknown(cell)) {
      for (int a = 0; a < D; ++a) {
        const Index<D> above = cell.shifted(a, 1);
        diagonal += system_.coupling[a][cell] + system_.coupling[a][above];
        divergence += (flux_[a][above] - flux_[a][cell]) / grid_->spacing()[a];
      }
      const double porosity = pores_[cell] / filling_[cell];
      diagonal += porosity / (options_->water_bulk_modulus * filling_[cell] * dt);
    }
    system_.diagonal[cell] = diagonal;
    system_.right_side[cell] = -divergence;
    pull_[cell] = 0.0;
  });
}

/// Leaves out what leads to cells without soil, where the pull is zero. Returns whether any does.
template <int D>
bool PoreProjection<D>::cut_couplings() {
  bool drained = false;
  for (int d = 0; d < D; ++d)
    for_each(box_.extended(d, 1), [&](const Index<D>& face) {
      const bool above = has_unknown(face), below = has_unknown(face.shifted(d, -1));
      double& coupling = system_.coupling[d][face];
      if (above && below) return;
      drained = drained || ((above || below) && coupling > 0.0);
      coupling = 0.0;
    });
  return drained;
}

template <int D>
void PoreProjection<D>::solve(double dt, double time) {
  set_up_cells(dt);
  const bool drained = max_over_ranks(*grid_, cut_couplings() ? 1.0 : 0.0) > 0.0;
  const double* diagonal = system_.diagonal.data();
  const auto unknown = [&](std::ptrdiff_t at) { return diagonal[at] > 0.0; };
  find_spans(*grid_, box_, unknown, system_.unknowns);
  system_.constant_free = !drained && std::isinf(options_->water_bulk_modulus);
  const double largest = solver_.largest_right_side(system_);
  if (!std::isfinite(largest)) report_failure(time);
  if (largest > 0.0) {
    const SolveReport report = solver_.solve(system_, pull_, tolerance * largest, hierarchy_);
    if (hierarchy_ == Hierarchy::fresh) usual_iterations_ = report.iterations;
    hierarchy_ = report.iterations > usual_iterations_ + more_iterations ? Hierarchy::fresh
                                                                         : Hierarchy::kept;
    if (!report.converged && !(report.residual <= largest_residual * largest)) report_failure(time);
  } else {
    ghosts_.update(pull_);
  }
}

template <int D>
void PoreProjection<D>::keep_rise(double dt) {
  for_each(box_, [&](const Index<D>& cell) {
    rise_[cell] = has_unknown(cell) ? pull_[cell] / filling_[cell] : 0.0;
    if (centred_) last_rate_[cell] = pull_[cell] / dt;
  });
  ghosts_.update(rise_);
  if (centred_) ghosts_.update(last_rate_);
}

template <int D>
void PoreProjection<D>::project(double dt, double time, bool sealed, NodeField<NodeSums, D>& sums,
                                NodeField<NodeMotion, D>& motion, SoilEnergy& energy) {
  set_up_faces(dt, sealed, sums, motion);
  solve(dt, time);
  const double volume = grid_->cell_volume(), share = centred_ ? centred_rise : 1.0;
  for (int d = 0; d < D; ++d)
    for_each(faces(d), [&](const Index<D>& face) {
      NodeSums& node = sums[static_cast<std::size_t>(d)][face];
      NodeMotion& moved = motion[static_cast<std::size_t>(d)][face];
      if (held(d, face) || !carries_motion(node, volume)) return;
      const FaceBalance balance(node, *options_, dt, tied(sealed, node, volume));
      const PhaseVelocity answer = balance.answer();
      const double force = -volume * slope(pull_, d, face);
      moved.grain_velocity += dt * force * answer.grains;
      moved.grain_change += dt * force * answer.grains;
      moved.water_velocity += dt * force * answer.water;
      moved.water_change += dt * force * answer.water;
      moved.total_flux += dt * force * balance.flux(answer);
      double on_mixture = share * force;
      node.mixture_force += on_mixture;
      node.water_force += force;
      if (centred_) on_mixture += share * dt * volume * slope(last_rate_, d, face);
      energy.external -= dt * (on_mixture * moved.grain_velocity +
                               force * (moved.total_flux - moved.grain_velocity));
    });
  keep_rise(dt);
}

/// Names the worst cell of all ranks and throws.
template <int D>
void PoreProjection<D>::report_failure(double time) const {
  double worst = -1.0;
  Index<D> place{};
  for_each(box_, [&](const Index<D>& cell) {
    const double size = std::abs(system_.right_side[cell]);
    if (std::isfinite(worst) && (size > worst || !std::isfinite(size))) worst = size, place = cell;
  });
  const double largest = max_over_ranks(*grid_, std::isfinite(worst) ? worst : HUGE_VAL);
  std::string problem;
  if (!(worst < largest) && worst >= 0.0) {
    const Point3 x = to_point3(grid_->cell_centre(place));
    problem = fmt::format(
        "soil: no pore pressure can be found at ({:.6g}, {:.6g}, {:.6g}) m, t = {:.6g} s (the "
        "volume changes there by {:.4g} 1/s)",
        x[0], x[1], x[2], time, worst);
  }
  throw_divergence_if_any(grid_->comm(), problem);
  throw DivergenceError(fmt::format("soil: no pore pressure can be found at t = {:.6g} s", time));
}

template class PoreProjection<2>;
template class PoreProjection<3>;

}  // namespace mudlark

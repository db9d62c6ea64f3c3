#include "numerics/pressure_solver.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {
constexpr int multigrid_limit = 80;  // iterations; 6-15 are usual
constexpr int plain_limit = 20000;
/// A start that is this much better than asked for is left alone; any other gets one cycle at
/// least, so that water at rest does not drift within the tolerance, step by step in the same
/// direction.
constexpr double good_start = 1e-6;
}  // namespace

template <int D>
void apply(const Grid<D>& grid, const IndexBox<D>& box, const PressureSystem<D>& system,
           const CellField<D>& p, CellField<D>& out) {
  const double* x = p.data();
  const double* diagonal = system.diagonal.data();
  double* y = out.data();
  const double* c0 = system.coupling[0].data();
  const double* c1 = system.coupling[1].data();
  const double* c2 = system.coupling[D - 1].data();
  const std::ptrdiff_t s1 = grid.stride(1), s2 = grid.stride(D - 1);
  for_each_offset(grid, box, [&](std::ptrdiff_t at) {
    double sum = diagonal[at] * x[at] - c0[at] * x[at - 1] - c0[at + 1] * x[at + 1] -
                 c1[at] * x[at - s1] - c1[at + s1] * x[at + s1];
    if constexpr (D == 3) sum -= c2[at] * x[at - s2] + c2[at + s2] * x[at + s2];
    y[at] = sum;
  });
}

template <int D>
PressureSolver<D>::PressureSolver(const Grid<D>& grid)
    : grid_(&grid),
      box_(grid.owned()),
      ghosts_(grid),
      multigrid_(grid),
      residual_(grid, "residual", "1/s"),
      scaled_(grid, "scaled residual", "Pa"),
      direction_(grid, "search direction", "Pa"),
      image_(grid, "image", "1/s") {}

template <int D>
void PressureSolver<D>::cover(const IndexBox<D>& box) {
  const bool moved = !(box == box_);
  if (max_over_ranks(*grid_, moved ? 1.0 : 0.0) == 0.0) return;
  box_ = box;
  direction_.fill(0.0);  // its ghosts are read beyond the box
  multigrid_.cover(box);
  built_ = false;
}

template <int D>
double PressureSolver<D>::dot_product(const CellField<D>& left, const CellField<D>& right) const {
  double sum = 0.0;
  const double* a = left.data();
  const double* b = right.data();
  for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) { sum += a[at] * b[at]; });
  return sum_over_ranks(*grid_, sum);
}

template <int D>
double PressureSolver<D>::largest(const CellField<D>& field) const {
  double size = 0.0;
  bool finite = true;
  const double* a = field.data();
  for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) {
    size = std::max(size, std::abs(a[at]));
    finite = finite && std::isfinite(a[at]);
  });
  return max_over_ranks(*grid_, finite ? size : HUGE_VAL);
}

/// Takes the mean over all cells with an unknown out of a field.
template <int D>
void PressureSolver<D>::remove_mean(const PressureSystem<D>& system, CellField<D>& field) const {
  double sum = 0.0, count = 0.0;
  double* value = field.data();
  const double* diagonal = system.diagonal.data();
  for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) {
    if (diagonal[at] > 0.0) sum += value[at], count += 1.0;
  });
  const double mean = sum_over_ranks(*grid_, sum) / std::max(sum_over_ranks(*grid_, count), 1.0);
  for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) {
    if (diagonal[at] > 0.0) value[at] -= mean;
  });
}

template <int D>
void PressureSolver<D>::find_residual(const PressureSystem<D>& system, CellField<D>& p) {
  ghosts_.update(p);
  apply(*grid_, box_, system, p, image_);
  const double* b = system.right_side.data();
  const double* image = image_.data();
  const double* diagonal = system.diagonal.data();
  double* r = residual_.data();
  for_each_offset(*grid_, box_,
                  [&](std::ptrdiff_t at) { r[at] = diagonal[at] > 0.0 ? b[at] - image[at] : 0.0; });
  if (system.constant_free) remove_mean(system, residual_);
}

template <int D>
void PressureSolver<D>::precondition(const PressureSystem<D>& system, bool multigrid) {
  if (multigrid) {
    multigrid_.apply(residual_, scaled_);
  } else {
    const double* r = residual_.data();
    const double* diagonal = system.diagonal.data();
    double* z = scaled_.data();
    for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) {
      z[at] = diagonal[at] > 0.0 ? r[at] / diagonal[at] : 0.0;
    });
  }
  if (system.constant_free) remove_mean(system, scaled_);
}

/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) with the flexible (Polak-Ribiere)
/// step, which forgives a preconditioner that is only nearly symmetric. Returns whether the
/// tolerance was reached.
template <int D>
bool PressureSolver<D>::iterate(const PressureSystem<D>& system, CellField<D>& p, double tolerance,
                                int limit, bool multigrid, SolveReport& report) {
  double energy = 0.0;
  for (int iteration = 0; iteration < limit; ++iteration) {
    precondition(system, multigrid);
    const double fresh = dot_product(residual_, scaled_);
    if (!(fresh > 0.0) || !std::isfinite(fresh)) break;  // lost positive definiteness to round-off
    // image_ still holds A direction and step*image_ is what the residual lost, hence r.z_old + ...
    const double weight = iteration == 0 ? 0.0 : -dot_product(image_, scaled_) / energy;
    double* d = direction_.data();
    const double* z = scaled_.data();
    for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) {
      d[at] = weight == 0.0 ? z[at] : z[at] + weight * d[at];
    });
    ghosts_.exchange(direction_);
    apply(*grid_, box_, system, direction_, image_);
    energy = dot_product(direction_, image_);
    if (!(energy > 0.0)) break;
    const double step = dot_product(direction_, residual_) / energy;
    double* x = p.data();
    double* r = residual_.data();
    const double* image = image_.data();
    for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) {
      x[at] += step * d[at];
      r[at] -= step * image[at];
    });
    report.iterations += 1;
    report.residual = largest(residual_);
    if (report.residual <= tolerance) return true;
  }
  return false;
}

template <int D>
SolveReport PressureSolver<D>::solve(PressureSystem<D>& system, CellField<D>& p, double tolerance,
                                     Hierarchy hierarchy) {
  SolveReport report;
  if (system.constant_free) remove_mean(system, system.right_side);
  bool current = false;
  // The recursive residual drifts from the true one by round-off: restart from the true one until
  // both agree.
  for (int restart = 0; restart < 4 && !report.converged; ++restart) {
    find_residual(system, p);
    report.residual = largest(residual_);
    report.converged = report.residual <= (restart > 0 ? tolerance : good_start * tolerance);
    if (report.converged || !std::isfinite(report.residual)) break;
    if (!current && (restart > 0 || !built_ || hierarchy == Hierarchy::fresh)) {
      multigrid_.build(system);
      current = built_ = true;
    }
    report.plain = restart == 3;
    if (report.plain)
      iterate(system, p, tolerance, plain_limit, false, report);
    else
      iterate(system, p, tolerance, multigrid_limit, true, report);
  }
  if (!report.converged) {
    find_residual(system, p);
    report.residual = largest(residual_);
    report.converged = report.residual <= tolerance;
  }
  ghosts_.update(p);
  return report;
}

template void apply(const Grid<2>&, const IndexBox<2>&, const PressureSystem<2>&,
                    const CellField<2>&, CellField<2>&);
template void apply(const Grid<3>&, const IndexBox<3>&, const PressureSystem<3>&,
                    const CellField<3>&, CellField<3>&);
template class PressureSolver<2>;
template class PressureSolver<3>;

}  // namespace mudlark

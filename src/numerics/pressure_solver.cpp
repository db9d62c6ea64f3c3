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

/// out = A p on the cells of the spans; `p` needs valid ghosts.
template <int D>
void apply(const Grid<D>& grid, const Spans& cells, const PressureSystem<D>& system,
           const CellField<D>& p, CellField<D>& out) {
  const double* x = p.data();
  const double* diagonal = system.diagonal.data();
  double* y = out.data();
  const double* c0 = system.coupling[0].data();
  const double* c1 = system.coupling[1].data();
  const double* c2 = system.coupling[D - 1].data();
  const std::ptrdiff_t s1 = grid.stride(1), s2 = grid.stride(D - 1);
  for_each_offset(cells, [&](std::ptrdiff_t at) {
    double sum = diagonal[at] * x[at] - c0[at] * x[at - 1] - c0[at + 1] * x[at + 1] -
                 c1[at] * x[at - s1] - c1[at + s1] * x[at + s1];
    if constexpr (D == 3) sum -= c2[at] * x[at - s2] + c2[at + s2] * x[at + s2];
    y[at] = sum;
  });
}

}  // namespace

template <int D>
PressureSolver<D>::PressureSolver(const Grid<D>& grid)
    : grid_(&grid),
      ghosts_(grid),
      multigrid_(grid),
      residual_(grid, "residual", "1/s"),
      scaled_(grid, "scaled residual", "Pa"),
      direction_(grid, "search direction", "Pa"),
      image_(grid, "image", "1/s") {}

/// Values of cells that had an unknown before and have none now are taken out of the work arrays.
template <int D>
void PressureSolver<D>::take_unknowns(const PressureSystem<D>& system) {
  if (unknowns_ == system.unknowns) return;
  for (CellField<D>* field : {&residual_, &scaled_, &direction_, &image_})
    for_each_offset(unknowns_, [values = field->data()](std::ptrdiff_t at) { values[at] = 0.0; });
  unknowns_ = system.unknowns;
}

template <int D>
std::array<double, 2> PressureSolver<D>::dot_products(const CellField<D>& one,
                                                      const CellField<D>& first,
                                                      const CellField<D>& second) const {
  constexpr int lanes = 4;  // sums side by side: no addition waits for the one before
  std::array<double, lanes> sums[2] = {};
  const double *a = one.data(), *b = first.data(), *c = second.data();
  for (const Span& span : unknowns_) {
    std::ptrdiff_t at = span.first;
    for (; at + lanes <= span.last; at += lanes)
      for (std::size_t k = 0; k < lanes; ++k) {
        const auto place = at + static_cast<std::ptrdiff_t>(k);
        sums[0][k] += a[place] * b[place];
        sums[1][k] += a[place] * c[place];
      }
    for (; at < span.last; ++at) sums[0][0] += a[at] * b[at], sums[1][0] += a[at] * c[at];
  }
  std::array<double, 2> total{};
  for (std::size_t n = 0; n < 2; ++n)
    for (const double sum : sums[n]) total[n] += sum;
  MPI_Allreduce(MPI_IN_PLACE, total.data(), 2, MPI_DOUBLE, MPI_SUM, grid_->comm());
  return total;
}

template <int D>
double PressureSolver<D>::largest(const CellField<D>& field) const {
  double size = 0.0;
  bool finite = true;
  const double* a = field.data();
  for_each_offset(unknowns_, [&](std::ptrdiff_t at) {
    size = std::max(size, std::abs(a[at]));
    finite = finite && std::isfinite(a[at]);
  });
  return max_over_ranks(*grid_, finite ? size : HUGE_VAL);
}

template <int D>
double PressureSolver<D>::largest_right_side(PressureSystem<D>& system) {
  take_unknowns(system);
  if (system.constant_free) remove_mean(system.right_side);
  return largest(system.right_side);
}

/// Takes the mean over all cells with an unknown out of a field.
template <int D>
void PressureSolver<D>::remove_mean(CellField<D>& field) const {
  std::array<double, 2> sum{};  // and count
  double* value = field.data();
  for_each_offset(unknowns_, [&](std::ptrdiff_t at) { sum[0] += value[at], sum[1] += 1.0; });
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 2, MPI_DOUBLE, MPI_SUM, grid_->comm());
  const double mean = sum[0] / std::max(sum[1], 1.0);
  for_each_offset(unknowns_, [&](std::ptrdiff_t at) { value[at] -= mean; });
}

template <int D>
void PressureSolver<D>::find_residual(const PressureSystem<D>& system, CellField<D>& p) {
  ghosts_.update(p);
  apply(*grid_, unknowns_, system, p, image_);
  const double* b = system.right_side.data();
  const double* image = image_.data();
  double* r = residual_.data();
  for_each_offset(unknowns_, [&](std::ptrdiff_t at) { r[at] = b[at] - image[at]; });
  if (system.constant_free) remove_mean(residual_);
}

template <int D>
void PressureSolver<D>::precondition(const PressureSystem<D>& system, bool multigrid) {
  const double* r = residual_.data();
  const double* diagonal = system.diagonal.data();
  double* z = scaled_.data();
  // A kept hierarchy may leave out some of the cells: they get the diagonal.
  for_each_offset(unknowns_, [&](std::ptrdiff_t at) { z[at] = r[at] / diagonal[at]; });
  if (multigrid) multigrid_.apply(residual_, scaled_);
  if (system.constant_free) remove_mean(scaled_);
}

/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) with the flexible (Polak-Ribiere)
/// step, which forgives a preconditioner that is only nearly symmetric. Returns whether the
/// tolerance was reached.
template <int D>
bool PressureSolver<D>::iterate(const PressureSystem<D>& system, CellField<D>& p, double tolerance,
                                int limit, bool multigrid, SolveReport& report) {
  double energy = 0.0;
  double *x = p.data(), *r = residual_.data(), *d = direction_.data();
  const double *z = scaled_.data(), *image = image_.data();
  for (int iteration = 0; iteration < limit; ++iteration) {
    precondition(system, multigrid);
    // image_ still holds A direction and step*image_ is what the residual lost, hence r.z_old + ...
    const auto [fresh, lost] = dot_products(scaled_, residual_, image_);
    if (!(fresh > 0.0) || !std::isfinite(fresh)) break;  // lost positive definiteness to round-off
    const double weight = iteration == 0 ? 0.0 : -lost / energy;
    for_each_offset(unknowns_, [&](std::ptrdiff_t at) {
      d[at] = weight == 0.0 ? z[at] : z[at] + weight * d[at];
    });
    ghosts_.exchange(direction_);
    apply(*grid_, unknowns_, system, direction_, image_);
    const auto [curvature, slope] = dot_products(direction_, image_, residual_);
    energy = curvature;
    if (!(energy > 0.0)) break;
    const double step = slope / energy;
    for_each_offset(unknowns_, [&](std::ptrdiff_t at) {
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
  take_unknowns(system);
  if (system.constant_free) remove_mean(system.right_side);
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

template class PressureSolver<2>;
template class PressureSolver<3>;

}  // namespace mudlark

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

/// Calls body(place in the grid's arrays, place of the same cell in packed ones, its run).
template <int D, class Body>
void for_each_pair(const Spans& spans, const PackedCells<D>& cells, Body&& body) {
  for (std::size_t n = 0; n < spans.size(); ++n) {
    const auto& run = cells.runs()[n];
    for (std::ptrdiff_t k = 0; k < run.cells; ++k) body(spans[n].first + k, run.at + k, run);
  }
}

}  // namespace

template <int D>
PressureSolver<D>::PressureSolver(const Grid<D>& grid)
    : grid_(&grid), ghosts_(grid), cells_(grid.partition()), multigrid_(grid) {}

template <int D>
void PressureSolver<D>::take_unknowns(const PressureSystem<D>& system) {
  if (max_over_ranks(*grid_, unknowns_ == system.unknowns ? 0.0 : 1.0) == 0.0) return;
  unknowns_ = system.unknowns;
  std::vector<RowPart<D>> parts;
  for (const Span& span : unknowns_) {
    RowPart<D> part{{}, static_cast<int>(span.last - span.first)};
    for (int a = 0; a < D; ++a) part.first[a] = grid_->index_along(a, span.first);
    parts.push_back(part);
  }
  cells_.store(parts);
  for (Values& values : coupling_) values.assign(cells_.size(), 0.0);
  for (Values* values : {&diagonal_, &pressure_, &residual_, &scaled_, &direction_, &image_})
    values->assign(cells_.size(), 0.0);
}

template <int D>
void PressureSolver<D>::take_matrix(const PressureSystem<D>& system) {
  for_each_pair(unknowns_, cells_, [&](std::ptrdiff_t at, std::ptrdiff_t here, const auto&) {
    diagonal_[static_cast<std::size_t>(here)] = system.diagonal.data()[at];
  });
  for (int a = 0; a < D; ++a) {
    const double* from = system.coupling[a].data();
    double* to = coupling_[static_cast<std::size_t>(a)].data();
    const std::ptrdiff_t s = grid_->stride(a);
    for_each_pair(unknowns_, cells_, [&](std::ptrdiff_t at, std::ptrdiff_t here, const auto& run) {
      to[here] = from[at];
      to[here + run.above[static_cast<std::size_t>(a)]] = from[at + s];
    });
  }
}

/// image_ = A p on the cells. Collective.
template <int D>
void PressureSolver<D>::multiply(Values& p) {
  cells_.exchange(p);
  const double *x = p.data(), *diagonal = diagonal_.data();
  const double *c0 = coupling_[0].data(), *c1 = coupling_[1].data(), *c2 = coupling_[D - 1].data();
  double* y = image_.data();
  for (const auto& run : cells_.runs()) {
    const std::ptrdiff_t b1 = run.below[1], a1 = run.above[1];
    const std::ptrdiff_t b2 = run.below[D - 1], a2 = run.above[D - 1];
    for (std::ptrdiff_t at = run.at; at < run.at + run.cells; ++at) {
      double sum = diagonal[at] * x[at] - c0[at] * x[at - 1] - c0[at + 1] * x[at + 1] -
                   c1[at] * x[at + b1] - c1[at + a1] * x[at + a1];
      if constexpr (D == 3) sum -= c2[at] * x[at + b2] + c2[at + a2] * x[at + a2];
      y[at] = sum;
    }
  }
}

template <int D>
std::array<double, 2> PressureSolver<D>::dot_products(const Values& one, const Values& first,
                                                      const Values& second) const {
  constexpr int lanes = 4;  // sums side by side: no addition waits for the one before
  std::array<double, lanes> sums[2] = {};
  const double *a = one.data(), *b = first.data(), *c = second.data();
  for (const auto& run : cells_.runs()) {
    std::ptrdiff_t at = run.at;
    const std::ptrdiff_t last = at + run.cells;
    for (; at + lanes <= last; at += lanes)
      for (std::size_t k = 0; k < lanes; ++k) {
        const auto place = at + static_cast<std::ptrdiff_t>(k);
        sums[0][k] += a[place] * b[place];
        sums[1][k] += a[place] * c[place];
      }
    for (; at < last; ++at) sums[0][0] += a[at] * b[at], sums[1][0] += a[at] * c[at];
  }
  std::array<double, 2> total{};
  for (std::size_t n = 0; n < 2; ++n)
    for (const double sum : sums[n]) total[n] += sum;
  MPI_Allreduce(MPI_IN_PLACE, total.data(), 2, MPI_DOUBLE, MPI_SUM, grid_->comm());
  return total;
}

template <int D>
double PressureSolver<D>::largest(const Values& values) const {
  double size = 0.0;
  bool finite = true;
  cells_.for_each([&, v = values.data()](std::ptrdiff_t at, const auto&) {
    size = std::max(size, std::abs(v[at]));
    finite = finite && std::isfinite(v[at]);
  });
  return max_over_ranks(*grid_, finite ? size : HUGE_VAL);
}

template <int D>
double PressureSolver<D>::largest_right_side(PressureSystem<D>& system) {
  take_unknowns(system);
  take_right_side(system);
  return largest(residual_);
}

/// residual_ = right side; its mean over all cells with an unknown is taken out where a constant is
/// free, in the system too.
template <int D>
void PressureSolver<D>::take_right_side(PressureSystem<D>& system) {
  double* b = system.right_side.data();
  for_each_pair(unknowns_, cells_, [&](std::ptrdiff_t at, std::ptrdiff_t here, const auto&) {
    residual_[static_cast<std::size_t>(here)] = b[at];
  });
  if (!system.constant_free) return;
  remove_mean(residual_);
  for_each_pair(unknowns_, cells_, [&](std::ptrdiff_t at, std::ptrdiff_t here, const auto&) {
    b[at] = residual_[static_cast<std::size_t>(here)];
  });
}

template <int D>
void PressureSolver<D>::remove_mean(Values& values) const {
  std::array<double, 2> sum{};  // and count
  double* v = values.data();
  cells_.for_each([&](std::ptrdiff_t at, const auto&) { sum[0] += v[at], sum[1] += 1.0; });
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 2, MPI_DOUBLE, MPI_SUM, grid_->comm());
  const double mean = sum[0] / std::max(sum[1], 1.0);
  cells_.for_each([&](std::ptrdiff_t at, const auto&) { v[at] -= mean; });
}

template <int D>
void PressureSolver<D>::find_residual(const PressureSystem<D>& system) {
  multiply(pressure_);
  const double *b = system.right_side.data(), *image = image_.data();
  double* r = residual_.data();
  for_each_pair(unknowns_, cells_, [&](std::ptrdiff_t at, std::ptrdiff_t here, const auto&) {
    r[here] = b[at] - image[here];
  });
  if (system.constant_free) remove_mean(residual_);
}

template <int D>
void PressureSolver<D>::precondition(bool constant_free, bool multigrid) {
  const double *r = residual_.data(), *diagonal = diagonal_.data();
  double* z = scaled_.data();
  // A kept hierarchy may leave out some of the cells: they get the diagonal.
  if (!multigrid || !multigrid_.fits(cells_))
    cells_.for_each([&](std::ptrdiff_t at, const auto&) { z[at] = r[at] / diagonal[at]; });
  if (multigrid) multigrid_.apply(cells_, residual_, scaled_);
  if (constant_free) remove_mean(scaled_);
}

/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) with the flexible (Polak-Ribiere)
/// step, which forgives a preconditioner that is only nearly symmetric. Returns whether the
/// tolerance was reached.
template <int D>
bool PressureSolver<D>::iterate(bool constant_free, double tolerance, int limit, bool multigrid,
                                SolveReport& report) {
  double energy = 0.0;
  double *x = pressure_.data(), *r = residual_.data(), *d = direction_.data();
  const double *z = scaled_.data(), *image = image_.data();
  for (int iteration = 0; iteration < limit; ++iteration) {
    precondition(constant_free, multigrid);
    // image_ still holds A direction and step*image_ is what the residual lost, hence r.z_old + ...
    const auto [fresh, lost] = dot_products(scaled_, residual_, image_);
    if (!(fresh > 0.0) || !std::isfinite(fresh)) break;  // lost positive definiteness to round-off
    const double weight = iteration == 0 ? 0.0 : -lost / energy;
    cells_.for_each([&](std::ptrdiff_t at, const auto&) {
      d[at] = weight == 0.0 ? z[at] : z[at] + weight * d[at];
    });
    multiply(direction_);
    const auto [curvature, slope] = dot_products(direction_, image_, residual_);
    energy = curvature;
    if (!(energy > 0.0)) break;
    const double step = slope / energy;
    cells_.for_each([&](std::ptrdiff_t at, const auto&) {
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
  take_matrix(system);
  if (system.constant_free) take_right_side(system);
  for_each_pair(unknowns_, cells_, [&](std::ptrdiff_t at, std::ptrdiff_t here, const auto&) {
    pressure_[static_cast<std::size_t>(here)] = p.data()[at];
  });
  bool current = false;
  // The recursive residual drifts from the true one by round-off: restart from the true one until
  // both agree.
  for (int restart = 0; restart < 4 && !report.converged; ++restart) {
    find_residual(system);
    report.residual = largest(residual_);
    report.converged = report.residual <= (restart > 0 ? tolerance : good_start * tolerance);
    if (report.converged || !std::isfinite(report.residual)) break;
    if (!current && (restart > 0 || !built_ || hierarchy == Hierarchy::fresh)) {
      multigrid_.build(cells_, coupling_, diagonal_);
      current = built_ = true;
    }
    report.plain = restart == 3;
    iterate(system.constant_free, tolerance, report.plain ? plain_limit : multigrid_limit,
            !report.plain, report);
  }
  if (!report.converged) {
    find_residual(system);
    report.residual = largest(residual_);
    report.converged = report.residual <= tolerance;
  }
  for_each_pair(unknowns_, cells_, [&](std::ptrdiff_t at, std::ptrdiff_t here, const auto&) {
    p.data()[at] = pressure_[static_cast<std::size_t>(here)];
  });
  ghosts_.update(p);
  return report;
}

template class PressureSolver<2>;
template class PressureSolver<3>;

}  // namespace mudlark

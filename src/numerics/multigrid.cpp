#include "numerics/multigrid.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace mudlark {
namespace {

/// Cells of all ranks at which hypre takes over: little work is left, and what it costs to call it
/// does not count yet.
constexpr double few_cells = 150.0;
/// An excess smaller than this part of the diagonal is what round-off left of its sum.
constexpr double round_off = 1e-13;

/// A period can be closed on all levels when it halves evenly down to one cell.
template <int D>
bool closes_seam(const Grid<D>& grid, int axis) {
  return grid.periodic(axis) && std::has_single_bit(static_cast<unsigned>(grid.cells()[axis]));
}

template <int D>
double count(const Index<D>& cells) {
  double product = 1.0;
  for (int a = 0; a < D; ++a) product *= cells[a];
  return product;
}

/// The ends of an axis whose period is not closed are no neighbours.
template <int D>
Partition<D> without_seams(const Grid<D>& grid) {
  Partition<D> partition = grid.partition();
  for (int a = 0; a < D; ++a) {
    auto& neighbour = partition.neighbour[static_cast<std::size_t>(a)];
    if (closes_seam(grid, a)) continue;
    if (grid.owned().lower[a] == 0) neighbour[0] = MPI_PROC_NULL;
    if (grid.owned().upper[a] == grid.cells()[a]) neighbour[1] = MPI_PROC_NULL;
  }
  return partition;
}

}  // namespace

template <int D>
Multigrid<D>::Multigrid(const Grid<D>& grid) : grid_(&grid) {
  for (int a = 0; a < D; ++a) closed_[static_cast<std::size_t>(a)] = closes_seam(grid, a);
  levels_.emplace_back(without_seams(grid), grid.cells());
}

/// Operator of the finest level: the system's, without couplings that lead beyond the ends.
template <int D>
void Multigrid<D>::fill_finest(const PressureSystem<D>& system) {
  const Grid<D>& grid = *grid_;
  MultigridLevel<D>& level = levels_.front();
  places_.clear();
  Spans spans;
  for (const Span& span : system.unknowns) {
    Index<D> first;
    for (int a = 0; a < D; ++a) first[a] = grid.index_along(a, span.first);
    const std::ptrdiff_t at = level.offset(first);
    spans.push_back({at, at + (span.last - span.first)});
    places_.push_back(span.first);
  }
  level.take_unknowns(std::move(spans));
  for (std::size_t n = 0; n < places_.size(); ++n) {
    const Span& span = level.spans()[n];
    const Index<D> first = level.index_of(span.first);
    for (std::ptrdiff_t k = 0; k < span.last - span.first; ++k) {
      const double diagonal = system.diagonal.data()[places_[n] + k];
      double excess = diagonal;
      const auto u = static_cast<std::size_t>(span.first + k);
      for (int a = 0; a < D; ++a) {
        const double* c = system.coupling[a].data() + places_[n] + k;
        const int index = first[a] + (a == 0 ? static_cast<int>(k) : 0);
        const double lower = index > 0 || closed_[static_cast<std::size_t>(a)] ? c[0] : 0.0;
        const bool beyond = index + 1 == grid.cells()[a] && !closed_[static_cast<std::size_t>(a)];
        level.coupling[static_cast<std::size_t>(a)][u] = lower;
        excess -= lower + (beyond ? 0.0 : c[grid.stride(a)]);
      }
      level.excess[u] = excess < round_off * diagonal ? 0.0 : excess;
    }
  }
  level.assemble();
}

/// Makes the level below of the same shape as last time, or all from there on anew.
template <int D>
void Multigrid<D>::coarsen(std::size_t from, int axis) {
  if (from + 1 == levels_.size() || axes_[from] != axis) {
    levels_.erase(levels_.begin() + static_cast<std::ptrdiff_t>(from) + 1, levels_.end());
    axes_.resize(from);
    coarsest_.reset();
    levels_.push_back(levels_[from].halved(axis));
    axes_.push_back(axis);
  }
  levels_[from].coarsen(levels_[from + 1], axis);
}

template <int D>
void Multigrid<D>::build(const PressureSystem<D>& system) {
  fill_finest(system);
  std::size_t last = 0;
  for (; count(levels_[last].cells()) > few_cells; ++last) {
    const int axis = levels_[last].choose_axis();
    if (axis < 0) break;
    coarsen(last, axis);
  }
  if (!coarsest_) {
    Index<D> period{};
    for (int a = 0; a < D; ++a)
      if (closed_[static_cast<std::size_t>(a)]) period[a] = levels_[last].cells()[a];
    coarsest_ = std::make_unique<Pfmg<D>>(grid_->comm(), levels_[last].owned(), period);
  }
  coarsest_->build(levels_[last]);
}

template <int D>
void Multigrid<D>::cycle(std::size_t level) {
  MultigridLevel<D>& here = levels_[level];
  if (level + 1 == levels_.size()) {
    coarsest_->apply(here);
    return;
  }
  MultigridLevel<D>& below = levels_[level + 1];
  here.smooth_from_zero();
  here.restrict_to(below);
  cycle(level + 1);
  here.add_from(below);
  here.smooth_back();
}

template <int D>
void Multigrid<D>::apply(const CellField<D>& residual, CellField<D>& out) {
  MultigridLevel<D>& finest = levels_.front();
  const double* r = residual.data();
  double* z = out.data();
  for (std::size_t n = 0; n < places_.size(); ++n) {
    const Span& span = finest.spans()[n];
    std::copy_n(r + places_[n], span.last - span.first, finest.right_side.data() + span.first);
  }
  cycle(0);
  for (std::size_t n = 0; n < places_.size(); ++n) {
    const Span& span = finest.spans()[n];
    std::copy_n(finest.solution.data() + span.first, span.last - span.first, z + places_[n]);
  }
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace mudlark

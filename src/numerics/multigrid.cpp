#include "numerics/multigrid.hpp"

#include <algorithm>
#include <bit>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Cells of all ranks at which hypre takes over: little work is left, and what it costs to call it
/// does not count yet.
constexpr double few_cells = 600.0;
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
  levels_.emplace_back(without_seams(grid), grid.cells());
}

/// Operator of the finest level: the system's, without couplings that lead beyond the ends.
template <int D>
void Multigrid<D>::fill_finest(const PressureSystem<D>& system, const IndexBox<D>& box) {
  const Grid<D>& grid = *grid_;
  MultigridLevel<D>& level = levels_.front();
  std::fill(level.excess.begin(), level.excess.end(), 0.0);
  IndexBox<D> rows = box;
  rows.upper[0] = rows.lower[0] + 1;
  if (!box.empty())
    for_each(rows, [&](const Index<D>& row) {
      const double* diagonal = system.diagonal.data() + grid.offset(row);
      std::copy(diagonal, diagonal + (box.upper[0] - box.lower[0]),
                level.excess.data() + level.offset(row));
    });
  level.find_unknowns();
  for (const Span& span : level.spans()) {
    const Index<D> first = level.index_of(span.first);
    const std::ptrdiff_t shift = grid.offset(first) - span.first;
    for (std::ptrdiff_t at = span.first; at < span.last; ++at) {
      double& excess = level.excess[static_cast<std::size_t>(at)];
      const double diagonal = excess;
      for (int a = 0; a < D; ++a) {
        const auto u = static_cast<std::size_t>(a);
        const std::ptrdiff_t s = grid.stride(a);
        const double* c = system.coupling[a].data() + at + shift;
        const int index = first[a] + (a == 0 ? static_cast<int>(at - span.first) : 0);
        const bool lower = index > 0 || closes_seam(grid, a);
        const bool upper = index + 1 < grid.cells()[a] || closes_seam(grid, a);
        level.coupling[u][static_cast<std::size_t>(at)] = lower ? c[0] : 0.0;
        excess -= (lower ? c[0] : 0.0) + (upper ? c[s] : 0.0);
      }
      if (excess < round_off * diagonal) excess = 0.0;
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
void Multigrid<D>::build(const PressureSystem<D>& system, const IndexBox<D>& box) {
  fill_finest(system, box);
  std::size_t last = 0;
  for (; count(levels_[last].cells()) > few_cells; ++last) {
    const int axis = levels_[last].choose_axis();
    if (axis < 0) break;
    coarsen(last, axis);
  }
  if (!coarsest_) {
    Index<D> period{};
    for (int a = 0; a < D; ++a)
      if (closes_seam(*grid_, a)) period[a] = levels_[last].cells()[a];
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
  const auto copy = [&](auto&& body) {
    for (const Span& span : finest.spans()) {
      const std::ptrdiff_t place = grid_->offset(finest.index_of(span.first));
      body(span, place);
    }
  };
  const double* r = residual.data();
  double* z = out.data();
  copy([&](const Span& span, std::ptrdiff_t place) {
    std::copy(r + place, r + place + (span.last - span.first),
              &finest.right_side[static_cast<std::size_t>(span.first)]);
  });
  cycle(0);
  copy([&](const Span& span, std::ptrdiff_t place) {
    std::copy(finest.solution.data() + span.first, finest.solution.data() + span.last, z + place);
  });
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace mudlark

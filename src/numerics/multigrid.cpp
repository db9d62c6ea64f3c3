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
void Multigrid<D>::fill_finest(const PackedCells<D>& cells, const std::array<Values, D>& coupling,
                               const Values& diagonal) {
  MultigridLevel<D>& level = levels_.front();
  level.take_unknowns({cells.runs().begin(), cells.runs().end()});
  for (const auto& run : cells.runs())  // the same cells lie at the same places
    for (int k = 0; k < run.cells; ++k) {
      const auto at = static_cast<std::size_t>(run.at + k);
      double excess = diagonal[at];
      for (int a = 0; a < D; ++a) {
        const auto u = static_cast<std::size_t>(a);
        const double* c = coupling[u].data() + run.at + k;
        const int index = run.first[a] + (a == 0 ? k : 0);
        const double lower = index > 0 || closed_[u] ? c[0] : 0.0;
        const bool beyond = index + 1 == grid_->cells()[a] && !closed_[u];
        level.coupling[u][at] = lower;
        excess -= lower + (beyond ? 0.0 : c[run.above[u]]);
      }
      level.excess[at] = excess < round_off * diagonal[at] ? 0.0 : excess;
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
void Multigrid<D>::build(const PackedCells<D>& cells, const std::array<Values, D>& coupling,
                         const Values& diagonal) {
  fill_finest(cells, coupling, diagonal);
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
bool Multigrid<D>::fits(const PackedCells<D>& cells) const {
  return std::equal(cells.runs().begin(), cells.runs().end(), levels_.front().runs().begin(),
                    levels_.front().runs().end(),
                    [](const RowPart<D>& one, const RowPart<D>& other) { return one == other; });
}

template <int D>
void Multigrid<D>::apply(const PackedCells<D>& cells, const Values& residual, Values& out) {
  MultigridLevel<D>& finest = levels_.front();
  // Calls body(place among the cells, place in the finest level) for all that both have.
  const auto for_each_common = [&](auto&& body) {
    for (const auto& run : finest.runs())
      for (int k = 0; k < run.cells; ++k)
        if (const std::ptrdiff_t at = cells.find(run.first.shifted(0, k)); at >= 0)
          body(static_cast<std::size_t>(at), static_cast<std::size_t>(run.at + k));
  };
  const bool same = fits(cells);
  if (same)
    finest.right_side = residual;
  else
    for_each_common(
        [&](std::size_t at, std::size_t here) { finest.right_side[here] = residual[at]; });
  cycle(0);
  if (same)
    cells.for_each([&](std::ptrdiff_t at, const auto&) {
      out[static_cast<std::size_t>(at)] = finest.solution[static_cast<std::size_t>(at)];
    });
  else
    for_each_common([&](std::size_t at, std::size_t here) { out[at] = finest.solution[here]; });
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace mudlark

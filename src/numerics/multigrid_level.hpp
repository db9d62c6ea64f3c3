#pragma once
/// One level of our own multigrid: a 5- or 7-point operator on the cells that have an unknown, its
/// smoother, and the way to the next coarser level.
#include <array>
#include <vector>

#include "base/vec.hpp"
#include "numerics/packed_cells.hpp"

namespace mudlark {

/// Semicoarsening with interpolation by the operator (Ashby & Falgout 1996, Nucl. Sci. Eng. 124):
/// every second cell along one axis stays; a cell between takes (l p_below + u p_above)/(l + u + e)
/// with its couplings l, u along the axis and its excess e (diagonal less all couplings: Dirichlet
/// and storage terms). Along the axis that is elimination, exact; couplings across it are lumped,
/// so that the operator keeps its 5 or 7 points and all terms stay positive. Only cells with an
/// unknown cost anything. Which cells stay does not depend on the ranks.
///
/// Values outside the cells with an unknown are zero.
template <int D>
class MultigridLevel {
 public:
  using Values = std::vector<double>;

  /// `partition` tells this level's cells of this rank. Collective.
  MultigridLevel(const Partition<D>& partition, const Index<D>& cells);
  /// The shape of the level that halving along an axis leads to, still without operator.
  MultigridLevel halved(int axis) const;

  /// Axis with the strongest couplings of those that can be halved (every rank keeps a cell, a
  /// period two), the same on all ranks; -1 where there is none. Collective.
  int choose_axis() const;

  const Index<D>& cells() const { return cells_; }
  const IndexBox<D>& owned() const { return packed_.owned(); }
  using Run = typename PackedCells<D>::Run;
  const PackedCells<D>& packed() const { return packed_; }
  const std::vector<Run>& runs() const { return packed_.runs(); }

  /// Cells of this rank with an unknown; all values are zero until they are given. Collective.
  void take_unknowns(const std::vector<RowPart<D>>& cells) { store(cells, {}); }
  /// Takes over couplings and excesses of those cells. Collective.
  void assemble();
  /// Operator of the level below, halved along `axis`. Collective.
  void coarsen(MultigridLevel& coarse, int axis);

  /// solution = one red-black sweep for `right_side` from zero.
  void smooth_from_zero();
  /// Right side of the level below: what is left of this one's, restricted. Collective.
  void restrict_to(MultigridLevel& coarse);
  /// Adds the solution of the level below, interpolated. Collective.
  void add_from(MultigridLevel& coarse);
  /// The mirror image of the sweep from zero, which makes the cycle symmetric. Collective.
  void smooth_back();

  std::array<Values, D> coupling;  ///< of a cell with its lower neighbour along the axis
  Values excess;                   ///< diagonal less the couplings
  Values right_side, solution;     ///< zero where there is no unknown
  /// Excess and the sum of the couplings.
  double diagonal(std::ptrdiff_t at, const Run& run) const;

 private:
  /// A run of the level below, and where its cells are here.
  struct Kept {
    std::ptrdiff_t kept, at, below, above;
    int cells;
  };
  /// What a run here follows on the level below: the place of its first cell's image or of the
  /// image's lower neighbour, and the way from there to the upper one.
  struct Followed {
    bool between;  ///< does the first cell lie between two that stay?
    std::ptrdiff_t from, above;
  };
  using Cross = std::array<std::array<std::ptrdiff_t, 3>, 3>;  ///< ways by shift along two axes

  void store(const std::vector<RowPart<D>>& cells, const std::vector<IndexBox<D>>& asked);
  void find_weights();
  std::vector<RowPart<D>> kept_runs() const;
  std::vector<IndexBox<D>> asked_below() const;
  void find_ways(const MultigridLevel& coarse);
  Cross ways_across(const Index<D>& cell, int axis) const;
  double coarse_excess(std::ptrdiff_t at, const Kept& run) const;
  double coupling_across(std::ptrdiff_t at, int axis, const Cross& ways, std::size_t side) const;
  template <class Body>
  void for_each_of_colour(int colour, Body&& body) const;
  double neighbours(std::ptrdiff_t at, const Run& run) const;
  void sweep(int colour);

  PackedCells<D> packed_;
  Index<D> cells_;
  std::array<bool, D> halves_{};
  int axis_ = 0;                    ///< along which the level below is halved
  std::vector<Kept> kept_;          ///< by run of the level below
  std::vector<Followed> followed_;  ///< by run
  Values inverse_;                  ///< of the diagonal, zero without an unknown
  Values below_, above_;  ///< weights by which a cell follows its neighbours along the axis
  Values residual_;
};

extern template class MultigridLevel<2>;
extern template class MultigridLevel<3>;

}  // namespace mudlark

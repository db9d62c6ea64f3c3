#pragma once
/// One level of our own multigrid: a 5- or 7-point operator on the cells that have an unknown, its
/// smoother, and the way to the next coarser level.
#include <array>
#include <vector>

#include "base/vec.hpp"
#include "numerics/spans.hpp"
#include "parallel/partition.hpp"

namespace mudlark {

/// Semicoarsening with interpolation by the operator (Ashby & Falgout 1996, Nucl. Sci. Eng. 124):
/// every second cell along one axis stays; a cell between takes (l p_below + u p_above)/(l + u + e)
/// with its couplings l, u along the axis and its excess e (diagonal less all couplings: Dirichlet
/// and storage terms). Along the axis that is elimination, exact; couplings across it are lumped,
/// so that the operator keeps its 5 or 7 points and all terms stay positive. Only cells with an
/// unknown cost anything. Which cells stay does not depend on the ranks.
///
/// Arrays hold this rank's cells and one layer of ghosts; behind a wall they are zero.
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
  const IndexBox<D>& owned() const { return partition_.owned; }
  const Spans& spans() const { return spans_; }
  std::ptrdiff_t stride(int axis) const { return strides_[static_cast<std::size_t>(axis)]; }
  std::ptrdiff_t offset(const Index<D>& index) const {
    std::ptrdiff_t at = 0;
    for (int a = 0; a < D; ++a) at += (index[a] - owned().lower[a] + 1) * stride(a);
    return at;
  }
  Index<D> index_of(std::ptrdiff_t at) const;

  /// Cells of this rank with an unknown; all values are zero until they are given.
  void take_unknowns(Spans spans);
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

  std::array<Values, D> coupling;           ///< of a cell with its lower neighbour along the axis
  Values excess;                            ///< diagonal less the couplings
  Values right_side, solution;              ///< zero where there is no unknown
  double coupled(std::ptrdiff_t at) const;  ///< sum of the couplings of a cell

 private:
  void exchange(Values& values);  ///< ghosts beyond faces; corners are left
  void exchange_with_corners(Values& values);
  void exchange_along(int first, int last, Values& values);
  IndexBox<D> layer(int axis, int side, bool ghost) const;
  void find_weights();
  Spans kept_spans(const MultigridLevel& coarse) const;
  double coarse_excess(std::ptrdiff_t at) const;
  double coarse_coupling(std::ptrdiff_t at, int axis) const;
  template <class Body>
  void for_each_kept(const MultigridLevel& coarse, Body&& body) const;
  template <class Body>
  void for_each_of_colour(int colour, Body&& body) const;
  double neighbours(std::ptrdiff_t at) const;
  void sweep(int colour);

  Partition<D> partition_;
  Index<D> cells_;
  std::array<std::ptrdiff_t, D> strides_{};
  std::array<bool, D> halves_{};
  int axis_ = 0;              ///< along which the level below is halved
  Spans spans_;               ///< this rank's cells with an unknown
  std::vector<int> colours_;  ///< of the first cell of each span
  Values inverse_;            ///< of the diagonal, zero without an unknown
  Values below_, above_;      ///< weights by which a cell follows its neighbours along the axis
  Values residual_;
  std::array<Values, static_cast<std::size_t>(2 * D)> send_, receive_;  ///< by axis and side
};

extern template class MultigridLevel<2>;
extern template class MultigridLevel<3>;

}  // namespace mudlark

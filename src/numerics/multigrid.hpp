#pragma once
/// One multigrid cycle as preconditioner for the pressure system: our own levels while there is
/// work, on cells with an unknown only; hypre's PFMG where little is left.
#include <memory>
#include <vector>

#include "grid/grid.hpp"
#include "numerics/multigrid_level.hpp"
#include "numerics/pfmg.hpp"

namespace mudlark {

template <int D>
class Multigrid {
 public:
  explicit Multigrid(const Grid<D>& grid);

  using Values = typename PackedCells<D>::Values;

  /// Builds the hierarchy for a new matrix on some cells. Couplings across a periodic seam are left
  /// out of the preconditioner unless the cells halve evenly down to one; the diagonal keeps them,
  /// so it stays positive definite. Collective.
  void build(const PackedCells<D>& cells, const std::array<Values, D>& coupling,
             const Values& diagonal);
  /// Was it built for these cells?
  bool fits(const PackedCells<D>& cells) const;
  /// out = M^-1 residual on those of the cells that it was built for. Collective.
  void apply(const PackedCells<D>& cells, const Values& residual, Values& out);

 private:
  void fill_finest(const PackedCells<D>& cells, const std::array<Values, D>& coupling,
                   const Values& diagonal);
  void coarsen(std::size_t from, int axis);
  void cycle(std::size_t level);

  const Grid<D>* grid_;
  std::array<bool, D> closed_{};           ///< is there a period of the levels along the axis?
  std::vector<MultigridLevel<D>> levels_;  ///< finest first
  std::vector<int> axes_;                  ///< along which each level was halved
  std::unique_ptr<Pfmg<D>> coarsest_;      ///< for the last level
};

extern template class Multigrid<2>;
extern template class Multigrid<3>;

}  // namespace mudlark

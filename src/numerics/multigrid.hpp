#pragma once
/// One multigrid cycle as preconditioner for the pressure system: our own levels while there is
/// work, on cells with an unknown only; hypre's PFMG where little is left.
#include <memory>
#include <vector>

#include "numerics/multigrid_level.hpp"
#include "numerics/pfmg.hpp"
#include "numerics/pressure_system.hpp"

namespace mudlark {

template <int D>
class Multigrid {
 public:
  explicit Multigrid(const Grid<D>& grid);

  /// Builds the hierarchy for a new matrix. Couplings across a periodic seam are left out of the
  /// preconditioner unless the cells halve evenly down to one; the diagonal keeps them, so it stays
  /// positive definite. Collective.
  void build(const PressureSystem<D>& system);
  /// out = M^-1 residual on the cells that had an unknown when it was built. Collective.
  void apply(const CellField<D>& residual, CellField<D>& out);

 private:
  void fill_finest(const PressureSystem<D>& system);
  void coarsen(std::size_t from, int axis);
  void cycle(std::size_t level);

  const Grid<D>* grid_;
  std::array<bool, D> closed_{};           ///< is there a period of the levels along the axis?
  std::vector<std::ptrdiff_t> places_;     ///< of the finest level's spans in the grid's arrays
  std::vector<MultigridLevel<D>> levels_;  ///< finest first
  std::vector<int> axes_;                  ///< along which each level was halved
  std::unique_ptr<Pfmg<D>> coarsest_;      ///< for the last level
};

extern template class Multigrid<2>;
extern template class Multigrid<3>;

}  // namespace mudlark

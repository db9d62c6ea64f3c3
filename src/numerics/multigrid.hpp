#pragma once
/// One cycle of hypre's structured multigrid (PFMG) as preconditioner for the pressure system.
/// Ashby & Falgout (1996), Nucl. Sci. Eng. 124; Falgout & Jones (2000).
#include <memory>

#include "numerics/pressure_system.hpp"

namespace mudlark {

template <int D>
class Multigrid {
 public:
  explicit Multigrid(const Grid<D>& grid);
  ~Multigrid();
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  /// Works on these owned cells only, which may be none on some ranks; at first on all. Collective.
  void cover(const IndexBox<D>& box);
  /// Builds the hierarchy for a new matrix. Couplings across a periodic seam are left out of the
  /// preconditioner (PFMG wants powers of two there); the diagonal keeps them, so it stays positive
  /// definite.
  void build(const PressureSystem<D>& system);
  /// out = M^-1 residual on the covered cells.
  void apply(const CellField<D>& residual, CellField<D>& out);

 private:
  struct Hypre;  // keeps hypre's headers (and macros) out of everybody else's sight
  const Grid<D>* grid_;
  IndexBox<D> box_;
  std::unique_ptr<Hypre> hypre_;
  std::vector<double> buffer_;
};

extern template class Multigrid<2>;
extern template class Multigrid<3>;

}  // namespace mudlark

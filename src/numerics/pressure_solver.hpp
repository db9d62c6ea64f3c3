#pragma once
/// Conjugate gradients for the pressure, preconditioned by structured multigrid.
#include <array>

#include "numerics/multigrid.hpp"
#include "numerics/pressure_system.hpp"

namespace mudlark {

struct SolveReport {
  int iterations = 0;
  double residual = 0.0;  ///< largest |right side - A p| of all cells [1/s]
  bool converged = false;
  bool plain = false;  ///< multigrid stalled and diagonal scaling took over
};

/// Multigrid built for the matrix at hand, or kept from an earlier one that was much the same.
enum class Hierarchy { fresh, kept };

template <int D>
class PressureSolver {
 public:
  explicit PressureSolver(const Grid<D>& grid);

  /// Solves A p = right side from the present p (warm start), until the largest residual is below
  /// `tolerance` [1/s]; one cycle at least, unless the start is a million times better. With
  /// `system.constant_free` the mean of the right side is taken out first (a closed box cannot
  /// change its volume) and p keeps its mean. Falls back to diagonal scaling where multigrid
  /// stalls; the caller decides what a report without convergence means. Leaves the ghosts of p
  /// valid. A kept hierarchy saves its construction, costs more iterations the more the matrix
  /// changes, and is built anew where it does not lead to the tolerance. Cells without an unknown
  /// cost next to nothing.
  SolveReport solve(PressureSystem<D>& system, CellField<D>& p, double tolerance,
                    Hierarchy hierarchy = Hierarchy::fresh);

  /// Largest right side of all ranks, its mean taken out where pressure is free by a constant
  /// [1/s].
  double largest_right_side(PressureSystem<D>& system);

 private:
  using Values = typename PackedCells<D>::Values;

  void take_unknowns(const PressureSystem<D>& system);
  void take_matrix(const PressureSystem<D>& system);
  void take_right_side(PressureSystem<D>& system);
  bool iterate(bool constant_free, double tolerance, int limit, bool multigrid,
               SolveReport& report);
  void find_residual(const PressureSystem<D>& system);
  void precondition(bool constant_free, bool multigrid);
  void multiply(Values& p);
  void remove_mean(Values& values) const;
  /// Products of one field with two others, over all ranks.
  std::array<double, 2> dot_products(const Values& one, const Values& first,
                                     const Values& second) const;
  double largest(const Values& values) const;

  const Grid<D>* grid_;
  Spans unknowns_;  ///< in the grid's arrays
  Ghosts<D> ghosts_;
  PackedCells<D> cells_;  ///< the same cells, close together: all below is of these
  Multigrid<D> multigrid_;
  bool built_ = false;  ///< is there a hierarchy?
  std::array<Values, D> coupling_;
  Values diagonal_, pressure_, residual_, scaled_, direction_;
  Values image_;  ///< A times pressure or direction
};

extern template class PressureSolver<2>;
extern template class PressureSolver<3>;

}  // namespace mudlark

#pragma once
/// The linear system of a pressure projection: a symmetric 5- or 7-point operator on the cells.
#include "grid/field.hpp"
#include "numerics/ghosts.hpp"
#include "numerics/spans.hpp"

namespace mudlark {

/// (A p)_c = diagonal_c p_c - sum over faces of coupling_f p_neighbour. Cells without an unknown
/// have diagonal 0 here and no coupling; the solver leaves their value alone and reads nothing of
/// them.
template <int D>
struct PressureSystem {
  explicit PressureSystem(const Grid<D>& grid)
      : coupling(grid, "coupling", "1/(Pa s)"),
        diagonal(grid, "diagonal", "1/(Pa s)"),
        right_side(grid, "right side", "1/s") {}

  FaceVector<D> coupling;  ///< >= 0, on owned and bounding faces
  CellField<D> diagonal;   ///< sum of the couplings, Dirichlet terms and storage terms
  CellField<D> right_side;
  Spans unknowns;  ///< this rank's cells with an unknown
  bool constant_free =
      false;  ///< no Dirichlet and no storage term anywhere: p is known up to a constant
};

}  // namespace mudlark

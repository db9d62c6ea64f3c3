#pragma once
/// Water that seeps down through half empty pores and arrives at the water's surface below.
#include "base/pore_filling.hpp"
#include "flow/porous_medium.hpp"

namespace mudlark {

/// A step of dt [s] of water of a weight rho g [N/m3]; the flux of water at rest in itself is
/// rho g k_r / A, A = mu/kappa.
template <int D>
struct Percolation {
  double dt, weight;
  const PoreFilling& filling;
  const FaceVector<D>& resistance;  ///< A [Pa s/m2]
  const FaceVector<D>& carried;     ///< what the transport of the step has moved, share of a cell
};

/// Cells with a pressure keep their volume, so what their pores lack would stay air for ever. It
/// leaves as water comes from above: a cell of the ground at least half full takes from the cell
/// over it, which is not, what falls by k_r(S) and the transport has not brought, up to its room.
/// `water` in `porosity` with ghosts; those of the result are stale.
template <int D>
void fall_to_surface(const Grid<D>& grid, const PorousMedium<D>& medium,
                     const CellField<D>& porosity, const Percolation<D>& step, CellField<D>& water);

}  // namespace mudlark

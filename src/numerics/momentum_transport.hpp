#pragma once
/// Advection of the water's velocity with the very volume fluxes that moved the interface.
///
/// Consistent mass and momentum transport in the spirit of Rudman (1998), Int. J. Numer. Meth.
/// Fluids 28: the control volume of a face holds half the water of its two cells, M_f = (W_L +
/// W_R)/2, and its fluxes are the means of theirs, so a uniform velocity stays uniform to the last
/// bit whatever the interface does.
#include "numerics/cell_runs.hpp"

namespace mudlark {

/// What has mass: the water alone, so that cells may hold next to nothing, or the gas beside it
/// too.
enum class Inertia { water, water_and_gas };

/// What carries momentum, relative to water that fills the cell: its mass before and after the
/// step, the porosity [1], and the share that passed each face. All with valid ghosts.
template <int D>
struct Masses {
  const CellField<D>*before, *after, *porosity;
  const FaceVector<D>* flux;
};

template <int D>
class MomentumTransport {
 public:
  MomentumTransport(const Grid<D>& grid, const CellRuns<D>& near);

  /// velocity <- velocity - sum F (v* - velocity) / M_f^new on the faces inside the domain; v* is
  /// upwind with van Leer's limited slope (van Leer 1974, J. Comput. Phys. 14). The velocity needs
  /// valid ghosts, which are stale afterwards. Faces of open walls copy their inner neighbour.
  void advance(Inertia inertia, const Masses<D>& masses, FaceVector<D>& velocity);

 private:
  template <class Rule>
  void advance_component(int component, const Masses<D>& masses, const FaceVector<D>& velocity);
  void copy_to_open_walls(int component, double* values) const;

  const Grid<D>* grid_;
  const CellRuns<D>* near_;
  FaceVector<D> moved_;
};

/// Faces of an axis that lie inside the domain (no wall faces), among those that this rank owns.
template <int D>
IndexBox<D> inner_faces(const Grid<D>& grid, int axis);

extern template class MomentumTransport<2>;
extern template class MomentumTransport<3>;

}  // namespace mudlark

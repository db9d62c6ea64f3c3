#pragma once
/// Advection of the water's velocity with the very volume fluxes that moved the interface.
///
/// Consistent mass and momentum transport in the spirit of Rudman (1998), Int. J. Numer. Meth.
/// Fluids 28: the control volume of a face holds half the water of its two cells, M_f = (W_L +
/// W_R)/2, and its fluxes are the means of theirs, so a uniform velocity stays uniform to the last
/// bit whatever the interface does.
#include "numerics/ghosts.hpp"

namespace mudlark {

template <int D>
class MomentumTransport {
 public:
  explicit MomentumTransport(const Grid<D>& grid);

  /// velocity <- velocity - sum F (v* - velocity) / M_f^new on the faces inside the domain; v* is
  /// upwind with van Leer's limited slope (van Leer 1974, J. Comput. Phys. 14). `water_flux` is the
  /// share of a cell's volume that passed each face. All inputs need valid ghosts. Faces of open
  /// walls copy their inner neighbour; ghosts of `velocity` are stale afterwards.
  void advance(const CellField<D>& old_water, const CellField<D>& new_water,
               const CellField<D>& porosity, const FaceVector<D>& water_flux,
               FaceVector<D>& velocity);

 private:
  void advance_component(int component, const double* old_water, const double* new_water,
                         const double* porosity, const FaceVector<D>& water_flux,
                         const double* velocity, double* moved) const;
  void copy_to_open_walls(int component, double* values) const;

  const Grid<D>* grid_;
  FaceVector<D> moved_;
};

/// Faces of an axis that lie inside the domain (no wall faces), among those that this rank owns.
template <int D>
IndexBox<D> inner_faces(const Grid<D>& grid, int axis);

extern template class MomentumTransport<2>;
extern template class MomentumTransport<3>;

}  // namespace mudlark

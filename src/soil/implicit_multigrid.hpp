#pragma once
/// Preconditioner for the stiffness of the grains: two grids, none of them with a matrix of its own
/// on the fine one.
#include "soil/contact_stiffness.hpp"
#include "soil/implicit_coarse.hpp"
#include "soil/implicit_operator.hpp"
#include "soil/implicit_spline_mass.hpp"
#include "soil/implicit_unknowns.hpp"

namespace mudlark {

/// Chebyshev polynomials of degree 2 before and after a correction on a grid of twice the cell
/// size. They are built on the inverse of SplineMass instead of the diagonal: a stiffness of
/// splines is bounded by their mass over h^2 at every frequency, so the number of iterations
/// depends neither on the grid nor much on the dimension (Hofreither & Takacs 2017 for single-patch
/// splines). The stiffness is that of the tangents when this was made, their symmetric part, with
/// what yields kept from vanishing.
template <int D>
class DisplacementMultigrid {
 public:
  DisplacementMultigrid(const Grid<D>& grid, const ImplicitUnknowns<D>& unknowns,
                        UnknownPlaces& places, std::vector<LinearPoint<D>> points,
                        ContactStiffness<D> contacts);
  DisplacementMultigrid(const DisplacementMultigrid&) = delete;
  DisplacementMultigrid& operator=(const DisplacementMultigrid&) = delete;

  /// Displacement [m] that nearly balances forces [N].
  void apply(::Vec force, ::Vec way);

 private:
  void multiply(::Vec way, ::Vec force);
  void find_largest_eigenvalue();
  /// Improves `way`; residual_ holds force - K way at its start and, if `renew`, at its end.
  void smooth(::Vec way, bool renew);

  const Grid<D>* grid_;
  UnknownPlaces* places_;
  std::vector<LinearPoint<D>> points_;
  PointOperator<D> operator_;
  ContactStiffness<D> contacts_;
  FaceVector<D> way_, force_;
  SplineMass<D> mass_;
  VecHandle residual_, direction_, product_;
  double largest_ = 1.0;  ///< eigenvalue of mass^-1 stiffness
  CoarseDisplacements<D> coarse_;
};

extern template class DisplacementMultigrid<2>;
extern template class DisplacementMultigrid<3>;

}  // namespace mudlark

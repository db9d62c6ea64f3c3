#pragma once
/// Preconditioner for the pore pressure of an implicit step, grains and water eliminated.
#include "soil/implicit_operator.hpp"
#include "soil/implicit_places.hpp"
#include "soil/implicit_spline_mass.hpp"

namespace mudlark {

/// With composite splines the divergence of a way is that of the staggered grid, interpolated, so
/// what is left of the balance of water after its way is eliminated by its (diagonal) drag R/dt is
///   S = M_c + dt M D R^-1 D^T M,
/// M the mass of the pressure's splines, M_c the same weighted by the compliance c = n/K_w + 1/E of
/// water and grains (fixed stress; E confined modulus), D the divergence. Its inverse is nearly
///   M^-1 A^-1 M^-1,  A = c/m T + dt D R^-1 D^T, where water flows within a step, and
///   m^-1 A^-1 M^-1 with T = 1                  where it does not:
/// m row sums of M, T a bound for m M^-1. A has the stencil of a Laplacian and goes to hypre's
/// BoomerAMG; M^-1 is conjugate gradients on SplineMass.
template <int D>
class PressurePreconditioner {
 public:
  /// `signs` of the pressure's places: minus behind sides with a pressure.
  PressurePreconditioner(const Grid<D>& grid, const PointOperator<D>& points,
                         UnknownPlaces& pressure, const std::vector<double>& signs,
                         const UnknownPlaces& water, ::Vec drag, double dt);
  PressurePreconditioner(const PressurePreconditioner&) = delete;
  PressurePreconditioner& operator=(const PressurePreconditioner&) = delete;

  /// Pressure [Pa] that nearly takes up volumes [m^D].
  void apply(::Vec volume, ::Vec pressure);

 private:
  void make_laplacian(const UnknownPlaces& water, ::Vec drag, double dt);
  void drop_signs(CellField<D>& field) const;
  void multiply_mass(::Vec in, ::Vec out);
  void divide_by_mass(::Vec in, ::Vec out);

  const Grid<D>* grid_;
  const PointOperator<D>* points_;
  UnknownPlaces* places_;
  const std::vector<double>* signs_;
  CellField<D> cells_, sums_;
  SplineMass<D> mass_;
  VecHandle volume_, compliance_;  ///< row sums of M, and of M_c
  VecHandle first_, second_, residual_, direction_, product_, improved_;
  bool flows_ = false;
  MatHandle laplacian_;
  PcHandle multigrid_;
};

extern template class PressurePreconditioner<2>;
extern template class PressurePreconditioner<3>;

}  // namespace mudlark

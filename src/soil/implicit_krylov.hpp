#pragma once
/// The linear system of a Newton iteration without a matrix: operator and preconditioner for
/// PETSc's Krylov methods.
#include <Eigen/LU>
#include <memory>

#include "soil/implicit_contact.hpp"
#include "soil/implicit_multigrid.hpp"
#include "soil/implicit_pressure.hpp"

namespace mudlark {

/// [ K   0  -G ] [u]        K stiffness of the grains, R drag, C storage of water,
/// [ 0  R/dt -B ] [w]       G, B: what pressure does to grains and to water.
/// [ G^T B^T C ] [p]
/// Preconditioner: w is eliminated exactly (R is a diagonal), then block by block
/// u = K^-1 f_u, p = S^-1 (f_p - G^T u - B^T dt R^-1 f_w), with DisplacementMultigrid for K and
/// PressurePreconditioner for S. docs/decisions/0017-krylov-for-implicit-steps.md.
template <int D>
class ImplicitKrylov {
 public:
  /// `x`: a vector of all unknowns. Rows of cells are multiplied by `water_scale` [Pa/m].
  ImplicitKrylov(const Grid<D>& grid, const ImplicitUnknowns<D>& unknowns,
                 ImplicitContact<D>& contact, ::Vec x, double dt, double water_scale);
  ImplicitKrylov(const ImplicitKrylov&) = delete;
  ImplicitKrylov& operator=(const ImplicitKrylov&) = delete;

  /// Points linearised anew; they must outlive the next use. Collective.
  void linearise(const std::vector<LinearPoint<D>>& points);
  /// Makes the preconditioner for the present points.
  void prepare();
  bool prepared() const { return displacement_ != nullptr; }

  void multiply(::Vec x, ::Vec y);
  void precondition(::Vec r, ::Vec x);

 private:
  void make_drag();
  void find_flow();
  void move_bodies(::Vec r, ::Vec x);
  void difference_push();

  const Grid<D>* grid_;
  const ImplicitUnknowns<D>* unknowns_;
  ImplicitContact<D>* contact_;
  double dt_, water_scale_;
  UnknownPlaces grains_, water_, pressure_;
  FaceVector<D> ways_, forces_, seals_;
  CellField<D> cell_pressure_, flow_, storage_, pore_push_;
  VecHandle u_, w_, p_, f_u_, f_w_, f_p_;
  std::vector<double> bodies_, rests_;            ///< ways of rigid bodies, forces on them
  Eigen::PartialPivLU<Eigen::MatrixXd> holding_;  ///< of them by the soil around
  VecHandle drag_;                                ///< R [Pa s m^D / m2]
  VecHandle resistance_;  ///< R with the diagonal of what sealed surfaces answer
  std::vector<LinearPoint<D>> frozen_;
  std::unique_ptr<PointOperator<D>> points_, frozen_points_;
  std::unique_ptr<DisplacementMultigrid<D>> displacement_;
  std::unique_ptr<PressurePreconditioner<D>> pore_pressure_;
};

extern template class ImplicitKrylov<2>;
extern template class ImplicitKrylov<3>;

}  // namespace mudlark

#pragma once
/// Forces on the water other than pressure: gravity, viscosity, drag of the grains.
#include "flow/body_acceleration.hpp"
#include "flow/options.hpp"
#include "flow/porous_medium.hpp"
#include "flow/two_fluids.hpp"
#include "flow/viscous_force.hpp"
#include "numerics/cell_runs.hpp"

namespace mudlark {

template <int D>
class Predictor {
 public:
  Predictor(const Grid<D>& grid, const CellRuns<D>& beside, const FlowOptions& options);

  /// velocity <- ((rho + m) v + dt rho (g + b + nu lap v) + dt R v_s) / (rho + m + dt (R + F)) on
  /// all faces but closed walls: b of the body at half the step, m the added mass of fixed grains,
  /// F of the walls, R = n_f (A + B|w|); and mobility = dt / (rho + m + dt (R + F)) [m2 s/kg]: what
  /// a unit pressure gradient changes v by. Drag is implicit in v with |w| of the start of the
  /// step, `time` [s]. Ghosts of all inputs valid; afterwards ghosts of velocity are stale;
  /// mobility holds on owned and bounding faces.
  /// `eddy` is the dynamic viscosity of turbulence [Pa s], if any. With a mixture, density, weight
  /// and viscosity are its own, and drag is that of its share of water and gas: A is proportional
  /// to viscosity, B to density.
  void advance(const PorousMedium<D>& medium, const CellField<D>& porosity,
               const FaceVector<D>& capacity, const FaceVector<D>& wall_friction, double time,
               double dt, const Mixture<D>* mixture, const CellField<D>* eddy,
               FaceVector<D>& velocity, FaceVector<D>& mobility);
  /// Of the body at a time [s], [m/s2]. Collective.
  double largest_body_acceleration(double time) const { return body_.largest(time); }

 private:
  void find_forces(const PorousMedium<D>& medium, const CellField<D>& porosity,
                   const FaceVector<D>& capacity, const Mixture<D>* mixture,
                   const CellField<D>* eddy, const FaceVector<D>& velocity,
                   FaceVector<D>& resistance);
  double water_share(double density) const;
  void find_viscous_acceleration(int component, const double* porosity, const double* velocity,
                                 double* out) const;

  const Grid<D>* grid_;
  const CellRuns<D>* beside_;
  double density_, viscosity_, gas_density_, gas_viscosity_;
  /// 1/d^2 [1/m2] by local index along each axis, d the width of a cell and the distance between
  /// the centres of the cells beside a face.
  std::array<std::vector<double>, D> across_cell_, across_face_;
  ViscousForce<D> viscous_;
  BodyAcceleration<D> body_;
  CellField<D> water_viscosity_;  ///< the same everywhere [Pa s]
  FaceVector<D> acceleration_;
};

extern template class Predictor<2>;
extern template class Predictor<3>;

}  // namespace mudlark

#pragma once
/// Water and a gas above it, both incompressible and with mass: what differs from water alone.
///
/// Pressure, here and in all output, is that above gas at rest, p - rho_gas g.x: zero in still air,
/// as in a void (docs/methods/two-fluids.md).
#include "flow/options.hpp"
#include "flow/porous_medium.hpp"
#include "numerics/interface_advection.hpp"
#include "numerics/momentum_transport.hpp"

namespace mudlark {

/// What forces act on at faces where two fluids meet, on owned and bounding faces.
template <int D>
struct Mixture {
  explicit Mixture(const Grid<D>& grid)
      : density(grid, "density", "kg/m3", 1.0),
        acceleration(grid, "weight", "m/s2"),
        viscosity(grid, "viscosity", "Pa s") {}

  FaceVector<D> density;       ///< rho_f of what fills the pores [kg/m3]
  FaceVector<D> acceleration;  ///< weight that gas at rest does not balance, per mass [m/s2]
  CellField<D> viscosity;      ///< dynamic, ghosts valid [Pa s]
};

template <int D>
class TwoFluids {
 public:
  TwoFluids(const Grid<D>& grid, const FlowOptions& options);

  /// Remembers the mass of each cell before the transport: W + r (theta - W), r = rho_gas / rho.
  /// Ghosts of water and porosity are valid.
  void begin(const CellField<D>& water, const CellField<D>& porosity);
  /// Moves the momentum with the mass of both fluids. `flux` is theta_f v [m/s], `water_flux` what
  /// passed each face as a share of a cell's volume; the rest was gas.
  void move_momentum(const CellField<D>& water, const CellField<D>& porosity,
                     const FaceVector<D>& flux, const FaceVector<D>& water_flux, double dt,
                     MomentumTransport<D>& momentum, FaceVector<D>& velocity);

  /// Density, weight and viscosity for the present water. All ghosts are valid.
  void find_mixture(const CellField<D>& water, const CellField<D>& porosity,
                    const CellField<D>& alpha);
  const Mixture<D>& mixture() const { return mixture_; }

  /// Adds how the gas gives way, theta (1 - alpha) / (K dt) [1/(Pa s)], in cells that are mostly
  /// gas.
  const CellField<D>& with_gas_storage(const CellField<D>& give_way, const CellField<D>& water,
                                       const CellField<D>& porosity, double dt);
  /// Of the last move_momentum(): mass after it, and what passed each face.
  const CellField<D>& mass() const { return mass_; }
  const FaceVector<D>& mass_flux() const { return mass_flux_; }
  bool compressible() const { return gas_.bulk_modulus.has_value(); }
  /// Share of gas in the cells where its pressure is zero: those of the highest layer, or all where
  /// that holds none. For closed boxes. Collective.
  const CellField<D>& find_reference(const CellField<D>& alpha);

 private:
  void find_mass(const CellField<D>& water, const CellField<D>& porosity, CellField<D>& mass) const;
  void find_surface_height(const CellField<D>& alpha);
  double height_in_column(const double* alpha, std::ptrdiff_t at, int axis, int direction,
                          bool& found) const;
  void find_weight(int axis, const CellField<D>& porosity, const CellField<D>& alpha);

  const Grid<D>* grid_;
  double density_, viscosity_;
  Gas gas_;
  Ghosts<D> ghosts_;
  Mixture<D> mixture_;
  CellField<D> old_mass_, mass_;
  FaceVector<D> mass_flux_;
  CellField<D> rise_;      ///< g.(surface - cell centre) in cells that the surface cuts [m2/s2]
  CellField<D> resolved_;  ///< 1 where that is known
  CellField<D> storage_;
};

extern template class TwoFluids<2>;
extern template class TwoFluids<3>;

}  // namespace mudlark

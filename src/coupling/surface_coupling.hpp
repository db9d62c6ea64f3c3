#pragma once
/// Water and soil meeting at the mudline: the paper's coupling (NUMERICS C1), the only place that
/// sees both.
#include "coupling/options.hpp"
#include "coupling/pressure_extension.hpp"
#include "coupling/soil_in_water.hpp"
#include "flow/flow_solver.hpp"
#include "flow/porous_medium.hpp"
#include "soil/fluid_load.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {

template <int D>
class SurfaceCoupling {
 public:
  SurfaceCoupling(const Grid<D>& grid, const CouplingOptions& options, const FlowOptions& flow,
                  const SoilSolver<D>& soil);

  /// What the water feels of the soil: porosity 1 - phi_c, motion of the grains, Darcy drag.
  /// `fixed` is the ground that does not move (rubble, filters). Collective.
  void map_soil_to_grid(SoilSolver<D>& soil, const PorousMedium<D>& fixed, PorousMedium<D>& medium);

  /// The bed's velocity as the water will see it, after a step `dt` [s] of the soil.
  ///
  /// Added mass (NUMERICS C3): water of depth H rides on a bed of impedance Z, so loose coupling
  /// multiplies changes of the bed's velocity by -a, a = rho_w H / (Z dt), and diverges for a >
  /// 1/2. Therefore the water sees the bed's velocity through f <- f + omega (v_s - f), omega =
  /// 1/(1 + 2 a), stable for any a (docs/methods/coupling.md); volume that lags behind comes in by
  /// the drift feedback of the flow.
  void relax_bed_velocity(const SoilSolver<D>& soil, double dt);

  /// a = rho_w H / (Z dt) of the present water over the soil. H is the depth of water over the
  /// soil, or less when the domain is narrow: a wave of the bed of length 2 L moves water up to
  /// L/pi above it. Z = sqrt(rho G), the softest answer that the undrained bed gives. Collective in
  /// `measure_depth`, called by map_flow_to_soil.
  double added_mass(double dt) const;

  /// What the soil feels of the water: the pressure on its surface, before and after the flow's
  /// step, both for the soil as it lies now. Collective.
  void map_flow_at_begin(const FlowSolver<D>& flow, const SoilSolver<D>& soil, double time,
                         FluidLoad<D>& load);
  void map_flow_at_end(const FlowSolver<D>& flow, const SoilSolver<D>& soil, double time,
                       FluidLoad<D>& load);

  /// Pore pressure in equilibrium with the water at the start (mudline = "consistent" only): p =
  /// p_e. Collective.
  void initialise(const FlowSolver<D>& flow, SoilSolver<D>& soil, FluidLoad<D>& load);
  /// Ghost values after a state was loaded. Collective.
  void restore() { halo_.exchange(bed_velocity_); }

  /// Share of the water's load that acts at a time (ramp), 0..1.
  double load_share(double time) const;

  template <class Archive>
  void archive(Archive& a) {
    a.faces("coupling/bed velocity", bed_velocity_);
    a.number("coupling/water depth", water_depth_);
  }

 private:
  void measure_depth(const CellField<D>& pressure);
  void extended_pressure(const FlowSolver<D>& flow, const SoilSolver<D>& soil, double share,
                         CellField<D>& pressure);

  const Grid<D>* grid_;
  CouplingOptions options_;
  Halo<D> halo_;
  PressureExtension<D> extension_;
  SoilInWater<D> room_;
  CellField<D> open_, wet_;
  double water_density_;        ///< [kg/m3]
  double full_fraction_;        ///< solid fraction of undisturbed soil [-]
  double impedance_;            ///< sqrt(rho G) of the softest soil [Pa s/m]
  double water_depth_ = 0.0;    ///< of water over the soil, bounded by the width of the domain [m]
  FaceVector<D> bed_velocity_;  ///< velocity of the grains as the water sees it [m/s]
};

extern template class SurfaceCoupling<2>;
extern template class SurfaceCoupling<3>;

}  // namespace mudlark

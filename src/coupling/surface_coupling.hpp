#pragma once
/// Water and soil meeting at the mudline: the paper's coupling (NUMERICS C1), the only place that
/// sees both.
#include "coupling/options.hpp"
#include "coupling/pressure_extension.hpp"
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

  /// `fixed` is the ground that does not move (rubble, filters).
  /// What the water feels of the soil: porosity 1 - phi_c, motion of the grains, Darcy drag, and
  /// how easily the bed gives way to pressure. Collective.
  void map_soil_to_grid(SoilSolver<D>& soil, const PorousMedium<D>& fixed, PorousMedium<D>& medium);

  /// What the soil feels of the water: the pressure on its surface at both ends of the flow step
  /// just taken. Collective.
  void map_flow_to_soil(const FlowSolver<D>& flow, const SoilSolver<D>& soil, double end_of_step,
                        FluidLoad<D>& load);

  /// Pore pressure in equilibrium with the water at the start (mudline = "consistent" only): p =
  /// p_e. Collective.
  void initialise(const FlowSolver<D>& flow, SoilSolver<D>& soil, FluidLoad<D>& load);

  /// Share of the water's load that acts at a time (ramp), 0..1.
  double load_share(double time) const;

  template <class Archive>
  void archive(Archive& a, FluidLoad<D>& load) {
    a.cells("coupling/water pressure", load.pressure_end);
  }

 private:
  void set_compliance(PorousMedium<D>& medium);
  void extended_pressure(const FlowSolver<D>& flow, const SoilSolver<D>& soil, double share,
                         CellField<D>& pressure);

  const Grid<D>* grid_;
  CouplingOptions options_;
  Halo<D> halo_;
  PressureExtension<D> extension_;
  CellField<D> fraction_;    ///< grain volume per cell volume phi_c [-]
  CellField<D> resistance_;  ///< mu / kappa, fading at the rim [Pa s/m2]
  CellField<D> open_, wet_;
  double water_density_;  ///< [kg/m3]
  double full_fraction_;  ///< solid fraction of undisturbed soil [-]
  double impedance_;      ///< rho c of the undrained soil [Pa s/m]
};

extern template class SurfaceCoupling<2>;
extern template class SurfaceCoupling<3>;

}  // namespace mudlark

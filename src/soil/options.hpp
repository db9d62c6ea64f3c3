#pragma once
/// What the case file says about the soil, as plain data (SI units).
#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/pore_filling.hpp"
#include "base/varying.hpp"
#include "base/vec.hpp"
#include "grid/shape.hpp"
#include "grid/solid_options.hpp"
#include "materials/options.hpp"
#include "soil/side_options.hpp"

namespace mudlark {

/// two_phase: the points carry it; unified: it is the flow's water, on the grid.
enum class PoreWater { none, two_phase, unified };
enum class PermeabilityLaw { constant, kozeny_carman };

struct GeostaticStress {
  double lateral_coefficient = -1.0;  ///< K0 [-]; negative: what the law says
};

/// Stress that varies in space, xx yy zz xy yz zx [Pa]; of time zero.
struct StressField {
  std::array<Varying, 6> component{};
};

/// One body of soil.
struct SoilBody {
  std::string name;
  Shape shape;
  double grain_density = 2650.0;  ///< [kg/m3]
  double porosity = 0.4;          ///< [-], initial
  PoreWater pore_water = PoreWater::two_phase;
  double intrinsic_permeability = 0.0;  ///< kappa [m2], initial
  /// d [m], with one water: the drag of the grains is that of their size, from a bed to a cloud; 0:
  /// that of the permeability.
  double grain_diameter = 0.0;
  PermeabilityLaw permeability_law = PermeabilityLaw::constant;
  PoreFilling filling;      ///< unified: of pores that are not full
  int points_per_cell = 4;  ///< total per full cell; a D-th power (4, 9, 16 in 2D; 8, 27, 64 in 3D)
  SoilLawOptions law;
  StrainMeasure strain = StrainMeasure::hencky;
  /// Effective, tension positive [Pa].
  std::variant<SymTensor, GeostaticStress, StressField> initial_stress = SymTensor{};
  std::optional<Varying>
      initial_pore_pressure;  ///< [Pa], added to the hydrostatic one of GeostaticStress
  std::array<Varying, 3> initial_velocity{};  ///< [m/s] per axis, grains and pore water alike
  std::size_t stage = 0;                      ///< at whose start the body is placed
};

/// What a load presses on. skeleton: the pore water drains at the surface at zero pressure; water:
/// the load is the pressure of water over the soil, and pore water drains against it.
enum class LoadedPhase { skeleton, water };

/// Pressure on the free surface of the soil; positive pushes inwards.
struct SurfaceLoad {
  std::string name;
  Varying pressure;  ///< [Pa]
  LoadedPhase on = LoadedPhase::skeleton;
};

enum class Kernel { linear, quadratic, composite };
enum class Transfer { flip, apic };
/// When the soil counts as at rest (NUMERICS A6).
struct RestCriterion {
  double unbalanced_force = 1e-3;  ///< largest ||F_ext - F_int|| / ||F_ext|| on the faces [-]
  double kinetic_energy = 1e-3;    ///< largest kinetic energy over the external work so far [-]
  double after = 0.0;              ///< [s], not before: loads may still come
};

/// explicit: small steps with inertia. implicit: quasi-static steps of any length.
enum class TimeMethod { explicit_steps, implicit_steps };

/// A part of the run with settings of its own; nothing: those of the solver.
struct SoilStage {
  std::string name;
  std::optional<double> damping, water_damping;  ///< [-]
  std::optional<double> mass_scaling;            ///< [-]
  std::optional<TimeMethod> method{};
  std::optional<RestCriterion> stop_when_static{};  ///< `after` counts from the stage's start
  std::optional<std::vector<bool>> loads{};         ///< which act, of all in order; nothing: all
  std::optional<Shape> remove{};                    ///< whose soil is taken out at the start
  bool reset_displacements = false;                 ///< at the start
};

/// How implicit steps solve their linear systems; automatic: what is faster for their size.
enum class LinearSolver { automatic, direct, iterative };

/// Search for the state of rest from which a case starts.
struct EquilibriumStart {
  RestCriterion rest;
  double damping = 0.7;  ///< of grains and pore water while it is sought [-]
  /// Simulated time after which there is none [s]; of implicit steps how long pore water drains
  /// meanwhile, 0: until nothing is left to drain.
  double longest = 0.0;
  bool reset_displacements = true;
};

/// How grains and pore water move together (docs/methods/formulations.md). u_w: velocities of both,
/// pore pressure from compression of the water, explicit. u_w_p: the same velocities, pore pressure
/// by an implicit projection. u_p: relative acceleration dropped, pore pressure implicit.
enum class Formulation { u_w, u_w_p, u_p };

enum class LoadForm { virtual_stress, facets };

struct SoilOptions {
  std::vector<SoilBody> bodies;
  std::vector<SurfaceLoad> loads;
  std::vector<SolidOptions> solids;
  std::vector<SoilBoundary> boundaries;
  std::vector<Shape> flooded;  ///< where soil whose water is the flow's stands in it at the start
  double water_density = 1000.0;       ///< pore water [kg/m3]
  double water_viscosity = 1.002e-3;   ///< [Pa s]
  double water_bulk_modulus = 2.15e9;  ///< [Pa]; infinite: incompressible (u_w_p only)
  Formulation formulation = Formulation::u_w;
  bool inertia_in_darcy = false;  ///< u_p: keep rho_w a_s in Darcy's law
  /// u_p: shortest period of what loads the soil [s], for the check of its range; nothing: the
  /// period of the soil's first undrained mode.
  std::optional<double> loading_period;
  Kernel kernel = Kernel::composite;
  Transfer transfer = Transfer::flip;
  double flip_fraction = 0.99;  ///< share of FLIP in the velocity update [-], the rest is PIC
  double damping = 0.0;         ///< local non-viscous damping of the grains [-] (Cundall 1987)
  std::optional<double> water_damping;  ///< the same of the pore water [-]; nothing: as `damping`
  /// Factor on the inertia of grains and pore water, not on their weight [-]; the step grows by its
  /// square root. For slow motion only: see SoilSolver::statics().
  double mass_scaling = 1.0;
  std::optional<RestCriterion> stop_when_static;
  std::optional<EquilibriumStart> start_in_equilibrium;
  /// Share of the largest stable step [-]; that is 1.0 (composite), 0.8 (quadratic) or 0.65
  /// (linear) of the time in which the fastest wave crosses a cell.
  double courant = 0.5;
  std::optional<double> max_step;  ///< [s]
  TimeMethod method = TimeMethod::explicit_steps;
  /// Error of an implicit step as a share of the largest displacement so far [-].
  double step_tolerance = 3e-4;
  LinearSolver linear_solver = LinearSolver::automatic;  ///< of implicit steps
  LoadForm load_form = LoadForm::virtual_stress;
  std::vector<SoilStage> stages{};        ///< in order; none: the whole run has one
  std::optional<double> split_stretched;  ///< extent at which a point is split [cells]
  /// Acceleration beside gravity, x y z [m/s2], of grains and pore water.
  std::optional<std::array<Varying, 3>> body_acceleration;
};

/// In any of its stages?
inline bool takes_implicit_steps(const SoilOptions& soil) {
  const auto implicit = [](TimeMethod method) { return method == TimeMethod::implicit_steps; };
  if (soil.stages.empty()) return implicit(soil.method);
  return std::any_of(soil.stages.begin(), soil.stages.end(), [&](const SoilStage& stage) {
    return implicit(stage.method.value_or(soil.method));
  });
}

}  // namespace mudlark

#pragma once
/// Free-surface flow of water through open space and porous ground: the incompressible
/// Navier-Stokes equations averaged over the pores (VANS), with the interface by geometric volume
/// of fluid.
///
/// One step t -> t + dt (docs/methods/free-surface-flow.md):
///   1. the present velocity, free of divergence, moves water, porosity and momentum;
///   2. gravity, viscosity and drag act;
///   3. pressure makes the velocity free of divergence again on the new water;
///   4. the velocity is extended beyond the surface, where that is a void. A gas is computed with
///      the water (flow/two_fluids.hpp): steps 1 to 3 are those of both.
/// So at the end of a step surface, velocity and pressure belong to the same time, and the bound
/// that stable_step() gives is exact for the transport that follows.
#include <cstdint>
#include <optional>

#include "flow/drained_ground.hpp"
#include "flow/fixed_ground.hpp"
#include "flow/moving_grains.hpp"
#include "flow/options.hpp"
#include "flow/porous_medium.hpp"
#include "flow/predictor.hpp"
#include "flow/projection.hpp"
#include "flow/solid_load.hpp"
#include "flow/turbulence.hpp"
#include "flow/two_fluids.hpp"
#include "flow/water_storage.hpp"
#include "numerics/interface_advection.hpp"
#include "numerics/momentum_transport.hpp"
#include "numerics/near_water.hpp"
#include "numerics/velocity_extension.hpp"

namespace mudlark {

/// Volume of the water since the start; present = initial - outflow to round-off [m^D]. What wave
/// zones add counts as negative outflow.
struct WaterLedger {
  double initial = 0.0, outflow = 0.0, present = 0.0;
};

/// What the steps have cost so far: wall-clock time of this rank [s].
struct FlowEffort {
  double interface = 0.0;   ///< water, porosity and what follows from where they are
  double momentum = 0.0;    ///< transport of momentum and turbulence
  double forces = 0.0;      ///< waves, friction, viscosity and drag
  double pressure = 0.0;    ///< system and solution
  double extension = 0.0;   ///< velocity beyond the surface
  std::int64_t cycles = 0;  ///< of multigrid
};

template <int D>
struct FastestPlace {
  double speed = 0.0;  ///< [m/s]
  Vec<D> position;     ///< cell centre [m]
};

template <int D>
class FlowSolver {
 public:
  FlowSolver(const Grid<D>& grid, const FlowOptions& options);
  FlowSolver(const FlowSolver&) = delete;  // its parts point at one another
  FlowSolver& operator=(const FlowSolver&) = delete;

  /// Water W = theta * share of the cell inside the bodies (exact for boxes), their velocity made
  /// free of divergence, and the pressure that holds the water at rest.
  void initialise(const PorousMedium<D>& medium);

  /// Water that shares its pressure with grains gives way to it, by 1/K [1/Pa]. Before
  /// initialise().
  void let_water_give_way(double compressibility) { storage_.emplace(*grid_, compressibility); }
  /// Drained pores keep what the medium's residual saturation says. Before initialise().
  void keep_residual_water() { residual_.emplace(*grid_, options_); }
  /// Room that bodies leave in the medium where they are now: before initialise().
  void place_solids(PorousMedium<D>& medium);
  /// What follows from a state just loaded.
  void restore(PorousMedium<D>& medium);
  /// Moves bodies over the coming step, and the room in the medium with them.
  void move_solids(PorousMedium<D>& medium, double dt);
  /// After a step of dt [s]: free bodies take the velocity that water, weight and given forces give
  /// them for the next.
  void drive_solids(double dt);
  /// Free bodies are driven by others with their names: what those have of the water's load over
  /// the last step of dt [s], and their velocity for the next one.
  void push_solids(std::vector<Solid>& leaders, double dt) const;
  void follow_leaders(const std::vector<Solid>& leaders) {
    solids_.follow(leaders);
    with_ground_ = true;  // leaders are the soil's
  }
  /// After move_solids(): puts the leaders a step ahead of the water's bodies.
  void place_leaders(std::vector<Solid>& leaders, double dt) const { solids_.lead(leaders, dt); }

  /// Largest step that keeps the transport bounded, the viscosity stable and surface waves resolved
  /// [s] (NUMERICS B2, B5). The same on all ranks.
  double stable_step(const PorousMedium<D>& medium) const;

  /// One step of dt [s]. Throws DivergenceError (on all ranks) when dt is too large for the
  /// velocity, when a bound is broken, when the pressure does not converge or when a number is no
  /// longer finite.
  /// With `grains` they share the pressure with the water, and their velocity is that after the
  /// step (NUMERICS C2); `medium` then says where they are, its flux and drag only what else there
  /// is. Fields of `grains` valid on owned and bounding faces.
  void advance(const PorousMedium<D>& medium, double dt, MovingGrains<D>* grains = nullptr);
  /// Nothing happens until a time [s].
  void rest_until(double time) { time_ = time; }

  const CellField<D>& pressure() const { return pressure_; }  ///< [Pa], above that of still air
  /// alpha = W / theta [-]; where pores keep a residue, of the water beyond it in the room beyond.
  const CellField<D>& saturation() const { return saturation_; }
  const CellField<D>& water_fraction() const {
    return water_;
  }  ///< W, water volume per cell volume [-]
  const CellField<D>& porosity() const {
    return porosity_;
  }  ///< theta as transported with the water [-]
  const FaceVector<D>& velocity() const { return velocity_; }  ///< interstitial [m/s]
  double density() const { return options_.density; }          ///< [kg/m3]
  /// Water that passed each face in the last step as a share of a cell's volume; zero before the
  /// first step. On owned and bounding faces.
  const FaceVector<D>& water_flux() const { return carried_; }

  WaterLedger ledger() const;
  double kinetic_energy() const;      ///< [J], per metre in 2D
  Vec<D> momentum() const;            ///< [kg m/s], per metre in 2D; collective
  FastestPlace<D> max_speed() const;  ///< among the faces that touch water
  /// Height of the topmost surface in the column of cells through a position (its vertical entry is
  /// ignored); the domain's bottom where there is no water. Collective.
  double surface_height(const Vec<D>& position) const;
  /// Largest x that water reaches; the domain's lower end without water. Collective.
  double front() const;
  /// Values at a position by linear interpolation; zero outside the domain. Collective.
  double pressure_at(const Vec<D>& position) const;
  Vec<D> velocity_at(const Vec<D>& position) const;
  /// Of water out of the ground through a part of a side, mean over the last step [m^D/s].
  /// Collective.
  double ground_discharge(const std::string& side) const {
    return ground_sides_ ? ground_sides_->discharge(side) : 0.0;
  }
  /// Null where the flow has none.
  const Turbulence<D>* turbulence() const { return turbulence_ ? &*turbulence_ : nullptr; }
  const SolidBodies<D>& solids() const { return solids_; }
  /// Of the water on a body about its centre, or on the part of its surface in a box. Collective.
  SolidLoad solid_load(std::size_t body, const std::optional<BoxShape>& part) const;
  /// The same a time [s] later, if the water stood still meanwhile. Collective.
  SolidLoad solid_load_ahead(std::size_t body, double time) const;
  const SolveReport& last_solve() const { return last_solve_; }
  const FlowEffort& effort() const { return effort_; }

  /// What the present pressure does to grains at rest: force per unit of their share of a face
  /// [N/m3], and what menisci pull them with [N/m3]. Between steps. Collective.
  void push_on_grains(const PorousMedium<D>& medium, const FaceVector<D>& share,
                      FaceVector<D>& per_share, FaceVector<D>& menisci);

  /// The whole state: a run that goes on from it continues bit for bit.
  template <class Archive>
  void archive(Archive& a) {
    a.integer("flow step", step_);
    a.number("flow time", time_);
    a.number("initial water", initial_volume_);
    a.number("water outflow", outflow_);
    a.cells("water fraction", water_);
    a.cells("flow porosity", porosity_);
    a.cells("flow pressure", pressure_);
    a.faces("flow velocity", velocity_);
    a.faces("flow capacity", capacity_);
    solids_.archive(a);
    ghosts_.exchange(capacity_);
    if (turbulence_) turbulence_->archive(a);
    if (storage_) storage_->archive(a);
    if (residual_) residual_->archive(a);
    if (ground_sides_) ground_sides_->archive(a);
    update_derived(everywhere_);
    find_sides(time_);
    find_near();
  }

 private:
  void update_derived(const CellRuns<D>& where, const PorousMedium<D>* medium = nullptr);
  void fill_with_bodies(const PorousMedium<D>& medium);
  void move_water(const PorousMedium<D>& medium, double dt, const FaceVector<D>* grain_velocity);
  void move_momentum(double dt);
  void settle_water(const PorousMedium<D>& medium, double dt, const MovingGrains<D>* grains);
  void make_friction();
  void apply_forces(const PorousMedium<D>& medium, double dt, bool with_grains);
  void make_free_of_divergence(const PorousMedium<D>& medium, double dt, MovingGrains<D>* grains);
  void extend_velocity(const PorousMedium<D>& medium);
  void find_loose(const CellRuns<D>& where);
  void keep_old_water(const CellRuns<D>& where);
  void keep_carried(const CellRuns<D>& where);
  void find_capacity(const PorousMedium<D>& medium);
  void follow_solids(const PorousMedium<D>& medium);
  void find_flux();
  void find_target(const PorousMedium<D>& medium, double dt, double most);
  void add_outflow();
  void make_waves(double dt);
  void find_sides(double time, const PorousMedium<D>* medium = nullptr);
  void hold_sides();
  void project_start(const PorousMedium<D>& medium);
  bool far_changes(const PorousMedium<D>& medium) const;
  const CellRuns<D>& changing(const PorousMedium<D>& medium) const {
    return far_changes(medium) ? everywhere_ : near_.cells();
  }
  void find_near(const PorousMedium<D>* medium = nullptr);
  void find_unknowns();
  /// What moves as water with a sharp surface, and its room.
  const CellField<D>& free_water() const { return residual_ ? residual_->free() : water_; }
  const CellField<D>& free_room() const { return residual_ ? residual_->room() : porosity_; }
  void push_given(const PorousMedium<D>& medium);
  void project_with_grains(const PorousMedium<D>& medium, const CellField<D>& give_way, double dt,
                           MovingGrains<D>& grains);
  WallPressure<D> wall_pressure() const;
  void check_bounds(const CellRuns<D>& where) const;
  void check_finite() const;
  double courant_rate() const;
  void check_step(double dt) const;

  const Grid<D>* grid_;
  FlowOptions options_;
  Ghosts<D> ghosts_;
  NearWater<D> near_;       ///< where the parts below look for something to do
  CellRuns<D> everywhere_;  ///< where they look if farther cells change as well
  InterfaceAdvection<D> interface_;
  MomentumTransport<D> momentum_;
  Predictor<D> predictor_;
  DrainedGround<D> drained_;
  Projection<D> projection_;
  VelocityExtension<D> extension_;
  WaveZones<D> waves_;
  FlowSides<D> sides_;
  WaveSources<D> sources_;
  Rain<D> rain_;
  std::optional<GroundSides<D>> ground_sides_;
  std::optional<TwoFluids<D>> gas_;
  std::optional<Turbulence<D>> turbulence_;
  std::optional<WaterStorage<D>> storage_;  ///< where water that gives way meets grains
  std::optional<GrainsInWater<D>> with_grains_;
  std::optional<ResidualWater<D>> residual_;  ///< where drained pores keep some
  SolidBodies<D> solids_;
  CellField<D> water_, porosity_, pressure_, saturation_;
  FaceVector<D> velocity_;
  CellField<D> old_water_, new_porosity_, target_, no_storage_;
  CellField<D> seen_;       ///< saturation, continued behind the walls of bodies
  CellField<D> loose_;      ///< 1 in cells whose porosity was not transported
  FaceVector<D> capacity_;  ///< theta_f: what a face lets through of a unit velocity [-]
  FaceVector<D> flux_, carried_, mobility_, wall_friction_, body_friction_;
  double initial_volume_ = 0.0, outflow_ = 0.0, time_ = 0.0;
  std::int64_t step_ = 0;
  bool with_ground_ = false;  ///< grains share the pressure
  SolveReport last_solve_;
  FlowEffort effort_;
};

extern template class FlowSolver<2>;
extern template class FlowSolver<3>;

}  // namespace mudlark

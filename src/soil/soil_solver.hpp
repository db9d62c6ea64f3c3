#pragma once
/// The soil: material points on the shared grid, under given loads of the free water.
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "grid/halo.hpp"
#include "grid/solid_collisions.hpp"
#include "materials/soil_model.hpp"
#include "soil/absorbing_sides.hpp"
#include "soil/energy.hpp"
#include "soil/fluid_load.hpp"
#include "soil/kinematics.hpp"
#include "soil/nodes.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/pore_projection.hpp"
#include "soil/side_water.hpp"
#include "soil/sides.hpp"
#include "soil/solid_contact.hpp"
#include "soil/statics.hpp"
#include "soil/surface_load.hpp"
#include "soil/transfer.hpp"
#include "soil/wall_contact.hpp"

namespace mudlark {

struct ImplicitOutcome;
template <int D>
struct ImplicitProblem;
template <int D>
class ImplicitSides;

/// Two-phase (velocities of grains and pore water, drag implicit) or single-phase material point
/// method, explicit in the effective stress. Pore pressure is explicit (u-w) or found by an
/// implicit projection (u-w-p, u-p). NUMERICS A1, A2, A4, A5, C2 (kernels).
template <int D>
class SoilSolver {
 public:
  /// Throws InputError when the options do not fit together.
  SoilSolver(const Grid<D>& grid, const SoilOptions& options);

  SoilSolver(const SoilSolver&) = delete;  // its parts point at each other
  SoilSolver& operator=(const SoilSolver&) = delete;

  /// Seeds the points and sets their initial state. Collective.
  void initialise();

  /// Moves the points under gravity, loads and accelerations of time zero until they are at rest
  /// (explicit steps: damped; implicit ones: weight and loads in a few shares), and starts from
  /// there: velocities and work are zero, displacements where asked. After
  /// initialise(); does nothing where the options do not ask for it. Throws InputError on all ranks
  /// when the soil finds no rest. Collective.
  void find_equilibrium();
  /// The same search where the coupling moves the faces: between the two sides and bodies stand
  /// still, and the damping is that of the search; after it points start from rest, at time zero.
  struct Dampings {
    double both;
    std::optional<double> water;
  };
  Dampings seek_rest();
  void begin_at_rest(const Dampings& given);
  /// Throws when the search took longer than it may [s].
  void check_search(double elapsed, const Statics& statics) const;
  /// Loads and accelerations stay those of the start while rest is sought.
  void stop_clock() { time_ = 0.0; }

  /// Enters a stage of the run: its settings, soil taken out and placed, displacements from here
  /// on. Collective.
  void begin_stage(std::size_t stage);
  /// Only the settings: for a state that was loaded within the stage.
  void apply_stage(std::size_t stage);

  /// Sends points to their owners, sorts them, and finds where soil is. Collective.
  void redistribute();
  /// Largest stable step of `advance` [s]: courant * limit of the kernel * h / (c + |v|), c the
  /// undrained or the
  /// drag-free compression wave, whichever is faster. Permeability does not enter. Same on all
  /// ranks.
  double stable_step() const;
  /// How long an outer step may be [s]: some explicit steps, or one implicit step whose error is
  /// within the tolerance. Collective.
  double outer_step() const;
  /// What implicit steps took so far; `repeated` ones are not among the steps.
  struct ImplicitEffort {
    std::int64_t steps = 0, repeated = 0, newton_iterations = 0, linear_iterations = 0;
  };
  const ImplicitEffort& implicit_effort() const { return implicit_effort_; }
  bool is_implicit() const { return options_.method == TimeMethod::implicit_steps; }
  /// Opens an outer step [time, time + length]: redistributes and samples the loads at both ends.
  void begin_step(double time, double length, const FluidLoad<D>* water);
  /// One step of `dt` [s] inside the outer step. Throws DivergenceError on all ranks with place and
  /// quantity.
  void advance(double dt);

  /// Where the pore water is on the grid (coupling/unified_coupling.hpp), a step is: points and
  /// rigid bodies move over dt [s] with the velocity of the grains, and what it changed by, on this
  /// rank's own faces; then they leave their sums on the faces again, loads of that time and what
  /// bodies pressed with before included; then bodies press with what the velocity that came of it
  /// still asks for, and walls of friction hold back. All collective; the first throws
  /// DivergenceError on all ranks.
  void move_with(const FaceVector<D>& velocity, const FaceVector<D>& change, double dt);
  const NodeField<NodeSums, D>& load_faces(double dt);
  void press_solids(FaceVector<D>& velocity, double dt);
  void rub_walls(const FaceVector<D>& before, double dt, FaceVector<D>& velocity);

  const SoilOptions& options() const { return options_; }
  std::size_t bodies() const { return points_.size(); }
  SoilParticles<D>& points(std::size_t body) { return points_[body]; }
  const SoilParticles<D>& points(std::size_t body) const { return points_[body]; }
  const BodyConstants& constants(std::size_t body) const { return constants_[body]; }
  const SoilModel& law(std::size_t body) const { return *laws_[body]; }
  bool two_phase() const;
  /// What the formulation cannot do in these soils, in words; the same on all ranks. Collective.
  std::vector<std::string> warnings() const;
  /// Rigid bodies, the same on all ranks.
  const std::vector<Solid>& solids() const { return solids_; }
  std::vector<Solid>& solids() { return solids_; }
  /// Water of a density [kg/m3] flows around them: before the first step.
  void put_solids_in_water(double density);
  /// Cells around the soil, with the reach of the kernels; within this rank's local box.
  const IndexBox<D>& active() const { return active_; }

  /// Grain volume per cell volume [-], and the Darcy resistance mu/kappa [Pa s/m2] that fades with
  /// the grains at the rim, from the points, ghosts included. Collective.
  void solid_fraction(CellField<D>& fraction, CellField<D>& resistance);
  /// What each soil has at its porosity at the start, suction for example, in proportion to the
  /// grains. After solid_fraction(). Collective.
  void spread_over_grains(double (*value)(const SoilBody&), CellField<D>& field);
  /// Pore pressure from a cell field (ghosts valid), plus the excess that the case gives. For the
  /// start.
  void set_pore_pressure(const CellField<D>& pressure);
  /// Velocity of the grains v_s [m/s] on faces, mean over the last outer step; zero where there are
  /// none; on this rank's own faces. What the bed swept in that step is exactly this motion,
  /// elastic waves averaged out.
  const FaceVector<D>& mean_grain_velocity() const { return mean_velocity_; }

  struct Totals {
    double grain_mass = 0.0, water_mass = 0.0;  ///< [kg]
    double kinetic_energy = 0.0;                ///< with the scaled inertia [J]
    Vec<D> momentum{};                          ///< [kg m/s]
    double removed_grain_mass = 0.0;            ///< left through open sides [kg]
    double excavated_grain_mass = 0.0;          ///< taken out at the start of stages [kg]
    double placed_grain_mass = 0.0;             ///< placed at the start of stages [kg]
    long long points = 0;
  };
  Totals totals() const;  ///< over all ranks; collective

  /// Pore water that flows out through a boundary of the case, mean over the last outer step
  /// [m^D/s]. Collective.
  double discharge(const std::string& boundary) const { return side_water_.discharge(boundary); }

  /// Largest distance of a point from its place at the start [m]. Collective.
  double largest_displacement() const;

  /// Is the balance of energy that of the whole run? Implicit steps do not keep it.
  bool keeps_energy() const;

  /// How far from rest the soil is, with the loads at the end of the step; nothing before the first
  /// step. Collective.
  std::optional<Statics> statics();

  /// Work since the start, over all ranks; collective.
  const SoilEnergy& energy() {
    settle_sums();
    return energy_;
  }

  template <class Archive>
  void archive(Archive& a) {
    settle_sums();
    energy_.archive(a);
    for (std::size_t b = 0; b < points_.size(); ++b) points_[b].archive(a, options_.bodies[b].name);
    for (Solid& solid : solids_) solid.archive(a);
    a.number("soil/removed grain mass", removed_grain_mass_);
    a.number("soil/excavated grain mass", excavated_grain_mass_);
    a.number("soil/placed grain mass", placed_grain_mass_);
    a.number("soil/time", time_);
    a.number("soil/next implicit step", next_step_);
    if (projection_) projection_->archive(a);
    side_water_.archive(a);
    if (Archive::loading) side_water_.spread(sides_, halo_);
    absorbing_.archive(a);
    wall_contact_.archive(a);
  }

 private:
  void watch_collisions(bool in_water);
  void gather_nodes() { gather_nodes(time_); }
  void gather_nodes(double body_force_time);
  void gather_sides();
  void solve_nodes(double dt);
  bool damps() const {
    return options_.damping > 0.0 || options_.water_damping.value_or(0.0) > 0.0;
  }
  void damp_face(const NodeSums& sums, double dt, NodeMotion& motion) const;
  void solve_sides(double dt);
  void account_nodes(double dt);
  void solve_face(const NodeSums& sums, double dt, double face_volume, const FaceHold& hold,
                  NodeMotion& motion) const;
  void update_points(double dt);
  std::size_t update_block(std::size_t body, PointRange block, double dt);
  void sort_strays();
  void place_bodies(std::size_t stage);
  double squared_force_on_free_faces();
  void settle_sums();
  void advance_implicitly(double dt, int cuts);
  void advance_in_halves(double dt, int cuts);
  bool solids_leap(double dt) const;
  void find_equilibrium_implicitly();
  void start_bodies_and_sides();
  double drainage_time() const;
  void start_from_rest();
  void begin_implicit_step(double dt);
  ImplicitProblem<D> implicit_problem(const ImplicitSides<D>& sides, double loads_of, double dt);
  ImplicitOutcome solve_implicitly(ImplicitProblem<D> problem);
  void note_failed_stress(std::size_t body, const StressResult& result);
  void report_bad_point(double largest_speed, std::size_t failed) const;

  const Grid<D>* grid_;
  SoilOptions options_;
  Halo<D> halo_;
  std::vector<SoilParticles<D>> points_;
  std::vector<BodyConstants> constants_;
  std::vector<std::unique_ptr<SoilModel>> laws_;
  SurfaceLoads<D> surface_;
  SoilSides<D> sides_;
  SideWater<D> side_water_;
  AbsorbingSides<D> absorbing_;
  WallContact<D> wall_contact_;
  std::optional<PoreProjection<D>> projection_;  ///< where pore pressure is found implicitly
  std::vector<Solid> solids_;
  std::optional<SolidCollisions> collisions_;     ///< of free ones
  std::optional<SolidContact<D>> solid_contact_;  ///< where there are any
  NodeField<NodeSums, D> sums_;
  NodeField<NodeMotion, D> motion_;
  CellField<D> occupied_;
  FaceVector<D> mean_velocity_;
  double length_ = 0.0;  ///< of the open outer step [s]
  PointMotion point_motion_;
  IndexBox<D> active_{};
  double time_ = 0.0;
  double step_ = 0.0;         ///< of the motion being computed [s]
  double travelled_ = 0.0;    ///< bound on how far any point moved since redistribute(), in cells
  bool solids_wait_ = false;  ///< given motion has not begun
  double removed_grain_mass_ = 0.0;     ///< up to the last settle_sums(), over all ranks
  double recently_removed_mass_ = 0.0;  ///< of this rank since then
  double excavated_grain_mass_ = 0.0, placed_grain_mass_ = 0.0;  ///< over all ranks
  SoilStage defaults_;                                           ///< of what a stage may set
  SoilEnergy energy_;         ///< up to the open outer step, over all ranks
  SoilEnergy recent_energy_;  ///< of this rank since then
  ImplicitEffort implicit_effort_;
  double next_step_ = 0.0;     ///< that the last implicit step recommends [s]
  std::string failed_stress_;  ///< the point that a law could not integrate, in words
};

extern template class SoilSolver<2>;
extern template class SoilSolver<3>;

}  // namespace mudlark

#pragma once
/// One water (NUMERICS C2): free and pore water are the flow's, grains live on the points, and one
/// pressure moves both.
///
/// A step t -> t + dt, with the velocities of both at t:
///   1. the points move, and their stress follows;
///   2. porosity and drag of the grains go to the grid (`map_soil_to_grid`);
///   3. the points leave mass, momentum and forces on the faces (`load_grains`);
///   4. the flow moves its water, and solves the momentum of water and grains with the pressure
///      that makes the flux of the two together free of divergence (flow/moving_grains.hpp);
///   5. the grains' velocities wait for the next step (`follow_water`).
#include "coupling/end_of_ground.hpp"
#include "coupling/grain_drag.hpp"
#include "coupling/options.hpp"
#include "coupling/pressure_extension.hpp"
#include "coupling/soil_in_water.hpp"
#include "flow/flow_solver.hpp"
#include "grid/halo.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {

template <int D>
class UnifiedCoupling {
 public:
  UnifiedCoupling(const Grid<D>& grid, const SoilSolver<D>& soil, GrainShare share);

  /// Velocities of the grains at the start, after flow and soil have theirs. Collective.
  void initialise(const FlowSolver<D>& flow, const Space<D>& space, SoilSolver<D>& soil);
  /// Moves the grains under the pressure of the water at rest until they are at rest too
  /// (soil_solver.start_in_equilibrium). After initialise(); porosity, and with it the water, are
  /// to be set again. Throws InputError on all ranks when the soil finds no rest. Collective.
  void find_equilibrium(FlowSolver<D>& flow, const PorousMedium<D>& medium, SoilSolver<D>& soil);
  /// Rigid bodies stand where the space says. Collective.
  void place_solids(const Space<D>& space) { room_.find_reach(space); }

  void map_soil_to_grid(SoilSolver<D>& soil, const PorousMedium<D>& fixed, PorousMedium<D>& medium);
  /// How full pores are at the start where no body of water is. After map_soil_to_grid().
  void map_start(SoilSolver<D>& soil, const PorousMedium<D>& fixed, PorousMedium<D>& medium) const;
  void move_grains(SoilSolver<D>& soil, double dt);
  void load_grains(const FlowSolver<D>& flow, const Space<D>& space, SoilSolver<D>& soil,
                   double dt);
  /// Drag of what load_grains() found ends where the ground does (coupling/end_of_ground.hpp).
  void end_ground(const FlowSolver<D>& flow, const Space<D>& space, SoilSolver<D>& soil);
  void follow_water(const FlowSolver<D>& flow, SoilSolver<D>& soil, double dt);

  /// What follows from a state just loaded. Collective.
  void restore() { halo_.exchange(pressure_); }

  MovingGrains<D>& grains() { return grains_; }
  /// Of the grains, at the end of the last step [kg m/s]. Collective.
  Vec<D> grain_momentum() const;
  /// After a step of dt [s]: work of gravity on grains and water. Collective.
  void add_work(const FlowSolver<D>& flow, const SoilSolver<D>& soil, double dt);
  /// How far grains and water are from rest, after a step. Forces are those on the grains, external
  /// ones their weight and the push of the water; energy is that of both, over the work of gravity
  /// on both since the start. Nothing before the first step. Collective.
  std::optional<Statics> statics(FlowSolver<D>& flow, const PorousMedium<D>& medium,
                                 const SoilSolver<D>& soil);

  template <class Archive>
  void archive(Archive& a) {
    a.faces("grain velocity", grains_.velocity);
    a.faces("grain change", change_);
    a.cells("continued pressure", pressure_);
    a.number("coupling/last step", last_step_);
    a.number("coupling/work of gravity", work_);
  }

 private:
  double damping_force(int axis, const Index<D>& face, double velocity, double damping) const;
  void map_partly_filled(SoilSolver<D>& soil, const PorousMedium<D>& fixed,
                         PorousMedium<D>& medium);
  void spread(double (*value)(const SoilBody&), double most, SoilSolver<D>& soil,
              const CellField<D>& fixed, CellField<D>& field) const;
  /// What water at rest does to the grains.
  struct Push {
    FaceVector<D> per_share;  ///< of a face [N/m3]
    FaceVector<D> menisci;    ///< [N/m3]
  };
  struct Balance;
  double unbalanced_force(int axis, const Index<D>& face, double damping) const;
  Balance step_towards_rest(const Push& push, const FlowSolver<D>& flow, const Space<D>& space,
                            SoilSolver<D>& soil, double dt);
  void find_room(const PorousMedium<D>& fixed, const Space<D>& space);
  void resist_at_sides(const Space<D>& space);
  void note_pore_pressure(const FlowSolver<D>& flow, SoilSolver<D>& soil);
  void extend_into_solids(const FlowSolver<D>& flow);
  void push_beside_solids(const Space<D>& space);

  const Grid<D>* grid_;
  Halo<D> halo_;
  SoilInWater<D> room_;
  EndOfGround<D> end_;
  GrainDrag<D> drag_;
  CellField<D> pressure_;  ///< of the water, continued into bodies and behind closed sides [Pa]
  std::optional<PressureExtension<D>> extension_;  ///< where there are bodies
  CellField<D> open_, wet_;                        ///< cells that are no body; with water
  MovingGrains<D> grains_;
  double strongest_suction_ = 0.0;  ///< of all soils [Pa]
  double last_step_ = 0.0;          ///< [s]
  double work_ = 0.0;               ///< of gravity on grains and water [J], per metre in 2D
  std::optional<Push> push_;        ///< once statics() asked
  FaceVector<D> change_;            ///< of the grains' velocity over the last step [m/s]
  FaceVector<D> before_;            ///< that velocity before it [m/s]
};

extern template class UnifiedCoupling<2>;
extern template class UnifiedCoupling<3>;

}  // namespace mudlark

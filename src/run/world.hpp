#pragma once
/// Everything that a case consists of while it runs.
#include <memory>
#include <optional>

#include "coupling/surface_coupling.hpp"
#include "coupling/unified_coupling.hpp"
#include "flow/flow_solver.hpp"
#include "run/clock.hpp"
#include "run/flow_meters.hpp"
#include "run/ledger.hpp"
#include "run/options.hpp"
#include "run/stage_record.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {

template <int D>
class World {
 public:
  /// Builds grid, solvers and coupling; nothing is seeded yet. Throws InputError.
  World(const CaseOptions& options, MPI_Comm comm);

  /// The state at time zero. Collective.
  void initialise();
  /// Starts from rest where the case asks for it; after initialise(). Collective.
  void find_equilibrium();
  /// Largest outer step that both solvers accept [s]. Collective.
  double stable_step();
  /// One outer step of the paper's flow chart: soil to grid, water, water to soil, soil in small
  /// steps. Collective.
  void advance(double dt);
  /// Enters the stage that follows the one that is over. Collective.
  void begin_next_stage();
  /// What the case asks of methods that cannot do it well, in words. Collective.
  std::vector<std::string> warnings() const;
  /// Brings derived values up to date after a state was loaded. Collective.
  void restore();

  const CaseOptions& options() const { return options_; }
  const Grid<D>& grid() const { return grid_; }
  FlowSolver<D>* flow() { return flow_ ? &*flow_ : nullptr; }
  SoilSolver<D>* soil() { return soil_ ? &*soil_ : nullptr; }
  /// Null without one water.
  UnifiedCoupling<D>* unified() { return unified_ ? &*unified_ : nullptr; }
  const PorousMedium<D>& medium() const { return medium_; }
  Clock& clock() { return clock_; }
  /// Added-mass number a of the coupling for a step [s] (above 1/2 loose coupling would diverge); 0
  /// without coupling.
  double added_mass(double dt) const { return coupling_ ? coupling_->added_mass(dt) : 0.0; }

  /// Seconds spent per phase, and counts, on this rank.
  struct Effort {
    double mapping = 0.0, flow = 0.0, soil = 0.0, output = 0.0;
    std::int64_t soil_steps = 0;
    double smallest_step = 0.0, largest_step = 0.0;            ///< outer [s]
    double smallest_soil_step = 0.0, largest_soil_step = 0.0;  ///< [s]
  };
  Effort& effort() { return effort_; }
  /// How far the soil, and with one water the water too, are from rest. Between steps. Collective.
  std::optional<Statics> statics();

  const Ledger<D>& ledger() const { return ledger_; }
  const FlowMeters<D>& meters() const { return meters_; }
  /// One per stage of the case; those that did not end yet have not `ended`.
  const std::vector<StageRecord>& stages() const { return stages_; }

  template <class Archive>
  void archive(Archive& a) {
    clock_.archive(a);
    ledger_.archive(a);
    meters_.archive(a);
    for (StageRecord& stage : stages_) stage.archive(a);
    if (flow_) flow_->archive(a);
    if (soil_) soil_->archive(a);
    if (coupling_) coupling_->archive(a);
    if (unified_) unified_->archive(a);
  }

 private:
  void advance_flow(double dt);
  void advance_soil(double dt);
  void advance_together(double dt);
  bool at_rest();
  void pass_to_stage_end();

  CaseOptions options_;
  Grid<D> grid_;
  Clock clock_;
  PorousMedium<D> fixed_, medium_;
  std::optional<FlowSolver<D>> flow_;
  std::optional<SoilSolver<D>> soil_;
  std::optional<SurfaceCoupling<D>> coupling_;
  std::optional<UnifiedCoupling<D>> unified_;
  std::optional<FluidLoad<D>> load_;
  Ledger<D> ledger_;
  FlowMeters<D> meters_;
  std::vector<StageRecord> stages_;
  Effort effort_;
};

extern template class World<2>;
extern template class World<3>;

}  // namespace mudlark

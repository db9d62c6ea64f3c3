#include "run/world.hpp"

#include <algorithm>
#include <cmath>

#include "flow/fixed_ground.hpp"
#include "parallel/stopwatch.hpp"
#include "run/doubts.hpp"

namespace mudlark {
namespace {

std::vector<double> gauge_periods(const CaseOptions& options) {
  std::vector<double> periods;
  for (const GaugeOptions& gauge : options.gauges)
    if (gauge.every > 0.0) periods.push_back(gauge.every);
  return periods;
}

/// When tables of what drives soil in implicit steps bend: no step may pass a load that comes and
/// goes. Explicit steps are short enough.
std::vector<double> bends_of(const CaseOptions& options) {
  std::vector<double> bends;
  if (!options.soil || !takes_implicit_steps(*options.soil)) return bends;
  const SoilOptions& soil = *options.soil;
  const auto add = [&](const Varying& value) {
    bends.insert(bends.end(), value.bends.begin(), value.bends.end());
  };
  for (const SurfaceLoad& load : soil.loads) add(load.pressure);
  if (soil.body_acceleration)
    for (const Varying& component : *soil.body_acceleration) add(component);
  for (const SoilBoundary& boundary : soil.boundaries) {
    add(boundary.value);
    for (const Varying& component : boundary.motion) add(component);
  }
  for (const SolidOptions& solid : soil.solids) {
    if (const auto* led = std::get_if<PrescribedSolid>(&solid.motion))
      for (std::size_t a = 0; a < 3; ++a) add(led->translation[a]), add(led->rotation[a]);
    if (const auto* free = std::get_if<FreeSolid>(&solid.motion))
      for (std::size_t a = 0; a < 3; ++a) add(free->force[a]), add(free->moment[a]);
  }
  std::sort(bends.begin(), bends.end());
  return bends;
}

}  // namespace

template <int D>
World<D>::World(const CaseOptions& options, MPI_Comm comm)
    : options_(options),
      grid_(options.domain, comm),
      clock_(options.time, gauge_periods(options), bends_of(options)),
      fixed_(grid_),
      medium_(grid_),
      meters_(grid_, options.gauges) {
  if (options.flow) {
    flow_.emplace(grid_, *options.flow);
    fill_fixed_ground(grid_, *options.flow, fixed_);
    fill_fixed_ground(grid_, *options.flow, medium_);
  }
  if (options.soil) {
    soil_.emplace(grid_, *options.soil);
    for (const SoilStage& stage : options.soil->stages) stages_.push_back({stage.name});
    if (!stages_.empty()) stages_.front().began = 0.0;
  }
  if (flow_ && soil_ && options.coupling.mode == CouplingMode::surface) {
    coupling_.emplace(grid_, options.coupling, *options.flow, *soil_);
    load_.emplace(grid_);
  }
  if (flow_ && soil_ && options.coupling.mode == CouplingMode::unified) {
    unified_.emplace(grid_, *soil_, options.coupling.grain_share);
    soil_->put_solids_in_water(options.flow->density);
    flow_->follow_leaders(soil_->solids());
    if (const double bulk = options.soil->water_bulk_modulus; std::isfinite(bulk))
      flow_->let_water_give_way(1.0 / bulk);
    for (const SoilBody& body : options.soil->bodies)
      if (body.filling.residual > 0.0) flow_->keep_residual_water();
  }
}

template <int D>
void World<D>::initialise() {
  if (soil_) soil_->initialise();
  if (flow_) flow_->place_solids(medium_);
  if (unified_) unified_->place_solids(medium_.space);
  if (coupling_) coupling_->map_soil_to_grid(*soil_, fixed_, medium_);
  if (unified_) unified_->map_soil_to_grid(*soil_, fixed_, medium_);
  if (unified_) unified_->map_start(*soil_, fixed_, medium_);
  if (flow_) flow_->initialise(medium_);
  if (unified_) unified_->initialise(*flow_, medium_.space, *soil_);
  if (coupling_) coupling_->initialise(*flow_, *soil_, *load_);
  ledger_ = open_ledger(*this);
}

template <int D>
void World<D>::find_equilibrium() {
  if (!soil_ || !soil_->options().start_in_equilibrium) return;
  if (!unified_) return soil_->find_equilibrium();
  unified_->find_equilibrium(*flow_, medium_, *soil_);
  unified_->map_soil_to_grid(*soil_, fixed_, medium_);
  unified_->map_start(*soil_, fixed_, medium_);
  flow_->initialise(medium_);  // the same water between grains that have moved
  unified_->initialise(*flow_, medium_.space, *soil_);
  ledger_ = open_ledger(*this);
}

template <int D>
std::vector<std::string> World<D>::warnings() const {
  std::vector<std::string> all = doubts(options_);
  if (soil_)
    for (std::string& warning : soil_->warnings()) all.push_back(std::move(warning));
  if (flow_ && flow_->solids().moving())
    all.emplace_back(
        "a [[solid]] moves through water. Where it enters or leaves through the surface single "
        "steps may have twice the right force, and more where water closes over it; take means "
        "over some of them (docs/methods/bodies-in-water.md).");
  return all;
}

template <int D>
void World<D>::restore() {
  if (soil_) {
    soil_->apply_stage(clock_.stage());
    soil_->redistribute();
  }
  if (flow_) flow_->place_solids(medium_);
  if (unified_) {
    unified_->restore();
    unified_->place_solids(medium_.space);
    unified_->map_soil_to_grid(*soil_, fixed_, medium_);
  }
  if (flow_) flow_->restore(medium_);
  if (!coupling_) return;
  coupling_->restore();
  coupling_->map_soil_to_grid(*soil_, fixed_, medium_);
}

template <int D>
double World<D>::stable_step() {
  if (unified_) return std::min(flow_->stable_step(medium_), soil_->stable_step());
  if (flow_) return flow_->stable_step(medium_);
  return soil_->outer_step();
}

template <int D>
void World<D>::advance(double dt) {
  if (unified_) {
    advance_together(dt);
  } else {
    if (flow_) advance_flow(dt);
    if (soil_) advance_soil(dt);
  }
  clock_.advance(dt);
  effort_.largest_step = std::max(effort_.largest_step, dt);
  effort_.smallest_step = effort_.smallest_step > 0.0 ? std::min(effort_.smallest_step, dt) : dt;
  StageRecord* stage = stages_.empty() ? nullptr : &stages_[clock_.stage()];
  if (at_rest()) {
    if (stage) stage->rested = clock_.time();
    if (clock_.in_last_stage())
      clock_.stop();
    else
      pass_to_stage_end();
  }
  if (stage && (clock_.stage_over() || clock_.finished())) stage->ended = clock_.time();
}

/// Has the soil, and with one water the water, come to rest, where the case asks for it?
template <int D>
bool World<D>::at_rest() {
  if (!soil_ || !soil_->options().stop_when_static) return false;
  const RestCriterion& criterion = *soil_->options().stop_when_static;
  const double began = stages_.empty() ? 0.0 : stages_[clock_.stage()].began;
  return clock_.time() >= began + criterion.after && statics()->at_rest(criterion);
}

template <int D>
void World<D>::pass_to_stage_end() {
  clock_.pass_to_stage_end();
  if (!unified_) return;
  flow_->rest_until(clock_.time());
  soil_->begin_step(clock_.time(), 0.0, nullptr);
}

template <int D>
std::optional<Statics> World<D>::statics() {
  if (!soil_) return {};
  return unified_ ? unified_->statics(*flow_, medium_, *soil_) : soil_->statics();
}

template <int D>
void World<D>::begin_next_stage() {
  clock_.begin_next_stage();
  const auto before = soil_->totals();
  soil_->begin_stage(clock_.stage());
  const auto after = soil_->totals();
  StageRecord& stage = stages_[clock_.stage()];
  stage.began = clock_.time();
  stage.excavated = after.excavated_grain_mass - before.excavated_grain_mass;
  stage.placed = after.placed_grain_mass - before.placed_grain_mass;
}

template <int D>
void World<D>::advance_flow(double dt) {
  const double time = clock_.time();
  if (coupling_) {
    const Stopwatch watch(effort_.mapping);
    coupling_->map_flow_at_begin(*flow_, *soil_, time, *load_);
  }
  {
    const Stopwatch watch(effort_.flow);
    flow_->move_solids(medium_, dt);
    flow_->advance(medium_, dt);
    flow_->drive_solids(dt);
    meters_.read(*flow_, dt);
  }
  if (!coupling_) return;
  const Stopwatch watch(effort_.mapping);
  coupling_->map_flow_at_end(*flow_, *soil_, time + dt, *load_);
}

/// One step of one water (NUMERICS C2): the points move, then the water, then one pressure
/// moves both.
template <int D>
void World<D>::advance_together(double dt) {
  {
    const Stopwatch watch(effort_.soil);
    unified_->move_grains(*soil_, dt);
  }
  {
    const Stopwatch watch(effort_.mapping);
    if (flow_->solids().moving()) {
      flow_->move_solids(medium_, dt);
      flow_->place_leaders(soil_->solids(), dt);
      unified_->place_solids(medium_.space);
    }
    unified_->map_soil_to_grid(*soil_, fixed_, medium_);
  }
  {
    const Stopwatch watch(effort_.soil);
    unified_->load_grains(*flow_, medium_.space, *soil_, dt);
    unified_->end_ground(*flow_, medium_.space, *soil_);
  }
  const Stopwatch watch(effort_.flow);
  flow_->advance(medium_, dt, &unified_->grains());
  flow_->push_solids(soil_->solids(), dt);
  unified_->follow_water(*flow_, *soil_, dt);
  unified_->add_work(*flow_, *soil_, dt);
  flow_->follow_leaders(soil_->solids());
  meters_.read(*flow_, dt);
  effort_.soil_steps += 1;
  effort_.largest_soil_step = std::max(effort_.largest_soil_step, dt);
  effort_.smallest_soil_step =
      effort_.smallest_soil_step > 0.0 ? std::min(effort_.smallest_soil_step, dt) : dt;
}

template <int D>
void World<D>::advance_soil(double dt) {
  {
    const Stopwatch watch(effort_.soil);
    soil_->begin_step(clock_.time(), dt, coupling_ ? &*load_ : nullptr);
    const double count = soil_->is_implicit()
                             ? 1.0
                             : std::max(1.0, std::ceil(dt / soil_->stable_step() * (1.0 - 1e-12)));
    const double sub = dt / count;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(count); ++i) soil_->advance(sub);
    effort_.soil_steps += static_cast<std::int64_t>(count);
    effort_.largest_soil_step = std::max(effort_.largest_soil_step, sub);
    effort_.smallest_soil_step =
        effort_.smallest_soil_step > 0.0 ? std::min(effort_.smallest_soil_step, sub) : sub;
    // Sums over points depend on their order to the last bit: it is that of a state just loaded.
    if (coupling_) soil_->redistribute();
  }
  const Stopwatch watch(effort_.mapping);
  if (!coupling_) return;
  coupling_->relax_bed_velocity(*soil_, dt);
  coupling_->map_soil_to_grid(*soil_, fixed_, medium_);
}

template class World<2>;
template class World<3>;

}  // namespace mudlark

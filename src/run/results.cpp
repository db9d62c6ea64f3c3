#include "run/results.hpp"

#include <algorithm>
#include <array>

#include "base/version.hpp"
#include "output/checkpoint.hpp"
#include "run/continuation.hpp"
#include "run/gauges.hpp"
#include "run/ledger.hpp"

namespace mudlark {
namespace {

/// The points of all bodies one after another, as named arrays for the writer.
template <int D>
class PointTable {
 public:
  explicit PointTable(SoilSolver<D>& soil) {
    for (std::size_t b = 0; b < soil.bodies(); ++b) {
      auto& points = soil.points(b);
      ids.insert(ids.end(), points.id.begin(), points.id.end());
      add(0, points.position);
      add(D, points.start);
      add(3 * D, points.velocity);
      add(4 * D, points.water_velocity);
      add(5 * D, points.stress);
      columns_[5 * D + 6].insert(columns_[5 * D + 6].end(), points.pore_pressure.begin(),
                                 points.pore_pressure.end());
      for (std::size_t p = 0; p < points.size(); ++p) {
        for (int a = 0; a < D; ++a)
          columns_[static_cast<std::size_t>(2 * D + a)].push_back(points.position[a][p] -
                                                                  points.start[a][p]);
        const double grains =
            points.grain_mass[p] / (soil.constants(b).grain_density * points.volume[p]);
        columns_[5 * D + 7].push_back(1.0 - grains);
        columns_[5 * D + 8].push_back(points.volume[p]);
        columns_[5 * D + 9].push_back(static_cast<double>(b));
      }
    }
    for (std::size_t b = 0; b < soil.bodies(); ++b) name_states(soil.points(b));
    for (std::size_t s = 0; s < states_.size(); ++s)
      for (std::size_t b = 0; b < soil.bodies(); ++b) add_state(states_[s], soil.points(b));
  }

  std::vector<PointArray> arrays() const {
    auto all = fixed_arrays();
    for (const State& state : states_)
      all.push_back({state.name, state.unit, {state.values.data()}});
    return all;
  }
  std::vector<std::int64_t> ids;

 private:
  /// A state variable of some soil laws; zero at points of the others.
  struct State {
    std::string name, unit;
    std::vector<double> values = {};
  };

  void name_states(const SoilParticles<D>& points) {
    for (std::size_t h = 0; h < points.history_names.size(); ++h) {
      const std::string& name = points.history_names[h];
      const auto known = [&](const State& state) { return state.name == name; };
      if (std::none_of(states_.begin(), states_.end(), known))
        states_.push_back({name, points.history_units[h]});
    }
  }
  static void add_state(State& state, const SoilParticles<D>& points) {
    const auto& names = points.history_names;
    const auto found = std::find(names.begin(), names.end(), state.name);
    if (found == names.end()) {
      state.values.resize(state.values.size() + points.size(), 0.0);
    } else {
      const auto& values = points.history[static_cast<std::size_t>(found - names.begin())];
      state.values.insert(state.values.end(), values.begin(), values.end());
    }
  }

  std::vector<PointArray> fixed_arrays() const {
    return {array("position", "m", 0, D),
            array("initial position", "m", D, D),
            array("displacement", "m", 2 * D, D),
            array("velocity", "m/s", 3 * D, D),
            array("water velocity", "m/s", 4 * D, D),
            array("effective stress", "Pa", 5 * D, 6),
            array("pore pressure", "Pa", 5 * D + 6, 1),
            array("porosity", "1", 5 * D + 7, 1),
            array("volume", D == 2 ? "m2" : "m3", 5 * D + 8, 1),
            array("soil", "1", 5 * D + 9, 1)};
  }
  template <int N>
  void add(std::size_t column, const PointQuantity<N>& quantity) {
    for (int c = 0; c < N; ++c, ++column)
      columns_[column].insert(columns_[column].end(), quantity[c].begin(), quantity[c].end());
  }
  PointArray array(const char* name, const char* unit, std::size_t first, int count) const {
    PointArray out{name, unit, {}};
    for (int c = 0; c < count; ++c)
      out.components.push_back(columns_[first + static_cast<std::size_t>(c)].data());
    return out;
  }

  std::array<std::vector<double>, 5 * D + 10> columns_;
  std::vector<State> states_;
};

/// W per volume of the cell itself: the solver's counts per mean cell of a stretched grid.
template <int D>
CellField<D> water_per_cell(World<D>& world) {
  const Grid<D>& grid = world.grid();
  CellField<D> share(grid, "water fraction", "1");
  for_each(grid.owned(), [&](const Index<D>& cell) {
    double size = 1.0;
    for (int a = 0; a < D; ++a) size *= grid.width(a, cell[a]) / grid.spacing()[a];
    share[cell] = world.flow()->water_fraction()[cell] / size;
  });
  return share;
}

/// Of what grains and bodies leave of each cell, what water fills.
template <int D>
CellField<D> water_per_room(World<D>& world) {
  const FlowSolver<D>& flow = *world.flow();
  CellField<D> share(world.grid(), "saturation", "1");
  for_each(world.grid().owned(), [&](const Index<D>& cell) {
    const double room = flow.porosity()[cell];
    share[cell] = room > 0.0 ? flow.water_fraction()[cell] / room : 0.0;
  });
  return share;
}

/// How much of each cell rigid bodies fill, from the distance of its centre to their surface.
template <int D>
CellField<D> solid_share(World<D>& world) {
  const Grid<D>& grid = world.grid();
  CellField<D> share(grid, "solid", "1");
  if (world.flow()) {
    for_each(grid.owned(), [&](const Index<D>& cell) {
      share[cell] = 1.0 - world.flow()->solids().open_volume()[cell];
    });
    return share;
  }
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const Point3 centre = to_point3(grid.cell_centre(cell));
    for (const Solid& solid : world.soil()->solids()) {
      if (!solid.near(centre, grid.smallest_spacing())) continue;
      const double away = solid.distance(centre).distance / grid.smallest_spacing();
      share[cell] = std::max(share[cell], std::clamp(0.5 - away, 0.0, 1.0));
    }
  });
  return share;
}

/// Work by name [J]; what is left between them is what transfers and time steps take.
template <int D>
std::vector<std::pair<std::string, double>> soil_energy(SoilSolver<D>& soil) {
  const SoilEnergy& energy = soil.energy();
  const double kinetic = soil.totals().kinetic_energy;
  const double scheme = energy.external - energy.internal - energy.drag - energy.damping -
                        (kinetic - energy.start_kinetic);
  return {{"kinetic", kinetic},
          {"kinetic at start", energy.start_kinetic},
          {"external work", energy.external},
          {"internal work", energy.internal},
          {"drag", energy.drag},
          {"damping", energy.damping},
          {"taken by the scheme", scheme}};
}

/// What the flow's share of the time went into.
std::vector<std::pair<std::string, double>> parts_of(const FlowEffort& effort) {
  return {{"interface [s]", effort.interface},
          {"momentum [s]", effort.momentum},
          {"forces [s]", effort.forces},
          {"pressure [s]", effort.pressure},
          {"extension [s]", effort.extension},
          {"multigrid cycles", static_cast<double>(effort.cycles)}};
}

}  // namespace

template <int D>
Results<D>::Results(World<D>& world, std::filesystem::path folder, std::optional<double> resumed_at)
    : folder_(std::move(folder)),
      resumed_(resumed_at.has_value()),
      started_(MPI_Wtime()),
      last_output_(resumed_at) {
  const MPI_Comm comm = world.grid().comm();
  const bool first = world.grid().rank() == 0;
  if (first) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << world.options().resolved_toml;
    log_.open(folder_ / "log.txt", resumed_ ? std::ios::app : std::ios::trunc);
  }
  MPI_Barrier(comm);
  if (!resumed_) remove_checkpoints(folder_ / "checkpoint", comm);
  fields_.emplace(world.grid(), folder_, resumed_at);
  if (world.soil()) points_.emplace_back(comm, folder_, resumed_at);
  for (const GaugeOptions& gauge : world.options().gauges)
    gauges_.emplace_back(comm, folder_, gauge.name, gauge_columns(gauge, D), resumed_at);
}

template <int D>
void Results<D>::write_due(World<D>& world) {
  const double begin = MPI_Wtime();
  write_gauges(world);
  if (world.clock().output_due() && last_output_ != world.clock().time()) write_fields(world);
  world.effort().output += MPI_Wtime() - begin;
}

template <int D>
void Results<D>::write_fields(World<D>& world) {
  last_output_ = world.clock().time();
  std::vector<const CellField<D>*> cells;
  std::vector<const FaceVector<D>*> faces;
  std::optional<CellField<D>> per_cell, per_room;
  if (FlowSolver<D>* flow = world.flow()) {
    cells = {&per_room.emplace(water_per_room(world)), &per_cell.emplace(water_per_cell(world)),
             &flow->pressure()};
    if (flow->turbulence())
      for (const CellField<D>* field : flow->turbulence()->fields()) cells.push_back(field);
    faces = {&flow->velocity()};
  }
  cells.push_back(&world.medium().porosity);
  std::optional<CellField<D>> solid;
  if ((world.soil() && !world.soil()->solids().empty()) ||
      (world.flow() && !world.flow()->solids().empty()))
    cells.push_back(&solid.emplace(solid_share(world)));
  fields_->write(world.clock().time(), world.clock().step(), cells, faces);
  if (!world.soil()) return;
  const PointTable<D> table(*world.soil());
  points_.front().write(world.clock().time(), world.clock().step(), table.ids, table.arrays());
}

template <int D>
void Results<D>::write_gauges(World<D>& world) {
  const double time = world.clock().time();
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    const GaugeOptions& gauge = world.options().gauges[g];
    if (Clock::due(time, gauge.every) || world.clock().at_stage_end() || world.clock().finished())
      gauges_[g].sample(time, read_gauge(world, gauge));
  }
}

template <int D>
void Results<D>::write_checkpoint(World<D>& world) {
  const double begin = MPI_Wtime();
  for (GaugeWriter& gauge : gauges_) gauge.flush();
  CheckpointWriter<D> archive(world.grid(), folder_ / "checkpoint",
                              lasting_part(world.options().resolved_toml), world.clock().step(),
                              world.clock().time());
  world.archive(archive);
  archive.commit();
  world.effort().output += MPI_Wtime() - begin;
}

template <int D>
Summary Results<D>::describe(World<D>& world) const {
  Summary summary;
  summary.title = world.options().title;
  summary.version = program_version();
  summary.commit = program_commit();
  summary.dimension = D;
  summary.ranks = world.grid().ranks();
  summary.resumed = resumed_;
  summary.cells = 1;
  for (int a = 0; a < D; ++a) summary.cells *= world.grid().cells()[a];
  const auto& effort = world.effort();
  summary.points = world.soil() ? world.soil()->totals().points : 0;
  summary.steps = world.clock().step();
  summary.soil_steps = effort.soil_steps;
  summary.time = world.clock().time();
  summary.end_time = world.options().time.end;
  summary.smallest_step = effort.smallest_step;
  summary.largest_step = effort.largest_step;
  summary.wall_seconds = MPI_Wtime() - started_;
  summary.cpu_seconds = cpu_seconds(world.grid().comm());
  summary.phase_seconds = {{"flow", effort.flow},
                           {"soil", effort.soil},
                           {"mapping", effort.mapping},
                           {"output", effort.output}};
  if (world.flow()) summary.flow_effort = parts_of(world.flow()->effort());
  summary.conservation_errors = conservation_errors(world);
  for (const StageRecord& stage : world.stages())
    if (stage.began >= 0.0)
      summary.stages.push_back({stage.name, stage.began,
                                stage.ended >= 0.0 ? stage.ended : world.clock().time(),
                                stage.rested >= 0.0 ? std::optional(stage.rested) : std::nullopt,
                                stage.excavated, stage.placed});
  if (world.soil() && world.soil()->keeps_energy())
    summary.soil_energy = soil_energy(*world.soil());
  summary.solids = describe_solids(world);
  if (world.soil() && world.soil()->implicit_effort().newton_iterations > 0) {
    const auto& implicit = world.soil()->implicit_effort();
    summary.implicit_effort = {
        {"steps", static_cast<double>(implicit.steps)},
        {"repeated", static_cast<double>(implicit.repeated)},
        {"Newton iterations", static_cast<double>(implicit.newton_iterations)},
        {"linear iterations", static_cast<double>(implicit.linear_iterations)}};
  }
  for (const GaugeWriter& gauge : gauges_)
    summary.gauges.push_back({gauge.name(), gauge.columns(), gauge.extremes()});
  summary.peak_memory_bytes = peak_memory(world.grid().comm());
  return summary;
}

template <int D>
void Results<D>::write_summary(World<D>& world, const std::string& status,
                               const std::string& message) {
  for (GaugeWriter& gauge : gauges_) gauge.flush();
  Summary summary = describe(world);
  summary.status = status;
  summary.message = message;
  // Of points that flew away nothing more can be said.
  if (world.soil() && status != "diverged")
    if (const auto statics = world.statics())
      summary.soil_statics = {{"unbalanced force / external force", statics->unbalanced_force},
                              {"kinetic energy / external work", statics->kinetic_energy}};
  mudlark::write_summary(folder_, summary, world.grid().comm());
}

template <int D>
void Results<D>::log(const std::string& line) {
  if (log_.is_open()) log_ << line << std::endl;
}

template class Results<2>;
template class Results<3>;

}  // namespace mudlark

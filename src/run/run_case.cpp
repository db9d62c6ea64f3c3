#include "run/run_case.hpp"

#include <fmt/format.h>

#include "output/checkpoint.hpp"
#include "run/continuation.hpp"
#include "run/time_loop.hpp"

namespace mudlark {
namespace {

template <int D>
ExitCode run_in(const CaseOptions& options, const RunSettings& settings) {
  World<D> world(options, settings.comm);
  std::optional<double> resumed_at;
  world.initialise();
  if (settings.resume) {
    const bool first = world.grid().rank() == 0;
    CheckpointReader<D> archive(world.grid(), settings.results / "checkpoint",
                                lasting_part(options.resolved_toml), [&](const std::string& note) {
                                  if (first) fmt::print(stderr, "{}\n", note);
                                });
    world.archive(archive);
    archive.finish();
    world.restore();
    resumed_at = world.clock().time();
  } else {
    world.find_equilibrium();
  }
  const InterruptGuard guard;
  Results<D> results(world, settings.results, resumed_at);
  return run_to_end(world, results, settings, guard);
}

/// Microseconds per cell and flow step, and per point and soil step, on one core (docs/validation,
/// benchmarks/).
constexpr double flow_cell_step = 1.5e-6, soil_point_step = 0.4e-6;

template <int D>
CaseEstimate estimate_in(const CaseOptions& options, MPI_Comm comm,
                         const std::optional<std::filesystem::path>& results_folder) {
  World<D> world(options, comm);
  world.initialise();
  if (results_folder) {
    Results<D> results(world, *results_folder, std::nullopt);
    results.write_fields(world);
    results.write_summary(world, "running", "initial state only");
  }
  CaseEstimate estimate;
  estimate.cells = 1;
  for (int a = 0; a < D; ++a) estimate.cells *= world.grid().cells()[a];
  const double end = options.time.end;
  if (world.flow()) {
    estimate.flow_step = world.stable_step();
    *estimate.cpu_seconds +=
        end / estimate.flow_step * static_cast<double>(estimate.cells) * flow_cell_step;
  }
  if (world.soil()) {
    estimate.points = world.soil()->totals().points;
    if (takes_implicit_steps(*options.soil)) {
      estimate.cpu_seconds.reset();
    } else {
      estimate.soil_step = world.soil()->stable_step();
      *estimate.cpu_seconds +=
          end / estimate.soil_step * static_cast<double>(estimate.points) * soil_point_step;
    }
  }
  estimate.warnings = world.warnings();
  if (const auto step = options.time.step;
      step && estimate.flow_step > 0.0 && *step > estimate.flow_step)
    estimate.warnings.push_back(fmt::format(
        "time.step = {:g} s is longer than the water can take when the run starts, {:.3g} s: the "
        "run stops at a step that is too long. Leave it out, or write max_step, which is shortened "
        "where that is needed.",
        *step, estimate.flow_step));
  constexpr double day = 86400.0;  // [s]
  if (world.soil() && estimate.cpu_seconds.value_or(0.0) > day)
    estimate.warnings.push_back(fmt::format(
        "steps of {:.2g} s would take days of computing. Slow processes take {}.",
        estimate.soil_step,
        world.flow() ? "soil_solver.mass_scaling where pore_water is \"unified\""
                     : "soil_solver.method = \"implicit\", or soil_solver.mass_scaling"));
  estimate.memory = peak_memory(comm);
  return estimate;
}

}  // namespace

ExitCode run_case(const CaseOptions& options, const RunSettings& settings) {
  CaseOptions timed = options;
  if (settings.until) timed.time.end = *settings.until;
  return timed.domain.dimension == 2 ? run_in<2>(timed, settings) : run_in<3>(timed, settings);
}

CaseEstimate estimate_case(const CaseOptions& options, MPI_Comm comm,
                           const std::optional<std::filesystem::path>& results) {
  return options.domain.dimension == 2 ? estimate_in<2>(options, comm, results)
                                       : estimate_in<3>(options, comm, results);
}

}  // namespace mudlark

#include "run/time_loop.hpp"

#include <fmt/format.h>

#include <array>

#include "base/version.hpp"
#include "flow/flow_checks.hpp"
#include "output/summary.hpp"
#include "run/progress.hpp"

namespace mudlark {
namespace {

/// Share of the longest step so far below which one of flowing water says that something has gone
/// wrong.
constexpr double hopeless_share = 1e-8;

/// What all ranks must agree on after a step: has anyone been interrupted, and is rank 0's time for
/// a checkpoint up?
struct Agreement {
  bool stop = false, save = false;
};

Agreement agree(MPI_Comm comm, bool save_due) {
  const std::array<int, 2> mine{InterruptGuard::requested() ? 1 : 0, save_due ? 1 : 0};
  std::array<int, 2> all{};
  MPI_Allreduce(mine.data(), all.data(), 2, MPI_INT, MPI_MAX, comm);
  return {all[0] != 0, all[1] != 0};
}

/// Says once in the log when loose coupling would have diverged, and what is done about it.
template <int D>
void note_added_mass(World<D>& world, Results<D>& results, double dt, bool& noted) {
  const double a = world.added_mass(dt);
  if (noted || a <= 0.5) return;
  noted = true;
  results.log(fmt::format(
      "t = {:.6g} s: added mass of the water on the soil, a = rho_w H / (Z dt) = {:.3g}, is above "
      "1/2: loose "
      "coupling would diverge; the water sees the bed's velocity relaxed by 1/(1 + 2 a {:g}).",
      world.clock().time(), a, world.options().coupling.added_mass_factor));
}

/// Has soil moved further than the run is meant for?
template <int D>
bool moved_too_far(World<D>& world, const RunSettings& settings) {
  return settings.largest_displacement && world.soil() &&
         world.soil()->largest_displacement() > *settings.largest_displacement;
}

/// Water that takes ever shorter steps has gone wrong.
template <int D>
void check_hope(World<D>& world, double stable) {
  if (!world.flow() || stable >= hopeless_share * world.effort().largest_step) return;
  const FastestPlace<D> fastest = world.flow()->max_speed();
  throw DivergenceError(
      fmt::format("the stable step fell to {:.3g} s; the run would not come to its end. The "
                  "fastest water, {:.3g} "
                  "m/s, is at {}.",
                  stable, fastest.speed, place_text(fastest.position)));
}

/// The lines of log.txt: what runs, how far it is every few seconds, how it ended.
template <int D>
class RunLog {
 public:
  RunLog(World<D>& world, Results<D>& results, bool resumed, bool quiet)
      : world_(&world), results_(&results) {
    results.log(fmt::format("{}: Mudlark {} ({}), {} ranks, {} from t = {:.9g} s to {:.9g} s",
                            world.options().title, program_version(), program_commit(),
                            world.grid().ranks(), resumed ? "resumed" : "started",
                            world.clock().time(), world.options().time.end));
    for (const std::string& warning : world.warnings()) {
      results.log("warning: " + warning);
      if (world.grid().rank() == 0 && !quiet) fmt::print(stderr, "warning: {}\n", warning);
    }
  }
  void stage() {
    const std::size_t number = world_->clock().stage();
    const StageRecord& stage = world_->stages().at(number);
    if (const StageRecord* last = number > 0 ? &stage - 1 : nullptr; last && last->rested >= 0.0)
      results_->log(fmt::format("t = {:.9g} s: at rest", last->rested));
    std::string line = fmt::format("t = {:.9g} s: stage {}", world_->clock().time(), stage.name);
    if (stage.excavated > 0.0)
      line += fmt::format(", {:.6g} kg of grains taken out", stage.excavated);
    if (stage.placed > 0.0) line += fmt::format(", {:.6g} kg of grains placed", stage.placed);
    results_->log(line);
  }
  void step(double dt) {
    if (MPI_Wtime() - written_ < seconds_between_lines) return;
    written_ = MPI_Wtime();
    results_->log(fmt::format("t = {:.9g} s, step {}, dt = {:.4g} s", world_->clock().time(),
                              world_->clock().step(), dt));
  }
  void end(const char* how) {
    results_->log(fmt::format("{} at t = {:.9g} s, step {}", how, world_->clock().time(),
                              world_->clock().step()));
  }

 private:
  static constexpr double seconds_between_lines = 5.0;
  World<D>* world_;
  Results<D>* results_;
  double written_ = MPI_Wtime();
};

}  // namespace

template <int D>
ExitCode run_to_end(World<D>& world, Results<D>& results, const RunSettings& settings,
                    const InterruptGuard&) {
  Clock& clock = world.clock();
  const bool first = world.grid().rank() == 0;
  Progress progress(first && !settings.quiet, clock.time(), world.options().time.end);
  double saved = MPI_Wtime();
  bool noted = false;
  RunLog<D> log(world, results, settings.resume, settings.quiet);
  try {
    results.write_due(world);
    results.write_summary(world, "running", "");
    if (!settings.resume)
      results.write_checkpoint(world);  // so that every failure leaves a good state
    if (!world.stages().empty()) log.stage();
    while (!clock.finished()) {
      if (clock.stage_over()) {
        world.begin_next_stage();
        log.stage();
      }
      const double stable = world.stable_step();
      check_hope(world, stable);
      const double dt = clock.choose_step(stable);
      world.advance(dt);
      if (moved_too_far(world, settings)) clock.stop();
      note_added_mass(world, results, dt, noted);
      results.write_due(world);
      log.step(dt);
      progress.show(clock.time(), clock.step(), dt, clock.finished());
      const bool due = first && MPI_Wtime() - saved > world.options().time.checkpoint_every;
      const Agreement agreement = agree(world.grid().comm(), due);
      if (agreement.stop || agreement.save) {
        results.write_checkpoint(world);
        saved = MPI_Wtime();
      }
      if (agreement.stop && !clock.finished()) {
        log.end("interrupted");
        results.write_summary(world, "interrupted",
                              fmt::format("interrupted at t = {:.9g} s", clock.time()));
        return ExitCode::interrupted;
      }
    }
    results.write_checkpoint(world);
    log.end(moved_too_far(world, settings) ? "moved too far"
            : clock.stopped()              ? "at rest"
                                           : "done");
    results.write_summary(world, "done", "");
    return ExitCode::done;
  } catch (const DivergenceError& error) {
    const std::string message =
        fmt::format("t = {:.9g} s, step {}: {}\nThe last good state is in {}.", clock.time(),
                    clock.step(), error.what(), (results.folder() / "checkpoint").string());
    results.log(message);
    results.write_summary(world, "diverged", message);
    throw DivergenceError(message);
  } catch (const std::exception& error) {
    if (first) {
      results.log(error.what());
      mark_failed(results.folder(), error.what());
    }
    throw;
  }
}

template ExitCode run_to_end(World<2>&, Results<2>&, const RunSettings&, const InterruptGuard&);
template ExitCode run_to_end(World<3>&, Results<3>&, const RunSettings&, const InterruptGuard&);

}  // namespace mudlark

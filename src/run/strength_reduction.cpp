#include "run/strength_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "materials/strength_reduction.hpp"
#include "output/files.hpp"
#include "run/time_loop.hpp"

namespace mudlark {
namespace {

void check(const CaseOptions& options, const StrengthReductionSettings& settings) {
  if (!options.soil) throw InputError("strength reduction: the case has no [[soil]]");
  if (options.flow && options.coupling.mode != CouplingMode::unified)
    throw InputError(
        "strength reduction: free water ([[water.body]]) goes with coupling.mode = \"unified\" "
        "only, where rest is that of soil and water together. Write it, with pore_water = "
        "\"unified\" in each [[soil]], or leave the water out and give its weight as a [[load]].");
  const auto& stages = options.soil->stages;
  if (!options.soil->stop_when_static && (stages.empty() || !stages.back().stop_when_static))
    throw InputError(
        "strength reduction needs soil_solver.stop_when_static, or that of the last stage: the "
        "soil stands when it comes to "
        "rest before time.end. Add stop_when_static = {} and, to get there, damping = 0.7.");
  if (options.soil->start_in_equilibrium)
    throw InputError(
        "strength reduction: leave soil_solver.start_in_equilibrium out; whether the soil finds "
        "rest is what each trial asks.");
  if (!(settings.lower > 0.0) || !(settings.upper > settings.lower))
    throw InputError(fmt::format("--lower {:g} --upper {:g} is not possible: 0 < lower < upper",
                                 settings.lower, settings.upper));
  if (!(settings.tolerance >= 1e-4))
    throw InputError(
        fmt::format("--tolerance {:g} is not possible: at least 0.0001", settings.tolerance));
  if (settings.largest_displacement && !(*settings.largest_displacement > 0.0))
    throw InputError("--largest-displacement must be above 0 m");
}

std::string name_of(double factor) { return fmt::format("{:.10g}", factor); }

CaseOptions weakened(const CaseOptions& options, double factor) {
  CaseOptions weak = options;
  for (SoilBody& body : weak.soil->bodies) body.law = reduced(body.law, factor);
  weak.title += fmt::format(" (strength reduced by {})", name_of(factor));
  weak.resolved_toml = fmt::format(
      "# A trial of strength reduction: this is the case with full strength. In this run\n"
      "# strengths are divided by F = {}.\n{}",
      name_of(factor), options.resolved_toml);
  return weak;
}

/// Nothing when the user interrupts.
template <int D>
std::optional<StrengthTrial> run_trial(const CaseOptions& options, double factor,
                                       const StrengthReductionSettings& settings) {
  World<D> world(weakened(options, factor), settings.comm);
  world.initialise();
  RunSettings run;
  run.results = settings.results / "trials" / name_of(factor);
  run.quiet = true;
  run.comm = settings.comm;
  const double limit =
      settings.largest_displacement.value_or(0.1 * world.grid().smallest_spacing());
  run.largest_displacement = limit;
  const InterruptGuard guard;
  prepare_folder(run.results, settings.comm);
  Results<D> results(world, run.results, std::nullopt);
  StrengthTrial trial;
  trial.factor = factor;
  try {
    if (run_to_end(world, results, run, guard) == ExitCode::interrupted) return std::nullopt;
    const auto statics = world.statics();
    const bool rests = statics && world.clock().in_last_stage() &&
                       world.soil()->options().stop_when_static &&
                       statics->at_rest(*world.soil()->options().stop_when_static);
    trial.displacement = world.soil()->largest_displacement();
    trial.stands = rests && trial.displacement <= limit;
    trial.undecided = !trial.stands && trial.displacement <= limit;
    trial.verdict = trial.stands      ? "stands"
                    : trial.undecided ? "no rest before the end"
                                      : "moved too far";
  } catch (const DivergenceError&) {
    trial.verdict = "diverged";
    trial.displacement = world.soil()->largest_displacement();
  }
  trial.time = world.clock().time();
  return trial;
}

void write(const StrengthReductionResult& result, const StrengthReductionSettings& settings) {
  using Json = nlohmann::ordered_json;
  const auto known = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  Json json;
  json["factor of safety"] = known(result.factor());
  json["stands at"] = known(result.stands);
  json["fails at"] = known(result.fails);
  json["tolerance"] = settings.tolerance;
  json["trials"] = Json::array();
  for (const StrengthTrial& trial : result.trials)
    json["trials"].push_back({{"factor", trial.factor},
                              {"stands", trial.stands},
                              {"verdict", trial.verdict},
                              {"undecided", trial.undecided},
                              {"time [s]", trial.time},
                              {"largest displacement [m]", trial.displacement}});
  on_rank_zero(settings.comm, [&] {
    write_atomically(settings.results / "strength_reduction.json", json.dump(2) + "\n");
  });
}

}  // namespace

const StrengthTrial* StrengthReductionResult::undecided() const {
  const auto failing = std::find_if(trials.begin(), trials.end(), [&](const StrengthTrial& trial) {
    return fails && trial.factor == *fails;
  });
  return failing != trials.end() && failing->undecided ? &*failing : nullptr;
}

std::optional<StrengthReductionResult> reduce_strength(
    const CaseOptions& options, const StrengthReductionSettings& settings,
    const std::function<void(const StrengthTrial&)>& report) {
  check(options, settings);
  prepare_folder(settings.results, settings.comm);
  StrengthReductionResult result;
  const auto tried = [&](double factor) {
    const auto trial = options.domain.dimension == 2 ? run_trial<2>(options, factor, settings)
                                                     : run_trial<3>(options, factor, settings);
    if (!trial) return false;
    (trial->stands ? result.stands : result.fails) = factor;
    result.trials.push_back(*trial);
    write(result, settings);
    report(*trial);
    return true;
  };
  if (!tried(settings.lower)) return std::nullopt;
  if (result.fails) return result;
  if (!tried(settings.upper)) return std::nullopt;
  while (result.fails && *result.fails - *result.stands > settings.tolerance * (1.0 + 1e-9))
    if (!tried(*result.factor())) return std::nullopt;
  return result;
}

}  // namespace mudlark

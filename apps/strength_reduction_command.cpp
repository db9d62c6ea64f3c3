#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "grid/rank_check.hpp"
#include "input/case_file.hpp"
#include "launcher.hpp"
#include "parallel/collective_error.hpp"
#include "parallel_session.hpp"
#include "run/strength_reduction.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

StrengthReductionSettings settings_of(const StrengthReductionArguments& arguments) {
  StrengthReductionSettings settings;
  settings.results = arguments.results.empty()
                         ? fs::path("results") / fs::path(arguments.case_file).stem()
                         : fs::path(arguments.results);
  settings.lower = arguments.lower;
  settings.upper = arguments.upper;
  settings.tolerance = arguments.tolerance;
  settings.largest_displacement = arguments.largest_displacement;
  return settings;
}

/// A trial that only ran out of time is no proof of failure.
std::string doubt_of(const StrengthReductionResult& result) {
  const StrengthTrial* open = result.undecided();
  if (!open) return {};
  return fmt::format(
      "warning: at F = {:.6g} the soil had neither come to rest nor moved too far when the run "
      "ended at {:.4g} s: the factor may be larger. A later end tells (time.end, or that of the "
      "last stage); --lower {:.6g} spares the trials below.\n",
      open->factor, open->time, *result.stands);
}

/// Prints what was found; the search has failed when the factor is not between the bounds.
ExitCode conclude(const StrengthReductionResult& result, bool first) {
  if (const auto factor = result.factor()) {
    if (first)
      fmt::print("factor of safety {:.4g} (stands at {:.6g}, fails at {:.6g})\n{}", *factor,
                 *result.stands, *result.fails, doubt_of(result));
    return ExitCode::done;
  }
  if (!result.fails)
    throw InputError(
        fmt::format("the soil still stands with its strength reduced by {:g}; try a larger --upper",
                    *result.stands));
  throw InputError(
      fmt::format("the soil does not stand with its strength reduced by {:g}; try a smaller "
                  "--lower, or a later time.end if it was still coming to rest",
                  *result.fails));
}

ExitCode search_here(const StrengthReductionArguments& arguments) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  CaseOptions options;
  std::string problem;
  try {
    options = read_case(arguments.case_file, arguments.overrides);
  } catch (const InputError& error) {
    problem = error.what();
  }
  throw_input_error_if_any(MPI_COMM_WORLD, problem);
  const auto result =
      reduce_strength(options, settings_of(arguments), [&](const StrengthTrial& trial) {
        if (rank != 0) return;
        fmt::print("F = {:<8.6g} {:<23} t = {:.4g} s, largest displacement {:.4g} m\n",
                   trial.factor, trial.verdict, trial.time, trial.displacement);
        std::fflush(stdout);
      });
  return result ? conclude(*result, rank == 0) : ExitCode::interrupted;
}

}  // namespace

ExitCode strength_reduction_command(const StrengthReductionArguments& arguments,
                                    const std::vector<std::string>& command_line) {
  if (!started_by_launcher() && arguments.ranks > 1) {
    check_ranks(read_case(arguments.case_file, arguments.overrides).domain, arguments.ranks);
    return run_on_ranks(arguments.ranks, command_line);
  }
  return in_parallel([&] { return search_here(arguments); });
}

}  // namespace mudlark

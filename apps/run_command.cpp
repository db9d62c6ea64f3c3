#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <fstream>
#include <optional>

#include "commands.hpp"
#include "folder_lock.hpp"
#include "grid/rank_check.hpp"
#include "input/case_file.hpp"
#include "input/quantity.hpp"
#include "launcher.hpp"
#include "parallel/collective_error.hpp"
#include "parallel_session.hpp"
#include "run/run_case.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

fs::path results_folder(const RunArguments& arguments) {
  if (!arguments.results.empty()) return arguments.results;
  return fs::path("results") / fs::path(arguments.case_file).stem();
}

/// Makes the folder and tries it, so that a long run does not fail at its first output.
void prepare_results(const fs::path& folder, bool resume) {
  std::error_code error;
  if (resume && !fs::is_directory(folder / "checkpoint", error))
    throw InputError(fmt::format("--resume: {} holds no checkpoint to go on from",
                                 (folder / "checkpoint").string()));
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw InputError(fmt::format("-o {}: the results folder cannot be made ({})", folder.string(),
                                 error ? error.message() : "there is a file of that name"));
  const fs::path trial = folder / fmt::format(".trial-{}", getpid());
  const bool written = static_cast<bool>(std::ofstream(trial) << "trial" << std::flush);
  fs::remove(trial, error);
  if (!written)
    throw InputError(
        fmt::format("-o {}: nothing can be written into this folder", folder.string()));
}

struct Prepared {
  CaseOptions options;
  RunSettings settings;
};

Prepared prepare(const RunArguments& arguments) {
  Prepared run;
  run.options = read_case(arguments.case_file, arguments.overrides);
  run.settings.results = results_folder(arguments);
  run.settings.resume = arguments.resume;
  run.settings.quiet = arguments.quiet;
  if (!arguments.until.empty()) {
    run.settings.until = read_quantity("--until", arguments.until, quantity::time);
    if (!(*run.settings.until > 0.0))
      throw InputError(fmt::format("--until = {} is not possible\n  (a run lasts longer than 0 s)",
                                   arguments.until));
  }
  return run;
}

/// On every rank; what one cannot read, all report.
ExitCode run_here(const RunArguments& arguments) {
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::string problem;
  Prepared run;
  std::optional<FolderLock> lock;
  try {
    if (arguments.ranks && *arguments.ranks != size)
      throw InputError(fmt::format("-n {} differs from the {} ranks that the launcher started",
                                   *arguments.ranks, size));
    run = prepare(arguments);
    if (rank == 0) {
      prepare_results(run.settings.results, arguments.resume);
      lock.emplace(run.settings.results);
    }
  } catch (const InputError& error) {
    problem = error.what();
  }
  throw_input_error_if_any(MPI_COMM_WORLD, problem);
  return run_case(run.options, run.settings);
}

}  // namespace

ExitCode run_command(const RunArguments& arguments, const std::vector<std::string>& command_line) {
  if (!started_by_launcher()) {
    const Prepared run = prepare(arguments);  // mistakes end here, before any rank starts
    check_ranks(run.options.domain, arguments.ranks.value_or(1));
    prepare_results(run.settings.results, arguments.resume);
    if (arguments.ranks.value_or(1) > 1) return run_on_ranks(*arguments.ranks, command_line);
  }
  return in_parallel([&] { return run_here(arguments); });
}

}  // namespace mudlark

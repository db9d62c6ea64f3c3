#pragma once
/// The entrance for the command line: a checked case in, an exit code out.
#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "run/options.hpp"

namespace mudlark {

struct RunSettings {
  std::filesystem::path results;               ///< results folder, made when missing
  bool resume = false;                         ///< go on from results/checkpoint
  bool quiet = false;                          ///< no progress lines
  std::optional<double> until;                 ///< [s], stop earlier (or later) than the case says
  std::optional<double> largest_displacement;  ///< [m], the run ends once soil has moved further
  MPI_Comm comm = MPI_COMM_WORLD;
};

/// Runs a case to its end. Writes the results folder (see docs/user/results.md).
/// Returns done, diverged or interrupted; throws InputError for what only shows with the grid at
/// hand.
ExitCode run_case(const CaseOptions& options, const RunSettings& settings);

/// What a run would cost, for `mudlark check`.
struct CaseEstimate {
  double flow_step = 0.0;  ///< first stable flow step [s], 0 without flow
  double soil_step = 0.0;  ///< first stable soil step [s], 0 without soil or without bound
  long long cells = 0;
  long long points = 0;  ///< material points
  double memory = 0.0;   ///< [bytes], all ranks together
  /// Rough cost of the whole run on one core; of implicit steps nobody knows their number.
  std::optional<double> cpu_seconds = 0.0;
  std::vector<std::string> warnings;  ///< what the case asks of methods that cannot do it well
};

/// Builds the case at time zero, writes its initial fields into `results` when given (for a
/// picture), and returns the estimate. Throws InputError like run_case.
CaseEstimate estimate_case(const CaseOptions& options, MPI_Comm comm,
                           const std::optional<std::filesystem::path>& results);

}  // namespace mudlark

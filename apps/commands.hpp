#pragma once
/// The commands of the program; each returns the program's exit code or throws one of
/// base/errors.hpp.
#include <optional>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace mudlark {

struct RunArguments {
  std::string case_file, results, until;
  std::optional<int> ranks;
  bool resume = false, quiet = false;
  std::vector<std::string> overrides;
};
ExitCode run_command(const RunArguments& arguments, const std::vector<std::string>& command_line);

struct StrengthReductionArguments {
  std::string case_file, results;
  double lower = 1.0, upper = 3.0, tolerance = 0.02;
  std::optional<double> largest_displacement;  ///< [m]
  int ranks = 1;
  std::vector<std::string> overrides;
};
ExitCode strength_reduction_command(const StrengthReductionArguments& arguments,
                                    const std::vector<std::string>& command_line);

struct CheckArguments {
  std::string case_file, picture;
  std::vector<std::string> overrides;
};
ExitCode check_command(const CheckArguments& arguments);

ExitCode cases_command(const std::string& name);
ExitCode info_command(const std::string& results);
/// The Python module mudlark.<module> on a results folder: plot, report.
ExitCode python_command(const std::string& module, const std::string& results,
                        const std::vector<std::string>& arguments);

/// Version, commit and libraries.
std::string version_text();

}  // namespace mudlark

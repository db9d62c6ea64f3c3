#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "commands.hpp"
#include "input/case_file.hpp"
#include "installation.hpp"
#include "parallel_session.hpp"
#include "run/run_case.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() : name_((fs::temp_directory_path() / "mudlark-check-XXXXXX").string()) {
    if (!mkdtemp(name_.data())) throw InputError(fmt::format("{}: cannot be made", name_));
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(name_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

std::string step_text(double step) {
  return step > 0.0 ? fmt::format("{:.4g} s", step) : std::string("-");
}

std::string duration_text(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0, day = 86400.0;
  if (seconds < 2.0 * minute) return fmt::format("{:.1f} s", seconds);
  if (seconds < 2.0 * hour) return fmt::format("{:.1f} min", seconds / minute);
  return seconds < 2.0 * day ? fmt::format("{:.1f} h", seconds / hour)
                             : fmt::format("{:.1f} days", seconds / day);
}

void print_estimate(const CaseEstimate& estimate) {
  constexpr double mebibyte = 1024.0 * 1024.0;
  fmt::print("\n# Estimate\n");
  fmt::print("#   cells              {}\n", estimate.cells);
  fmt::print("#   material points    {}\n", estimate.points);
  fmt::print("#   stable flow step   {}\n", step_text(estimate.flow_step));
  fmt::print("#   stable soil step   {}\n",
             estimate.cpu_seconds ? step_text(estimate.soil_step) : "any (implicit)");
  fmt::print("#   memory             {:.1f} MiB\n", estimate.memory / mebibyte);
  fmt::print("#   time on one core   {}\n",
             estimate.cpu_seconds
                 ? "about " + duration_text(*estimate.cpu_seconds) +
                       (estimate.flow_step > 0.0 ? " with the steps of the start; water that gets "
                                                   "faster takes more"
                                                 : "")
                 : "open: implicit steps are as long as accuracy allows");
}

}  // namespace

ExitCode check_command(const CheckArguments& arguments) {
  const CaseOptions options = read_case(arguments.case_file, arguments.overrides);
  const bool draw = !arguments.picture.empty();
  const TemporaryFolder scratch;
  const ExitCode code = in_parallel([&] {
    const std::optional<fs::path> results =
        draw ? std::optional<fs::path>(scratch.name()) : std::nullopt;
    const CaseEstimate estimate = estimate_case(options, MPI_COMM_WORLD, results);
    fmt::print("# {} is a valid case; every value that holds, in SI units:\n\n",
               arguments.case_file);
    fmt::print("{}", options.resolved_toml);
    print_estimate(estimate);
    for (const std::string& warning : estimate.warnings) fmt::print("# warning: {}\n", warning);
    return ExitCode::done;
  });
  if (code != ExitCode::done || !draw) return code;
  std::fflush(stdout);
  const ExitCode drawn = run_python("mudlark.picture", {scratch.name(), arguments.picture});
  if (drawn != ExitCode::done)
    throw InputError(fmt::format("--picture {}: not drawn", arguments.picture));
  fmt::print("# initial state drawn in {}\n", arguments.picture);
  return drawn;
}

}  // namespace mudlark

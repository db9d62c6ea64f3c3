#pragma once
/// `mudlark run -n RANKS`: the program starts itself under MPI's launcher.
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace mudlark {

/// Runs this program with `arguments` on so many ranks, passes Ctrl-C and termination on to them,
/// and returns the exit code that the ranks agreed on. Throws InputError when there is no launcher.
ExitCode run_on_ranks(int ranks, const std::vector<std::string>& arguments);

}  // namespace mudlark

#pragma once
/// MPI and PETSc around a command, and one exit code for all ranks.
#include <functional>

#include "base/errors.hpp"

namespace mudlark {

/// Name of the variable that tells a rank started by `mudlark run -n` where to write the exit code:
/// what mpiexec itself returns, and prints, for ranks that end with an error differs between MPI
/// libraries.
inline constexpr const char* exit_code_variable = "MUDLARK_EXIT_CODE_FILE";

/// Was this process started by mpirun, mpiexec or srun?
bool started_by_launcher();

/// Starts MPI and PETSc, runs `body` and returns the gravest exit code of all ranks. An error that
/// only some ranks meet ends the others, which wait in a collective call, after a few seconds.
ExitCode in_parallel(const std::function<ExitCode()>& body);

/// Calls `body`, prints what it throws, and returns the exit code that belongs to it.
ExitCode guarded(const std::function<ExitCode()>& body);

}  // namespace mudlark

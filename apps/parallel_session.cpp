#include "parallel_session.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <petscsys.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "parallel/session_folder.hpp"

namespace mudlark {
namespace {

struct Outcome {
  ExitCode code = ExitCode::done;
  std::string message;
};

Outcome outcome_of(const std::function<ExitCode()>& body) {
  try {
    return {body(), {}};
  } catch (const InputError& error) {
    return {ExitCode::wrong_input, error.what()};
  } catch (const DivergenceError& error) {
    return {ExitCode::diverged, error.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::internal_error, "internal error: out of memory"};
  } catch (const std::exception& error) {
    return {ExitCode::internal_error, fmt::format("internal error: {}", error.what())};
  } catch (...) {
    return {ExitCode::internal_error, "internal error of an unknown kind"};
  }
}

void print(const std::string& message) {
  if (!message.empty()) fmt::print(stderr, "{}\n", message);
}

void leave_exit_code(int rank, ExitCode code) {
  const char* file = std::getenv(exit_code_variable);
  if (file && (rank == 0 || code != ExitCode::done))
    std::ofstream(file) << static_cast<int>(code) << '\n';
}

/// Waits until all ranks have an outcome. False when others do not come and this one failed.
bool all_arrive(MPI_Comm comm, const Outcome& mine, int& gravest) {
  constexpr std::chrono::seconds patience(10);
  const int code = static_cast<int>(mine.code);
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&code, &gravest, 1, MPI_INT, MPI_MAX, comm, &request);
  const auto start = std::chrono::steady_clock::now();
  for (int arrived = 0;;) {
    MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
    if (arrived) return true;
    const bool late = std::chrono::steady_clock::now() - start > patience;
    if (mine.code != ExitCode::done && late) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

ExitCode agree(const Outcome& mine) {
  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0, gravest = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  comm = MPI_COMM_WORLD;
  if (!all_arrive(comm, mine, gravest)) {
    print(fmt::format("rank {}: {}", rank, mine.message));
    leave_exit_code(rank, mine.code);
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(mine.code));
  }
  const int candidate = mine.message.empty() ? size : rank;
  int speaker = size;
  MPI_Allreduce(&candidate, &speaker, 1, MPI_INT, MPI_MIN, comm);
  if (rank == speaker) print(mine.message);
  leave_exit_code(rank, static_cast<ExitCode>(gravest));
  return static_cast<ExitCode>(gravest);
}

/// mpiexec passes only SIGUSR1 on to the ranks without killing them; run_case stops at SIGTERM.
extern "C" void stop_gently(int) { std::raise(SIGTERM); }

}  // namespace

bool started_by_launcher() {
  constexpr std::array<const char*, 5> marks{"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK",
                                             "MPI_LOCALRANKID", "MV2_COMM_WORLD_RANK"};
  for (const char* mark : marks)
    if (std::getenv(mark)) return true;
  return false;
}

ExitCode guarded(const std::function<ExitCode()>& body) {
  const Outcome outcome = outcome_of(body);
  print(outcome.message);
  return outcome.code;
}

ExitCode in_parallel(const std::function<ExitCode()>& body) {
  const bool under_run = std::getenv(exit_code_variable) != nullptr;
  if (under_run) std::signal(SIGUSR1, stop_gently);
  // A file beyond the limit of a shell or a queue is a write that fails, as on a full disk, and no
  // reason to die without a word.
  std::signal(SIGXFSZ, SIG_IGN);
  const SessionFolder folder;
  MPI_Init(nullptr, nullptr);
  // PETSc would catch crashes and Ctrl-C and print pages about them; errors here are exceptions.
  PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
  if (PetscInitializeNoArguments()) {
    fmt::print(stderr, "internal error: PETSc does not start\n");
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::internal_error));
  }
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  const ExitCode code = agree(outcome_of(body));
  PetscPopErrorHandler();
  PetscFinalize();
  MPI_Finalize();
  return under_run ? ExitCode::done : code;
}

}  // namespace mudlark

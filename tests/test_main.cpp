// Runs GoogleTest inside MPI and PETSc. Any rank's failure fails the program.
#include <gtest/gtest.h>
#include <mpi.h>
#include <petscsys.h>

#include "parallel/session_folder.hpp"

int main(int argc, char** argv) {
  const mudlark::SessionFolder folder;
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  if (PetscInitializeNoArguments()) return 3;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    // Other ranks only speak when something fails there.
    class Failures : public testing::EmptyTestEventListener {
      void OnTestPartResult(const testing::TestPartResult& result) override {
        if (result.failed())
          std::printf("%s:%d: %s\n", result.file_name(), result.line_number(), result.message());
      }
    };
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures);
  }
  int mine = RUN_ALL_TESTS(), worst = 0;
  MPI_Allreduce(&mine, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  PetscFinalize();
  MPI_Finalize();
  return worst;
}

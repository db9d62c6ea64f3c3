// Runs Google Benchmark inside MPI and PETSc.
#include <benchmark/benchmark.h>
#include <mpi.h>
#include <petscsys.h>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (PetscInitializeNoArguments()) return 3;
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  PetscFinalize();
  MPI_Finalize();
  return 0;
}

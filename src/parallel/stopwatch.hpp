#pragma once
/// Wall-clock time of what a run does.
#include <mpi.h>

namespace mudlark {

/// Adds the time of its own life to a sum [s].
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(&sum), start_(MPI_Wtime()) {}
  ~Stopwatch() { *sum_ += MPI_Wtime() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double* sum_;
  double start_;
};

}  // namespace mudlark

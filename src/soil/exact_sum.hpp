#pragma once
/// A sum over points that does not depend on their order, so that a ledger balances to the last
/// bit.
#include <mpi.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace mudlark {

/// Adds values of at most `largest` in units of 2^-53 of it, in whole numbers: 2^26 and 2^27 steps
/// leave room for 2^36 values.
class ExactSum {
 public:
  explicit ExactSum(double largest) : exponent_(std::ilogb(largest) + 1) {}

  void add(double value) {
    const double scaled = std::ldexp(value, coarse_bits - exponent_), whole = std::floor(scaled);
    coarse_ += static_cast<std::int64_t>(whole);
    fine_ += std::llrint(std::ldexp(scaled - whole, fine_bits));
  }
  /// The sum over all ranks. Collective.
  double over_ranks(MPI_Comm comm) const {
    const std::array<std::int64_t, 2> mine{coarse_, fine_};
    std::array<std::int64_t, 2> all{};
    MPI_Allreduce(mine.data(), all.data(), 2, MPI_INT64_T, MPI_SUM, comm);
    return std::ldexp(static_cast<double>(all[0]), exponent_ - coarse_bits) +
           std::ldexp(static_cast<double>(all[1]), exponent_ - coarse_bits - fine_bits);
  }

 private:
  static constexpr int coarse_bits = 26, fine_bits = 27;
  int exponent_;
  std::int64_t coarse_ = 0, fine_ = 0;
};

}  // namespace mudlark

#pragma once
/// What a run says while it goes on.
#include <cstdint>
#include <string>

namespace mudlark {

/// One live line on a terminal, a line every few seconds in a log file. Rank 0 only; quiet says
/// nothing.
class Progress {
 public:
  Progress(bool speaks, double begin, double end);

  /// Shows simulated time, step, step size, speed and time left, when it is time to.
  void show(double time, std::int64_t step, double dt, bool last = false);

 private:
  bool speaks_, terminal_;
  double begin_, end_;      ///< simulated [s]
  double started_, shown_;  ///< wall clock [s]
};

}  // namespace mudlark

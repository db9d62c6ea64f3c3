#include "run/progress.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace mudlark {
namespace {

constexpr int bar_width = 24;

std::string duration(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{}h{:02}m", whole / 3600, whole % 3600 / 60);
  if (whole >= 60) return fmt::format("{}m{:02}s", whole / 60, whole % 60);
  return fmt::format("{}s", whole);
}

}  // namespace

Progress::Progress(bool speaks, double begin, double end)
    : speaks_(speaks),
      terminal_(isatty(STDOUT_FILENO) != 0),
      begin_(begin),
      end_(end),
      started_(MPI_Wtime()),
      shown_(started_ - (terminal_ ? 10.0 : 0.0)) {}

void Progress::show(double time, std::int64_t step, double dt, bool last) {
  if (!speaks_) return;
  const double now = MPI_Wtime();
  if (!last && now - shown_ < (terminal_ ? 0.2 : 5.0)) return;
  shown_ = now;
  const double share =
      end_ > begin_ ? std::clamp((time - begin_) / (end_ - begin_), 0.0, 1.0) : 1.0;
  const double elapsed = now - started_;
  const double speed = elapsed > 0.0 ? (time - begin_) / elapsed : 0.0;
  const std::string left = share > 0.0 ? duration(elapsed * (1.0 - share) / share) : "?";
  const int filled = static_cast<int>(share * bar_width);
  fmt::print(
      "{}[{:#>{}}{:.>{}}] {:5.1f} %  t = {:.5g} s  step {}  dt = {:.3g} s  {:.3g} s/s  {} left{}",
      terminal_ ? "\r" : "", "", filled, "", bar_width - filled, 100.0 * share, time, step, dt,
      speed, left, terminal_ && !last ? "   " : "\n");
  std::fflush(stdout);
}

}  // namespace mudlark

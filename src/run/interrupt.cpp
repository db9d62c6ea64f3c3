#include "run/interrupt.hpp"

#include <csignal>

namespace mudlark {
namespace {

constexpr int signals[3] = {SIGINT, SIGTERM, SIGUSR1};

// A signal handler can reach nothing but static data.
volatile std::sig_atomic_t stop_requested = 0;

void request_stop(int) { stop_requested = 1; }

}  // namespace

InterruptGuard::InterruptGuard() {
  stop_requested = 0;
  for (int i = 0; i < 3; ++i) previous_[i] = std::signal(signals[i], request_stop);
}

InterruptGuard::~InterruptGuard() {
  for (int i = 0; i < 3; ++i) std::signal(signals[i], previous_[i]);
}

bool InterruptGuard::requested() { return stop_requested != 0; }

}  // namespace mudlark

#pragma once
/// Ctrl-C and the batch system's signals: finish the step, save, leave.

namespace mudlark {

/// While it lives, SIGINT, SIGTERM and SIGUSR1 only raise a flag; afterwards the earlier handlers
/// are back.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Has this rank been asked to stop?
  static bool requested();

 private:
  using Handler = void (*)(int);
  Handler previous_[3];
};

}  // namespace mudlark

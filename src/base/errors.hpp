#pragma once
/// Errors that end a run, each with the exit code that the program reports for it.
#include <stdexcept>
#include <string>

namespace mudlark {

enum class ExitCode {
  done = 0,
  wrong_input = 1,
  diverged = 2,
  internal_error = 3,
  interrupted = 130
};

/// The user asked for something that cannot be done (case file, command line, unwritable folder).
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The computation left the range where it means anything; the message says where, when, which
/// quantity.
struct DivergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace mudlark

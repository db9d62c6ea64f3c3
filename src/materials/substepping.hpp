#pragma once
/// Explicit integration of rate equations over a strain increment in sub-steps of controlled error:
/// modified Euler with the difference to Euler as the error, after Sloan, Abbo & Sheng (2001),
/// Engineering Computations 18, 121-194.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec.hpp"

namespace mudlark {

struct SubstepControl {
  double tolerance = 1e-5;       ///< relative error of a sub-step
  double smallest = 1e-7;        ///< share of the increment below which a point counts as failed
  bool accept_smallest = false;  ///< takes the smallest sub-steps as they are instead
};

/// Goes through an increment in sub-steps. `attempt(share)` tries one over that share of it, moves
/// the state on only if its error is within the tolerance, and returns the error; infinity where no
/// answer was found. Returns whether the whole increment was gone through.
template <class Attempt>
bool in_substeps(const SubstepControl& control, const Attempt& attempt) {
  double done = 0.0, share = 1.0;
  bool just_refused = false;
  while (done < 1.0) {
    const double error = attempt(share);
    // A comparison that is false for NaN too.
    if (!(error <= control.tolerance)) {
      if (share <= control.smallest) return false;
      const double factor = std::isfinite(error)
                                ? std::clamp(0.9 * std::sqrt(control.tolerance / error), 0.1, 0.9)
                                : 0.1;
      share = std::max(control.smallest, factor * share);
      just_refused = true;
      continue;
    }
    done += share;
    const double growth =
        error > 0.0 ? std::clamp(0.9 * std::sqrt(control.tolerance / error), 0.1, 2.0) : 2.0;
    share *= just_refused ? std::min(growth, 1.0) : growth;
    just_refused = false;
    share = std::max(control.smallest, share);
    if (done + share > 1.0) share = 1.0 - done;
    if (1.0 - done < 1e-12) break;
  }
  return true;
}

/// Moves `state` along `strain`. `rate(state, strain)` gives the change of state for a strain;
/// `correct(state)` puts the result back on the yield surface and says whether it could. State
/// needs sum, product with a number, and `relative_error(error, state)`. Returns whether the whole
/// increment was integrated; `state` is of use only then.
template <class State, class Rate, class Correct>
bool integrate_in_substeps(State& state, const SymTensor& strain, const SubstepControl& control,
                           const Rate& rate, const Correct& correct) {
  return in_substeps(control, [&](double share) {
    const SymTensor part = share * strain;
    const State first = rate(state, part);
    const State second = rate(state + first, part);
    State next = state + 0.5 * (first + second);
    double error = relative_error(0.5 * (second + -1.0 * first), next);
    if (control.accept_smallest && share <= control.smallest && std::isfinite(error))
      error = std::min(error, control.tolerance);
    if (!(error <= control.tolerance)) return error;
    if (!correct(next)) return std::numeric_limits<double>::infinity();
    state = next;
    return error;
  });
}

/// Share of an elastic increment at which the yield function f(share) passes `target`, between
/// shares with f(inside) < target < f(outside): the Pegasus method (Dowell & Jarratt 1972).
template <class Function>
double crossing(const Function& f, double inside, double outside, double target, double close) {
  double low = f(inside) - target, high = f(outside) - target;
  for (int i = 0; i < 60; ++i) {
    const double middle = outside - high * (outside - inside) / (high - low);
    const double value = f(middle) - target;
    if (std::abs(value) <= close) return middle;
    if (value * high < 0.0) {
      inside = outside, low = high;
    } else {
      low *= high / (high + value);
    }
    outside = middle, high = value;
  }
  return outside;
}

}  // namespace mudlark

#pragma once
/// The loop over time of a case.
#include "base/errors.hpp"
#include "run/interrupt.hpp"
#include "run/results.hpp"
#include "run/run_case.hpp"
#include "run/world.hpp"

namespace mudlark {

/// Advances the world to its end and writes what is due on the way. Returns done or interrupted
/// (after saving the state); a DivergenceError passes through with the time added, after the
/// summary has been written. The guard is older than the results: a signal that comes as soon as
/// their first file is there must not be lost.
template <int D>
ExitCode run_to_end(World<D>& world, Results<D>& results, const RunSettings& settings,
                    const InterruptGuard& guard);

}  // namespace mudlark

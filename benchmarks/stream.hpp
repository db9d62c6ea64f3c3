#pragma once
/// The bandwidth that this machine's memory gives one core: STREAM's triad (McCalpin 1995), a = b +
/// s c.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace mudlark {

/// Best of ten passes over three arrays of 128 MiB in all [bytes/s], counted as STREAM does (24
/// bytes per element).
inline double stream_bandwidth() {
  static const double best = [] {
    constexpr std::size_t size = (128u << 20) / (3 * sizeof(double));
    std::vector<double> a(size, 1.0), b(size, 2.0), c(size, 3.0);
    double fastest = 0.0;
    for (int pass = 0; pass < 10; ++pass) {
      const auto start = std::chrono::steady_clock::now();
      for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + 0.5 * c[i];
      benchmark::DoNotOptimize(a.data());
      benchmark::ClobberMemory();
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      fastest = std::max(fastest, 24.0 * static_cast<double>(size) / time.count());
    }
    return fastest;
  }();
  return best;
}

/// Counters of a benchmark that handles `items` points or cells with `bytes_per_item` bytes each
/// per iteration: time per item, bytes per item, and the share of the measured STREAM bandwidth.
inline void set_counters(benchmark::State& state, double items, double bytes_per_item) {
  using benchmark::Counter;
  const double handled = items * static_cast<double>(state.iterations());
  state.counters["s_per_item"] = Counter(handled, Counter::kIsRate | Counter::kInvert);
  state.counters["bytes_per_item"] = bytes_per_item;
  state.counters["share_of_stream"] =
      Counter(handled * bytes_per_item / stream_bandwidth(), Counter::kIsRate);
}

}  // namespace mudlark

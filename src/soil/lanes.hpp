#pragma once
/// Short vectors of doubles that one instruction works on: lanes are points of one cell, or nodes
/// of one row. GCC's and Clang's vector extension: any processor, widest registers it has.
#include <cstddef>
#include <cstring>

namespace mudlark {

template <int N>
struct LanesOf {
  typedef double type __attribute__((vector_size(N * sizeof(double))));
};
/// N doubles with element-wise + - * /; comparisons give masks for `mask ? a : b`.
template <int N>
using Lanes = typename LanesOf<N>::type;

/// Doubles in the processor's widest register. Wider vectors would go through memory.
#ifdef __AVX512F__
inline constexpr int register_lanes = 8;
#else
inline constexpr int register_lanes = 4;
#endif

/// Points that a transfer handles at a time: no more than a register or a cell holds.
template <int D>
inline constexpr int point_lanes = D == 2 ? 4 : register_lanes;

template <int N>
inline Lanes<N> load(const double* from) {
  Lanes<N> lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}
template <int N>
inline void store(const Lanes<N>& lanes, double* to) {
  std::memcpy(to, &lanes, sizeof(lanes));
}
/// The same value in all lanes.
template <int N>
inline Lanes<N> spread(double value) {
  return value - Lanes<N>{};
}

/// Turns rows into columns: out[i] holds lane i of each of the four.
inline void transpose(const Lanes<4> (&rows)[4], Lanes<4> (&columns)[4]) {
  const Lanes<4> even_01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6);
  const Lanes<4> odd_01 = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Lanes<4> even_23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6);
  const Lanes<4> odd_23 = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  columns[0] = __builtin_shufflevector(even_01, even_23, 0, 1, 4, 5);
  columns[1] = __builtin_shufflevector(odd_01, odd_23, 0, 1, 4, 5);
  columns[2] = __builtin_shufflevector(even_01, even_23, 2, 3, 6, 7);
  columns[3] = __builtin_shufflevector(odd_01, odd_23, 2, 3, 6, 7);
}

}  // namespace mudlark

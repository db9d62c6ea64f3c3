#pragma once
/// Triangles and tetrahedra that a linear function cuts in a positive and a negative part.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec.hpp"

namespace mudlark {

/// Vertices and, at each, the value of a linear function. D = 2: triangle, D = 3: tetrahedron.
template <int D>
struct Simplex {
  std::array<Vec<D>, D + 1> place;
  std::array<double, D + 1> value;
};

/// Length or area of the cut, that times its centre, and its vector towards the positive side.
template <int D>
struct CutPiece {
  double size = 0.0;
  Vec<D> moment{}, area{};
};

/// Share of a segment, triangle or tetrahedron on which the linear function with these values at
/// the vertices is positive; no value may be zero.
template <std::size_t N>
double positive_share(std::array<double, N> value) {
  std::size_t positive = 0;
  for (const double v : value) positive += v > 0.0 ? 1 : 0;
  if (positive == 0) return 0.0;
  if (positive == N) return 1.0;
  // The corner cut off around a single vertex is the product of the shares along its edges.
  const auto corner = [&](std::size_t i) {
    double share = 1.0;
    for (std::size_t j = 0; j < N; ++j)
      if (j != i) share *= value[i] / (value[i] - value[j]);
    return share;
  };
  for (std::size_t i = 0; i < N; ++i) {
    if (positive == 1 && value[i] > 0.0) return corner(i);
    if (positive == N - 1 && value[i] < 0.0) return 1.0 - corner(i);
  }
  // Tetrahedron with two vertices on either side: a wedge of three tetrahedra.
  std::array<double, 2> up{}, down{};
  std::size_t ups = 0, downs = 0;
  for (const double v : value) (v > 0.0 ? up[ups++] : down[downs++]) = v;
  const auto along = [](double from, double to) { return from / (from - to); };
  const double a0 = along(up[0], down[0]), a1 = along(up[0], down[1]);
  const double b0 = along(up[1], down[0]), b1 = along(up[1], down[1]);
  return a0 * a1 + a0 * b1 * (1.0 - a1) + b0 * b1 * (1.0 - a0);
}

/// Centre of the part of a segment (N = 2) or triangle (N = 3) on which the linear function is
/// positive, times its size.
template <int D, std::size_t N>
CutPiece<D> positive_part(const std::array<Vec<D>, N>& place, const std::array<double, N>& value) {
  std::array<Vec<D>, N + 1> corner;
  std::size_t corners = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t j = (i + 1) % N;
    if (value[i] > 0.0 && corners < corner.size()) corner[corners++] = place[i];
    if ((value[i] > 0.0) == (value[j] > 0.0) || corners == corner.size()) continue;
    corner[corners++] = place[i] + value[i] / (value[i] - value[j]) * (place[j] - place[i]);
  }
  CutPiece<D> part;
  for (std::size_t k = N - 1; k < corners; ++k) {
    Vec<D> sum = corner[0] + corner[k];
    double size = norm(corner[k] - corner[0]);
    if constexpr (N == 3) {
      const Vec<D> a = corner[k - 1] - corner[0], b = corner[k] - corner[0];
      size = 0.5 * std::sqrt(std::max(0.0, dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b)));
      sum += corner[k - 1];
    }
    part.size += size;
    part.moment += size / static_cast<double>(N) * sum;
    if constexpr (N == 2) break;  // both ends list the crossing
  }
  return part;
}

template <int D>
CutPiece<D> cut_piece(const Simplex<D>& simplex) {
  std::array<Vec<D>, 4> corner;
  std::size_t corners = 0;
  const auto crossing = [&](std::size_t i, std::size_t j) {
    const double share = simplex.value[i] / (simplex.value[i] - simplex.value[j]);
    return simplex.place[i] + share * (simplex.place[j] - simplex.place[i]);
  };
  // Edges from each positive vertex; the second one's in reverse, so that a quadrilateral closes.
  std::size_t seen = 0;
  for (std::size_t i = 0; i <= D; ++i) {
    if (simplex.value[i] < 0.0) continue;
    const bool reverse = seen++ % 2 == 1;
    for (std::size_t k = 0; k <= D; ++k) {
      const std::size_t j = reverse ? D - k : k;
      if (simplex.value[j] < 0.0 && corners < corner.size()) corner[corners++] = crossing(i, j);
    }
  }
  CutPiece<D> piece;
  if constexpr (D == 2) {
    if (corners < 2) return piece;
    piece.size = norm(corner[1] - corner[0]);
    piece.moment = piece.size * (0.5 * (corner[0] + corner[1]));
    piece.area = {{corner[0][1] - corner[1][1], corner[1][0] - corner[0][0]}};
  } else {
    for (std::size_t k = 2; k < corners; ++k) {
      const Vec<D> a = corner[k - 1] - corner[0], b = corner[k] - corner[0];
      const Vec<D> cross{
          {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
      const double area = 0.5 * norm(cross);
      piece.size += area;
      piece.moment += area / 3.0 * (corner[0] + corner[k - 1] + corner[k]);
      piece.area += 0.5 * cross;
    }
  }
  for (std::size_t i = 0; i <= D; ++i)
    if (simplex.value[i] > 0.0) {
      if (dot(piece.area, simplex.place[i] - corner[0]) < 0.0) piece.area *= -1.0;
      break;
    }
  return piece;
}

}  // namespace mudlark

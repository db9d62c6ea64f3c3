#pragma once
/// Small fixed-size vectors, integer grid indices and symmetric tensors.
#include <array>
#include <cmath>
#include <cstddef>

namespace mudlark {

/// Vector of D real components; the last axis is vertical.
template <int D>
struct Vec {
  std::array<double, D> component{};

  double& operator[](int axis) { return component[static_cast<std::size_t>(axis)]; }
  double operator[](int axis) const { return component[static_cast<std::size_t>(axis)]; }
  Vec& operator+=(const Vec& other) {
    for (int a = 0; a < D; ++a) (*this)[a] += other[a];
    return *this;
  }
  Vec& operator*=(double factor) {
    for (int a = 0; a < D; ++a) (*this)[a] *= factor;
    return *this;
  }
  friend Vec operator+(Vec left, const Vec& right) { return left += right; }
  friend Vec operator-(Vec left, const Vec& right) {
    for (int a = 0; a < D; ++a) left[a] -= right[a];
    return left;
  }
  friend Vec operator*(double factor, Vec vec) { return vec *= factor; }
  friend bool operator==(const Vec&, const Vec&) = default;
};

template <int D>
double dot(const Vec<D>& left, const Vec<D>& right) {
  double sum = 0.0;
  for (int a = 0; a < D; ++a) sum += left[a] * right[a];
  return sum;
}

template <int D>
double norm(const Vec<D>& vec) {
  return std::sqrt(dot(vec, vec));
}

/// Point in three-dimensional space (x, y, z) for shapes and expressions; in 2D the plane is x-z, y
/// = 0.
using Point3 = std::array<double, 3>;

template <int D>
Point3 to_point3(const Vec<D>& position) {
  if constexpr (D == 2) return {position[0], 0.0, position[1]};
  return {position[0], position[1], position[D - 1]};
}

/// Integer index of a cell (or of the face on the cell's lower side along an axis).
template <int D>
struct Index {
  std::array<int, D> component{};

  int& operator[](int axis) { return component[static_cast<std::size_t>(axis)]; }
  int operator[](int axis) const { return component[static_cast<std::size_t>(axis)]; }
  Index shifted(int axis, int cells) const {
    Index other = *this;
    other[axis] += cells;
    return other;
  }
  friend bool operator==(const Index&, const Index&) = default;
};

/// Half-open box of indices, lower <= index < upper.
template <int D>
struct IndexBox {
  Index<D> lower, upper;

  bool contains(const Index<D>& index) const {
    for (int a = 0; a < D; ++a)
      if (index[a] < lower[a] || index[a] >= upper[a]) return false;
    return true;
  }
  bool empty() const {
    for (int a = 0; a < D; ++a)
      if (upper[a] <= lower[a]) return true;
    return false;
  }
  IndexBox grown(int cells) const {
    IndexBox box = *this;
    for (int a = 0; a < D; ++a) {
      box.lower[a] -= cells;
      box.upper[a] += cells;
    }
    return box;
  }
  /// The box with `cells` more rows on its upper side along one axis (for faces: the closing row).
  IndexBox extended(int axis, int cells) const {
    IndexBox box = *this;
    box.upper[axis] += cells;
    return box;
  }
  IndexBox intersected(const IndexBox& other) const {
    IndexBox box = *this;
    for (int a = 0; a < D; ++a) {
      box.lower[a] = box.lower[a] > other.lower[a] ? box.lower[a] : other.lower[a];
      box.upper[a] = box.upper[a] < other.upper[a] ? box.upper[a] : other.upper[a];
    }
    return box;
  }
  friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

/// Calls body(index) for every index of a box, first axis fastest.
template <int D, class Body>
void for_each(const IndexBox<D>& box, Body&& body) {
  if (box.empty()) return;
  if constexpr (D == 2) {
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i) body(Index<2>{{i, j}});
  } else {
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i) body(Index<3>{{i, j, k}});
  }
}

/// Symmetric 3x3 tensor, components xx yy zz xy yz zx (tensor, not engineering, shear).
/// In plane strain the plane is x-z; yy is the out-of-plane component.
struct SymTensor {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, yz = 0.0, zx = 0.0;

  double trace() const { return xx + yy + zz; }
  /// t : t, every off-diagonal pair counted twice.
  double squared_norm() const {
    return xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + zx * zx);
  }
  SymTensor& operator+=(const SymTensor& o) {
    xx += o.xx, yy += o.yy, zz += o.zz, xy += o.xy, yz += o.yz, zx += o.zx;
    return *this;
  }
  friend SymTensor operator+(SymTensor a, const SymTensor& b) { return a += b; }
  friend SymTensor operator*(double f, const SymTensor& a) {
    return {f * a.xx, f * a.yy, f * a.zz, f * a.xy, f * a.yz, f * a.zx};
  }
  friend bool operator==(const SymTensor&, const SymTensor&) = default;
  static SymTensor identity() { return {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}; }

  /// Component between two axes of a D-dimensional problem (2D: axis 0 is x, axis 1 is z).
  template <int D>
  double between(int row, int column) const {
    const int r = (D == 2 && row == 1) ? 2 : row;
    const int c = (D == 2 && column == 1) ? 2 : column;
    if (r == c) return r == 0 ? xx : r == 1 ? yy : zz;
    const int sum = r + c;  // 1: xy, 2: zx, 3: yz
    return sum == 1 ? xy : sum == 2 ? zx : yz;
  }
};

}  // namespace mudlark

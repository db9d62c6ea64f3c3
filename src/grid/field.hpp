#pragma once
/// Values on the grid: one per cell, or one per face of an axis, with ghost layers.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/vec.hpp"
#include "grid/grid.hpp"

namespace mudlark {

/// Where the values of a field lie.
struct AtCell {};
struct AtFace {};

/// Owns the values of one quantity on this rank's local box (owned cells and ghost layers), with
/// its name and unit. Copying is explicit: `copy()`.
template <class T, class Place, int D>
class Field {
 public:
  Field(const Grid<D>& grid, std::string name, std::string unit, T value = T{})
      : name_(std::move(name)),
        unit_(std::move(unit)),
        values_(grid.local_size(), value),
        local_(grid.local()) {
    for (int a = 0; a < D; ++a) strides_[static_cast<std::size_t>(a)] = grid.stride(a);
  }
  Field(Field&&) noexcept = default;
  Field& operator=(Field&&) noexcept = default;
  Field& operator=(const Field&) = delete;
  ~Field() = default;
  Field copy() const { return Field(*this); }

  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }

  T& operator[](const Index<D>& index) { return values_[offset(index)]; }
  const T& operator[](const Index<D>& index) const { return values_[offset(index)]; }
  std::size_t offset(const Index<D>& index) const {
    std::ptrdiff_t at = 0;
    for (int a = 0; a < D; ++a)
      at += (index[a] - local_.lower[a]) * strides_[static_cast<std::size_t>(a)];
    return static_cast<std::size_t>(at);
  }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  std::size_t size() const { return values_.size(); }
  const IndexBox<D>& local() const { return local_; }
  void fill(T value) { std::fill(values_.begin(), values_.end(), value); }
  void copy_values_from(const Field& other) { values_ = other.values_; }
  void swap(Field& other) noexcept { values_.swap(other.values_); }

 private:
  Field(const Field&) = default;

  std::string name_, unit_;
  std::vector<T> values_;
  IndexBox<D> local_;
  std::array<std::ptrdiff_t, D> strides_{};
};

template <int D>
using CellField = Field<double, AtCell, D>;
template <int D>
using FaceField = Field<double, AtFace, D>;

/// One face field per axis: a vector quantity on the staggered (MAC) grid.
template <int D>
class FaceVector {
 public:
  FaceVector(const Grid<D>& grid, const std::string& name, const std::string& unit,
             double value = 0.0) {
    axes_.reserve(D);
    for (int a = 0; a < D; ++a) axes_.emplace_back(grid, name, unit, value);
  }
  FaceField<D>& operator[](int axis) { return axes_[static_cast<std::size_t>(axis)]; }
  const FaceField<D>& operator[](int axis) const { return axes_[static_cast<std::size_t>(axis)]; }
  /// Values of all axes, for loops over all of them at once.
  std::array<const double*, D> data() const {
    std::array<const double*, D> data;
    for (int a = 0; a < D; ++a) data[static_cast<std::size_t>(a)] = (*this)[a].data();
    return data;
  }
  const std::string& name() const { return axes_[0].name(); }
  const std::string& unit() const { return axes_[0].unit(); }
  void fill(double value) {
    for (auto& field : axes_) field.fill(value);
  }
  void copy_values_from(const FaceVector& other) {
    for (int a = 0; a < D; ++a) (*this)[a].copy_values_from(other[a]);
  }

 private:
  std::vector<FaceField<D>> axes_;
};

}  // namespace mudlark

#pragma once
/// A few points side by side in the arrays, whatever their cells, as lanes.
#include <span>

#include "soil/particles.hpp"
#include "soil/strain_lanes.hpp"

namespace mudlark {

/// Points first .. first + live - 1; lanes from `live` on repeat the last of them.
struct PointGroup {
  std::size_t first, live;

  TensorValue get(const std::vector<double>& array) const { return get(array.data() + first); }
  /// From values that start with those of the group.
  TensorValue get(const double* values) const {
    if (live == tensor_lanes) return load<tensor_lanes>(values);
    TensorValue lanes;
    for (std::size_t i = 0; i < tensor_lanes; ++i) lanes[i] = values[i < live ? i : live - 1];
    return lanes;
  }
  void set(const TensorValue& lanes, std::vector<double>& array) const {
    if (live == tensor_lanes) return store<tensor_lanes>(lanes, array.data() + first);
    for (std::size_t i = 0; i < live; ++i) array[first + i] = lanes[i];
  }
  TensorLanes get(const PointQuantity<6>& q) const {
    return {get(q[0]), get(q[1]), get(q[2]), get(q[3]), get(q[4]), get(q[5])};
  }
  void set(const TensorLanes& t, PointQuantity<6>& q) const {
    set(t.xx, q[0]), set(t.yy, q[1]), set(t.zz, q[2]);
    set(t.xy, q[3]), set(t.yz, q[4]), set(t.zx, q[5]);
  }
  /// Velocity gradient of the step, component after component, each of all points of a range; in 2D
  /// rows and columns x and z of the 3 x 3 matrix.
  template <int D>
  MatrixLanes gradient(const double* values, PointRange range) const {
    MatrixLanes g{};
    values += first - range.first;
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = 0; j < D; ++j, values += range.last - range.first)
        g[D == 2 ? 6 * i + 2 * j : 3 * i + j] = get(values);
    return g;
  }
};

/// Calls f(group) for groups that make up the range.
template <class F>
void for_each_group(PointRange range, F&& f) {
  for (std::size_t first = range.first; first < range.last; first += tensor_lanes)
    f(PointGroup{first, range.last - first < tensor_lanes ? range.last - first : tensor_lanes});
}

}  // namespace mudlark

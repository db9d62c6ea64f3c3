#include "flow/body_acceleration.hpp"

#include <algorithm>
#include <cmath>

#include "grid/halo.hpp"
#include "numerics/loops.hpp"

namespace mudlark {

template <int D>
BodyAcceleration<D>::BodyAcceleration(const Grid<D>& grid, const FlowOptions& options)
    : grid_(&grid), given_(options.body_acceleration) {}

/// Calls body(face, value).
template <int D>
template <class Body>
void BodyAcceleration<D>::for_each_value(int axis, double time, Body&& body) const {
  const Varying& given = (*given_)[static_cast<std::size_t>(D == 2 && axis == 1 ? 2 : axis)];
  if (given.constant() && given({}, time) == 0.0) return;
  for_each(bounding_faces(*grid_, axis), [&](const Index<D>& face) {
    body(face, given(to_point3(grid_->face_centre(axis, face)), time));
  });
}

template <int D>
void BodyAcceleration<D>::add(int axis, double time, FaceField<D>& out) const {
  if (!given_) return;
  for_each_value(axis, time, [&](const Index<D>& face, double value) { out[face] += value; });
}

template <int D>
double BodyAcceleration<D>::largest(double time) const {
  if (!given_) return 0.0;
  double squares = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    double most = 0.0;
    for_each_value(axis, time,
                   [&](const Index<D>&, double value) { most = std::max(most, std::abs(value)); });
    squares += most * most;
  }
  return max_over_ranks(*grid_, std::sqrt(squares));
}

template class BodyAcceleration<2>;
template class BodyAcceleration<3>;

}  // namespace mudlark

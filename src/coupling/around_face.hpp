#pragma once
/// Velocities where a face of a staggered grid has one component only.
#include "grid/field.hpp"

namespace mudlark {

/// Mean around a face [m/s]: its own component, and the others on the four faces of theirs around.
/// Each counts with its `weight`, if there is one. Needs a layer of valid ghosts.
template <int D>
Vec<D> velocity_around(int axis, const Index<D>& face, const FaceVector<D>& velocity,
                       const FaceVector<D>* weight = nullptr) {
  Vec<D> mean{};
  const Index<D> behind = face.shifted(axis, -1);
  for (int a = 0; a < D; ++a) {
    double sum = 0.0, weights = 0.0;
    const auto add = [&](const Index<D>& at) {
      const double w = weight ? (*weight)[a][at] : 1.0;
      sum += w * velocity[a][at], weights += w;
    };
    add(face);
    if (a != axis) add(face.shifted(a, 1)), add(behind), add(behind.shifted(a, 1));
    mean[a] = weights > 0.0 ? sum / weights : 0.0;
  }
  return mean;
}

}  // namespace mudlark

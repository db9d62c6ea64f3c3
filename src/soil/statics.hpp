#pragma once
/// How far from rest soil is.
#include <limits>

#include "soil/options.hpp"

namespace mudlark {

/// Measures of rest, dimensionless; infinite when there is something to compare and nothing to
/// compare it with.
struct Statics {
  /// ||F_ext - F_int|| / ||F_ext|| over the faces that may move: F_ext gravity, loads and given
  /// accelerations, F_int effective stress and pore pressure, of grains and pore water together.
  double unbalanced_force = 0.0;
  /// Kinetic energy, with the scaled inertia, over the external work since the start.
  double kinetic_energy = 0.0;

  bool at_rest(const RestCriterion& criterion) const {
    return unbalanced_force < criterion.unbalanced_force &&
           kinetic_energy < criterion.kinetic_energy;
  }
};

/// `part` >= 0 as a share of `whole` [-].
inline double share_of(double part, double whole) {
  if (part == 0.0) return 0.0;
  return whole > 0.0 ? part / whole : std::numeric_limits<double>::infinity();
}

}  // namespace mudlark

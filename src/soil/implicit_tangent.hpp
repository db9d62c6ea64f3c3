#pragma once
/// What a material point contributes to the linear system of a Newton iteration.
#include <Eigen/Core>

#include "base/vec.hpp"

namespace mudlark {

/// A point of an implicit step, linearised about the displacements that its stress was computed at:
///   change of stress = tangent : grad(du) - cofactor dp,
///   change of stored volume = cofactor : grad(du) + div(dw) + storage dp,
/// both times the volume at the step's start. du, dw: ways of grains and of water relative to
/// them, dp: pore pressure.
template <int D>
struct LinearPoint {
  static constexpr int G = D * D;
  using Gradient = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  using Tangent = Eigen::Matrix<double, G, G>;

  Vec<D> position;       ///< at the step's start [m]
  double volume = 0.0;   ///< [m^D]
  double storage = 0.0;  ///< n / K_w [1/Pa]
  double drag = 0.0;     ///< mu / kappa [Pa s/m2]
  bool wet = false;
  Gradient cofactor = Gradient::Identity();  ///< J F^-T [-]
  Tangent tangent = Tangent::Zero();         ///< d (first Piola-Kirchhoff stress) / d gradient [Pa]
};

}  // namespace mudlark

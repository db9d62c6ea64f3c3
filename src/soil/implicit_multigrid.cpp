#include "soil/implicit_multigrid.hpp"

// GCC 12 finds the undefined operand of its own 512-bit intrinsics uninitialised.
#pragma GCC diagnostic ignored "-Wuninitialized"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mudlark {
namespace {

/// Smoothed are eigenvalues from this share of the largest one on.
constexpr double smallest_smoothed = 0.05;
constexpr int power_iterations = 12;
/// On the estimate of the largest eigenvalue, which comes from below.
constexpr double safety = 1.15;
/// Stiffness that yielding leaves in any direction, as a share of the largest one.
constexpr double least_stiffness = 0.01;

/// Symmetric part of a tangent without what is negative or nearly zero in its space of strains.
template <int D>
typename LinearPoint<D>::Tangent made_positive(const typename LinearPoint<D>::Tangent& tangent) {
  constexpr int G = D * D;
  // Strains: rotations stay without stiffness.
  using Square = Eigen::Matrix<double, G, G>;
  Square strain = Square::Zero();
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      strain(i * D + j, i * D + j) += 0.5, strain(i * D + j, j * D + i) += 0.5;
  const Square symmetric = strain * (0.5 * (tangent + tangent.transpose())) * strain;
  const Eigen::SelfAdjointEigenSolver<Square> solver(symmetric);
  double largest = 1e-3;
  for (int i = 0; i < G; ++i) largest = std::max(largest, std::abs(solver.eigenvalues()[i]));
  Square raised = Square::Zero();
  for (int i = 0; i < G; ++i) {
    const double stiffness = std::max(solver.eigenvalues()[i], least_stiffness * largest);
    raised += stiffness * solver.eigenvectors().col(i) * solver.eigenvectors().col(i).transpose();
  }
  return strain * raised * strain;
}

template <int D>
std::vector<LinearPoint<D>> with_positive_tangents(std::vector<LinearPoint<D>> points) {
  for (LinearPoint<D>& point : points) point.tangent = made_positive<D>(point.tangent);
  return points;
}

}  // namespace

template <int D>
DisplacementMultigrid<D>::DisplacementMultigrid(const Grid<D>& grid,
                                                const ImplicitUnknowns<D>& unknowns,
                                                UnknownPlaces& places,
                                                std::vector<LinearPoint<D>> points,
                                                ContactStiffness<D> contacts)
    : grid_(&grid),
      places_(&places),
      points_(with_positive_tangents(std::move(points))),
      operator_(grid, points_),
      contacts_(std::move(contacts)),
      way_(grid, "way", "m"),
      force_(grid, "force", "N"),
      coarse_(grid, places, points_, contacts_, unknowns.grain_sign) {
  places.make_vector(residual_);
  places.make_vector(direction_);
  places.make_vector(product_);
  for (int d = 0; d < D; ++d)
    mass_.add(grid, d, places.numbers(static_cast<std::size_t>(d)), places.first());
  force_.fill(0.0);
  operator_.add_stiffness_diagonal(pointers(force_));
  contacts_.add_diagonal(force_);
  for (int d = 0; d < D; ++d) {  // a diagonal has no sign behind walls
    const auto& sign = unknowns.grain_sign[static_cast<std::size_t>(d)];
    for (std::size_t at = 0; at < sign.size(); ++at) force_[d].data()[at] *= sign[at];
  }
  places.to_unknowns(pointers(std::as_const(force_)), product_);
  mass_.set_diagonal(product_);
  find_largest_eigenvalue();
}

template <int D>
void DisplacementMultigrid<D>::multiply(::Vec way, ::Vec force) {
  places_->to_places(way, pointers(way_));
  force_.fill(0.0);
  operator_.apply_stiffness(pointers(way_), pointers(force_));
  contacts_.apply(way_, force_);
  places_->to_unknowns(pointers(std::as_const(force_)), force);
}

/// Power iteration on mass^-1 stiffness, from a vector without a pattern.
template <int D>
void DisplacementMultigrid<D>::find_largest_eigenvalue() {
  PetscScalar* values = nullptr;
  VecGetArray(direction_, &values);
  std::uint64_t state = 88172645463325252ull + 977ull * static_cast<std::uint64_t>(grid_->rank());
  for (PetscInt i = 0; i < places_->owned(); ++i) {  // xorshift64 (Marsaglia 2003)
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    values[i] = static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
  }
  VecRestoreArray(direction_, &values);
  for (int i = 0; i < power_iterations; ++i) {
    PetscReal length = 0.0;
    VecNorm(direction_, NORM_2, &length);
    VecScale(direction_, 1.0 / std::max(length, 1e-300));
    multiply(direction_, product_);
    mass_.apply(product_, direction_);
  }
  PetscReal length = 0.0;
  VecNorm(direction_, NORM_2, &length);
  largest_ = safety * std::max(length, 1e-300);
}

template <int D>
void DisplacementMultigrid<D>::smooth(::Vec way, bool renew) {
  const double low = smallest_smoothed * largest_;
  const double centre = 0.5 * (largest_ + low), half = 0.5 * (largest_ - low);
  const double ratio = centre / half;
  mass_.apply(residual_, direction_);
  VecScale(direction_, 1.0 / centre);
  VecAXPY(way, 1.0, direction_);
  multiply(direction_, product_);
  VecAXPY(residual_, -1.0, product_);
  const double next = 1.0 / (2.0 * ratio - 1.0 / ratio);
  mass_.apply(residual_, product_);
  VecScale(direction_, next / ratio);
  VecAXPY(direction_, 2.0 * next / half, product_);
  VecAXPY(way, 1.0, direction_);
  if (!renew) return;
  multiply(direction_, product_);
  VecAXPY(residual_, -1.0, product_);
}

template <int D>
void DisplacementMultigrid<D>::apply(::Vec force, ::Vec way) {
  VecSet(way, 0.0);
  VecCopy(force, residual_);
  smooth(way, true);
  coarse_.correct(residual_, way);
  multiply(way, product_);
  VecWAXPY(residual_, -1.0, product_, force);
  smooth(way, false);
}

template class DisplacementMultigrid<2>;
template class DisplacementMultigrid<3>;

}  // namespace mudlark

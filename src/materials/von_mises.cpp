#include "materials/von_mises.hpp"

#include <cmath>
#include <limits>

#include "materials/invariants.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 1> names{"plastic shear strain [-]"};

}  // namespace

VonMises::VonMises(const VonMisesOptions& options)
    : options_(options),
      elasticity_(Elasticity::from(options.young_modulus, options.poisson_ratio)) {}

std::span<const std::string_view> VonMises::history_names() const { return names; }

/// s_u [Pa] after a plastic shear strain.
double VonMises::strength(double plastic_shear, double length) const {
  if (!options_.residual || plastic_shear <= 0.0) return options_.undrained_strength;
  const auto& [residual, softening] = *options_.residual;
  return residual +
         (options_.undrained_strength - residual) * softening.share(plastic_shear, length);
}

/// Plastic shear strain of the step: sqrt(J2) of the trial - G x = s_u(g + x). Newton from the
/// largest x possible: the difference is concave in x, so every step stays on the root's right.
double VonMises::shear_to_surface(double trial, double plastic_shear, double length) const {
  const double shear = elasticity_.shear;
  if (!options_.residual) return (trial - options_.undrained_strength) / shear;
  const auto& [residual, softening] = *options_.residual;
  double x = (trial - residual) / shear;
  for (int i = 0; i < 60; ++i) {
    const double now = strength(plastic_shear + x, length);
    const double wider = softening.length > 0.0 ? length / softening.length : 1.0;
    const double slope = (now - residual) * wider / softening.strain - shear;
    const double change = (trial - shear * x - now) / slope;
    x -= change;
    if (std::abs(change) <= 1e-14 + 1e-13 * x) break;
  }
  return x;
}

std::size_t VonMises::update_stress(const MaterialPoints& points) const {
  std::size_t failed = 0;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    SymTensor& stress = points.stress[i];
    double& plastic_shear = points.history[i];
    stress += elasticity_.stress(points.strain_increment[i]);
    const double square = second_invariant(stress);
    const double allowed = strength(plastic_shear, points.length);
    if (square <= allowed * allowed) continue;
    const double root = std::sqrt(square);
    if (!std::isfinite(root)) {
      ++failed;
      if (!points.failed.empty()) points.failed[i] = 1;
      continue;
    }
    const double plastic = shear_to_surface(root, plastic_shear, points.length);
    plastic_shear += plastic;
    const double mean = mean_of(stress), left = 1.0 - elasticity_.shear * plastic / root;
    stress = left * deviator_of(stress) + mean * SymTensor::identity();
  }
  return failed;
}

}  // namespace mudlark

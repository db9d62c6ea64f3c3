#include "materials/mu_i.hpp"

#include <algorithm>
#include <cmath>

#include "materials/invariants.hpp"
#include "materials/separation.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 2> names{"plastic shear strain [-]", "separation [-]"};

}  // namespace

MuI::MuI(const MuIOptions& options)
    : options_(options),
      elasticity_(Elasticity::from(options.young_modulus, options.poisson_ratio)) {}

std::span<const std::string_view> MuI::history_names() const { return names; }

/// Not less than the cone of mu_s carries.
double MuI::earth_pressure_at_rest() const {
  const double root = std::sqrt(3.0), mu = options_.static_friction;
  return std::max(1.0 - mu, (root - mu) / (root + 2.0 * mu));
}

/// sqrt(J2) [Pa] at the end of a step in which grains slide. With a = G dt I_0 sqrt(P/rho_s)/d,
/// (trial - t)(mu_2 P - t) = a (t - mu_s P): the smaller root t, in the form without cancellation.
double MuI::sliding_shear(double trial, double pressure, double dt) const {
  const double slow = options_.static_friction * pressure;
  const double fast = options_.limiting_friction * pressure;
  const double a = elasticity_.shear * dt * options_.inertial_number *
                   std::sqrt(pressure / options_.grain_density) / options_.grain_diameter;
  const double sum = fast + trial + a, product = fast * trial + a * slow;
  return 2.0 * product / (sum + std::sqrt(std::max(sum * sum - 4.0 * product, 0.0)));
}

std::size_t MuI::update_stress(const MaterialPoints& points) const {
  std::size_t failed = 0;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    SymTensor strain = points.strain_increment[i];
    double &plastic_shear = points.history[2 * i], &separation = points.history[2 * i + 1];
    if (still_apart(separation, strain)) continue;
    SymTensor& stress = points.stress[i];
    stress += elasticity_.stress(strain);
    const double pressure = -mean_of(stress), trial = std::sqrt(second_invariant(stress));
    if (pressure > 0.0 && trial <= options_.static_friction * pressure) continue;
    if (pressure <= 0.0) {
      separation = -pressure / elasticity_.bulk();
      plastic_shear += trial / elasticity_.shear;
      stress = SymTensor{};
      continue;
    }
    if (!std::isfinite(trial) || !std::isfinite(pressure)) {
      ++failed;
      if (!points.failed.empty()) points.failed[i] = 1;
      continue;
    }
    const double root = sliding_shear(trial, pressure, points.dt);
    plastic_shear += (trial - root) / elasticity_.shear;
    stress = (root / trial) * stress + (root / trial - 1.0) * pressure * SymTensor::identity();
  }
  return failed;
}

}  // namespace mudlark

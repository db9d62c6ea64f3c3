#include "materials/newtonian.hpp"

#include <cmath>

#include "materials/invariants.hpp"
#include "materials/separation.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 1> names{"separation [-]"};

}  // namespace

std::span<const std::string_view> Newtonian::history_names() const { return names; }

std::size_t Newtonian::update_stress(const MaterialPoints& points) const {
  const double viscous = points.dt > 0.0 ? 2.0 * options_.viscosity / points.dt : 0.0;
  std::size_t failed = 0;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    SymTensor strain = points.strain_increment[i];
    if (still_apart(points.history[i], strain)) continue;
    double mean = mean_of(points.stress[i]) + options_.bulk_modulus * strain.trace();
    if (!std::isfinite(mean)) {
      ++failed;
      if (!points.failed.empty()) points.failed[i] = 1;
    }
    const double beyond = mean - options_.tension_cutoff;
    if (beyond > 0.0) {
      points.history[i] = beyond / options_.bulk_modulus;
      points.stress[i] = options_.tension_cutoff * SymTensor::identity();
      continue;
    }
    points.stress[i] = viscous * deviator_of(strain) + mean * SymTensor::identity();
  }
  return failed;
}

}  // namespace mudlark

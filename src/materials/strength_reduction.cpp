#include "materials/strength_reduction.hpp"

#include <algorithm>
#include <string>

#include "base/errors.hpp"
#include "materials/registry.hpp"

namespace mudlark {
namespace {

/// Of MohrCoulombOptions, their residual part, or DruckerPragerOptions.
template <class Strength>
void weaken(Strength& strength, double factor) {
  strength.cohesion /= factor;
  strength.friction_angle = std::atan(std::tan(strength.friction_angle) / factor);
  strength.dilatancy_angle = std::min(strength.dilatancy_angle, strength.friction_angle);
}

template <class Options>
SoilLawOptions undrained(Options options, double factor) {
  options.undrained_strength /= factor;
  if (options.residual) options.residual->strength /= factor;
  return options;
}

struct Reduction {
  double factor;

  SoilLawOptions operator()(MohrCoulombOptions options) const {
    weaken(options, factor);
    if (options.residual) weaken(*options.residual, factor);
    return options;
  }
  SoilLawOptions operator()(DruckerPragerOptions options) const {
    weaken(options, factor);
    return options;
  }
  SoilLawOptions operator()(const TrescaOptions& options) const {
    return undrained(options, factor);
  }
  SoilLawOptions operator()(const VonMisesOptions& options) const {
    return undrained(options, factor);
  }
  template <class Options>
  SoilLawOptions operator()(const Options& options) const {
    throw InputError(
        "strength reduction: soil law \"" + std::string(make_soil_model(options)->name()) +
        "\" has no cohesion, friction angle or undrained strength to reduce. Use \"mohr-coulomb\", "
        "\"drucker-prager\", \"tresca\" or \"von-mises\".");
  }
};

}  // namespace

SoilLawOptions reduced(const SoilLawOptions& options, double factor) {
  return std::visit(Reduction{factor}, options);
}

}  // namespace mudlark

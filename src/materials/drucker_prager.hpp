#pragma once
/// Linear elasticity inside the Drucker-Prager cone, with a limit on the mean tension.
#include <limits>

#include "materials/elasticity.hpp"
#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

/// sqrt(J2) + A p <= B and p <= t, p the mean stress, tension positive; flow potential
/// sqrt(J2) + A' p.
struct DruckerPragerCone {
  double friction = 0.0;                                     ///< A [-]
  double dilatancy = 0.0;                                    ///< A' [-]
  double cohesion = 0.0;                                     ///< B [Pa]
  double tension = std::numeric_limits<double>::infinity();  ///< t: cut-off or apex B/A [Pa]

  /// The cone that agrees with Mohr-Coulomb as `match` says.
  static DruckerPragerCone from(const DruckerPragerOptions& options);
};

/// Closed-form return to cone, cut-off or apex; no principal stresses. State: plastic shear strain
/// and the separation of grains.
class DruckerPrager final : public SoilModel {
 public:
  explicit DruckerPrager(const DruckerPragerOptions& options);

  std::string_view name() const override { return "drucker-prager"; }
  std::span<const std::string_view> history_names() const override;
  double wave_modulus(std::span<const SymTensor>, std::span<const double>) const override {
    return elasticity_.constrained();
  }
  double shear_modulus() const override { return elasticity_.shear; }
  /// Jaky's 1 - sin(phi), or the least that the cone carries where that is more; without friction
  /// that of elasticity.
  double earth_pressure_at_rest() const override;
  bool supports(StrainMeasure measure) const override {
    return measure == StrainMeasure::jaumann || measure == StrainMeasure::hencky;
  }
  SymTensor elastic_strain(const SymTensor& stress) const override {
    return elasticity_.strain(stress);
  }
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  double sine_;  ///< of the angle of friction
  Elasticity elasticity_;
  DruckerPragerCone cone_;
};

}  // namespace mudlark

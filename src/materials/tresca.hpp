#pragma once
/// Undrained strength in total stresses: sigma_1 - sigma_3 <= 2 s_u, at constant volume.
#include "materials/mohr_coulomb.hpp"

namespace mudlark {

/// The Mohr-Coulomb law without friction, its cohesion the undrained strength s_u; with softening
/// as there.
class Tresca final : public SoilModel {
 public:
  explicit Tresca(const TrescaOptions& options) : law_(without_friction(options)) {}

  std::string_view name() const override { return "tresca"; }
  std::span<const std::string_view> history_names() const override { return law_.history_names(); }
  double wave_modulus(std::span<const SymTensor> stress,
                      std::span<const double> history) const override {
    return law_.wave_modulus(stress, history);
  }
  double shear_modulus() const override { return law_.shear_modulus(); }
  double earth_pressure_at_rest() const override { return law_.earth_pressure_at_rest(); }
  bool supports(StrainMeasure measure) const override { return law_.supports(measure); }
  SymTensor elastic_strain(const SymTensor& stress) const override {
    return law_.elastic_strain(stress);
  }
  std::size_t update_stress(const MaterialPoints& points) const override {
    return law_.update_stress(points);
  }

 private:
  static MohrCoulombOptions without_friction(const TrescaOptions& options);
  MohrCoulomb law_;
};

inline MohrCoulombOptions Tresca::without_friction(const TrescaOptions& options) {
  MohrCoulombOptions same;
  same.young_modulus = options.young_modulus;
  same.poisson_ratio = options.poisson_ratio;
  same.cohesion = options.undrained_strength;
  if (options.residual)
    same.residual = MohrCoulombOptions::Residual{options.residual->strength, 0.0, 0.0,
                                                 options.residual->softening};
  return same;
}

}  // namespace mudlark

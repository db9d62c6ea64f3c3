#pragma once
/// Undrained strength in total stresses, round in the deviator's plane: sqrt(J2) <= s_u.
#include "materials/elasticity.hpp"
#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

/// Radial return (Wilkins 1964), at constant volume. s_u is the strength in shear and in plane
/// strain; a triaxial test gives q = sqrt(3) s_u. Softens like Tresca. State: plastic shear strain.
class VonMises final : public SoilModel {
 public:
  explicit VonMises(const VonMisesOptions& options);

  std::string_view name() const override { return "von-mises"; }
  std::span<const std::string_view> history_names() const override;
  double wave_modulus(std::span<const SymTensor>, std::span<const double>) const override {
    return elasticity_.constrained();
  }
  double shear_modulus() const override { return elasticity_.shear; }
  double earth_pressure_at_rest() const override { return elasticity_.confined_ratio(); }
  bool supports(StrainMeasure measure) const override {
    return measure == StrainMeasure::jaumann || measure == StrainMeasure::hencky;
  }
  SymTensor elastic_strain(const SymTensor& stress) const override {
    return elasticity_.strain(stress);
  }
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  double strength(double plastic_shear, double length) const;
  double shear_to_surface(double trial, double plastic_shear, double length) const;

  VonMisesOptions options_;
  Elasticity elasticity_;
};

}  // namespace mudlark

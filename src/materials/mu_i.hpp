#pragma once
/// Granular flow by mu(I): elastic grains that slide at a friction which grows with the rate.
#include "materials/elasticity.hpp"
#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

/// sqrt(J2) = mu(I) P while sliding, P the pressure of the grains, mu = mu_s + (mu_2 - mu_s)/(1 +
/// I_0/I), I = rate d sqrt(rho_s/P) with the plastic shear rate (Jop, Forterre & Pouliquen 2006);
/// no change of volume. Implicit return of Dunatunga & Kamrin (2015), Eqs. 33-40. Looser than where
/// grains last touched without stress they carry nothing. State: plastic shear strain, separation.
class MuI final : public SoilModel {
 public:
  explicit MuI(const MuIOptions& options);

  std::string_view name() const override { return "mu-i"; }
  std::span<const std::string_view> history_names() const override;
  double wave_modulus(std::span<const SymTensor>, std::span<const double>) const override {
    return elasticity_.constrained();
  }
  double shear_modulus() const override { return elasticity_.shear; }
  /// 1 - mu_s, Jaky's ratio for the sine of friction mu_s that the law has in plane shear.
  double earth_pressure_at_rest() const override;
  bool supports(StrainMeasure measure) const override {
    return measure == StrainMeasure::jaumann || measure == StrainMeasure::hencky;
  }
  SymTensor elastic_strain(const SymTensor& stress) const override {
    return elasticity_.strain(stress);
  }
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  double sliding_shear(double trial, double pressure, double dt) const;

  MuIOptions options_;
  Elasticity elasticity_;
};

}  // namespace mudlark

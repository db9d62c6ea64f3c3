#pragma once
/// Linear elasticity inside the Mohr-Coulomb surface, exact at its edges and apex, with tension
/// cut-off and softening.
#include "materials/mohr_coulomb_surface.hpp"
#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

/// Cohesion, tan(friction angle) and tan(dilatancy angle) fall from their first to their residual
/// values as exp(-g h/(g_s l)): g plastic shear strain, h cell size, g_s softening strain and l
/// softening length, so that h g, the slip across a band one cell wide, decides. State: g and the
/// separation of grains.
class MohrCoulomb final : public SoilModel {
 public:
  explicit MohrCoulomb(const MohrCoulombOptions& options);

  std::string_view name() const override { return "mohr-coulomb"; }
  std::span<const std::string_view> history_names() const override;
  double wave_modulus(std::span<const SymTensor>, std::span<const double>) const override {
    return elasticity_.constrained();
  }
  double shear_modulus() const override { return elasticity_.shear; }
  /// Jaky's 1 - sin(phi), of soil that was laid down and never unloaded; without friction that of
  /// elasticity.
  double earth_pressure_at_rest() const override;
  bool supports(StrainMeasure measure) const override {
    return measure == StrainMeasure::jaumann || measure == StrainMeasure::hencky;
  }
  SymTensor elastic_strain(const SymTensor& stress) const override {
    return elasticity_.strain(stress);
  }
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  MohrCoulombSurface surface_at(double plastic_shear, double length) const;
  PrincipalValues soften(const PrincipalValues& trial, double length, double& plastic_shear) const;
  double shear_between(const PrincipalValues& trial, const PrincipalValues& stress) const;
  bool yield(SymTensor& stress, double length, double& plastic_shear, double& separation) const;

  MohrCoulombOptions options_;
  Elasticity elasticity_;
  struct Strength {
    double cohesion = 0.0, tan_friction = 0.0, tan_dilatancy = 0.0;  ///< [Pa], [-]
  };
  Strength peak_, last_{};
  MohrCoulombSurface first_;  ///< before any softening
  bool softens_ = false;
};

}  // namespace mudlark

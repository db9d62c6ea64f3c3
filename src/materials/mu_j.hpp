#pragma once
/// Grains in a liquid: friction and density by the viscous-inertial number J, dilatancy by the
/// distance from that density.
#include "materials/elasticity.hpp"
#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

/// With J = (eta rate + a rho_s d^2 rate^2)/P, while grains slide at the plastic shear rate:
///   phi_eq(J) = phi_m / (1 + sqrt J),  b = K (phi - phi_eq)
///   sqrt(J2) = (mu(J) + b) P,  mu(J) = mu_1 + (mu_2 - mu_1)/(1 + J_0/J) + 5/2 phi_m sqrt J
///   plastic growth of volume = b rate
/// Boyer, Guazzelli & Pouliquen 2011 (mu, phi_eq; the liquid's own eta rate is the liquid's),
/// Pailha & Pouliquen 2009 (b), Tapia, Ichihara, Pouliquen & Guazzelli 2022 (a). Elastic below. The
/// return is implicit in the rate. Grains that part carry nothing until their gap has closed, which
/// shear also does: at P = 0 they have b = K phi. State: solid fraction, plastic shear strain,
/// separation.
class MuJ final : public SoilModel {
 public:
  explicit MuJ(const MuJOptions& options);

  std::string_view name() const override { return "mu-j"; }
  std::span<const std::string_view> history_names() const override;
  void initialise_history(std::span<const SymTensor> stress, double porosity,
                          std::span<double> history) const override;
  double wave_modulus(std::span<const SymTensor>, std::span<const double>) const override {
    return elasticity_.constrained();
  }
  double shear_modulus() const override { return elasticity_.shear; }
  double earth_pressure_at_rest() const override;
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  /// Where a step of plastic shear strain `shear` ends.
  struct Slide {
    double shear = 0.0, pressure = 0.0, strength = 0.0;  ///< [-], P [Pa], sqrt(J2) [Pa]
  };
  double slow_friction(double fraction) const;
  Slide slide(double shear, double compression, double fraction, double dt) const;
  Slide find_slide(double trial, double compression, double fraction, double dt) const;

  MuJOptions options_;
  Elasticity elasticity_;
};

}  // namespace mudlark

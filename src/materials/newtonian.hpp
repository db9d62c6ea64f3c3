#pragma once
/// A weakly compressible Newtonian liquid of material points.
#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

/// sigma = -P I + 2 mu dev(strain rate), dP = -K d(ln J): mass and momentum of the coupling paper's
/// one-phase liquid, Eqs. 3-4, closed by linear compressibility. Pulled beyond `tension_cutoff` it
/// parts, and carries no more until the void has closed. State: the separation.
class Newtonian final : public SoilModel {
 public:
  explicit Newtonian(const NewtonianOptions& options) : options_(options) {}

  std::string_view name() const override { return "newtonian"; }
  std::span<const std::string_view> history_names() const override;
  double wave_modulus(std::span<const SymTensor>, std::span<const double>) const override {
    return options_.bulk_modulus;
  }
  double wave_viscosity() const override { return 4.0 / 3.0 * options_.viscosity; }
  double shear_modulus() const override { return 0.0; }
  double earth_pressure_at_rest() const override { return 1.0; }
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  NewtonianOptions options_;
};

}  // namespace mudlark

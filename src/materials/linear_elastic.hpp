#pragma once
/// Isotropic linear elasticity (Hooke): sigma = lambda tr(eps) I + 2 G eps.
#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

class LinearElastic final : public SoilModel {
 public:
  explicit LinearElastic(const LinearElasticOptions& options);

  std::string_view name() const override { return "linear-elastic"; }
  std::span<const std::string_view> history_names() const override { return {}; }
  double wave_modulus(std::span<const SymTensor>, std::span<const double>) const override {
    return lame_ + 2.0 * shear_;
  }
  double shear_modulus() const override { return shear_; }
  double earth_pressure_at_rest() const override { return lame_ / (lame_ + 2.0 * shear_); }
  bool supports(StrainMeasure) const override { return true; }
  bool yields() const override { return false; }
  SymTensor elastic_strain(const SymTensor& stress) const override;
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  double lame_, shear_;  ///< Lame's first constant and the shear modulus [Pa]
};

}  // namespace mudlark

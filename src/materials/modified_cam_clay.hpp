#pragma once
/// Modified Cam-Clay (Roscoe & Burland 1968): f = q^2 / M^2 + p (p - p_c), associated flow, and p_c
/// grows with the plastic loss of volume.
#include "materials/options.hpp"
#include "materials/porous_elasticity.hpp"
#include "materials/soil_model.hpp"
#include "materials/substepping.hpp"

namespace mudlark {

class ModifiedCamClay final : public SoilModel {
 public:
  explicit ModifiedCamClay(const ModifiedCamClayOptions& options);

  std::string_view name() const override { return "modified-cam-clay"; }
  std::span<const std::string_view> history_names() const override;
  void initialise_history(std::span<const SymTensor> stress, double porosity,
                          std::span<double> history) const override;
  double wave_modulus(std::span<const SymTensor> stress,
                      std::span<const double> history) const override;
  double shear_modulus() const override;
  double earth_pressure_at_rest() const override;
  std::size_t update_stress(const MaterialPoints& points) const override;

  /// q^2 / M^2 + p (p - p_c) [Pa2] of a compression-positive stress.
  double yield_function(const SymTensor& stress, double size) const;

 private:
  /// Compression positive.
  struct State {
    SymTensor stress;     ///< [Pa]
    double size = 0.0;    ///< p_c [Pa]
    double volume = 1.0;  ///< v = 1 + e [-]
    double scale = 0.0;   ///< stress that errors are compared with at least [Pa]
    friend State operator+(State a, const State& b) {
      a.stress += b.stress, a.size += b.size, a.volume += b.volume;
      return a;
    }
    friend State operator*(double f, State a) {
      a.stress = f * a.stress, a.size *= f, a.volume *= f;
      return a;
    }
    friend double relative_error(const State& error, const State& state) {
      return std::max(std::sqrt(error.stress.squared_norm()) /
                          (std::sqrt(state.stress.squared_norm()) + state.scale),
                      std::abs(error.size) / state.size);
    }
  };
  /// What plastic flow does at a stress on the yield surface.
  struct Flow {
    SymTensor gradient;  ///< df/dsigma
    SymTensor elastic;   ///< D : df/dsigma
    double hardening;    ///< dp_c per plastic multiplier
    double resistance;   ///< df/dsigma : D : df/dsigma - df/dp_c hardening
  };
  Flow flow(const State& state) const;
  State rate(const State& state, const SymTensor& strain) const;
  bool correct(State& state) const;
  double elastic_share(const State& state, const SymTensor& strain) const;
  bool update_point(SymTensor& stress, const SymTensor& strain, double* history) const;

  ModifiedCamClayOptions options_;
  PorousElasticity elasticity_;
};

}  // namespace mudlark

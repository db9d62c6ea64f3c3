#pragma once
/// SANISAND: Dafalias & Manzari (2004), J. Eng. Mech. 130, 622-634. A narrow cone that moves with
/// the stress ratio between a bounding and a dilatancy surface, which depend on how far the void
/// ratio is from critical; a fabric tensor remembers dilation.
#include <array>

#include "materials/options.hpp"
#include "materials/soil_model.hpp"
#include "materials/substepping.hpp"
#include "materials/tensor_algebra.hpp"

namespace mudlark {

class Sanisand final : public SoilModel {
 public:
  explicit Sanisand(const SanisandOptions& options);

  std::string_view name() const override { return "sanisand"; }
  std::span<const std::string_view> history_names() const override;
  std::span<const std::size_t> history_tensors() const override;
  void initialise_history(std::span<const SymTensor> stress, double porosity,
                          std::span<double> history) const override;
  double wave_modulus(std::span<const SymTensor> stress,
                      std::span<const double> history) const override;
  double shear_modulus() const override {
    return shear(options_.mean_stress_floor, options_.critical_void_ratio);
  }
  double earth_pressure_at_rest() const override;
  std::size_t update_stress(const MaterialPoints& points) const override;

  /// Void ratio of the critical state at a mean stress [Pa].
  double critical_void_ratio(double pressure) const;

 private:
  /// Compression positive.
  struct State {
    SymTensor stress;      ///< [Pa]
    SymTensor back;        ///< alpha, centre of the cone as a stress ratio [-]
    SymTensor back_start;  ///< alpha_in, where the present loading began [-]
    SymTensor fabric;      ///< z [-]
    double void_ratio = 0.0;
    friend State operator+(State a, const State& b) {
      a.stress += b.stress, a.back += b.back, a.fabric += b.fabric;
      a.void_ratio += b.void_ratio;
      return a;
    }
    friend State operator*(double f, State a) {
      a.stress = f * a.stress, a.back = f * a.back, a.fabric = f * a.fabric;
      a.void_ratio *= f;
      return a;
    }
    friend double relative_error(const State& error, const State& state) {
      constexpr double scale = 10.0;  // [Pa]: larger ones hold up sand that flows to nothing
      const double size = std::sqrt(state.stress.squared_norm());
      const double stress = std::sqrt(error.stress.squared_norm()) / (size + scale);
      // What an error of the cone means for the stress.
      const double back = std::sqrt(error.back.squared_norm()) * size / (size + scale);
      const double fabric =
          std::sqrt(error.fabric.squared_norm()) / (1.0 + std::sqrt(state.fabric.squared_norm()));
      return stress + back + 0.1 * fabric;  // a sum, so that NaN is seen
    }
  };
  /// Plastic flow at a stress on the cone, per plastic multiplier.
  struct Flow {
    SymTensor normal;        ///< n
    SymTensor stress;        ///< stress lost, D : R
    SymTensor back, fabric;  ///< change of alpha and z
    double ratio;            ///< N = n : r
    double resistance;       ///< K_p + n : D : R
  };
  double shear(double pressure, double void_ratio) const;
  SymTensor elastic_stress(const State& state, const SymTensor& strain) const;
  SymTensor stress_ratio(const SymTensor& stress) const;
  double yield_function(const SymTensor& stress, const SymTensor& back) const;
  Flow flow(const State& state) const;
  double loading(const State& state, const Flow& flow, const SymTensor& strain) const;
  State rate(const State& state, const SymTensor& strain) const;
  bool correct(State& state) const;
  double elastic_share(const State& state, const SymTensor& strain) const;
  double gap_without_structure(double void_ratio) const;
  void touch_down(State& state, const SymTensor& strain) const;
  bool advance(State& state, const SymTensor& strain) const;
  bool update_point(SymTensor& stress, const SymTensor& strain, double* history) const;

  SanisandOptions options_;
  double bulk_ratio_;  ///< K / G [-]
  double least_;       ///< mean stress of grains that hardly touch [Pa]
};

}  // namespace mudlark

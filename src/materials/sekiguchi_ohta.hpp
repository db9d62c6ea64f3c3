#pragma once
/// Sekiguchi & Ohta (1977, Proc. 9th ICSMFE, Specialty Session 9, 229-238): Cam-Clay whose yield
/// surface leans towards the stress ratio eta_0 of its consolidation,
///   f = (lambda - kappa)/(1 + e_0) ln(p/p_0) + D eta* - eps_v^p = 0,
///   eta* = sqrt(3/2 (eta - eta_0):(eta - eta_0)),  eta = s/p,
/// associated flow. With D = (lambda - kappa)/(M (1 + e_0)) this is ln(p/p_c) + eta*/M = 0 with
/// d ln p_c = v d eps_v^p/(lambda - kappa): a cone over (ln p, eta) with its tip, a little rounded,
/// on the line of consolidation. Everything here is compression positive.
#include "materials/options.hpp"
#include "materials/porous_elasticity.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

class SekiguchiOhta final : public SoilModel {
 public:
  explicit SekiguchiOhta(const SekiguchiOhtaOptions& options);

  std::string_view name() const override { return "sekiguchi-ohta"; }
  std::span<const std::string_view> history_names() const override;
  std::span<const std::size_t> history_tensors() const override;
  void initialise_history(std::span<const SymTensor> stress, double porosity,
                          std::span<double> history) const override;
  double wave_modulus(std::span<const SymTensor> stress,
                      std::span<const double> history) const override;
  double shear_modulus() const override;
  double earth_pressure_at_rest() const override;
  std::size_t update_stress(const MaterialPoints& points) const override;

  /// ln(p/p_c) + (sqrt(eta*^2 + a^2) - a)/M [-], a the rounding of the tip, of a
  /// compression-positive stress; `axis` is eta_0.
  double yield_function(const SymTensor& stress, const SymTensor& axis, double size) const;

 private:
  struct State {
    double pressure = 0.0;  ///< p [Pa]
    SymTensor distance;     ///< eta - eta_0 [-]
    double size = 0.0;      ///< p_c [Pa]
    double volume = 1.0;    ///< v = 1 + e [-]
  };
  /// Where a sub-step ends if it loses `lost` of the specific volume for good, and what its flow
  /// would then lose.
  struct Trial {
    double pressure, log_ratio;  ///< p, ln(p_c/p)
    double share, stiffness;     ///< of old eta and of the strain in eta without plastic strain
    double length;               ///< |eta - eta_0| without plastic strain of shape
    double allowed;              ///< that the yield surface allows
    double flow;                 ///< r = d(eta*/M)/d|eta - eta_0| there
    double excess;               ///< r times (lost less what the flow rule asks for)
  };
  class Substep;

  double shape(double length) const;  ///< eta*/M, rounded, of a norm of eta - eta_0
  SymTensor stress_of(const State& state, const SymTensor& axis) const;
  /// One backward Euler step; `lost` is its plastic loss of specific volume. False if there is no
  /// answer.
  bool step(State& state, const SymTensor& axis, const SymTensor& strain, double& lost) const;
  double attempt(State& state, const SymTensor& axis, const SymTensor& strain) const;
  double elastic_share(const State& state, const SymTensor& axis, const SymTensor& strain) const;
  bool update_point(SymTensor& stress, const SymTensor& strain, double* history) const;

  SekiguchiOhtaOptions options_;
  PorousElasticity elasticity_;
  double slope_;  ///< sqrt(3/2)/M: eta*/M per norm of eta - eta_0
  double blunt_;  ///< a/M
};

}  // namespace mudlark

#pragma once
/// Parameters of the soil laws that know void ratio and critical state.

namespace mudlark {

/// What Modified Cam-Clay and Sekiguchi-Ohta share.
struct CriticalStateOptions {
  double compression_index = 0.0;      ///< lambda [-], slope of the compression line over ln p
  double swelling_index = 0.0;         ///< kappa [-], slope of swelling lines over ln p
  double critical_stress_ratio = 0.0;  ///< M [-], q/p at the critical state in compression
  double poisson_ratio = 0.3;          ///< [-]
  /// p_c at the start [Pa]; 0: from the overconsolidation ratio.
  double preconsolidation_pressure = 0.0;
  double overconsolidation_ratio = 1.0;  ///< [-], see initial_size in the laws
  double mean_stress_floor = 500.0;      ///< below it stiffness falls no further [Pa]
};

struct ModifiedCamClayOptions : CriticalStateOptions {};

struct SekiguchiOhtaOptions : CriticalStateOptions {
  /// K0 of the virgin consolidation under the vertical stress [-], from which eta* is measured;
  /// negative: the ratio of the initial stress, component by component.
  double consolidation_ratio = -1.0;
  /// D [-] = (lambda - kappa) / (M (1 + e_0)), given instead of M; 0: M is given.
  double dilatancy_coefficient = 0.0;
};

/// Parameters of Dafalias & Manzari (2004), with their letters.
struct SanisandOptions {
  double shear_coefficient = 0.0;      ///< G_0 [-]
  double poisson_ratio = 0.0;          ///< [-]
  double critical_stress_ratio = 0.0;  ///< M [-] in compression
  double extension_ratio = 0.0;        ///< c [-], M in extension over M in compression
  double critical_slope = 0.0;         ///< lambda_c [-]
  double critical_void_ratio = 0.0;    ///< e_0 [-], of the critical state at no stress
  double critical_exponent = 0.0;      ///< xi [-]
  double yield_radius = 0.0;           ///< m [-]
  double hardening_coefficient = 0.0;  ///< h_0 [-]
  double hardening_void_ratio = 0.0;   ///< c_h [-]
  double bounding_exponent = 0.0;      ///< n^b [-]
  double dilatancy_coefficient = 0.0;  ///< A_0 [-]
  double dilatancy_exponent = 0.0;     ///< n^d [-]
  double largest_fabric = 0.0;         ///< z_max [-]
  double fabric_rate = 0.0;            ///< c_z [-]
  double reference_pressure = 1e5;     ///< p_at [Pa]
  double mean_stress_floor = 500.0;  ///< below it moduli fall with p, and h and psi not at all [Pa]
  /// Void ratio at which grains that were shaken apart touch again [-]; 0: the present one.
  double settled_void_ratio = 0.0;

  /// Toyoura sand, Table 1 there.
  static SanisandOptions toyoura() {
    return {125.0, 0.05,  1.25, 0.712, 0.019, 0.934, 0.7,  0.01,
            7.05,  0.968, 1.1,  0.704, 3.5,   4.0,   600.0};
  }
};

}  // namespace mudlark

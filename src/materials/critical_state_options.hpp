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

}  // namespace mudlark

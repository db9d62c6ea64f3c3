#pragma once
/// Parameters of the soil laws, as plain data (SI units).
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "materials/critical_state_options.hpp"
#include "materials/umat_options.hpp"

namespace mudlark {

/// How strain is measured against stress. small: Cauchy stress linear in the displacement gradient;
/// logarithmic: Cauchy stress linear in logarithmic strain; hencky: Kirchhoff stress linear in
/// logarithmic strain; objective: Hill's rate, as Anura3D with its objective stress switched on;
/// jaumann: the increment of the step added to the rotated old stress (Hughes & Winget 1980), the
/// one measure of laws whose elasticity depends on the stress, and of UMATs.
enum class StrainMeasure { small, logarithmic, hencky, objective, jaumann };

struct LinearElasticOptions {
  double young_modulus = 0.0;  ///< [Pa], effective
  double poisson_ratio = 0.0;  ///< [-], effective
};
/// Exponential fall of strength with plastic engineering shear strain g, measured as slip h g
/// across a band one cell wide when a length is given: then the work spent until the strength is
/// gone does not depend on the cell size h.
struct Softening {
  double strain = 0.1;  ///< g_s, at which 1/e of what can be lost is left [-]
  double length = 0.0;  ///< l [m], the width of band that g_s was measured at; 0: g alone decides

  /// What is left of what can be lost [-].
  double share(double plastic_shear, double cell_size) const {
    const double wider = length > 0.0 ? cell_size / length : 1.0;
    return std::exp(-plastic_shear / strain * wider);
  }
};

struct MohrCoulombOptions {
  double young_modulus = 0.0;    ///< [Pa], effective
  double poisson_ratio = 0.0;    ///< [-], effective
  double cohesion = 0.0;         ///< c [Pa]
  double friction_angle = 0.0;   ///< phi [rad]
  double dilatancy_angle = 0.0;  ///< psi [rad]
  double tension_cutoff =
      std::numeric_limits<double>::infinity();  ///< largest principal stress [Pa]
  struct Residual {
    double cohesion = 0.0, friction_angle = 0.0, dilatancy_angle = 0.0;  ///< [Pa], [rad]
    Softening softening{};
  };
  std::optional<Residual> residual{};
};

/// Undrained strength s_u [Pa], in total stresses, and what is left of it.
struct UndrainedResidual {
  double strength = 0.0;  ///< [Pa]
  Softening softening{};
};
struct TrescaOptions {
  double young_modulus = 0.0;       ///< [Pa], undrained
  double poisson_ratio = 0.0;       ///< [-], undrained
  double undrained_strength = 0.0;  ///< s_u [Pa]
  std::optional<UndrainedResidual> residual{};
};
struct VonMisesOptions {
  double young_modulus = 0.0;       ///< [Pa], undrained
  double poisson_ratio = 0.0;       ///< [-], undrained
  double undrained_strength = 0.0;  ///< s_u [Pa] in shear
  std::optional<UndrainedResidual> residual{};
};

/// The states at which the cone has the strength of Mohr-Coulomb.
enum class DruckerPragerMatch { plane_strain, compression, extension };
struct DruckerPragerOptions {
  double young_modulus = 0.0;                                       ///< [Pa], effective
  double poisson_ratio = 0.0;                                       ///< [-], effective
  double cohesion = 0.0;                                            ///< c [Pa]
  double friction_angle = 0.0;                                      ///< phi [rad]
  double dilatancy_angle = 0.0;                                     ///< psi [rad]
  double tension_cutoff = std::numeric_limits<double>::infinity();  ///< largest mean stress [Pa]
  DruckerPragerMatch match = DruckerPragerMatch::plane_strain;
};

/// mu(I); the defaults are glass beads (Jop, Forterre & Pouliquen 2006).
struct MuIOptions {
  double young_modulus = 0.0;         ///< [Pa], of the grains' skeleton
  double poisson_ratio = 0.0;         ///< [-]
  double static_friction = 0.3819;    ///< mu_s [-]
  double limiting_friction = 0.6435;  ///< mu_2 [-]
  double inertial_number = 0.279;     ///< I_0 [-]
  double grain_diameter = 0.0;        ///< d [m]
  double grain_density = 2650.0;      ///< rho_s [kg/m3]
};

/// mu(J), grains in a liquid; the defaults are glass beads (Boyer, Guazzelli & Pouliquen 2011;
/// Pailha & Pouliquen 2009).
struct MuJOptions {
  double young_modulus = 0.0;           ///< [Pa], of the grains' skeleton
  double poisson_ratio = 0.0;           ///< [-]
  double static_friction = 0.32;        ///< mu_1 [-]
  double limiting_friction = 0.7;       ///< mu_2 [-]
  double viscous_number = 0.005;        ///< J_0 [-]
  double critical_fraction = 0.585;     ///< phi_m, share of grains that slow shear tends to [-]
  double dilatancy_coefficient = 4.09;  ///< K [-]
  double grain_diameter = 0.0;          ///< d [m]
  double grain_density = 2650.0;        ///< rho_s [kg/m3]
  double liquid_viscosity = 1.002e-3;   ///< eta [Pa s]
};

struct NewtonianOptions {
  double bulk_modulus = 0.0;    ///< K [Pa]
  double viscosity = 0.0;       ///< mu [Pa s]
  double tension_cutoff = 0.0;  ///< largest mean stress [Pa]
};
using SoilLawOptions =
    std::variant<LinearElasticOptions, MohrCoulombOptions, TrescaOptions, VonMisesOptions,
                 DruckerPragerOptions, MuIOptions, MuJOptions, NewtonianOptions,
                 ModifiedCamClayOptions, SekiguchiOhtaOptions, SanisandOptions, UmatOptions>;

}  // namespace mudlark

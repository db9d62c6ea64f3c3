#pragma once
/// Parameters of the soil laws, as plain data (SI units).
#include <variant>

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
using SoilLawOptions = std::variant<LinearElasticOptions>;

}  // namespace mudlark

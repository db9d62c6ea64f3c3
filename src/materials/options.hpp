#pragma once
/// Parameters of the soil laws, as plain data (SI units).
#include <variant>

namespace mudlark {

/// How strain is measured against stress. small: Cauchy stress linear in the displacement gradient;
/// logarithmic: Cauchy stress linear in logarithmic strain; hencky: Kirchhoff stress linear in
/// logarithmic strain; objective: Hill's rate, as Anura3D with its objective stress switched on.
enum class StrainMeasure { small, logarithmic, hencky, objective };

struct LinearElasticOptions {
  double young_modulus = 0.0;  ///< [Pa], effective
  double poisson_ratio = 0.0;  ///< [-], effective
  StrainMeasure strain = StrainMeasure::hencky;
};
using SoilLawOptions = std::variant<LinearElasticOptions>;

}  // namespace mudlark

#include "materials/linear_elastic.hpp"

namespace mudlark {

LinearElastic::LinearElastic(const LinearElasticOptions& options)
    : lame_(options.young_modulus * options.poisson_ratio /
            ((1.0 + options.poisson_ratio) * (1.0 - 2.0 * options.poisson_ratio))),
      shear_(options.young_modulus / (2.0 * (1.0 + options.poisson_ratio))) {}

SymTensor LinearElastic::elastic_strain(const SymTensor& stress) const {
  const double volumetric = stress.trace() / (3.0 * lame_ + 2.0 * shear_);
  return (0.5 / shear_) * (stress + (-lame_ * volumetric) * SymTensor::identity());
}

std::size_t LinearElastic::update_stress(const MaterialPoints& points) const {
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    const SymTensor& strain = points.strain_increment[i];
    points.stress[i] += 2.0 * shear_ * strain + (lame_ * strain.trace()) * SymTensor::identity();
  }
  return 0;
}

}  // namespace mudlark

#include "soil/kinematics.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace mudlark {
namespace {

using Matrix = Eigen::Matrix3d;

Matrix to_matrix(const SymTensor& t) {
  Matrix m;
  m << t.xx, t.xy, t.zx, t.xy, t.yy, t.yz, t.zx, t.yz, t.zz;
  return m;
}
SymTensor to_tensor(const Matrix& m) {
  return {m(0, 0),
          m(1, 1),
          m(2, 2),
          0.5 * (m(0, 1) + m(1, 0)),
          0.5 * (m(1, 2) + m(2, 1)),
          0.5 * (m(0, 2) + m(2, 0))};
}

}  // namespace

SymTensor half_log_plane(const SymTensor& b) {
  const double mean = 0.5 * (b.xx + b.zz), difference = 0.5 * (b.xx - b.zz);
  const double radius = std::sqrt(difference * difference + b.zx * b.zx);
  const double middle = 0.25 * std::log(b.xx * b.zz - b.zx * b.zx);
  const double ratio = radius / mean;
  const double slope = 0.5 * (ratio > 1e-6 ? std::atanh(ratio) / radius : 1.0 / mean);
  SymTensor strain;
  strain.xx = middle + slope * difference;
  strain.zz = middle - slope * difference;
  strain.zx = slope * b.zx;
  strain.yy = 0.5 * std::log(b.yy);
  return strain;
}

SymTensor half_log(const SymTensor& b) {
  const Matrix m = to_matrix(b), x = m - Matrix::Identity();
  if (x.squaredNorm() <
      1e-6) {  // ln(I + X) = X - X^2/2 + X^3/3 - ...: below round-off after six terms
    Matrix power = x, sum = x;
    for (int k = 2; k <= 6; ++k) {
      power = power * x;
      sum += (k % 2 == 0 ? -1.0 : 1.0) / k * power;
    }
    return to_tensor(0.5 * sum);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(m);
  return to_tensor(eigen.eigenvectors() *
                   (0.5 * eigen.eigenvalues().array().log()).matrix().asDiagonal() *
                   eigen.eigenvectors().transpose());
}

SymTensor exp_twice(const SymTensor& strain) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(to_matrix(strain));
  return to_tensor(eigen.eigenvectors() *
                   (2.0 * eigen.eigenvalues().array()).exp().matrix().asDiagonal() *
                   eigen.eigenvectors().transpose());
}

template <int D>
void initialise_material_state(SoilParticles<D>& points, const SoilModel& law,
                               StrainMeasure measure, double porosity) {
  const std::size_t count = points.history.size();
  std::vector<double> history(count);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SymTensor stress = get_tensor(points.stress, p);
    std::fill(history.begin(), history.end(), 0.0);
    law.initialise_history({&stress, 1}, porosity, history);
    for (std::size_t h = 0; h < count; ++h) points.history[h][p] = history[h];
    if (points.carries_deformation)
      for (int a = 0; a < D; ++a) points.deformation[a * D + a][p] = 1.0;
    if (measure == StrainMeasure::objective || measure == StrainMeasure::jaumann) continue;
    const SymTensor strain = law.elastic_strain(stress);
    set_tensor(points.elastic, p, measure == StrainMeasure::small ? strain : exp_twice(strain));
  }
}

template void initialise_material_state(SoilParticles<2>&, const SoilModel&, StrainMeasure, double);
template void initialise_material_state(SoilParticles<3>&, const SoilModel&, StrainMeasure, double);

}  // namespace mudlark

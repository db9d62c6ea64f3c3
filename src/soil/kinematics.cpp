#include "soil/kinematics.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
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

/// The D x D matrix of a plane or spatial problem, put into three dimensions (2D: rows x and z).
template <int D>
Matrix embed(const double* values, double out_of_plane) {
  Matrix m = Matrix::Identity() * out_of_plane;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) m(D == 2 ? 2 * i : i, D == 2 ? 2 * j : j) = values[i * D + j];
  return m;
}

/// 1/2 ln of the plane block (x, z) in closed form, and of yy; exact for plane strain.
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

struct Batch {
  static constexpr std::size_t capacity = 128;
  std::array<SymTensor, capacity> strain, stress;
};

/// Rotated old stress and strain increment of Hughes & Winget (1980), Eqs. 15-22, mid-step
/// gradient.
void rotate(const Matrix& step_gradient, SymTensor& stress, SymTensor& strain) {
  const Matrix identity = Matrix::Identity();
  const Matrix middle = step_gradient * (identity + 0.5 * step_gradient).inverse();
  const Matrix spin = 0.5 * (middle - middle.transpose());
  const Matrix rotation = (identity - 0.5 * spin).inverse() * (identity + 0.5 * spin);
  stress = to_tensor(rotation * to_matrix(stress) * rotation.transpose());
  strain = to_tensor(middle);
}

/// b_e <- f b_e f^T with f = I + step gradient.
template <int D>
SymTensor push_forward(const SymTensor& b, const double* gradient) {
  if constexpr (D == 2) {
    const double a = 1.0 + gradient[0], c = gradient[1], d = gradient[2], e = 1.0 + gradient[3];
    SymTensor out = b;
    out.xx = a * a * b.xx + 2.0 * a * c * b.zx + c * c * b.zz;
    out.zz = d * d * b.xx + 2.0 * d * e * b.zx + e * e * b.zz;
    out.zx = a * d * b.xx + (a * e + c * d) * b.zx + c * e * b.zz;
    return out;
  } else {
    const Matrix f = Matrix::Identity() + embed<D>(gradient, 0.0);
    return to_tensor(f * to_matrix(b) * f.transpose());
  }
}

/// The strain that the law sees, and the stress that it starts from.
template <int D>
void prepare(SoilParticles<D>& points, std::size_t p, const double* gradient, StrainMeasure measure,
             SymTensor& strain, SymTensor& stress) {
  stress = SymTensor{};
  if (measure == StrainMeasure::objective) {
    stress = get_tensor(points.stress, p);
    rotate(embed<D>(gradient, 0.0), stress, strain);
  } else if (measure == StrainMeasure::small) {
    std::array<double, D * D> old{}, now{};
    for (int c = 0; c < D * D; ++c)
      now[static_cast<std::size_t>(c)] = old[static_cast<std::size_t>(c)] =
          points.deformation[c][p];
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        for (int k = 0; k < D; ++k)
          now[static_cast<std::size_t>(i * D + j)] +=
              gradient[i * D + k] * old[static_cast<std::size_t>(k * D + j)];
    for (int c = 0; c < D * D; ++c) points.deformation[c][p] = now[static_cast<std::size_t>(c)];
    strain = to_tensor(embed<D>(now.data(), 1.0)) + -1.0 * SymTensor::identity() +
             get_tensor(points.elastic, p);
  } else {
    const SymTensor b = push_forward<D>(get_tensor(points.elastic, p), gradient);
    set_tensor(points.elastic, p, b);
    strain = D == 2 ? half_log_plane(b) : half_log(b);
  }
}

}  // namespace

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
std::size_t update_stress(SoilParticles<D>& points, std::size_t first, std::size_t count,
                          std::span<const double> gradient, const SoilModel& law,
                          StrainMeasure measure, double dt) {
  Batch batch;
  std::size_t failed = 0;
  for (std::size_t start = 0; start < count; start += Batch::capacity) {
    const std::size_t length = std::min(Batch::capacity, count - start);
    for (std::size_t k = 0; k < length; ++k)
      prepare<D>(points, first + start + k, gradient.data() + (start + k) * D * D, measure,
                 batch.strain[k], batch.stress[k]);
    failed +=
        law.update_stress({{batch.strain.data(), length}, {batch.stress.data(), length}, {}, dt});
    for (std::size_t k = 0; k < length; ++k) {
      const std::size_t p = first + start + k;
      SymTensor stress = batch.stress[k];
      if (measure == StrainMeasure::hencky)
        stress = (points.start_volume[p] / points.volume[p]) * stress;
      if (measure == StrainMeasure::objective) {  // Hill's term, mid-step
        const double half_rate = 0.5 * batch.strain[k].trace();
        SymTensor rotated = get_tensor(points.stress, p), unused;
        rotate(embed<D>(gradient.data() + (start + k) * D * D, 0.0), rotated, unused);
        stress = (1.0 / (1.0 + half_rate)) * (stress + -half_rate * rotated);
      }
      set_tensor(points.stress, p, stress);
    }
  }
  return failed;
}

template <int D>
void initialise_elastic_state(SoilParticles<D>& points, const SoilModel& law,
                              StrainMeasure measure) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SymTensor strain = law.elastic_strain(get_tensor(points.stress, p));
    set_tensor(points.elastic, p, measure == StrainMeasure::small ? strain : exp_twice(strain));
    if (points.carries_deformation)
      for (int a = 0; a < D; ++a) points.deformation[a * D + a][p] = 1.0;
  }
}

template std::size_t update_stress(SoilParticles<2>&, std::size_t, std::size_t,
                                   std::span<const double>, const SoilModel&, StrainMeasure,
                                   double);
template std::size_t update_stress(SoilParticles<3>&, std::size_t, std::size_t,
                                   std::span<const double>, const SoilModel&, StrainMeasure,
                                   double);
template void initialise_elastic_state(SoilParticles<2>&, const SoilModel&, StrainMeasure);
template void initialise_elastic_state(SoilParticles<3>&, const SoilModel&, StrainMeasure);

}  // namespace mudlark

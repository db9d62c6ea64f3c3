#include "soil/kinematics.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
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

/// A run of points on their way through the law.
struct Batch {
  static constexpr std::size_t capacity = 128;
  std::array<SymTensor, capacity> strain, stress;
  std::array<std::array<double, 9>, capacity> rotation;
  std::array<unsigned char, capacity> failed;
  std::vector<double> history;  ///< point after point
};

SymTensor rotated(const SymTensor& tensor, const Matrix& rotation) {
  return to_tensor(rotation * to_matrix(tensor) * rotation.transpose());
}

/// The same about the y axis, the one rotation of plane problems.
SymTensor rotated_in_plane(const SymTensor& t, const Matrix& rotation) {
  const double c = rotation(0, 0), s = rotation(0, 2);
  const double mean = 0.5 * (t.xx + t.zz), half = 0.5 * (t.xx - t.zz);
  const double cosine = c * c - s * s, sine = 2.0 * s * c;  // of twice the angle
  const double turned = cosine * half + sine * t.zx;
  return {mean + turned,       t.yy,
          mean - turned,       c * t.xy + s * t.yz,
          c * t.yz - s * t.xy, cosine * t.zx - sine * half};
}

/// Rotation and strain increment of Hughes & Winget (1980), Eqs. 15-22, mid-step gradient.
template <int D>
Matrix step_rotation(const double* gradient, SymTensor& strain);

/// In the plane in closed form: with the spin [0 w; -w 0] the rotation is [1 - w^2/4, w; -w, 1 -
/// w^2/4] / (1 + w^2/4).
template <>
Matrix step_rotation<2>(const double* gradient, SymTensor& strain) {
  const double a = 1.0 + 0.5 * gradient[0], b = 0.5 * gradient[1];
  const double c = 0.5 * gradient[2], d = 1.0 + 0.5 * gradient[3];
  // g (I + g/2)^-1 = 2 (I - (I + g/2)^-1), written without cancellation
  const double twice = 2.0 / (a * d - b * c);
  const double xx = twice * (0.5 * gradient[0] * d - b * c), xz = twice * b;
  const double zz = twice * (0.5 * gradient[3] * a - b * c), zx = twice * c;
  strain = {xx, 0.0, zz, 0.0, 0.0, 0.5 * (xz + zx)};
  const double half = 0.25 * (xz - zx), scale = 1.0 / (1.0 + half * half);
  Matrix rotation = Matrix::Identity();
  rotation(0, 0) = rotation(2, 2) = (1.0 - half * half) * scale;
  rotation(0, 2) = 2.0 * half * scale;
  rotation(2, 0) = -rotation(0, 2);
  return rotation;
}

template <>
Matrix step_rotation<3>(const double* gradient, SymTensor& strain) {
  const Matrix step_gradient = embed<3>(gradient, 0.0);
  const Matrix identity = Matrix::Identity();
  const Matrix middle = step_gradient * (identity + 0.5 * step_gradient).inverse();
  const Matrix spin = 0.5 * (middle - middle.transpose());
  strain = to_tensor(middle);
  return (identity - 0.5 * spin).inverse() * (identity + 0.5 * spin);
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

bool is_rate(StrainMeasure measure) {
  return measure == StrainMeasure::objective || measure == StrainMeasure::jaumann;
}

/// The strain that the law sees, and the stress that it starts from.
template <int D>
void prepare(SoilParticles<D>& points, std::size_t p, const double* gradient, StrainMeasure measure,
             SymTensor& strain, SymTensor& stress, Matrix& rotation) {
  stress = SymTensor{};
  if (is_rate(measure)) {
    rotation = step_rotation<D>(gradient, strain);
    const SymTensor old = get_tensor(points.stress, p);
    stress = D == 2 ? rotated_in_plane(old, rotation) : rotated(old, rotation);
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

namespace {

/// State variables of the points [first, first + length) into the batch, tensors turned.
template <int D>
void load_history(const SoilParticles<D>& points, std::size_t first, std::size_t length,
                  const SoilModel& law, bool rate, Batch& batch) {
  const std::size_t count = points.history.size();
  batch.history.resize(count * length);
  for (std::size_t h = 0; h < count; ++h)
    for (std::size_t k = 0; k < length; ++k)
      batch.history[k * count + h] = points.history[h][first + k];
  if (!rate) return;
  for (const std::size_t at : law.history_tensors())
    for (std::size_t k = 0; k < length; ++k) {
      double* values = &batch.history[k * count + at];
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(
          batch.rotation[k].data());
      const SymTensor turned =
          rotated({values[0], values[1], values[2], values[3], values[4], values[5]}, rotation);
      values[0] = turned.xx, values[1] = turned.yy, values[2] = turned.zz;
      values[3] = turned.xy, values[4] = turned.yz, values[5] = turned.zx;
    }
}
template <int D>
void store_history(SoilParticles<D>& points, std::size_t first, std::size_t length,
                   const Batch& batch) {
  const std::size_t count = points.history.size();
  for (std::size_t h = 0; h < count; ++h)
    for (std::size_t k = 0; k < length; ++k)
      points.history[h][first + k] = batch.history[k * count + h];
}

/// Cauchy stress from what the law gave, and the elastic state that belongs to it.
template <int D>
void finish(SoilParticles<D>& points, std::size_t p, const SymTensor& strain,
            const Matrix& rotation, const SoilModel& law, StrainMeasure measure, SymTensor stress) {
  if (measure == StrainMeasure::hencky) {
    if (law.yields()) {
      const SymTensor elastic = law.elastic_strain(stress);
      const SymTensor lost = strain + -1.0 * elastic;
      if (lost.squared_norm() > 1e-26) set_tensor(points.elastic, p, exp_twice(elastic));
    }
    stress = (points.start_volume[p] / points.volume[p]) * stress;
  }
  if (measure == StrainMeasure::objective) {  // Hill's term, mid-step
    const double half_rate = 0.5 * strain.trace();
    const SymTensor old = rotated(get_tensor(points.stress, p), rotation);
    stress = (1.0 / (1.0 + half_rate)) * (stress + -half_rate * old);
  }
  set_tensor(points.stress, p, stress);
}

}  // namespace

template <int D>
StressResult update_stress(SoilParticles<D>& points, std::span<const double> gradient,
                           const SoilModel& law, StrainMeasure measure, const StressStep& step) {
  Batch batch;
  StressResult result;
  const bool with_history = !points.history.empty();
  Matrix rotation = Matrix::Identity();
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  for (std::size_t first = 0; first < points.size(); first += Batch::capacity) {
    const std::size_t length = std::min(Batch::capacity, points.size() - first);
    for (std::size_t k = 0; k < length; ++k) {
      prepare<D>(points, first + k, gradient.data() + (first + k) * D * D, measure, batch.strain[k],
                 batch.stress[k], rotation);
      if (is_rate(measure)) Eigen::Map<RowMajor>(batch.rotation[k].data()) = rotation;
    }
    if (with_history) load_history(points, first, length, law, is_rate(measure), batch);
    std::fill_n(batch.failed.begin(), length, static_cast<unsigned char>(0));
    MaterialPoints material{
        {batch.strain.data(), length}, {batch.stress.data(), length}, batch.history};
    material.dt = step.dt, material.time = step.time, material.length = step.length;
    if (law.wants_rotation()) material.rotation = {batch.rotation.data(), length};
    material.failed = {batch.failed.data(), length};
    const std::size_t failed = law.update_stress(material);
    if (failed > 0 && result.failed == 0)
      result.first_failed =
          first + static_cast<std::size_t>(std::find(batch.failed.begin(), batch.failed.end(), 1) -
                                           batch.failed.begin());
    result.failed += failed;
    if (with_history) store_history(points, first, length, batch);
    for (std::size_t k = 0; k < length; ++k)
      finish(points, first + k, batch.strain[k],
             is_rate(measure) ? Matrix(Eigen::Map<const RowMajor>(batch.rotation[k].data()))
                              : rotation,
             law, measure, batch.stress[k]);
  }
  return result;
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
    if (is_rate(measure)) continue;
    const SymTensor strain = law.elastic_strain(stress);
    set_tensor(points.elastic, p, measure == StrainMeasure::small ? strain : exp_twice(strain));
  }
}

template StressResult update_stress(SoilParticles<2>&, std::span<const double>, const SoilModel&,
                                    StrainMeasure, const StressStep&);
template StressResult update_stress(SoilParticles<3>&, std::span<const double>, const SoilModel&,
                                    StrainMeasure, const StressStep&);
template void initialise_material_state(SoilParticles<2>&, const SoilModel&, StrainMeasure, double);
template void initialise_material_state(SoilParticles<3>&, const SoilModel&, StrainMeasure, double);

}  // namespace mudlark

#pragma once
/// Exact consolidation of an elastic layer under a load that varies along it.
#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace mudlark {

/// A layer of height H on a smooth, impermeable base; its surface is drained and carries
/// q cos(xi x) from time zero on; grains and water are incompressible (Biot 1941; Gibson, Schiffman
/// & Pu 1970 for the layer). With settlement and pressure proportional to cos(xi x), M = lambda +
/// 2 G, c = k M / gamma_w and e the volumetric strain, the Laplace transform of Biot's equations
/// has the solutions
///   e = A cosh(mu z),  p = M e + C cosh(xi z),  mu^2 = xi^2 + s/c,
///   u_z = A mu sinh(mu z) c/s + C/(2G) z cosh(xi z) + F sinh(xi z),
/// and drainage, normal and shear stress at z = H give A, C, F. The transform is inverted by
/// Stehfest's method (1970), which does for smooth histories.
class LayerConsolidation {
 public:
  LayerConsolidation(double lambda, double shear, double consolidation, double height)
      : lambda_(lambda), shear_(shear), consolidation_(consolidation), height_(height) {}

  struct State {
    double way = 0.0;       ///< upwards [m]
    double pressure = 0.0;  ///< [Pa]
  };
  /// Amplitudes at height z and time t for q = 1 Pa and wave number xi [1/m].
  State operator()(double wave_number, double z, double time) const {
    constexpr int terms = 12;
    State sum;
    for (int i = 1; i <= terms; ++i) {
      const double weight = stehfest(i, terms) * std::log(2.0) / time;
      const State part = transformed(wave_number, z, i * std::log(2.0) / time);
      sum.way += weight * part.way;
      sum.pressure += weight * part.pressure;
    }
    return sum;
  }

 private:
  static double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }
  static double stehfest(int i, int terms) {
    double sum = 0.0;
    const int half = terms / 2;
    for (int k = (i + 1) / 2; k <= std::min(i, half); ++k)
      sum += std::pow(k, half) * factorial(2 * k) /
             (factorial(half - k) * factorial(k) * factorial(k - 1) * factorial(i - k) *
              factorial(2 * k - i));
    return (half + i) % 2 == 0 ? sum : -sum;
  }
  /// cosh(a z) / cosh(a H) and sinh(a z) / cosh(a H).
  double even(double a, double z) const {
    return std::exp(a * (z - height_)) * (1.0 + std::exp(-2.0 * a * z)) /
           (1.0 + std::exp(-2.0 * a * height_));
  }
  double odd(double a, double z) const {
    return std::exp(a * (z - height_)) * (1.0 - std::exp(-2.0 * a * z)) /
           (1.0 + std::exp(-2.0 * a * height_));
  }

  State transformed(double xi, double z, double s) const {
    const double modulus = lambda_ + 2.0 * shear_, h = height_;
    const double mu = std::sqrt(xi * xi + s / consolidation_);
    if (xi == 0.0) {
      const double strain = -1.0 / (s * modulus);
      return {strain * odd(mu, z) / mu, 1.0 / s + modulus * strain * even(mu, z)};
    }
    // Unknowns: M A cosh(mu H), C cosh(xi H), 2 G xi F cosh(xi H), all pressures.
    const double inverse = consolidation_ / s;  // 1 / (mu^2 - xi^2)
    const double tanh_mu = odd(mu, h), tanh_xi = odd(xi, h), half = 0.5 / shear_;
    Eigen::Matrix3d matrix;
    matrix.row(0) << 1.0, 1.0, 0.0;
    matrix.row(1) << (lambda_ + 2.0 * shear_ * mu * mu * inverse) / modulus, 1.0 + xi * h * tanh_xi,
        1.0;
    // u_x' - xi u_z with u_x = (e - u_z') / xi, times 2 G / xi; 1 - mu^2/(mu^2 - xi^2) written out.
    matrix.row(2) << -4.0 * shear_ * mu * tanh_mu * inverse / modulus, -2.0 * (tanh_xi / xi + h),
        -2.0 * tanh_xi / xi;
    Eigen::Vector3d factor = matrix.fullPivLu().solve(Eigen::Vector3d(0.0, -1.0 / s, 0.0));
    factor[0] /= modulus;
    factor[2] *= half / xi;
    return {factor[0] * mu * odd(mu, z) * inverse + factor[1] * half * z * even(xi, z) +
                factor[2] * odd(xi, z),
            modulus * factor[0] * even(mu, z) + factor[1] * even(xi, z)};
  }

  double lambda_, shear_, consolidation_, height_;
};

}  // namespace mudlark

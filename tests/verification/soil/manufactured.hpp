#pragma once
/// Manufactured motions of an elastic solid (Kirchhoff stress linear in logarithmic strain,
/// `hencky`) and the body accelerations that they need. Derived here; the motions are those of
/// Wallstedt & Guilkey (2008) and Kamojjala, Brannon, Sadeghirad & Guilkey (2015).
#include <cmath>
#include <numbers>

#include "base/vec.hpp"

namespace mudlark {

struct ElasticSolid {
  double young = 1e7, poisson = 0.3, density = 1000.0;
  double shear() const { return 0.5 * young / (1.0 + poisson); }
  double lame() const { return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
};

/// Axis-aligned motion of the unit square, u = A sin(2 pi X) sin(C pi t), w = A sin(2 pi Z) sin(C
/// pi t + pi), C = sqrt(E/rho).
struct AxisAligned {
  static constexpr double pi = std::numbers::pi;
  ElasticSolid solid;
  double amplitude = 0.05;

  double rate() const { return pi * std::sqrt(solid.young / solid.density); }
  double phase(int axis) const { return axis == 0 ? 0.0 : pi; }
  double displacement(int axis, double start, double time) const {
    return amplitude * std::sin(2.0 * pi * start) * std::sin(rate() * time + phase(axis));
  }
  double velocity(int axis, double start, double time) const {
    return rate() * amplitude * std::sin(2.0 * pi * start) * std::cos(rate() * time + phase(axis));
  }
  double stretch(int axis, double start, double time) const {
    return 1.0 + 2.0 * pi * amplitude * std::cos(2.0 * pi * start) *
                     std::sin(rate() * time + phase(axis));
  }
  /// Start of the material that is at `place` now, by Newton's method.
  double start_of(int axis, double place, double time) const {
    double start = place;
    for (int i = 0; i < 50; ++i) {
      const double off = start + displacement(axis, start, time) - place;
      if (std::abs(off) < 1e-15) break;
      start -= off / stretch(axis, start, time);
    }
    return start;
  }
  /// b = a - div P / rho, with P = tau/F and tau = lambda ln J + 2 mu ln F along the axis.
  double body_acceleration(int axis, const Vec<2>& place, double time) const {
    const double x = start_of(axis, place[axis], time);
    const double other = start_of(1 - axis, place[1 - axis], time);
    const double f = stretch(axis, x, time), g = stretch(1 - axis, other, time);
    const double wave = solid.lame() + 2.0 * solid.shear();
    const double stress = solid.lame() * std::log(f * g) + 2.0 * solid.shear() * std::log(f);
    const double slope = -4.0 * pi * pi * displacement(axis, x, time);
    const double force = slope / (f * f) * (wave - stress);
    return -rate() * rate() * displacement(axis, x, time) - force / solid.density;
  }
};

/// Generalised vortex in the ring 0.75 < R < 1.25 about `centre`: every circle turns by alpha(R, t)
/// = g(t) h(R), so that the shear varies in space and time and the ring's edges rest.
struct Vortex {
  ElasticSolid solid{1000.0, 0.3, 1000.0};
  double period = 1.0, largest = 1.0;
  Vec<2> centre{{1.5, 1.5}};

  double g(double t) const { return 0.5 * (1.0 - std::cos(w() * t)); }
  double g1(double t) const { return 0.5 * w() * std::sin(w() * t); }
  double g2(double t) const { return 0.5 * w() * w() * std::cos(w() * t); }
  double w() const { return 2.0 * std::numbers::pi / period; }
  static bool in_ring(double r) { return r > 0.75 && r < 1.25; }
  double h(double r) const {
    const double q = r - 1.0;
    return in_ring(r) ? largest * (1.0 - 32.0 * q * q + 256.0 * q * q * q * q) : 0.0;
  }
  double h1(double r) const {
    const double q = r - 1.0;
    return in_ring(r) ? largest * (-64.0 * q + 1024.0 * q * q * q) : 0.0;
  }
  double h2(double r) const {
    const double q = r - 1.0;
    return in_ring(r) ? largest * (-64.0 + 3072.0 * q * q) : 0.0;
  }
  Vec<2> position(const Vec<2>& start, double time) const {
    const Vec<2> x = start - centre;
    const double angle = g(time) * h(norm(x)), c = std::cos(angle), s = std::sin(angle);
    return centre + Vec<2>{{c * x[0] - s * x[1], s * x[0] + c * x[1]}};
  }
  Vec<2> velocity(const Vec<2>& place, double time) const {
    const Vec<2> x = place - centre;
    const double turn = g1(time) * h(norm(x));
    return Vec<2>{{-turn * x[1], turn * x[0]}};
  }
  /// tau_rtheta and tau_thetatheta = -tau_rr [Pa] at the shear gamma: V of simple shear has the
  /// principal stretches exp(+-asinh(gamma/2)).
  void stress(double gamma, double& shear, double& hoop) const {
    const double size =
        2.0 * solid.shear() * std::asinh(0.5 * gamma) / std::sqrt(1.0 + 0.25 * gamma * gamma);
    shear = size;
    hoop = 0.5 * gamma * size;
  }
  /// rho b = rho a - div tau (J = 1), in polar coordinates; derivatives along r by central
  /// differences of closed forms.
  Vec<2> body_acceleration(const Vec<2>& place, double time) const {
    const Vec<2> x = place - centre;
    const double r = norm(x);
    if (!in_ring(r)) return {};
    const double d = 1e-5;
    double shear[3], hoop[3];
    for (int i = 0; i < 3; ++i) {
      const double at = r + (i - 1) * d;
      stress(at * g(time) * h1_inside(at), shear[i], hoop[i]);
    }
    const double shear_slope = (shear[2] - shear[0]) / (2.0 * d);
    const double radial_slope = -(hoop[2] - hoop[0]) / (2.0 * d);
    const double turn = g1(time) * h(r);
    const double radial = -r * turn * turn - (radial_slope - 2.0 * hoop[1] / r) / solid.density;
    const double along = r * g2(time) * h(r) - (shear_slope + 2.0 * shear[1] / r) / solid.density;
    return Vec<2>{{(radial * x[0] - along * x[1]) / r, (radial * x[1] + along * x[0]) / r}};
  }
  /// h' of the polynomial, also just outside the ring.
  double h1_inside(double r) const {
    const double q = r - 1.0;
    return largest * (-64.0 * q + 1024.0 * q * q * q);
  }
};

}  // namespace mudlark

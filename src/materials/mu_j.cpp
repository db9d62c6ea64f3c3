#include "materials/mu_j.hpp"

#include <algorithm>
#include <cmath>

#include "materials/invariants.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 3> names{"solid fraction [-]", "plastic shear strain [-]",
                                                "separation [-]"};
/// Weight a of inertia in J: the two regimes meet at a Stokes number of 10 (Tapia et al. 2022).
constexpr double inertial_weight = 0.1;
/// Friction of the liquid squeezed between grains, 5/2 phi_m sqrt J (Boyer et al. 2011, Eq. 6).
constexpr double squeezed = 2.5;
constexpr int most_iterations = 60;

/// The positive root q of (q^2 - top)(q + s) + fall q for top > 0. There is exactly one, and Newton
/// comes down to it from sqrt(top): the cubic is convex for q > 0.
double root_of_pressure(double top, double s, double fall) {
  double q = std::sqrt(top);
  for (int i = 0; i < most_iterations; ++i) {
    const double value = (q * q - top) * (q + s) + fall * q;
    const double slope = 2.0 * q * (q + s) + q * q - top + fall;
    const double next = q - value / slope;
    if (!(next < q * (1.0 - 1e-14))) break;
    q = next;
  }
  return q;
}

}  // namespace

MuJ::MuJ(const MuJOptions& options)
    : options_(options),
      elasticity_(Elasticity::from(options.young_modulus, options.poisson_ratio)) {}

std::span<const std::string_view> MuJ::history_names() const { return names; }

void MuJ::initialise_history(std::span<const SymTensor> stress, double porosity,
                             std::span<double> history) const {
  for (std::size_t i = 0; i < stress.size(); ++i) history[names.size() * i] = 1.0 - porosity;
}

/// As mu(I): Jaky's ratio for the sine of friction mu_1, not less than its cone carries.
double MuJ::earth_pressure_at_rest() const {
  const double root = std::sqrt(3.0), mu = options_.static_friction;
  return std::max(1.0 - mu, (root - mu) / (root + 2.0 * mu));
}

/// Friction as J tends to zero; grains far looser than phi_m have none.
double MuJ::slow_friction(double fraction) const {
  return std::max(0.0, options_.static_friction + options_.dilatancy_coefficient *
                                                      (fraction - options_.critical_fraction));
}

/// P from the elastic compression that is left, P = K_e (compression + shear K (phi - phi_eq)),
/// with phi_eq = phi_m q/(q + s), q = sqrt P, s^2 = J P; then the strength at that P.
MuJ::Slide MuJ::slide(double shear, double compression, double fraction, double dt) const {
  const double bulk = elasticity_.bulk(), rate = shear / dt;
  const double d_rate = options_.grain_diameter * rate;
  const double s = std::sqrt(options_.liquid_viscosity * rate +
                             inertial_weight * options_.grain_density * d_rate * d_rate);
  const double open = options_.dilatancy_coefficient * shear;
  const double top = bulk * (compression + open * fraction);
  if (!(top > 0.0)) return {shear, 0.0, 0.0};
  const double q = root_of_pressure(top, s, bulk * open * options_.critical_fraction);
  const double root_j = s / q, j = root_j * root_j;
  const double equilibrium = options_.critical_fraction / (1.0 + root_j);
  const double friction =
      options_.static_friction +
      (options_.limiting_friction - options_.static_friction) * j / (j + options_.viscous_number) +
      squeezed * options_.critical_fraction * root_j +
      options_.dilatancy_coefficient * (fraction - equilibrium);
  return {shear, q * q, std::max(0.0, friction) * q * q};
}

/// trial - G shear = strength(shear), between no sliding and no strength, by the Illinois rule.
MuJ::Slide MuJ::find_slide(double trial, double compression, double fraction, double dt) const {
  const double stiffness = elasticity_.shear;
  Slide now;
  const auto excess = [&](double shear) {
    now = slide(shear, compression, fraction, dt);
    return trial - stiffness * shear - now.strength;
  };
  double lower = 0.0, upper = trial / stiffness;
  double above = excess(upper), below = excess(lower);
  if (above >= 0.0) return slide(upper, compression, fraction, dt);
  for (int i = 0; i < most_iterations; ++i) {
    const double middle = (lower * above - upper * below) / (above - below);
    const double rest = excess(middle);
    if (std::abs(rest) <= 1e-13 * trial) break;
    if (rest > 0.0)
      lower = middle, below = rest, above *= 0.5;
    else
      upper = middle, above = rest, below *= 0.5;
  }
  return now;
}

std::size_t MuJ::update_stress(const MaterialPoints& points) const {
  std::size_t failed = 0;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    const SymTensor& strain = points.strain_increment[i];
    SymTensor& stress = points.stress[i];
    double* state = &points.history[names.size() * i];
    double &fraction = state[0], &plastic_shear = state[1], &separation = state[2];
    const double growth = strain.trace(), bulk = elasticity_.bulk();
    fraction *= std::exp(-growth);
    const double before = separation > 0.0 ? -separation : -mean_of(stress) / bulk;
    const double compression = before - growth;
    const SymTensor shearing = deviator_of(stress) + 2.0 * elasticity_.shear * deviator_of(strain);
    const double trial = std::sqrt(second_invariant(shearing));
    if (!std::isfinite(trial) || !std::isfinite(compression)) {
      ++failed;
      if (!points.failed.empty()) points.failed[i] = 1;
      continue;
    }
    Slide end{0.0, bulk * std::max(compression, 0.0), trial};
    if (trial > slow_friction(fraction) * end.pressure)
      end = find_slide(trial, compression, fraction, points.dt);
    plastic_shear += end.shear;
    const double opened = options_.dilatancy_coefficient * end.shear * fraction;
    separation = end.pressure > 0.0 ? 0.0 : std::max(0.0, -(compression + opened));
    const double left = trial > 0.0 ? end.strength / trial : 0.0;
    stress = left * shearing + -end.pressure * SymTensor::identity();
  }
  return failed;
}

}  // namespace mudlark

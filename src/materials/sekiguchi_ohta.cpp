#include "materials/sekiguchi_ohta.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "materials/substepping.hpp"
#include "materials/tensor_algebra.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 9> names{"consolidation ratio xx [-]",
                                                "consolidation ratio yy [-]",
                                                "consolidation ratio zz [-]",
                                                "consolidation ratio xy [-]",
                                                "consolidation ratio yz [-]",
                                                "consolidation ratio zx [-]",
                                                "preconsolidation pressure [Pa]",
                                                "void ratio [-]",
                                                "separation [-]"};
constexpr std::array<std::size_t, 1> tensors{0};
constexpr std::size_t variables = names.size();
constexpr std::size_t size_at = 6, void_ratio_at = 7, separation_at = 8;
/// Specific volume of the stress-free soil that no point is known of.
constexpr double usual_volume = 2.0;
/// Below this share of the floor a point counts as free of stress.
constexpr double stress_free = 0.02;
/// Allowed yield function [-].
constexpr double on_surface = 1e-10;
/// The tip of the cone is rounded over this distance of stress ratios, (sqrt(eta*^2 + a^2) - a)/M
/// for eta*/M. With a sharp tip soil on the line of consolidation would follow any change of shape
/// at no stress, and quasi-static steps would have no unique answer.
constexpr double rounding = 0.005;
/// Error of backward Euler that a sub-step may have; what extrapolation leaves of it is about its
/// power of 3/2.
constexpr double substep_error = 5e-4;
/// Error of a backward Euler step that needs no second opinion.
constexpr double small_step = 1e-5;

double norm_of(const SymTensor& t) { return std::sqrt(t.squared_norm()); }

}  // namespace

double SekiguchiOhta::shape(double length) const {
  return std::hypot(slope_ * length, blunt_) - blunt_;
}

/// A backward Euler step in the unknown `lost`, the plastic loss of specific volume. The exact
/// elastic law gives p and the direction m of eta - eta_0, which the flow rule
///   de^p = L r m,  d eps_v^p = L (1 - r m:eta),  r = d(eta*/M)/d|eta - eta_0|
/// keeps, and what is left is one equation. With old d = eta - eta_0 and the strain's deviator e,
/// eta - eta_0 without plastic strain of shape is  share d + (share - 1) eta_0 + stiffness e.
class SekiguchiOhta::Substep {
 public:
  Substep(const SekiguchiOhta& law, const State& old, const SymTensor& axis,
          const SymTensor& strain)
      : law_(law), old_(old), axis_(axis), deviator_(deviator_of(strain)) {
    const CriticalStateOptions& options = law.options_;
    const double volumetric = strain.trace(), compressed = old.volume * -std::expm1(-volumetric);
    const double mean_volume = std::abs(volumetric) > 1e-9 ? compressed / volumetric : old.volume;
    volume_ = old.volume - compressed;
    swing_ = compressed / options.swelling_index;
    mean_volume_ = mean_volume;
    stiffness_ = 2.0 * law.elasticity_.shear_ratio * mean_volume / options.swelling_index;
    log_ratio_ = std::log(old.size / old.pressure);
    dd_ = contraction(old.distance, old.distance), aa_ = contraction(axis, axis);
    ee_ = contraction(deviator_, deviator_), da_ = contraction(old.distance, axis);
    de_ = contraction(old.distance, deviator_), ae_ = contraction(axis, deviator_);
  }

  Trial trial(double lost) const {
    const CriticalStateOptions& options = law_.options_;
    const double floor = options.mean_stress_floor;
    const double change = swing_ - lost / options.swelling_index;
    const double growth = lost / (options.compression_index - options.swelling_index);
    Trial t;
    t.share = std::exp(-change);
    double mean, log_ratio = log_ratio_ + growth - change;  // mean: of p, over p at the end
    if (old_.pressure >= floor && old_.pressure >= floor * t.share) {
      t.pressure = old_.pressure / t.share;
      mean = std::abs(change) > 1e-9 ? (1.0 - t.share) / change : 1.0;
    } else {
      // Nothing divides by less; a point with that little is set free of stress afterwards.
      t.pressure =
          std::max(law_.elasticity_.moved(old_.pressure, change), 0.01 * stress_free * floor);
      t.share = old_.pressure / t.pressure;
      mean = std::abs(change) > 1e-9 ? (1.0 - t.share) / change
                                     : std::max(old_.pressure, floor) / t.pressure;
      log_ratio = log_ratio_ + growth + std::log(t.share);
    }
    log_ratio = std::max(log_ratio, std::log(floor / t.pressure));  // clay remembers the floor
    t.log_ratio = log_ratio;
    t.stiffness = stiffness_ * mean;
    const double b = t.share - 1.0, c = t.stiffness;
    t.length = std::sqrt(std::max(0.0, t.share * (t.share * dd_ + 2.0 * (b * da_ + c * de_)) +
                                           b * (b * aa_ + 2.0 * c * ae_) + c * c * ee_));
    const double height = law_.blunt_ + std::max(0.0, log_ratio);
    t.flow = law_.slope_ * std::sqrt(1.0 - law_.blunt_ * law_.blunt_ / (height * height));
    t.allowed = height * t.flow / (law_.slope_ * law_.slope_);
    const double lean = t.length > 0.0 ? (t.share * da_ + b * aa_ + c * ae_) / t.length : 0.0;
    t.excess = t.flow * lost -
               mean_volume_ * (t.length - t.allowed) / c * (1.0 - t.flow * (lean + t.allowed));
    return t;
  }

  /// eta - eta_0 at the end of an elastic step.
  SymTensor distance(const Trial& t) const {
    return t.share * old_.distance + (t.share - 1.0) * axis_ + t.stiffness * deviator_;
  }
  /// The state at the end of a step with the direction of `towards`, on the yield surface.
  State on_surface(const Trial& t, const SymTensor& towards) const {
    const double length = norm_of(towards);
    return {t.pressure, (length > 0.0 ? t.allowed / length : 0.0) * towards,
            t.pressure * std::exp(t.log_ratio), volume_};
  }
  State elastic(const Trial& t) const { return {t.pressure, distance(t), old_.size, volume_}; }

  /// The loss at which p meets p_c: eta = eta_0, the tip of the surface.
  double lost_at_tip() const {
    const double kappa = law_.options_.swelling_index, lambda = law_.options_.compression_index;
    const PorousElasticity& elastic = law_.elasticity_;
    const double level = elastic.level(old_.pressure) + swing_;
    const double lost = (level - elastic.level(old_.size)) * kappa * (lambda - kappa) / lambda;
    // The clay remembers no less than the floor.
    const double floor = law_.options_.mean_stress_floor;
    return old_.size * std::exp(lost / (lambda - kappa)) >= floor ? lost : kappa * (level - 1.0);
  }

 private:
  const SekiguchiOhta& law_;
  const State& old_;
  const SymTensor& axis_;
  SymTensor deviator_;  ///< of the strain
  double volume_, mean_volume_, swing_, stiffness_, log_ratio_;
  double dd_, aa_, ee_, da_, de_, ae_;  ///< d:d, eta_0:eta_0, e:e, d:eta_0, d:e, eta_0:e
};

SekiguchiOhta::SekiguchiOhta(const SekiguchiOhtaOptions& options)
    : options_(options),
      elasticity_(options.swelling_index, options.poisson_ratio, options.mean_stress_floor),
      slope_(std::sqrt(1.5) / options.critical_stress_ratio),
      blunt_(rounding / options.critical_stress_ratio) {}

std::span<const std::string_view> SekiguchiOhta::history_names() const { return names; }
std::span<const std::size_t> SekiguchiOhta::history_tensors() const { return tensors; }

void SekiguchiOhta::initialise_history(std::span<const SymTensor> stress, double porosity,
                                       std::span<double> history) const {
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const double pressure = std::max(-mean_of(stress[i]), options_.mean_stress_floor);
    SymTensor axis = (-1.0 / pressure) * deviator_of(stress[i]);
    if (const double ratio = options_.consolidation_ratio; ratio >= 0.0) {
      const SymTensor consolidation{ratio, ratio, 1.0, 0.0, 0.0, 0.0};
      axis = (1.0 / mean_of(consolidation)) * deviator_of(consolidation);
    }
    const SymTensor distance = difference((-1.0 / pressure) * deviator_of(stress[i]), axis);
    const double through = pressure * std::exp(shape(norm_of(distance)));
    const double wanted = options_.preconsolidation_pressure > 0.0
                              ? options_.preconsolidation_pressure
                              : options_.overconsolidation_ratio * through;
    double* values = &history[i * variables];
    values[0] = axis.xx, values[1] = axis.yy, values[2] = axis.zz;
    values[3] = axis.xy, values[4] = axis.yz, values[5] = axis.zx;
    values[size_at] = std::max(wanted, through);
    values[void_ratio_at] = porosity / (1.0 - porosity);
    values[separation_at] = 0.0;
  }
}

double SekiguchiOhta::wave_modulus(std::span<const SymTensor> stress,
                                   std::span<const double> history) const {
  double bulk = stress.empty() ? elasticity_.bulk(0.0, usual_volume) : 0.0;
  for (std::size_t i = 0; i < stress.size(); ++i)
    bulk = std::max(
        bulk, elasticity_.bulk(-mean_of(stress[i]), 1.0 + history[i * variables + void_ratio_at]));
  return bulk * (1.0 + 4.0 / 3.0 * elasticity_.shear_ratio);
}

double SekiguchiOhta::shear_modulus() const {
  return elasticity_.shear_ratio * elasticity_.bulk(0.0, usual_volume);
}

/// The given one, or Jaky (1944), 1 - sin(phi), with sin(phi) = 3 M / (6 + M) in compression.
double SekiguchiOhta::earth_pressure_at_rest() const {
  if (options_.consolidation_ratio >= 0.0) return options_.consolidation_ratio;
  const double m = options_.critical_stress_ratio;
  return 1.0 - 3.0 * m / (6.0 + m);
}

double SekiguchiOhta::yield_function(const SymTensor& stress, const SymTensor& axis,
                                     double size) const {
  const double pressure = mean_of(stress);
  return std::log(pressure / size) +
         shape(norm_of(difference((1.0 / pressure) * deviator_of(stress), axis)));
}

SymTensor SekiguchiOhta::stress_of(const State& state, const SymTensor& axis) const {
  return state.pressure * (SymTensor::identity() + axis + state.distance);
}

bool SekiguchiOhta::step(State& state, const SymTensor& axis, const SymTensor& strain,
                         double& lost) const {
  const Substep substep(*this, state, axis, strain);
  // Everything is smooth in u, the height (eta*/M) at which the step ends: 0 is the tip of the
  // surface, where flow turns to pure loss of volume.
  const double kappa = options_.swelling_index, tip = substep.lost_at_tip();
  const double scale = kappa * (1.0 - kappa / options_.compression_index);
  const auto loss = [&](double u) { return tip + (std::hypot(u, blunt_) - blunt_) * scale; };
  const auto excess = [&](double u) { return substep.trial(loss(u)).excess; };
  lost = tip;
  Trial end = substep.trial(tip);
  if (!std::isfinite(end.excess)) return false;
  if (end.excess < 0.0) {
    // Between a height at which the flow rule asks for more and one at which it asks for less.
    double low = 0.0,
           high = tip < 0.0 ? std::sqrt(tip / scale * (tip / scale - 2.0 * blunt_)) : 0.0;
    Trial other = high > 0.0 ? substep.trial(loss(high)) : end;
    for (int i = 0; i < 60 && other.excess < 0.0; ++i) {
      low = high;
      high = std::max(1.5 * low, slope_ * other.length);
      other = substep.trial(loss(high));
    }
    if (!(other.excess >= 0.0)) return false;
    lost = loss(crossing(excess, low, high, 0.0, 1e-12 * kappa * slope_));
    end = substep.trial(lost);
  }
  state = substep.on_surface(end, substep.distance(end));
  return true;
}

/// One step and two half steps; their difference is the error, and what they extrapolate to
/// (Richardson) the answer. A small step by itself is as good.
double SekiguchiOhta::attempt(State& state, const SymTensor& axis, const SymTensor& strain) const {
  constexpr double no_answer = std::numeric_limits<double>::infinity();
  const State old = state;
  State whole = state, halves = state;
  double lost_whole = 0.0, lost_first = 0.0, lost_second = 0.0;
  if (!step(whole, axis, strain, lost_whole)) return no_answer;
  const auto apart = [&](const State& one, const State& other) {
    return std::abs(std::log(one.pressure / other.pressure)) +
           slope_ * norm_of(difference(one.distance, other.distance));
  };
  // The error is about the change squared over the radius at which flow turns.
  const double change = apart(whole, old), turn = blunt_ + slope_ * norm_of(old.distance);
  if (change * change < small_step * turn) {
    state = whole;
    return 0.0;
  }
  if (!step(halves, axis, 0.5 * strain, lost_first) ||
      !step(halves, axis, 0.5 * strain, lost_second))
    return no_answer;
  const double error = apart(halves, whole);
  if (!(error <= substep_error)) return error;
  const Substep substep(*this, old, axis, strain);
  const Trial end = substep.trial(2.0 * (lost_first + lost_second) - lost_whole);
  state = substep.on_surface(end, 2.0 * halves.distance + -1.0 * whole.distance);
  return std::isfinite(state.size) ? error : no_answer;
}

/// Which part of a strain is elastic, from a state inside or on the yield surface.
double SekiguchiOhta::elastic_share(const State& state, const SymTensor& axis,
                                    const SymTensor& strain) const {
  const auto f = [&](double share) {
    const Trial t = Substep(*this, state, axis, share * strain).trial(0.0);
    return shape(t.length) - t.log_ratio;
  };
  if (f(1.0) <= on_surface) return 1.0;
  const double now = f(0.0);
  if (now < -on_surface) return crossing(f, 0.0, 1.0, 0.0, on_surface);
  // From the surface inwards and out again: find an inside first.
  if (f(1e-4) > now) return 0.0;
  for (double share = 0.5; share > 1e-6; share *= 0.5)
    if (f(share) < -on_surface) return crossing(f, share, 1.0, 0.0, on_surface);
  return 0.0;
}

bool SekiguchiOhta::update_point(SymTensor& stress, const SymTensor& strain_increment,
                                 double* history) const {
  const double smallest = stress_free * options_.mean_stress_floor;
  double volume = 1.0 + history[void_ratio_at];
  SymTensor opening = strain_increment;
  const SymTensor old = -1.0 * stress;
  if (!in_touch(mean_of(old), smallest, history[separation_at], volume, opening)) {
    stress = {};
    history[void_ratio_at] = volume - 1.0;
    return true;
  }
  const SymTensor axis{history[0], history[1], history[2], history[3], history[4], history[5]};
  const SymTensor strain = -1.0 * opening;
  // Grains that have just met press too little to have a direction.
  const double pressure = std::max(mean_of(old), smallest);
  State state{pressure, difference((1.0 / pressure) * deviator_of(old), axis), history[size_at],
              volume};
  const double share = elastic_share(state, axis, strain);
  if (share > 0.0) {
    const State old_state = state;
    const Substep elastic(*this, old_state, axis, share * strain);
    state = elastic.elastic(elastic.trial(0.0));
  }
  SubstepControl control;
  control.tolerance = substep_error;
  if (share < 1.0 && !in_substeps(control, [&](double part) {
        return attempt(state, axis, (part * (1.0 - share)) * strain);
      }))
    return false;
  const SymTensor now = stress_of(state, axis);
  if (!std::isfinite(now.squared_norm())) return false;
  stress = state.pressure < smallest ? SymTensor{} : -1.0 * now;
  history[size_at] = state.size;
  history[void_ratio_at] = PorousElasticity::compressed(volume, strain.trace()) - 1.0;
  return true;
}

std::size_t SekiguchiOhta::update_stress(const MaterialPoints& points) const {
  std::size_t failed = 0;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    if (update_point(points.stress[i], points.strain_increment[i], &points.history[i * variables]))
      continue;
    ++failed;
    if (!points.failed.empty()) points.failed[i] = 1;
  }
  return failed;
}

}  // namespace mudlark

#include "materials/sanisand.hpp"

#include "materials/invariants.hpp"
#include "materials/separation.hpp"

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 20> names{"back stress ratio xx [-]",
                                                 "back stress ratio yy [-]",
                                                 "back stress ratio zz [-]",
                                                 "back stress ratio xy [-]",
                                                 "back stress ratio yz [-]",
                                                 "back stress ratio zx [-]",
                                                 "reversal stress ratio xx [-]",
                                                 "reversal stress ratio yy [-]",
                                                 "reversal stress ratio zz [-]",
                                                 "reversal stress ratio xy [-]",
                                                 "reversal stress ratio yz [-]",
                                                 "reversal stress ratio zx [-]",
                                                 "fabric xx [-]",
                                                 "fabric yy [-]",
                                                 "fabric zz [-]",
                                                 "fabric xy [-]",
                                                 "fabric yz [-]",
                                                 "fabric zx [-]",
                                                 "void ratio [-]",
                                                 "separation [-]"};
constexpr std::array<std::size_t, 3> tensors{0, 6, 12};
constexpr std::size_t variables = names.size(), void_ratio_at = 18, separation_at = 19;
/// Mean stress of grains that hardly touch, in units of the floor.
constexpr double hardly = 0.02;
constexpr double tolerance = 1e-4;  ///< relative error of a sub-step
/// Smallest share of a step from a stress below the floor; it is taken whatever its error.
constexpr double rough = 1e-3;
/// Allowed yield function, in units of p.
constexpr double on_surface = 1e-8;
constexpr double root_two_thirds = 0.81649658092772603;
/// The fit 1 - c_h e of the hardening modulus ends where it would change its sign.
constexpr double least_hardening = 0.01;

SymTensor load(const double* v) { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }
void save(const SymTensor& t, double* v) {
  v[0] = t.xx, v[1] = t.yy, v[2] = t.zz, v[3] = t.xy, v[4] = t.yz, v[5] = t.zx;
}
double size_of(const SymTensor& t) { return std::sqrt(t.squared_norm()); }

}  // namespace

Sanisand::Sanisand(const SanisandOptions& options)
    : options_(options),
      bulk_ratio_(2.0 * (1.0 + options.poisson_ratio) /
                  (3.0 * (1.0 - 2.0 * options.poisson_ratio))),
      least_(hardly * options.mean_stress_floor) {}

std::span<const std::string_view> Sanisand::history_names() const { return names; }
std::span<const std::size_t> Sanisand::history_tensors() const { return tensors; }

void Sanisand::initialise_history(std::span<const SymTensor> stress, double porosity,
                                  std::span<double> history) const {
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const SymTensor ratio = stress_ratio(-1.0 * stress[i]);
    double* values = &history[i * variables];
    save(ratio, values);
    save(ratio, values + 6);
    values[void_ratio_at] = porosity / (1.0 - porosity);
  }
}

/// G = G_0 p_at (2.97 - e)^2 / (1 + e) sqrt(p / p_at); below the floor it falls with p, so that
/// the stress ratio never changes faster with strain than it does there.
double Sanisand::shear(double pressure, double void_ratio) const {
  const double space = 2.97 - void_ratio, floor = options_.mean_stress_floor;
  const double level = std::sqrt(options_.reference_pressure * std::max(pressure, floor)) *
                       std::clamp(pressure, least_, floor) / floor;
  return options_.shear_coefficient * space * space / (1.0 + void_ratio) * level;
}

double Sanisand::wave_modulus(std::span<const SymTensor> stress,
                              std::span<const double> history) const {
  double largest = stress.empty() ? shear_modulus() : 0.0;
  for (std::size_t i = 0; i < stress.size(); ++i)
    largest = std::max(largest, shear(std::max(-mean_of(stress[i]), options_.mean_stress_floor),
                                      history[i * variables + void_ratio_at]));
  return largest * (bulk_ratio_ + 4.0 / 3.0);
}

/// Jaky (1944), 1 - sin(phi), with sin(phi) = 3 M / (6 + M) in compression.
double Sanisand::earth_pressure_at_rest() const {
  const double m = options_.critical_stress_ratio;
  return 1.0 - 3.0 * m / (6.0 + m);
}

/// Li & Wang (1998): e_c = e_0 - lambda_c (p / p_at)^xi.
double Sanisand::critical_void_ratio(double pressure) const {
  return options_.critical_void_ratio -
         options_.critical_slope * std::pow(std::max(pressure, 0.0) / options_.reference_pressure,
                                            options_.critical_exponent);
}

/// Exact for the mean stress at the void ratio of mid-step: with K = k sqrt(p) above the floor and
/// k p / sqrt(floor) below it, k times the strain is the change of 2 (sqrt(p) - sqrt(floor)) or
/// sqrt(floor) ln(p / floor).
SymTensor Sanisand::elastic_stress(const State& state, const SymTensor& strain) const {
  const double volumetric = strain.trace(), pressure = std::max(mean_of(state.stress), least_);
  const double middle = state.void_ratio - 0.5 * (1.0 + state.void_ratio) * volumetric;
  double bulk = bulk_ratio_ * shear(pressure, middle);
  if (std::abs(volumetric) > 1e-10) {
    const double floor = options_.mean_stress_floor, root = std::sqrt(floor);
    const double unit = bulk * std::sqrt(std::max(pressure, floor)) / pressure;
    const double start =
        pressure > floor ? 2.0 * (std::sqrt(pressure) - root) : root * std::log(pressure / floor);
    const double end = start + unit * volumetric;
    const double above = root + 0.5 * end;
    const double after = end > 0.0 ? above * above : floor * std::exp(end / root);
    bulk = (after - pressure) / volumetric;
  }
  return state.stress + isotropic_stress(bulk, bulk / bulk_ratio_, strain);
}

SymTensor Sanisand::stress_ratio(const SymTensor& stress) const {
  return (1.0 / std::max(mean_of(stress), least_)) * deviator_of(stress);
}

/// |s - p alpha| - sqrt(2/3) m p [Pa].
double Sanisand::yield_function(const SymTensor& stress, const SymTensor& back) const {
  const double pressure = mean_of(stress);
  return size_of(difference(deviator_of(stress), pressure * back)) -
         root_two_thirds * options_.yield_radius * pressure;
}

Sanisand::Flow Sanisand::flow(const State& state) const {
  const SanisandOptions& o = options_;
  const double pressure = std::max(mean_of(state.stress), least_);
  const double firm = std::max(pressure, o.mean_stress_floor);
  const double shear = this->shear(pressure, state.void_ratio), bulk = bulk_ratio_ * shear;
  const SymTensor ratio = stress_ratio(state.stress), away = difference(ratio, state.back);
  const double distance = size_of(away);
  Flow flow;
  flow.normal = (distance > 0.0 ? 1.0 / distance : 0.0) * away;
  const SymTensor& n = flow.normal;
  const SymTensor n2 = square(n);
  const double n3 = contraction(n2, n), cosine = std::clamp(std::sqrt(6.0) * n3, -1.0, 1.0);
  const double c = o.extension_ratio;
  const double g = 2.0 * c / ((1.0 + c) - (1.0 - c) * cosine);
  const double psi = state.void_ratio - critical_void_ratio(firm);
  const double along = contraction(state.back, n);
  const double bounding =
      root_two_thirds *
      (g * o.critical_stress_ratio * std::exp(-o.bounding_exponent * psi) - o.yield_radius);
  const double dilating =
      root_two_thirds *
      (g * o.critical_stress_ratio * std::exp(o.dilatancy_exponent * psi) - o.yield_radius);
  const double gone = std::max(contraction(difference(state.back, state.back_start), n), 1e-10);
  const double hardening =
      o.shear_coefficient * o.hardening_coefficient *
      std::max(least_hardening, 1.0 - o.hardening_void_ratio * state.void_ratio) /
      std::sqrt(firm / o.reference_pressure) / gone;
  const double dilatancy = o.dilatancy_coefficient *
                           (1.0 + std::max(0.0, contraction(state.fabric, n))) * (dilating - along);
  const double b = 1.0 + 1.5 * (1.0 - c) / c * g * cosine;
  const double skew = 3.0 * std::sqrt(1.5) * (1.0 - c) / c * g;
  const SymTensor direction =
      b * n + -skew * difference(n2, (n2.trace() / 3.0) * SymTensor::identity());
  flow.ratio = contraction(n, ratio);
  flow.stress = 2.0 * shear * direction + (bulk * dilatancy) * SymTensor::identity();
  const double rises = o.fabric_rate * std::max(0.0, -dilatancy);
  flow.fabric = -rises * (o.largest_fabric * n + state.fabric);
  const double elastic = 2.0 * shear * contraction(n, direction) - bulk * flow.ratio * dilatancy;
  const double hardens = 2.0 / 3.0 * pressure * hardening * (bounding - along);
  // Beyond the bounding surface, where a turn of the loading may have left it, the cone softens;
  // right after a reversal it would do so at an infinite rate.
  const double share = hardens < -0.5 * elastic ? -0.5 * elastic / hardens : 1.0;
  flow.back = (2.0 / 3.0 * share * hardening) * difference(bounding * n, state.back);
  flow.resistance = share * hardens + elastic;
  return flow;
}

/// Rate of the yield function for an elastic strain.
double Sanisand::loading(const State& state, const Flow& flow, const SymTensor& strain) const {
  const double shear = this->shear(mean_of(state.stress), state.void_ratio);
  return 2.0 * shear * contraction(flow.normal, strain) -
         bulk_ratio_ * shear * flow.ratio * strain.trace();
}

Sanisand::State Sanisand::rate(const State& state, const SymTensor& strain) const {
  const Flow flow = this->flow(state);
  const double multiplier = std::max(0.0, loading(state, flow, strain) / flow.resistance);
  const double shear = this->shear(mean_of(state.stress), state.void_ratio);
  State change;
  change.stress = isotropic_stress(bulk_ratio_ * shear, shear, strain) + -multiplier * flow.stress;
  change.back = multiplier * flow.back;
  change.fabric = multiplier * flow.fabric;
  change.void_ratio = -(1.0 + state.void_ratio) * strain.trace();
  if (!(flow.resistance > 0.0)) change.void_ratio = change.stress.xx = std::nan("");
  return change;
}

/// The narrow cone follows the stress ratio; its start follows when the loading turns round.
bool Sanisand::correct(State& state) const {
  if (!std::isfinite(state.stress.squared_norm())) return false;
  if (mean_of(state.stress) < least_) state.stress = least_ * (SymTensor::identity() + state.back);
  const SymTensor ratio = stress_ratio(state.stress), away = difference(ratio, state.back);
  const double distance = size_of(away), radius = root_two_thirds * options_.yield_radius;
  if (distance > radius) state.back = difference(ratio, (radius / distance) * away);
  if (contraction(difference(state.back, state.back_start), away) < 0.0)
    state.back_start = state.back;
  return true;
}

/// Which part of a strain is elastic, from a state inside or on the cone.
double Sanisand::elastic_share(const State& state, const SymTensor& strain) const {
  const double close = on_surface * std::max(mean_of(state.stress), least_);
  const auto f = [&](double share) {
    return yield_function(elastic_stress(state, share * strain), state.back);
  };
  if (f(1.0) <= close) return 1.0;
  if (f(0.0) < -close) return crossing(f, 0.0, 1.0, 0.0, close);
  if (loading(state, flow(state), strain) >= 0.0) return 0.0;
  // From the surface inwards and out again: find an inside first.
  for (double share = 0.5; share > 1e-9; share *= 0.5)
    if (f(share) < -close) return crossing(f, share, 1.0, 0.0, close);
  return 0.0;
}

/// Sand that has lost all stress has lost its loose structure, whether in shear or pulled apart:
/// its grains sink until they touch in a denser one. The volumetric strain until then, 0 where they
/// stay in touch.
double Sanisand::gap_without_structure(double void_ratio) const {
  const double settled = options_.settled_void_ratio;
  return settled > 0.0 ? std::max(0.0, std::log((1.0 + void_ratio) / (1.0 + settled))) : 0.0;
}

/// Grains that meet again without a stress to start from: an elastic step, no steeper than the
/// critical state, and a cone around it.
void Sanisand::touch_down(State& state, const SymTensor& strain) const {
  state.stress = elastic_stress(state, strain);
  const double pressure = std::max(mean_of(state.stress), least_);
  const double steepest =
      root_two_thirds * options_.extension_ratio * options_.critical_stress_ratio * pressure;
  SymTensor deviator = deviator_of(state.stress);
  const double size = size_of(deviator);
  if (size > steepest) deviator = (steepest / size) * deviator;
  state.stress = deviator + pressure * SymTensor::identity();
  state.back = state.back_start = stress_ratio(state.stress);
}

/// From a stress that grains in touch carry, along `strain`. False: it could not be integrated.
bool Sanisand::advance(State& state, const SymTensor& strain) const {
  const double share = elastic_share(state, strain);
  state.stress = elastic_stress(state, share * strain);
  state.void_ratio = (1.0 + state.void_ratio) * std::exp(-share * strain.trace()) - 1.0;
  if (share >= 1.0) return true;
  const SymTensor away = difference(stress_ratio(state.stress), state.back);
  if (contraction(difference(state.back, state.back_start), away) < 0.0)
    state.back_start = state.back;
  // Below the floor the cone is crossed by the smallest strains, and the law jumps at each turn.
  const SubstepControl control = mean_of(state.stress) < options_.mean_stress_floor
                                     ? SubstepControl{tolerance, rough, true}
                                     : SubstepControl{tolerance};
  return integrate_in_substeps(
      state, (1.0 - share) * strain, control,
      [this](const State& s, const SymTensor& e) { return rate(s, e); },
      [this](State& s) { return correct(s); });
}

bool Sanisand::update_point(SymTensor& stress, const SymTensor& strain_increment,
                            double* history) const {
  State state{-1.0 * stress, load(history), load(history + 6), load(history + 12),
              history[void_ratio_at]};
  double& separation = history[separation_at];
  const double start = state.void_ratio;
  SymTensor rest = strain_increment;
  const bool stress_free = mean_of(state.stress) <= 0.0;
  bool apart = still_apart(separation, rest);
  state.void_ratio = (1.0 + start) * std::exp(strain_increment.trace() - rest.trace()) - 1.0;
  const double opening = std::max(0.0, rest.trace());
  const bool parts =
      !apart && opening > 0.0 && mean_of(elastic_stress(state, -1.0 * rest)) <= least_;
  if (!apart && !parts) {
    if (!stress_free) {
      if (!advance(state, -1.0 * rest)) return false;
    } else if (rest.squared_norm() > 0.0) {
      touch_down(state, -1.0 * rest);
    }
  }
  const double end = (1.0 + start) * std::exp(strain_increment.trace()) - 1.0;
  if (parts || (!apart && mean_of(state.stress) <= least_ * (1.0 + 1e-12))) {
    // Grains that never pressed on each other have no structure to lose.
    const double gap = stress_free ? 0.0 : gap_without_structure(end);
    separation = std::max(opening, gap);
    if (gap > opening) state.fabric = {};
    apart = separation > 0.0;
  }
  if (apart) state.stress = {};
  stress = -1.0 * state.stress;
  save(state.back, history);
  save(state.back_start, history + 6);
  save(state.fabric, history + 12);
  history[void_ratio_at] = end;
  return true;
}

std::size_t Sanisand::update_stress(const MaterialPoints& points) const {
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

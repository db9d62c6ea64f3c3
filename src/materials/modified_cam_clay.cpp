#include "materials/modified_cam_clay.hpp"

#include <array>

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 3> names{"preconsolidation pressure [Pa]", "void ratio [-]",
                                                "separation [-]"};
constexpr std::size_t variables = names.size();
/// Specific volume of the stress-free soil that no point is known of.
constexpr double usual_volume = 2.0;
/// Below this share of the floor a point counts as free of stress.
constexpr double stress_free = 0.02;
/// Allowed yield function, in units of p_c^2.
constexpr double on_surface = 1e-9;

}  // namespace

ModifiedCamClay::ModifiedCamClay(const ModifiedCamClayOptions& options)
    : options_(options),
      elasticity_(options.swelling_index, options.poisson_ratio, options.mean_stress_floor) {}

std::span<const std::string_view> ModifiedCamClay::history_names() const { return names; }

void ModifiedCamClay::initialise_history(std::span<const SymTensor> stress, double porosity,
                                         std::span<double> history) const {
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const double pressure = std::max(-mean_of(stress[i]), options_.mean_stress_floor);
    const double m = options_.critical_stress_ratio;
    const double through = pressure + 3.0 * second_invariant(stress[i]) / (m * m * pressure);
    const double wanted = options_.preconsolidation_pressure > 0.0
                              ? options_.preconsolidation_pressure
                              : options_.overconsolidation_ratio * through;
    double* values = &history[i * variables];
    values[0] = std::max(wanted, through);
    values[1] = porosity / (1.0 - porosity);
    values[2] = 0.0;
  }
}

double ModifiedCamClay::wave_modulus(std::span<const SymTensor> stress,
                                     std::span<const double> history) const {
  double bulk = stress.empty() ? elasticity_.bulk(0.0, usual_volume) : 0.0;
  for (std::size_t i = 0; i < stress.size(); ++i)
    bulk = std::max(bulk, elasticity_.bulk(-mean_of(stress[i]), 1.0 + history[i * variables + 1]));
  return bulk * (1.0 + 4.0 / 3.0 * elasticity_.shear_ratio);
}

double ModifiedCamClay::shear_modulus() const {
  return elasticity_.shear_ratio * elasticity_.bulk(0.0, usual_volume);
}

/// Jaky (1944), 1 - sin(phi), with sin(phi) = 3 M / (6 + M) in compression.
double ModifiedCamClay::earth_pressure_at_rest() const {
  const double m = options_.critical_stress_ratio;
  return 1.0 - 3.0 * m / (6.0 + m);
}

double ModifiedCamClay::yield_function(const SymTensor& stress, double size) const {
  const double pressure = mean_of(stress), m = options_.critical_stress_ratio;
  return 3.0 * second_invariant(stress) / (m * m) + pressure * (pressure - size);
}

ModifiedCamClay::Flow ModifiedCamClay::flow(const State& state) const {
  const double pressure = mean_of(state.stress), m2 = std::pow(options_.critical_stress_ratio, 2);
  const double bulk = elasticity_.bulk(pressure, state.volume);
  const double shear = elasticity_.shear_ratio * bulk;
  const double volumetric = 2.0 * pressure - state.size;  // tr df/dsigma
  Flow flow;
  flow.gradient =
      (3.0 / m2) * deviator_of(state.stress) + (volumetric / 3.0) * SymTensor::identity();
  flow.elastic = isotropic_stress(bulk, shear, flow.gradient);
  flow.hardening = state.volume * state.size * volumetric /
                   (options_.compression_index - options_.swelling_index);
  // The clay remembers no less than the floor.
  if (flow.hardening < 0.0 && state.size <= options_.mean_stress_floor) flow.hardening = 0.0;
  flow.resistance = contraction(flow.gradient, flow.elastic) + pressure * flow.hardening;
  return flow;
}

ModifiedCamClay::State ModifiedCamClay::rate(const State& state, const SymTensor& strain) const {
  const Flow flow = this->flow(state);
  const double bulk = elasticity_.bulk(mean_of(state.stress), state.volume);
  const double multiplier = std::max(0.0, contraction(flow.elastic, strain) / flow.resistance);
  State change;
  change.stress =
      isotropic_stress(bulk, elasticity_.shear_ratio * bulk, strain) + -multiplier * flow.elastic;
  change.size = multiplier * flow.hardening;
  change.volume = -state.volume * strain.trace();
  if (!(flow.resistance > 0.0)) change.size = std::nan("");
  return change;
}

/// Back to the yield surface at constant strain (Potts & Gens 1985).
bool ModifiedCamClay::correct(State& state) const {
  state.size = std::max(state.size, options_.mean_stress_floor);
  for (int i = 0; i < 20; ++i) {
    const double f = yield_function(state.stress, state.size);
    if (!std::isfinite(f)) return false;
    if (f <= on_surface * state.size * state.size) return true;
    const Flow flow = this->flow(state);
    if (!(flow.resistance > 0.0)) return false;
    const double multiplier = f / flow.resistance;
    state.stress += -multiplier * flow.elastic;
    state.size = std::max(state.size + multiplier * flow.hardening, options_.mean_stress_floor);
  }
  return false;
}

/// Which part of a strain is elastic, from a state inside or on the yield surface.
double ModifiedCamClay::elastic_share(const State& state, const SymTensor& strain) const {
  const double close = on_surface * state.size * state.size;
  const auto f = [&](double share) {
    return yield_function(elasticity_.stress(state.stress, state.volume, share * strain),
                          state.size);
  };
  if (f(1.0) <= close) return 1.0;
  if (f(0.0) < -close) return crossing(f, 0.0, 1.0, 0.0, close);
  if (contraction(flow(state).elastic, strain) >= 0.0) return 0.0;
  // From the surface inwards and out again: find an inside first.
  for (double share = 0.5; share > 1e-6; share *= 0.5)
    if (f(share) < -close) return crossing(f, share, 1.0, 0.0, close);
  return 0.0;
}

bool ModifiedCamClay::update_point(SymTensor& stress, const SymTensor& strain_increment,
                                   double* history) const {
  State state{-1.0 * stress, history[0], 1.0 + history[1], options_.mean_stress_floor};
  SymTensor opening = strain_increment;
  const double smallest = stress_free * options_.mean_stress_floor;
  bool good = true;
  if (!in_touch(mean_of(state.stress), smallest, history[2], state.volume, opening)) {
    state.stress = {};
  } else {
    const SymTensor strain = -1.0 * opening;
    const double volume = PorousElasticity::compressed(state.volume, strain.trace());
    const double share = elastic_share(state, strain);
    state.stress = elasticity_.stress(state.stress, state.volume, share * strain);
    state.volume = PorousElasticity::compressed(state.volume, share * strain.trace());
    if (share < 1.0)
      good = integrate_in_substeps(
          state, (1.0 - share) * strain, SubstepControl{},
          [this](const State& s, const SymTensor& e) { return rate(s, e); },
          [this](State& s) { return correct(s); });
    state.volume = volume;
    if (mean_of(state.stress) < smallest) state.stress = {};
  }
  if (!good) return false;
  stress = -1.0 * state.stress;
  history[0] = state.size;
  history[1] = state.volume - 1.0;
  return true;
}

std::size_t ModifiedCamClay::update_stress(const MaterialPoints& points) const {
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

#include "soil/stable_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mudlark {
namespace {

/// Square of the fastest compression wave [m2/s2]: the larger eigenvalue of the drag-free two-phase
/// problem M^-1 K, K = [E + (1-n)^2 Q, (1-n) n Q; ., n^2 Q], Q = K_w/n, M = diag((1-n) rho_s, n
/// rho_w). The undrained wave (E + Q)/rho is its Rayleigh quotient for equal velocities, hence
/// slower.
double fastest_wave_squared(double modulus, double porosity, double grain_density,
                            double water_density, double water_bulk_modulus) {
  const double n = porosity, solid = 1.0 - n;
  if (water_density == 0.0) return modulus / (solid * grain_density);
  const double q = water_bulk_modulus / n;
  const double a = (modulus + solid * solid * q) / (solid * grain_density);
  const double d = n * q / water_density;
  const double bc = solid * n * q * q / (grain_density * water_density);
  return 0.5 * (a + d + std::sqrt((a - d) * (a - d) + 4.0 * bc));
}

/// Square of the wave that bounds the step [m2/s2]. With implicit pore pressure it is that of the
/// drained skeleton: in u-w-p water may stay behind, in u-p it moves along.
double wave_squared(const SoilOptions& options, const BodyConstants& body, double modulus,
                    double porosity) {
  const double grains = (1.0 - porosity) * body.grain_density;
  switch (options.formulation) {
    case Formulation::u_w_p:
      return modulus / grains;
    case Formulation::u_p:
      return modulus / (grains + porosity * body.water_density);
    case Formulation::u_w:
      break;
  }
  return fastest_wave_squared(modulus, porosity, body.grain_density, body.water_density,
                              options.water_bulk_modulus);
}

/// Speed [m/s] that takes the step of an undamped wave down to that of a damped one: a mode of
/// frequency w and damping ratio x is stable up to dt = 2/w (sqrt(1 + x^2) - x) when its velocity
/// is updated first, with w = 2 c/h and x = w nu/(2 c^2), nu the kinematic viscosity [m2/s].
double damped_wave(double wave, double viscosity, double length) {
  const double damping = viscosity / length;  // c x
  return std::sqrt(wave * wave + damping * damping) + damping;
}

/// Share of the time in which a wave crosses a cell up to which each kernel is stable, measured in
/// 1D to 3D (verification_soil_stability).
double stable_courant(Kernel kernel) {
  switch (kernel) {
    case Kernel::linear:
      return 0.65;
    case Kernel::quadratic:
      return 0.8;
    case Kernel::composite:
      break;
  }
  return 1.0;
}

/// What bounds the step of one body, over all ranks: {-least porosity, -least stretch, largest
/// speed squared, largest stiffness}; the speed is negative without points.
template <int D>
std::vector<std::array<double, 4>> step_bounds(
    const Grid<D>& grid, const std::vector<SoilParticles<D>>& bodies,
    const std::vector<BodyConstants>& constants,
    const std::vector<std::unique_ptr<SoilModel>>& laws) {
  std::vector<std::array<double, 4>> mine(bodies.size(), {-1.0, -1.0, -1.0, 0.0}), all(mine);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& points = bodies[b];
    auto& [porosity, stretch, speed2, modulus] = mine[b];
    modulus = largest_wave_modulus(points, *laws[b]);
    for (std::size_t p = 0; p < points.size(); ++p) {
      porosity = std::max(
          porosity, points.grain_mass[p] / (constants[b].grain_density * points.volume[p]) - 1.0);
      stretch = std::max(stretch, -points.volume[p] / points.start_volume[p]);
      double v2 = 0.0, w2 = 0.0;
      for (int a = 0; a < D; ++a) {
        v2 += points.velocity[a][p] * points.velocity[a][p];
        w2 += points.water_velocity[a][p] * points.water_velocity[a][p];
      }
      speed2 = std::max({speed2, v2, w2});
    }
  }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(4 * mine.size()), MPI_DOUBLE, MPI_MAX,
                grid.comm());
  return all;
}

}  // namespace

template <int D>
double largest_wave_modulus(const SoilParticles<D>& points, const SoilModel& law) {
  constexpr std::size_t capacity = 128;
  const std::size_t variables = points.history.size();
  std::vector<SymTensor> stress(capacity);
  std::vector<double> history(capacity * variables);
  double largest = 0.0;
  for (std::size_t first = 0; first < points.size(); first += capacity) {
    const std::size_t length = std::min(capacity, points.size() - first);
    for (std::size_t k = 0; k < length; ++k) {
      stress[k] = get_tensor(points.stress, first + k);
      for (std::size_t h = 0; h < variables; ++h)
        history[k * variables + h] = points.history[h][first + k];
    }
    largest = std::max(
        largest, law.wave_modulus({stress.data(), length}, {history.data(), length * variables}));
  }
  return largest;
}

template <int D>
double stable_step(const Grid<D>& grid, const SoilOptions& options,
                   const std::vector<SoilParticles<D>>& bodies,
                   const std::vector<BodyConstants>& constants,
                   const std::vector<std::unique_ptr<SoilModel>>& laws) {
  double fastest = 0.0;
  const double limit = stable_courant(options.kernel);
  const auto bounds = step_bounds(grid, bodies, constants, laws);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyConstants& body = constants[b];
    const double least_stretch = -bounds[b][1], speed2 = bounds[b][2];
    if (speed2 < 0.0) continue;
    // Tangent of a law linear in logarithmic strain, seen in the compressed state (Kirchhoff: (M -
    // tau)/J). Rates carry their tangent in the state. Soil that has swollen as a whole may have
    // yielded: its stretch says nothing of its stress.
    const double stretch = std::min(least_stretch, 1.0);
    const double stiffer = options.bodies[b].strain == StrainMeasure::jaumann
                               ? 1.0
                               : (1.0 - std::log(stretch)) / stretch;
    const double modulus = bounds[b][3] * stiffer;
    const double n = std::clamp(-bounds[b][0], 0.01, 0.99);
    const double wave2 = wave_squared(options, body, modulus, n) / options.mass_scaling;
    const double viscosity =
        laws[b]->wave_viscosity() / (options.mass_scaling * (1.0 - n) * body.grain_density);
    const double wave = damped_wave(std::sqrt(wave2), viscosity, limit * grid.smallest_spacing());
    fastest = std::max(fastest, wave + std::sqrt(speed2));
  }
  const double share = options.courant * limit;
  double step = fastest > 0.0 ? share * grid.smallest_spacing() / fastest
                              : std::numeric_limits<double>::max();
  if (options.max_step) step = std::min(step, *options.max_step);
  return step;
}

template double stable_step(const Grid<2>&, const SoilOptions&,
                            const std::vector<SoilParticles<2>>&, const std::vector<BodyConstants>&,
                            const std::vector<std::unique_ptr<SoilModel>>&);
template double stable_step(const Grid<3>&, const SoilOptions&,
                            const std::vector<SoilParticles<3>>&, const std::vector<BodyConstants>&,
                            const std::vector<std::unique_ptr<SoilModel>>&);

template double largest_wave_modulus(const SoilParticles<2>&, const SoilModel&);
template double largest_wave_modulus(const SoilParticles<3>&, const SoilModel&);

}  // namespace mudlark

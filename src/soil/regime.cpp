#include "soil/regime.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "grid/halo.hpp"
#include "soil/stable_step.hpp"

namespace mudlark {
namespace {

constexpr double pi = std::numbers::pi;

/// Height over which a body's points reach, over all ranks [m]; zero without points.
template <int D>
double height_of(const Grid<D>& grid, const SoilParticles<D>& points) {
  double top = -HUGE_VAL, bottom = HUGE_VAL;
  for (const double z : points.position[D - 1])
    top = std::max(top, z), bottom = std::min(bottom, z);
  top = max_over_ranks(grid, top);
  bottom = min_over_ranks(grid, bottom);
  return top >= bottom ? std::max(top - bottom, grid.spacing()[D - 1]) : 0.0;
}

std::string range_warning(const std::string& name, const SaturatedLayer& layer, double frequency) {
  const RegimeNumbers numbers = regime_numbers(layer, frequency);
  return fmt::format(
      "soil {}: formulation u-p leaves out the acceleration of the pore water against the grains, "
      "which matters here: Pi1 = {:.3g}, Pi2 = {:.3g}, Pi1 Pi2 = k omega rho/(g rho_w) = {:.3g} "
      "for loads of period {:.3g} s over a height of {:.3g} m (it should be below {:g}; "
      "Zienkiewicz "
      "et al. 1980). Take formulation \"u-w-p\" or \"u-w\"; or, where loads are slower, give "
      "soil_solver.loading_period.",
      name, numbers.first, numbers.second, numbers.first * numbers.second, 2.0 * pi / frequency,
      layer.height, numbers.second > 1.0 ? 0.02 : 0.06);
}

std::string growth_warning(const std::string& name, const SaturatedLayer& layer, double spacing) {
  const double longest = u_p_growth(layer, 0.5 * pi / layer.height, true);
  const double shortest = u_p_growth(layer, 2.0 / spacing, true);
  return fmt::format(
      "soil {}: formulation u-p with inertia_in_darcy = true is unstable in this soil, whatever "
      "its "
      "permeability: (K_w/n)(rho - rho_w) = {:.3g} Pa kg/m3 must exceed rho_w M = {:.3g}. Waves "
      "grow at {:.3g} 1/s (four times the height of the soil) to {:.3g} 1/s (the shortest of the "
      "grid). Leave inertia_in_darcy out, or take formulation \"u-w-p\" or \"u-w\".",
      name, layer.stiffness() * (layer.density() - layer.water_density),
      layer.water_density * layer.modulus, longest, shortest);
}

}  // namespace

double SaturatedLayer::undrained_wave() const {
  return std::sqrt((modulus + stiffness()) / density());
}
double SaturatedLayer::first_frequency() const { return 0.5 * pi * undrained_wave() / height; }

RegimeNumbers regime_numbers(const SaturatedLayer& layer, double frequency) {
  const double second = frequency * layer.height / layer.undrained_wave();
  RegimeNumbers numbers;
  numbers.second = second * second;
  // k / (g b) = mobility rho, as k = kappa rho_w g / mu.
  numbers.first = layer.mobility * layer.density() * frequency / numbers.second;
  return numbers;
}

bool u_p_holds(const RegimeNumbers& numbers) {
  const double product = numbers.first * numbers.second;
  return numbers.second <= 30.0 && product < (numbers.second > 1.0 ? 0.02 : 0.06);
}

double u_p_growth(const SaturatedLayer& layer, double wave_number, bool inertia_in_darcy) {
  const double rho = layer.density(), q = layer.stiffness(), l2 = wave_number * wave_number;
  const double lost = inertia_in_darcy ? layer.water_density : 0.0;
  // Companion matrix of the cubic in s = scale * x, so that its entries are of one size.
  const double scale = layer.undrained_wave() * wave_number;
  const double a = q * layer.mobility * l2 * (rho - lost) / (rho * scale);
  const double b = (layer.modulus + q) * l2 / (rho * scale * scale);
  const double c = q * layer.mobility * layer.modulus * l2 * l2 / (rho * scale * scale * scale);
  Eigen::Matrix3d companion;
  companion << -a, -b, -c, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  return scale * companion.eigenvalues().real().maxCoeff();
}

template <int D>
std::vector<std::string> regime_warnings(const Grid<D>& grid, const SoilOptions& options,
                                         const std::vector<SoilParticles<D>>& bodies,
                                         const std::vector<BodyConstants>& constants,
                                         const std::vector<std::unique_ptr<SoilModel>>& laws) {
  std::vector<std::string> warnings;
  if (options.formulation != Formulation::u_p) return warnings;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyConstants& body = constants[b];
    const double height = height_of(grid, bodies[b]);
    if (body.water_density == 0.0 || height == 0.0) continue;
    const double modulus = max_over_ranks(grid, largest_wave_modulus(bodies[b], *laws[b]));
    const SaturatedLayer layer{modulus,
                               body.start_porosity,
                               options.mass_scaling * body.grain_density,
                               options.mass_scaling * body.water_density,
                               options.water_bulk_modulus,
                               body.intrinsic_permeability / body.water_viscosity,
                               height};
    const double frequency =
        options.loading_period ? 2.0 * pi / *options.loading_period : layer.first_frequency();
    const std::string& name = options.bodies[b].name;
    if (!u_p_holds(regime_numbers(layer, frequency)))
      warnings.push_back(range_warning(name, layer, frequency));
    if (options.inertia_in_darcy && layer.stiffness() * (layer.density() - layer.water_density) <=
                                        layer.water_density * modulus)
      warnings.push_back(growth_warning(name, layer, grid.smallest_spacing()));
  }
  return warnings;
}

template std::vector<std::string> regime_warnings(const Grid<2>&, const SoilOptions&,
                                                  const std::vector<SoilParticles<2>>&,
                                                  const std::vector<BodyConstants>&,
                                                  const std::vector<std::unique_ptr<SoilModel>>&);
template std::vector<std::string> regime_warnings(const Grid<3>&, const SoilOptions&,
                                                  const std::vector<SoilParticles<3>>&,
                                                  const std::vector<BodyConstants>&,
                                                  const std::vector<std::unique_ptr<SoilModel>>&);

}  // namespace mudlark

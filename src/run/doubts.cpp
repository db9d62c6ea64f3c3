#include "run/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/errors.hpp"
#include "run/water_doubts.hpp"

namespace mudlark {
namespace {

constexpr double degree = std::numbers::pi / 180.0;  // [rad]
/// Below this an angle of friction is more likely one in radians [rad].
constexpr double least_friction = 3.0 * degree;
/// Dry grains lighter than this are more likely in g/cm3 or t/m3 [kg/m3].
constexpr double lightest_grains = 500.0;
/// Grains that drain have less.
constexpr double drained_ratio = 0.4;
/// Even foam is heavier [kg/m3].
constexpr double lightest_solid = 10.0;
/// Of coarse gravel [m/s].
constexpr double largest_conductivity = 1.0;

double gravity_of(const DomainOptions& domain) {
  double sum = 0.0;
  for (const double g : domain.gravity) sum += g * g;
  return std::sqrt(sum);
}

std::optional<double> young_modulus(const SoilLawOptions& law) {
  return std::visit(
      [](const auto& options) -> std::optional<double> {
        if constexpr (requires { options.young_modulus; }) return options.young_modulus;
        return {};
      },
      law);
}

std::optional<double> poisson_ratio(const SoilLawOptions& law) {
  return std::visit(
      [](const auto& options) -> std::optional<double> {
        if constexpr (requires { options.poisson_ratio; }) return options.poisson_ratio;
        return {};
      },
      law);
}

std::optional<double> friction_angle(const SoilLawOptions& law) {
  return std::visit(
      [](const auto& options) -> std::optional<double> {
        if constexpr (requires { options.friction_angle; }) return options.friction_angle;
        return {};
      },
      law);
}

/// Does the field press or pull [Pa], in the middle of the cells that the body fills?
double mean_initial_stress(const CaseOptions& options, const SoilBody& body) {
  const auto* field = std::get_if<StressField>(&body.initial_stress);
  if (!field) return 0.0;
  const DomainOptions& domain = options.domain;
  const BoxShape around = bounds(body.shape);
  constexpr int samples = 8;
  double sum = 0.0;
  for (int i = 0; i < samples; ++i)
    for (int k = 0; k < samples; ++k) {
      Point3 place{};
      for (int axis = 0; axis < domain.dimension; ++axis) {
        const std::size_t at = axis == domain.dimension - 1 ? 2 : static_cast<std::size_t>(axis);
        const auto own = static_cast<std::size_t>(axis);
        const double lower = std::max(domain.lower[own], around.lower[at]);
        const double upper = std::min(domain.upper[own], around.upper[at]);
        const double share = at == 1 ? 0.5 : ((at == 2 ? k : i) + 0.5) / samples;
        place[at] = lower + share * (upper - lower);
      }
      if (!body.shape.contains(place)) continue;
      for (std::size_t c = 0; c < 3; ++c) sum += field->component[c](place, 0.0);
    }
  return sum;
}

void doubt_stiffness(const CaseOptions& options, const SoilBody& body,
                     std::vector<std::string>& found) {
  const std::optional<double> modulus = young_modulus(body.law);
  if (!modulus) return;
  const auto up = static_cast<std::size_t>(options.domain.dimension - 1);
  const double height = std::min(options.domain.upper[up], bounds(body.shape).upper[2]) -
                        std::max(options.domain.lower[up], bounds(body.shape).lower[2]);
  const double weight =
      (1.0 - body.porosity) * body.grain_density * gravity_of(options.domain) * height;
  if (weight > *modulus)
    found.push_back(
        fmt::format("soil \"{}\": young_modulus = {:g} Pa is less than what its own weight presses "
                    "with at its foot, {:.3g} Pa. Numbers without unit are Pa: write \"10 MPa\" "
                    "for ten megapascals.",
                    body.name, *modulus, weight));
  const bool wet = body.pore_water != PoreWater::none;
  if (wet && options.soil->water_bulk_modulus < *modulus)
    found.push_back(fmt::format(
        "soil \"{}\": the water in its pores is softer than its grains: water.bulk_modulus = {:g} "
        "Pa is below young_modulus = {:g} Pa. Pure water has \"2.15 GPa\".",
        body.name, options.soil->water_bulk_modulus, *modulus));
}

void doubt_grains(const CaseOptions& options, const SoilBody& body,
                  std::vector<std::string>& found) {
  const bool wet = body.pore_water != PoreWater::none;
  const double least = wet ? options.soil->water_density : lightest_grains;
  if (body.grain_density <= least)
    found.push_back(fmt::format(
        "soil \"{}\": grain_density = {:g} kg/m3{}. Quartz has 2650, or \"2.65 g/cm3\".", body.name,
        body.grain_density, wet ? " is no more than that of the water: the grains float" : ""));
  if (!wet || body.intrinsic_permeability == 0.0) return;
  constexpr double standard_gravity = 9.81;
  const double conductivity = body.intrinsic_permeability * options.soil->water_density *
                              standard_gravity / options.soil->water_viscosity;
  if (conductivity > largest_conductivity)
    found.push_back(fmt::format(
        "soil \"{}\": its hydraulic conductivity is {:.3g} m/s, more than that of coarse gravel. "
        "Sand has 1e-5 to 1e-2 m/s.",
        body.name, conductivity));
}

/// The ratio of undrained soil, where the water is computed that keeps its volume.
void doubt_volume(const SoilBody& body, std::vector<std::string>& found) {
  const double ratio = poisson_ratio(body.law).value_or(0.0);
  if (body.pore_water != PoreWater::unified || ratio <= drained_ratio) return;
  found.push_back(fmt::format(
      "soil \"{}\": poisson_ratio = {:g} is that of undrained soil in total stresses. With "
      "pore_water = \"unified\" the water keeps the volume, and grains that keep it too make noise "
      "in their stress which brakes what flows. Write that of the drained grains, 0.2 to 0.3.",
      body.name, ratio));
}

/// Walls hold soil in tension: what touches one above hangs from it. Whoever says what is there
/// knows.
void doubt_ceiling(const CaseOptions& options, const SoilBody& body,
                   std::vector<std::string>& found) {
  const DomainOptions& domain = options.domain;
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  const Wall ceiling = domain.walls[up][1];
  if (ceiling == Wall::open || ceiling == Wall::periodic || !(domain.gravity[up] < 0.0)) return;
  for (const SoilBoundary& boundary : options.soil->boundaries)
    if (boundary.axis == domain.dimension - 1 && boundary.side == 1) return;
  if (bounds(body.shape).upper[2] < domain.upper[up] - 0.01 * cell_size(domain, up)) return;
  found.push_back(fmt::format(
      "soil \"{}\": it reaches up to the closed upper side of the domain and hangs from it: closed "
      "sides hold soil in tension too. Make the domain higher, or write upper_z = \"open\" under "
      "[domain.walls].",
      body.name));
}

void doubt_soil(const CaseOptions& options, std::vector<std::string>& found) {
  for (const SoilBody& body : options.soil->bodies) {
    doubt_stiffness(options, body, found);
    doubt_grains(options, body, found);
    doubt_ceiling(options, body, found);
    doubt_volume(body, found);
    const double friction = friction_angle(body.law).value_or(0.0);
    if (friction > 0.0 && friction < least_friction)
      found.push_back(fmt::format(
          "soil \"{}\": friction_angle = {:.3g} degree is hardly any. Numbers without unit are "
          "degrees: write \"{:.3g} rad\" for radians.",
          body.name, friction / degree, friction / degree));
    if (mean_initial_stress(options, body) > 0.0)
      found.push_back(
          fmt::format("soil \"{}\": initial_stress pulls at the soil. Stresses are tension "
                      "positive: write minus for compression.",
                      body.name));
  }
}

/// Is the soil dry under open water in one of these columns? Height where that water ends [m].
std::optional<double> water_over_dry_soil(const CaseOptions& options, const SoilBody& body) {
  const DomainOptions& domain = options.domain;
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  const double step = 0.25 * cell_size(domain, up);
  const auto any = [](const auto& parts, const Point3& at) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const auto& part) { return part.shape.contains(at); });
  };
  constexpr int columns = 24;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < (domain.dimension == 3 ? columns : 1); ++j) {
      Point3 at{};
      at[0] = domain.lower[0] + (i + 0.5) / columns * (domain.upper[0] - domain.lower[0]);
      if (domain.dimension == 3)
        at[1] = domain.lower[1] + (j + 0.5) / columns * (domain.upper[1] - domain.lower[1]);
      std::optional<double> open_water;
      for (at[2] = domain.upper[up] - 0.5 * step; at[2] > domain.lower[up]; at[2] -= step) {
        if (any(options.flow->solids, at)) break;
        const bool ground = any(options.soil->bodies, at) || any(options.flow->porous, at);
        const bool water = any(options.flow->bodies, at);
        if (water && !ground) open_water = at[2] - 0.5 * step;
        if (!ground) continue;
        if (open_water && !water && body.shape.contains(at)) return open_water;
        break;  // only the topmost ground of a column
      }
    }
  return {};
}

/// Water that was drawn down to the bed only: the pores under it are empty, and it falls into them.
void doubt_pores(const CaseOptions& options, const SoilBody& body,
                 std::vector<std::string>& found) {
  const bool meant = body.filling.at_start > 0.0 || body.filling.suction > 0.0;
  if (body.pore_water == PoreWater::none || body.stage > 0 || meant) return;
  const std::optional<double> ends = water_over_dry_soil(options, body);
  if (!ends) return;
  found.push_back(fmt::format(
      "soil \"{}\": its pores are empty under open water, which ends at {:.3g} m and falls into "
      "them when the run starts. Let the shape of the [[water.body]] reach down through the soil: "
      "in soil it is the water of the pores.{}",
      body.name, *ends,
      body.pore_water == PoreWater::unified
          ? " Dry soil that is meant has initial_saturation or suction."
          : ""));
}

/// A surface from a file that is far larger than the domain: millimetres taken for metres.
void doubt_size(const DomainOptions& domain, const auto& solid, std::vector<std::string>& found) {
  if (!std::holds_alternative<StlShape>(solid.shape.form)) return;
  constexpr double far_larger = 20.0;
  const BoxShape box = bounds(solid.shape);
  double largest = 0.0, room = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    largest = std::max(largest, box.upper[a] - box.lower[a]);
    room = std::max(room, domain.upper[a] - domain.lower[a]);
  }
  if (largest > far_larger * room)
    found.push_back(fmt::format(
        "solid \"{}\": its surface is {:.4g} m long, and the domain {:.4g} m. A file in "
        "millimetres needs scale = 0.001.",
        solid.name, largest, room));
}

/// Of bodies in soil or in water.
void doubt_solids(const DomainOptions& domain, const auto& solids,
                  std::vector<std::string>& found) {
  for (const auto& solid : solids) {
    doubt_size(domain, solid, found);
    if (const auto* motion = std::get_if<FreeSolid>(&solid.motion);
        motion && motion->density > 0.0 && motion->density < lightest_solid)
      found.push_back(fmt::format(
          "solid \"{}\": density = {:g} kg/m3 is hardly any. Concrete has 2400, or \"2.4 g/cm3\".",
          solid.name, motion->density));
  }
}

}  // namespace

std::vector<std::string> doubts(const CaseOptions& options) {
  std::vector<std::string> found;
  if (options.flow)
    doubt_solids(options.domain, options.flow->solids, found);
  else if (options.soil)
    doubt_solids(options.domain, options.soil->solids, found);
  if (options.soil) doubt_soil(options, found);
  if (options.flow) doubt_water(options, found);
  if (options.soil && options.flow && options.coupling.mode != CouplingMode::none)
    for (const SoilBody& body : options.soil->bodies) doubt_pores(options, body, found);
  if (options.soil && options.flow && options.coupling.mode == CouplingMode::none)
    found.emplace_back(
        "soil and flowing water do not feel each other: coupling.mode is \"none\". Write "
        "[coupling] "
        "mode = \"surface\"; or \"unified\", for soil with pore_water = \"unified\".");
  return found;
}

}  // namespace mudlark

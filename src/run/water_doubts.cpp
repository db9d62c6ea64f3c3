#include "run/water_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/errors.hpp"
#include "flow/wave_zone.hpp"

namespace mudlark {

double cell_size(const DomainOptions& domain, std::size_t axis) {
  const std::vector<double>& faces = domain.faces[axis];
  if (faces.empty()) return (domain.upper[axis] - domain.lower[axis]) / domain.cells[axis];
  double smallest = faces[1] - faces[0];
  for (std::size_t f = 1; f + 1 < faces.size(); ++f)
    smallest = std::min(smallest, faces[f + 1] - faces[f]);
  return smallest;
}

namespace {

constexpr double degree = std::numbers::pi / 180.0;  // [rad]
constexpr double lightest_water = 100.0;             // more likely in g/cm3 or t/m3 [kg/m3]
/// Kinematic viscosity of water is 1e-6 m2/s; a dynamic one so small belongs to no liquid [Pa s].
constexpr double least_viscosity = 1e-5;
/// Cells that a wave needs at least over its height and its length.
constexpr double least_cells_of_height = 1.0, least_cells_of_length = 15.0;

/// Height of the highest water at the start in a column [m]; nothing where it is dry.
std::optional<double> water_level(const CaseOptions& options, double x, double y) {
  const auto up = static_cast<std::size_t>(options.domain.dimension - 1);
  const double step = 0.25 * cell_size(options.domain, up);
  const auto at = [&](const auto& part, double z) { return part.shape.contains({x, y, z}); };
  for (double z = options.domain.upper[up] - 0.5 * step; z > options.domain.lower[up]; z -= step) {
    const auto here = [&](const auto& part) { return at(part, z); };
    const FlowOptions& flow = *options.flow;
    if (std::any_of(flow.bodies.begin(), flow.bodies.end(), here) &&
        std::none_of(flow.solids.begin(), flow.solids.end(), here))
      return z + 0.5 * step;
  }
  return {};
}

/// Level of the water at the start where a wave is made or absorbed, if that is still_level nowhere
/// along it.
std::optional<double> other_level(const CaseOptions& options, const WaveZoneOptions& zone,
                                  double outer, double inner) {
  const DomainOptions& domain = options.domain;
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  constexpr int columns = 11;
  std::optional<double> other;
  for (int c = 0; c < columns; ++c) {
    const double along = outer + (inner - outer) * (c + 0.5) / columns;
    const double across = domain.dimension == 3
                              ? 0.5 * (domain.lower[1 - static_cast<std::size_t>(zone.axis)] +
                                       domain.upper[1 - static_cast<std::size_t>(zone.axis)])
                              : 0.0;
    const std::optional<double> level =
        zone.axis == 0 ? water_level(options, along, across) : water_level(options, across, along);
    if (!level) continue;
    if (std::abs(*level - zone.still_level) <= cell_size(domain, up)) return {};
    other = level;
  }
  return other;
}

/// [m]; nothing when there is no such wave, which is told elsewhere.
std::optional<double> wave_length(const CaseOptions& options, const WaveZoneOptions& zone) {
  const auto up = static_cast<std::size_t>(options.domain.dimension - 1);
  try {
    return make_wave(zone, std::abs(options.domain.gravity[up]))->length();
  } catch (const InputError&) {
    return {};
  }
}

/// A solitary wave whose crest starts so near that much of it has come in before the run starts.
void doubt_crest(const WaveZoneOptions& zone, std::vector<std::string>& found) {
  const auto* solitary = std::get_if<SolitaryWave>(&zone.wave);
  if (!solitary || zone.ramp > 0.0 || !(solitary->height > 0.0)) return;
  // eta = H sech^2 of K times the distance from the crest (Boussinesq)
  constexpr double most = 0.1, good = 0.02;
  const double scale = std::sqrt(0.75 * solitary->height / std::pow(zone.depth, 3));
  const double share = std::pow(std::cosh(scale * solitary->crest), -2.0);
  if (share <= most) return;
  found.push_back(fmt::format(
      "wave \"{}\": the solitary wave begins with a jolt: at its outer end the level has to stand "
      "{:.2g} m above still water when the run starts. Its crest starts farther away with crest = "
      "{:.3g} or less.",
      zone.name, share * solitary->height, -std::acosh(1.0 / std::sqrt(good)) / scale));
}

/// Waves at an angle between periodic sides that do not hold a whole number of them across.
void doubt_seam(const CaseOptions& options, const WaveZoneOptions& zone,
                std::vector<std::string>& found) {
  const DomainOptions& domain = options.domain;
  const auto across = 1 - static_cast<std::size_t>(zone.axis);
  if (domain.dimension != 3 || domain.walls[across][0] != Wall::periodic) return;
  const auto* irregular = std::get_if<IrregularSea>(&zone.wave);
  const auto* focused = std::get_if<FocusedWave>(&zone.wave);
  const bool spread =
      (irregular && irregular->sea.spreading) || (focused && focused->sea.spreading);
  if (spread || ((irregular || focused) && zone.direction != 0.0)) {
    found.push_back(fmt::format(
        "wave \"{}\": a sea at an angle jumps where the periodic sides meet: its components do not "
        "fit between them. Leave out direction and spreading, or close the sides.",
        zone.name));
    return;
  }
  const std::optional<double> length = wave_length(options, zone);
  if (zone.direction == 0.0 || !length || !(*length > 0.0)) return;
  constexpr double hair = 0.02;  // of a wave
  const double width = domain.upper[across] - domain.lower[across];
  const double sine = std::abs(std::sin(zone.direction));
  const double waves = width * sine / *length, whole = std::max(1.0, std::round(waves));
  if (std::abs(waves - whole) <= hair) return;
  const double fitting = whole * *length / width;  // sine of an angle, if there is one
  found.push_back(fmt::format(
      "wave \"{}\": at this angle {:.3g} waves of {:.4g} m lie between the periodic sides, so it "
      "jumps where they meet. What fits is {}a domain {:.4g} m wide.",
      zone.name, waves, *length,
      fitting <= 1.0 ? fmt::format("direction = {:.4g}, or ",
                                   std::copysign(std::asin(fitting) / degree, zone.direction))
                     : std::string(),
      whole * *length / sine));
}

void doubt_wave(const CaseOptions& options, const WaveZoneOptions& zone, double outer, double inner,
                std::vector<std::string>& found) {
  if (!std::holds_alternative<GivenWave>(zone.wave))
    if (const auto level = other_level(options, zone, outer, inner))
      found.push_back(fmt::format(
          "wave \"{}\": still_level is {:g} m, and the water there stands at {:.4g} m when the run "
          "starts: it rises or falls to still_level first.",
          zone.name, zone.still_level, *level));
  doubt_crest(zone, found);
  doubt_seam(options, zone, found);
  const auto* regular = std::get_if<RegularWave>(&zone.wave);
  if (!regular) return;
  const auto up = static_cast<std::size_t>(options.domain.dimension - 1);
  const double high = cell_size(options.domain, up);
  const double wide = cell_size(options.domain, static_cast<std::size_t>(zone.axis));
  const std::optional<double> found_length = wave_length(options, zone);
  if (!found_length) return;
  const double length = *found_length;
  if (regular->height < least_cells_of_height * high || length < least_cells_of_length * wide)
    found.push_back(fmt::format(
        "wave \"{}\": it is {:.3g} cells high and {:.3g} long. Waves lose height on so few; ten "
        "over the height and sixty over the length are good.",
        zone.name, regular->height / high, length / wide));
}

/// A nozzle in the air: without a level it takes the water at the side for what comes in.
void doubt_opening(const CaseOptions& options, const FlowSideOptions& side,
                   std::vector<std::string>& found) {
  const DomainOptions& domain = options.domain;
  if (side.flow != SideFlow::velocity || side.level || side.axis == domain.dimension - 1) return;
  const auto axis = static_cast<std::size_t>(side.axis);
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  const double inside = 0.5 * cell_size(domain, axis);
  const double place = side.side == 0 ? domain.lower[axis] + inside : domain.upper[axis] - inside;
  double depth = 0.0;  // of the water in the column, wherever it stands
  const double step = 0.25 * cell_size(domain, up);
  Point3 at{};
  at[axis] = place;
  if (domain.dimension == 3) {
    const std::size_t across = 1 - axis;
    at[across] = 0.5 * (std::max(side.from[across], domain.lower[across]) +
                        std::min(side.to[across], domain.upper[across]));
  }
  for (at[2] = domain.lower[up] + 0.5 * step; at[2] < domain.upper[up]; at[2] += step)
    if (std::any_of(options.flow->bodies.begin(), options.flow->bodies.end(),
                    [&](const WaterBody& body) { return body.shape.contains(at); }))
      depth += step;
  const double foot = std::max(side.from[2], domain.lower[up]);
  if (domain.lower[up] + depth > foot) return;
  found.push_back(fmt::format(
      "opening \"{}\" lets nothing in: it begins at {:g} m, above the water at its side, and what "
      "comes in is water only below `level`, by default that of the water there. Write level = "
      "{:g} "
      "for a full jet.",
      side.name, foot, std::min(side.to[2], domain.upper[up])));
}

/// Open water over the ground at a side that holds it at another level.
void doubt_head(const CaseOptions& options, const GroundSideOptions& side,
                std::vector<std::string>& found) {
  const DomainOptions& domain = options.domain;
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  const auto axis = static_cast<std::size_t>(side.axis);
  if (side.water != GroundSideWater::head || axis == up) return;
  Point3 at{};
  const double inside = 0.5 * cell_size(domain, axis);
  at[axis] = side.side == 0 ? domain.lower[axis] + inside : domain.upper[axis] - inside;
  if (domain.dimension == 3) {
    const std::size_t across = 1 - axis;
    at[across] = 0.5 * (std::max(side.from[across], domain.lower[across]) +
                        std::min(side.to[across], domain.upper[across]));
  }
  const std::optional<double> level = water_level(options, at[0], at[1]);
  if (!level) return;
  const double cell = cell_size(domain, up);
  at[2] = std::min(*level, side.to[2]) - 0.5 * cell;
  const auto here = [&](const auto& part) { return part.shape.contains(at); };
  const auto& soils = options.soil->bodies;
  const auto& porous = options.flow->porous;
  if (at[2] < side.from[2] || std::any_of(soils.begin(), soils.end(), here) ||
      std::any_of(porous.begin(), porous.end(), here))
    return;
  const double head = side.value(at, 0.0);
  if (std::abs(head - *level) <= cell) return;
  found.push_back(fmt::format(
      "boundary \"{}\": its head is {:g} m, and the open water there stands at {:.4g} m when the "
      "run starts: it {} to the head at once, as a wave. A boundary that ends at the ground "
      "(\"to\") "
      "leaves the water over it to the wall.",
      side.name, head, *level, head > *level ? "rises" : "falls"));
}

}  // namespace

void doubt_water(const CaseOptions& options, std::vector<std::string>& found) {
  const FlowOptions& flow = *options.flow;
  if (flow.density < lightest_water)
    found.push_back(fmt::format("water.density = {:g} kg/m3. Fresh water has 1000, or \"1 g/cm3\".",
                                flow.density));
  if (flow.viscosity > 0.0 && flow.viscosity < least_viscosity)
    found.push_back(fmt::format(
        "water.viscosity = {:g} Pa s is the dynamic one: water has 1e-3 Pa s (1e-6 m2/s is its "
        "kinematic viscosity).",
        flow.viscosity));
  for (const WaveZoneOptions& zone : flow.waves)
    doubt_wave(options, zone, zone.outer, zone.inner, found);
  for (const WaveSourceOptions& source : flow.wave_sources)
    doubt_wave(options, source.wave, source.wave.outer, source.wave.outer, found);
  for (const GroundSideOptions& side : flow.ground_sides) doubt_head(options, side, found);
  for (const FlowSideOptions& side : flow.sides) {
    if (side.flow != SideFlow::wave) {
      doubt_opening(options, side, found);
      continue;
    }
    const auto axis = static_cast<std::size_t>(side.axis);
    const double inwards = side.side == 0 ? 1.0 : -1.0;
    const double place = side.side == 0 ? options.domain.lower[axis] : options.domain.upper[axis];
    doubt_wave(options, side.wave, place, place + inwards * cell_size(options.domain, axis), found);
  }
}

}  // namespace mudlark

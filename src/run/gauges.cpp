#include "run/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/errors.hpp"
#include "flow/flow_checks.hpp"
#include "flow/flow_gauges.hpp"
#include "run/material_gauge.hpp"

namespace mudlark {
namespace {

template <int D>
Vec<D> place_of(const GaugeOptions& gauge) {
  Vec<D> place;
  for (int a = 0; a < D; ++a)
    place[a] = gauge.at[static_cast<std::size_t>(D == 2 && a == 1 ? 2 : a)];
  return place;
}

std::vector<std::string> per_axis(const std::string& name, const std::string& unit, int dimension) {
  std::vector<std::string> columns;
  for (const char* axis : dimension == 2 ? std::vector<const char*>{"x", "z"}
                                         : std::vector<const char*>{"x", "y", "z"})
    columns.push_back(fmt::format("{} {} [{}]", name, axis, unit));
  return columns;
}

std::vector<std::string> about_each(const std::string& name, const std::string& unit,
                                    int dimension) {
  if (dimension == 2) return {fmt::format("{} [{}]", name, unit)};
  return per_axis(name, unit, dimension);
}

MaterialQuantity material_quantity(GaugeQuantity quantity) {
  switch (quantity) {
    case GaugeQuantity::pore_pressure:
      return MaterialQuantity::pore_pressure;
    case GaugeQuantity::effective_stress:
      return MaterialQuantity::effective_stress;
    case GaugeQuantity::point_porosity:
      return MaterialQuantity::porosity;
    default:
      return MaterialQuantity::displacement;
  }
}

template <int D>
std::vector<double> read_soil(World<D>& world, const GaugeOptions& gauge) {
  std::vector<double> values = read_material(world.grid(), *world.soil(),
                                             material_quantity(gauge.quantity), place_of<D>(gauge));
  // Not yet placed or taken out, or it has left the domain.
  if (values.empty() && (!world.stages().empty() || world.clock().step() > 0))
    return std::vector<double>(gauge_columns(gauge, D).size(),
                               std::numeric_limits<double>::quiet_NaN());
  if (values.empty())
    throw InputError(fmt::format(
        "gauge {}: no soil at {} at the start. Put `at` inside a soil body or on its surface.",
        gauge.name, place_text(place_of<D>(gauge))));
  if (gauge.quantity == GaugeQuantity::settlement) return {-values[D - 1]};
  return values;
}

/// Components along the axes of the problem.
template <int D>
std::vector<double> along_axes(const Eigen::Vector3d& v) {
  if constexpr (D == 2) return {v[0], v[2]};
  return {v[0], v[1], v[2]};
}
/// Components about the axes; in the plane one, counter-clockwise, which is about -y.
template <int D>
std::vector<double> about_axes(const Eigen::Vector3d& v) {
  if constexpr (D == 2) return {-v[1]};
  return {v[0], v[1], v[2]};
}

/// A body in flowing water.
template <int D>
std::vector<double> read_flow_solid(World<D>& world, const GaugeOptions& gauge) {
  const SolidBodies<D>& solids = world.flow()->solids();
  const std::size_t body = *solids.find(gauge.of);
  const RigidPose& pose = solids.pose(body);
  const auto load = [&] {
    return world.flow()->solid_load(body, BoxShape{gauge.range.from, gauge.range.to});
  };
  switch (gauge.quantity) {
    case GaugeQuantity::solid_force:
      return along_axes<D>(load().force);
    case GaugeQuantity::solid_moment:
      return about_axes<D>(load().moment);
    case GaugeQuantity::solid_displacement:
      return along_axes<D>(pose.centre() - pose.start_centre());
    case GaugeQuantity::solid_rotation:
      return about_axes<D>(D == 2 ? pose.turned() : rotation_of(pose.turn()));
    case GaugeQuantity::solid_collision:
      return along_axes<D>(solids.collision_force(body));
    default:
      return along_axes<D>(solids.velocity(body).velocity);
  }
}

/// What soil and, where it flows around the body, water do to it. Collective.
template <int D>
SolidLoad load_on(World<D>& world, const Solid& solid) {
  SolidLoad load{solid.force(), solid.moment()};
  if (!world.flow()) return load;
  const auto body = world.flow()->solids().find(solid.options().name);
  const SolidLoad water = world.flow()->solid_load(*body, {});
  load.force += water.force, load.moment += water.moment;
  return load;
}

template <int D>
std::vector<double> read_solid(World<D>& world, const GaugeOptions& gauge) {
  if (!world.soil()) return read_flow_solid(world, gauge);
  const std::vector<Solid>& solids = world.soil()->solids();
  const Solid& solid = *std::find_if(solids.begin(), solids.end(), [&](const Solid& one) {
    return one.options().name == gauge.of;
  });
  switch (gauge.quantity) {
    case GaugeQuantity::solid_force:
      return along_axes<D>(load_on(world, solid).force);
    case GaugeQuantity::solid_moment:
      return about_axes<D>(load_on(world, solid).moment);
    case GaugeQuantity::solid_displacement:
      return along_axes<D>(solid.displacement());
    case GaugeQuantity::solid_rotation:
      return about_axes<D>(solid.rotation());
    case GaugeQuantity::solid_collision:
      return along_axes<D>(solid.collision_force());
    default:
      return along_axes<D>(solid.velocity());
  }
}

template <int D>
std::vector<double> read_levels(World<D>& world, const GaugeOptions& gauge) {
  std::vector<double> levels =
      surfaces_over(world.grid(), world.flow()->saturation(), place_of<D>(gauge));
  if (levels.empty()) levels.push_back(world.grid().lower()[D - 1]);
  levels.resize(static_cast<std::size_t>(gauge.crossings),
                std::numeric_limits<double>::quiet_NaN());
  return levels;
}

template <int D>
double read_run_up(World<D>& world, const GaugeOptions& gauge) {
  RunUpRange<D> range;
  for (int a = 0; a + 1 < D; ++a)
    range.from[a] = gauge.range.from[static_cast<std::size_t>(a)],
    range.to[a] = gauge.range.to[static_cast<std::size_t>(a)];
  range.thickness = gauge.thickness;
  return run_up(world.grid(), world.flow()->saturation(), world.medium(), range);
}

template <int D>
std::vector<double> read_energy(World<D>& world) {
  const FlowSolver<D>& flow = *world.flow();
  const double moving = flow.kinetic_energy();
  const double lifted =
      potential_energy(world.grid(), flow.water_fraction(), flow.saturation(), flow.density());
  return {moving, lifted, moving + lifted};
}

std::vector<std::string> level_columns(int crossings) {
  std::vector<std::string> columns{"water level [m]"};
  for (int n = 2; n <= crossings; ++n) columns.push_back(fmt::format("water level {} [m]", n));
  return columns;
}

template <int D>
double kinetic_energy(World<D>& world) {
  double energy = world.flow() ? world.flow()->kinetic_energy() : 0.0;
  if (world.soil()) {
    energy += world.soil()->totals().kinetic_energy;
    for (const Solid& solid : world.soil()->solids()) energy += solid.kinetic_energy();
  }
  return energy;
}

/// With one water the grains' of the faces: the points take theirs over when they next move.
template <int D>
Vec<D> momentum(World<D>& world) {
  Vec<D> sum = world.flow() ? world.flow()->momentum() : Vec<D>{};
  if (world.unified())
    sum += world.unified()->grain_momentum();
  else if (world.soil())
    sum += world.soil()->totals().momentum;
  return sum;
}

}  // namespace

std::vector<std::string> gauge_columns(const GaugeOptions& gauge, int dimension) {
  const std::string volume = dimension == 2 ? "m2" : "m3", energy = dimension == 2 ? "J/m" : "J";
  switch (gauge.quantity) {
    case GaugeQuantity::water_level:
      return level_columns(gauge.crossings);
    case GaugeQuantity::pressure:
      return {"pressure [Pa]"};
    case GaugeQuantity::velocity:
      return per_axis("velocity", "m/s", dimension);
    case GaugeQuantity::front:
      return {"front [m]"};
    case GaugeQuantity::total_water:
      return {"water volume [" + volume + "]"};
    case GaugeQuantity::kinetic_energy:
      return {"kinetic energy [" + energy + "]"};
    case GaugeQuantity::momentum:
      return per_axis("momentum", dimension == 2 ? "kg/s" : "kg m/s", dimension);
    case GaugeQuantity::max_speed:
      return {"largest speed [m/s]"};
    case GaugeQuantity::section_flux:
      return {"discharge [" + volume + "/s]"};
    case GaugeQuantity::overtopping:
      return {"volume [" + volume + "]", "discharge [" + volume + "/s]"};
    case GaugeQuantity::run_up:
      return {"run-up [m]"};
    case GaugeQuantity::energy:
      return {"kinetic energy [" + energy + "]", "potential energy [" + energy + "]",
              "energy [" + energy + "]"};
    case GaugeQuantity::settlement:
      return {"settlement [m]"};
    case GaugeQuantity::displacement:
      return per_axis("displacement", "m", dimension);
    case GaugeQuantity::pore_pressure:
      return {"pore pressure [Pa]"};
    case GaugeQuantity::effective_stress:
      return {"effective stress xx [Pa]", "effective stress yy [Pa]", "effective stress zz [Pa]",
              "effective stress zx [Pa]"};
    case GaugeQuantity::point_porosity:
      return {"porosity [1]"};
    case GaugeQuantity::solid_force:
    case GaugeQuantity::solid_collision:
      return per_axis("force", dimension == 2 ? "N/m" : "N", dimension);
    case GaugeQuantity::solid_moment:
      return about_each("moment", dimension == 2 ? "N m/m" : "N m", dimension);
    case GaugeQuantity::solid_displacement:
      return per_axis("displacement", "m", dimension);
    case GaugeQuantity::solid_rotation:
      return about_each("rotation", "rad", dimension);
    case GaugeQuantity::solid_velocity:
      return per_axis("velocity", "m/s", dimension);
    case GaugeQuantity::discharge:
      return {"discharge [" + volume + "/s]"};
  }
  return {};
}

template <int D>
std::vector<double> read_gauge(World<D>& world, const GaugeOptions& gauge) {
  const Vec<D> place = place_of<D>(gauge);
  switch (gauge.quantity) {
    case GaugeQuantity::water_level:
      return read_levels(world, gauge);
    case GaugeQuantity::pressure:
      return {world.flow()->pressure_at(place)};
    case GaugeQuantity::velocity: {
      const Vec<D> velocity = world.flow()->velocity_at(place);
      return {velocity.component.begin(), velocity.component.end()};
    }
    case GaugeQuantity::front:
      return {world.flow()->front()};
    case GaugeQuantity::total_water:
      return {world.flow()->ledger().present};
    case GaugeQuantity::kinetic_energy:
      return {kinetic_energy(world)};
    case GaugeQuantity::momentum: {
      const Vec<D> sum = momentum(world);
      return {sum.component.begin(), sum.component.end()};
    }
    case GaugeQuantity::max_speed:
      return {world.flow()->max_speed().speed};
    case GaugeQuantity::section_flux:
      return {world.meters().of(gauge.name).discharge};
    case GaugeQuantity::overtopping: {
      const FlowMeter& meter = world.meters().of(gauge.name);
      return {meter.volume, meter.discharge};
    }
    case GaugeQuantity::run_up:
      return {read_run_up(world, gauge)};
    case GaugeQuantity::energy:
      return read_energy(world);
    case GaugeQuantity::solid_force:
    case GaugeQuantity::solid_moment:
    case GaugeQuantity::solid_displacement:
    case GaugeQuantity::solid_rotation:
    case GaugeQuantity::solid_velocity:
    case GaugeQuantity::solid_collision:
      return read_solid(world, gauge);
    case GaugeQuantity::discharge:
      return {world.unified() ? world.flow()->ground_discharge(gauge.of)
                              : world.soil()->discharge(gauge.of)};
    default:
      return read_soil(world, gauge);
  }
}

template <int D>
std::vector<SolidSummary> describe_solids(World<D>& world) {
  std::vector<SolidSummary> all;
  const std::string force = D == 2 ? "N/m" : "N", moment = D == 2 ? "N m/m" : "N m";
  if (FlowSolver<D>* flow = world.flow(); flow && !world.soil()) {
    for (std::size_t b = 0; b < flow->solids().size(); ++b) {
      const RigidPose& pose = flow->solids().pose(b);
      const SolidLoad load = flow->solid_load(b, {});
      all.push_back({flow->solids().options(b).name,
                     {{"centre [m]", along_axes<D>(pose.centre())},
                      {"velocity [m/s]", along_axes<D>(flow->solids().velocity(b).velocity)},
                      {"force [" + force + "]", along_axes<D>(load.force)},
                      {"moment [" + moment + "]", about_axes<D>(load.moment)}}});
    }
  }
  if (!world.soil()) return all;
  for (const Solid& solid : world.soil()->solids()) {
    const SolidLoad load = load_on(world, solid);
    all.push_back({solid.options().name,
                   {{"centre [m]", along_axes<D>(solid.centre())},
                    {"displacement [m]", along_axes<D>(solid.displacement())},
                    {"rotation [rad]", about_axes<D>(solid.rotation())},
                    {"velocity [m/s]", along_axes<D>(solid.velocity())},
                    {"angular velocity [rad/s]", about_axes<D>(solid.spin())},
                    {"force [" + force + "]", along_axes<D>(load.force)},
                    {"moment [" + moment + "]", about_axes<D>(load.moment)}}});
  }
  return all;
}

template std::vector<SolidSummary> describe_solids(World<2>&);
template std::vector<SolidSummary> describe_solids(World<3>&);
template std::vector<double> read_gauge(World<2>&, const GaugeOptions&);
template std::vector<double> read_gauge(World<3>&, const GaugeOptions&);

}  // namespace mudlark

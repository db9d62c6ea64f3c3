#include "run/gauges.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"
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
  if (values.empty())
    throw InputError(fmt::format(
        "gauge {}: no soil at ({:g}, {:g}, {:g}) m at the start. Put `at` inside a soil body "
        "or on its surface.",
        gauge.name, gauge.at[0], gauge.at[1], gauge.at[2]));
  if (gauge.quantity == GaugeQuantity::settlement) return {-values[D - 1]};
  return values;
}

template <int D>
double kinetic_energy(World<D>& world) {
  double energy = world.flow() ? world.flow()->kinetic_energy() : 0.0;
  if (world.soil()) energy += world.soil()->totals().kinetic_energy;
  return energy;
}

}  // namespace

std::vector<std::string> gauge_columns(const GaugeOptions& gauge, int dimension) {
  const std::string volume = dimension == 2 ? "m2" : "m3", energy = dimension == 2 ? "J/m" : "J";
  switch (gauge.quantity) {
    case GaugeQuantity::water_level:
      return {"water level [m]"};
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
    case GaugeQuantity::max_speed:
      return {"largest speed [m/s]"};
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
      return {world.flow()->surface_height(place)};
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
    case GaugeQuantity::max_speed:
      return {world.flow()->max_speed().speed};
    case GaugeQuantity::discharge:
      return {world.soil()->discharge(gauge.boundary)};
    default:
      return read_soil(world, gauge);
  }
}

template std::vector<double> read_gauge(World<2>&, const GaugeOptions&);
template std::vector<double> read_gauge(World<3>&, const GaugeOptions&);

}  // namespace mudlark

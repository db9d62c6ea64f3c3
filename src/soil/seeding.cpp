#include "soil/seeding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "materials/registry.hpp"
#include "soil/splitting.hpp"

namespace mudlark {
namespace {

/// Points per cell and axis.
template <int D>
int points_per_axis(const SoilBody& body) {
  const int m = static_cast<int>(std::lround(std::pow(body.points_per_cell, 1.0 / D)));
  if (static_cast<int>(std::lround(std::pow(m, D))) != body.points_per_cell)
    throw InputError(fmt::format(
        "soil {}: points_per_cell = {} is not a {} number (for example {} or {})", body.name,
        body.points_per_cell, D == 2 ? "square" : "cubic", D == 2 ? 4 : 8, D == 2 ? 9 : 27));
  return m;
}

/// Position of a point of the lattice that fills a cell with m points per axis.
template <int D>
Vec<D> lattice_point(const Grid<D>& grid, const Index<D>& cell, const Index<D>& sub, int m) {
  Vec<D> x;
  for (int a = 0; a < D; ++a)
    x[a] = grid.lower()[a] + (cell[a] + (sub[a] + 0.5) / m) * grid.spacing()[a];
  return x;
}

template <int D>
Index<D> cube(int m) {
  Index<D> corner;
  for (int a = 0; a < D; ++a) corner[a] = m;
  return corner;
}

/// The body of a stage whose shape holds a place, or -1.
int body_at(const SoilOptions& options, std::size_t stage, const Point3& place) {
  for (std::size_t b = 0; b < options.bodies.size(); ++b)
    if (options.bodies[b].stage == stage && options.bodies[b].shape.contains(place))
      return static_cast<int>(b);
  return -1;
}

bool is_wet(const SoilOptions& options, const SoilBody& body, const Point3& place) {
  const auto floods = [&](const Shape& water) { return water.contains(place); };
  return body.pore_water == PoreWater::two_phase ||
         (body.pore_water == PoreWater::unified &&
          std::any_of(options.flooded.begin(), options.flooded.end(), floods));
}

/// Weight that grains, with what water hangs between them, give to those below, per volume [N/m^D].
double submerged_unit_weight(const SoilOptions& options, const SoilBody& body, bool wet,
                             double gravity) {
  const double buoyancy = wet ? options.water_density : 0.0;
  const double hanging = wet ? 0.0 : body.porosity * body.filling.at_start * options.water_density;
  return ((1.0 - body.porosity) * (body.grain_density - buoyancy) + hanging) * gravity;
}

struct Overburden {
  double effective = 0.0;  ///< [Pa]
  double water = 0.0;      ///< [Pa]
};

/// Sums the column of soil above a place in steps of the lattice, half a step of its own included.
/// Water that hangs in the pores pulls at the grains where its surface is.
template <int D>
Overburden overburden(const Grid<D>& grid, const SoilOptions& options, std::size_t stage,
                      const Vec<D>& place, double step) {
  const double gravity = -grid.gravity()[D - 1];
  Overburden sum;
  Vec<D> x = place;
  double held = 0.0;  // suction of soil that is wet, of the sample below
  for (double share = 0.5; x[D - 1] < grid.upper()[D - 1]; share = 1.0, x[D - 1] += step) {
    const int number = body_at(options, stage, to_point3(x));
    if (number < 0) {
      held = 0.0;  // a surface in the open is no meniscus
      continue;
    }
    const SoilBody& body = options.bodies[static_cast<std::size_t>(number)];
    const bool wet = is_wet(options, body, to_point3(x));
    sum.effective += share * step * submerged_unit_weight(options, body, wet, gravity);
    if (!wet) sum.effective += held;
    held = wet ? body.filling.suction : 0.0;
    if (body.pore_water == PoreWater::two_phase)
      sum.water += share * step * options.water_density * gravity;
  }
  return sum;
}

double lateral_coefficient(const SoilBody& body, const GeostaticStress& geostatic) {
  if (geostatic.lateral_coefficient >= 0.0) return geostatic.lateral_coefficient;
  return make_soil_model(body.law)->earth_pressure_at_rest();
}

}  // namespace

template <int D>
SoilParticles<D> seed_points(const Grid<D>& grid, const SoilBody& body, std::size_t body_number,
                             Transfer transfer, bool with_extent,
                             std::span<const SolidOptions> solids) {
  SoilParticles<D> points;
  points.carries_contact = !solids.empty();
  points.carries_affine = transfer == Transfer::apic;
  points.carries_deformation = body.strain == StrainMeasure::small;
  points.carries_extent = with_extent;
  points.set_history(make_soil_model(body.law)->history_names());
  const int m = points_per_axis<D>(body);
  const double volume = grid.cell_volume() / body.points_per_cell;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    std::int64_t number = 0;
    for (int a = D - 1; a >= 0; --a) number = number * grid.cells()[a] + cell[a];
    number = (number * body.points_per_cell) * 64 + static_cast<std::int64_t>(body_number);
    for_each(IndexBox<D>{Index<D>{}, cube<D>(m)}, [&](const Index<D>& sub) {
      const Vec<D> x = lattice_point(grid, cell, sub, m);
      const std::int64_t id = number;
      number += 64;
      const Point3 place = to_point3(x);
      const auto holds = [&](const SolidOptions& solid) { return solid.shape.contains(place); };
      if (!body.shape.contains(place) || std::any_of(solids.begin(), solids.end(), holds)) return;
      const std::size_t p = points.size();
      points.resize(p + 1);
      points.id[p] = id;
      for (int a = 0; a < D; ++a) {
        points.position[a][p] = points.start[a][p] = x[a];
        const int component = D == 2 && a == 1 ? 2 : a;
        points.velocity[a][p] = points.water_velocity[a][p] =
            body.initial_velocity[static_cast<std::size_t>(component)](to_point3(x), 0.0);
      }
      points.volume[p] = points.start_volume[p] = volume;
      if (with_extent) set_extent(grid, m, p, points);
      points.grain_mass[p] = (1.0 - body.porosity) * body.grain_density * volume;
    });
  });
  return points;
}

template <int D>
void set_initial_stress(const Grid<D>& grid, const SoilOptions& options, std::size_t stage,
                        std::vector<SoilParticles<D>>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const SoilBody& body = options.bodies[b];
    if (body.stage != stage) continue;
    const double step = grid.spacing()[D - 1] / points_per_axis<D>(body);
    const auto* geostatic = std::get_if<GeostaticStress>(&body.initial_stress);
    const double k0 = geostatic ? lateral_coefficient(body, *geostatic) : 0.0;
    for (std::size_t p = 0; p < bodies[b].size(); ++p) {
      SymTensor stress;
      double pore_pressure = 0.0;
      if (const auto* tensor = std::get_if<SymTensor>(&body.initial_stress)) {
        stress = *tensor;
      } else if (const auto* field = std::get_if<StressField>(&body.initial_stress)) {
        const Point3 place = to_point3(bodies[b].position_of(p));
        const auto& part = field->component;
        stress = {part[0](place, 0.0), part[1](place, 0.0), part[2](place, 0.0),
                  part[3](place, 0.0), part[4](place, 0.0), part[5](place, 0.0)};
      } else {
        const Overburden above = overburden(grid, options, stage, bodies[b].position_of(p), step);
        stress.zz = -above.effective;
        stress.xx = stress.yy = -k0 * above.effective;
        if (body.pore_water == PoreWater::two_phase) pore_pressure = above.water;
      }
      if (body.initial_pore_pressure)
        pore_pressure += (*body.initial_pore_pressure)(to_point3(bodies[b].position_of(p)), 0.0);
      set_tensor(bodies[b].stress, p, stress);
      bodies[b].pore_pressure[p] = pore_pressure;
    }
  }
}

template SoilParticles<2> seed_points(const Grid<2>&, const SoilBody&, std::size_t, Transfer, bool,
                                      std::span<const SolidOptions>);
template SoilParticles<3> seed_points(const Grid<3>&, const SoilBody&, std::size_t, Transfer, bool,
                                      std::span<const SolidOptions>);
template void set_initial_stress(const Grid<2>&, const SoilOptions&, std::size_t,
                                 std::vector<SoilParticles<2>>&);
template void set_initial_stress(const Grid<3>&, const SoilOptions&, std::size_t,
                                 std::vector<SoilParticles<3>>&);

}  // namespace mudlark

#include "flow/wave_zone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

double ramp_share(double ramp, double time) {
  return time < ramp ? 0.5 * (1.0 - std::cos(std::numbers::pi * time / ramp)) : 1.0;
}

}  // namespace

template <int D>
WaveZones<D>::WaveZones(const Grid<D>& grid, const std::vector<WaveZoneOptions>& options)
    : grid_(&grid) {
  const double gravity = std::max(-grid.gravity()[D - 1], 1e-300);
  for (const WaveZoneOptions& zone : options)
    zones_.push_back(
        {zone, make_wave(zone.wave, zone.depth, gravity), 0.02 * std::sqrt(zone.depth / gravity)});
}

/// 1 - chi^(dt / tau): how much of the target is taken at a position; 0 outside the zone.
template <int D>
double WaveZones<D>::share(const Zone& zone, double position, double dt) const {
  const double s = (position - zone.options.inner) / (zone.options.outer - zone.options.inner);
  if (s <= 0.0) return 0.0;
  const double free =
      1.0 - (std::exp(std::pow(std::min(s, 1.0), 3.5)) - 1.0) / (std::numbers::e - 1.0);
  return 1.0 - std::pow(std::max(free, 0.0), dt / zone.relaxation_time);
}

/// Distance along the wave's way from the outer end [m].
template <int D>
double WaveZones<D>::way(const Zone& zone, double position) const {
  return (position - zone.options.outer) * (zone.options.inner > zone.options.outer ? 1.0 : -1.0);
}

template <int D>
double WaveZones<D>::level(const Zone& zone, double position, double time) const {
  return zone.options.still_level +
         ramp_share(zone.options.ramp, time) * zone.motion.elevation(way(zone, position), time);
}

template <int D>
double WaveZones<D>::blend_water(const CellField<D>& porosity, double time, double dt,
                                 CellField<D>& water) const {
  const Grid<D>& grid = *grid_;
  double added = 0.0;
  for (const Zone& zone : zones_)
    for_each(grid.owned(), [&](const Index<D>& cell) {
      const Vec<D> centre = grid.cell_centre(cell);
      const double position = centre[zone.options.axis];
      const double taken = share(zone, position, dt);
      if (taken == 0.0) return;
      const double h = grid.width(D - 1, cell[D - 1]);
      const double below = level(zone, position, time) - (centre[D - 1] - 0.5 * h);
      const double target = porosity[cell] * std::clamp(below / h, 0.0, 1.0);
      const double change = taken * (target - water[cell]);
      water[cell] += change;
      added += change;
    });
  return added * grid.cell_volume();
}

template <int D>
void WaveZones<D>::blend_velocity(const CellField<D>& water, double time, double dt,
                                  FaceVector<D>& velocity) const {
  const Grid<D>& grid = *grid_;
  for (const Zone& zone : zones_)
    for (int component = 0; component < D; ++component)
      for_each(bounding_faces(grid, component), [&](const Index<D>& face) {
        const Vec<D> place = grid.face_centre(component, face);
        const double position = place[zone.options.axis];
        const double taken = share(zone, position, dt);
        if (taken == 0.0) return;
        const double surface = level(zone, position, time);
        const bool wet = water[face] > 0.0 || water[face.shifted(component, -1)] > 0.0;
        const int up = face[D - 1];
        const double h = component == D - 1 ? grid.gap(D - 1, up) : grid.width(D - 1, up);
        if (!wet && place[D - 1] - 0.5 * h > surface) return;
        double target = 0.0;
        if (component == zone.options.axis || component == D - 1) {
          const double z = std::min(place[D - 1], surface) - zone.options.still_level;
          const auto motion = zone.motion.velocity(way(zone, position), z, time);
          const double sign = zone.options.inner > zone.options.outer ? 1.0 : -1.0;
          target = ramp_share(zone.options.ramp, time) *
                   (component == D - 1 ? motion[1] : sign * motion[0]);
        }
        double& v = velocity[component][face];
        v += taken * (target - v);
      });
}

template class WaveZones<2>;
template class WaveZones<3>;

}  // namespace mudlark

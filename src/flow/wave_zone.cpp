#include "flow/wave_zone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

double inward(const WaveZoneOptions& zone) { return zone.inner > zone.outer ? 1.0 : -1.0; }

/// The lowest layer of a box: one index per column.
template <int D>
IndexBox<D> columns_of(IndexBox<D> box) {
  box.upper[D - 1] = std::min(box.upper[D - 1], box.lower[D - 1] + 1);
  return box;
}

}  // namespace

double ramp_share(double ramp, double time) {
  return time < ramp ? 0.5 * (1.0 - std::cos(std::numbers::pi * time / ramp)) : 1.0;
}

std::unique_ptr<const WaveMotion> make_wave(const WaveZoneOptions& zone, double gravity) {
  return make_wave(zone.wave, {zone.depth, gravity, zone.direction, zone.current * inward(zone)});
}

template <int D>
WaveZones<D>::WaveZones(const Grid<D>& grid, const std::vector<WaveZoneOptions>& options)
    : grid_(&grid) {
  const double gravity = std::max(-grid.gravity()[D - 1], 1e-300);
  for (const WaveZoneOptions& zone : options)
    zones_.push_back({zone, make_wave(zone, gravity), 0.02 * std::sqrt(zone.depth / gravity)});
  const auto longest = static_cast<std::size_t>(grid.cells()[D - 1] + 1);
  heights_.resize(longest);
  motions_.resize(longest);
}

/// 1 - chi^(dt / tau), or 1 - exp(-D dt): how much of the target is taken at a position; 0 outside
/// the zone.
template <int D>
double WaveZones<D>::share(const Zone& zone, double position, double dt) const {
  const double s = (position - zone.options.inner) / (zone.options.outer - zone.options.inner);
  if (s <= 0.0) return 0.0;
  if (zone.options.action == ZoneAction::velocity)
    return 1.0 - std::exp(-zone.options.damping * std::min(s * s, 1.0) * dt);
  const double free =
      1.0 - (std::exp(std::pow(std::min(s, 1.0), 3.5)) - 1.0) / (std::numbers::e - 1.0);
  return 1.0 - std::pow(std::max(free, 0.0), dt / zone.relaxation_time);
}

template <int D>
WavePlace WaveZones<D>::place_in(const Zone& zone, const Vec<D>& position) const {
  const int axis = zone.options.axis;
  return {(position[axis] - zone.options.outer) * inward(zone.options),
          D == 3 ? position[1 - axis] : 0.0};
}

template <int D>
double WaveZones<D>::level(const Zone& zone, const WavePlace& place, double time) const {
  return zone.options.still_level +
         ramp_share(zone.options.ramp, time) * zone.motion->elevation(place, time);
}

template <int D>
double WaveZones<D>::blend_water(const CellField<D>& porosity, double time, double dt,
                                 CellField<D>& water) const {
  const Grid<D>& grid = *grid_;
  const IndexBox<D>& owned = grid.owned();
  double added = 0.0;
  for (const Zone& zone : zones_) {
    if (zone.options.action == ZoneAction::velocity) continue;
    for_each(columns_of(owned), [&](const Index<D>& lowest) {
      const Vec<D> foot = grid.cell_centre(lowest);
      const double taken = share(zone, foot[zone.options.axis], dt);
      if (taken == 0.0) return;
      const double surface = level(zone, place_in(zone, foot), time);
      for (Index<D> cell = lowest; cell[D - 1] < owned.upper[D - 1]; ++cell[D - 1]) {
        const double h = grid.width(D - 1, cell[D - 1]);
        const double below = surface - grid.face_position(D - 1, cell[D - 1]);
        const double target = porosity[cell] * std::clamp(below / h, 0.0, 1.0);
        const double change = taken * (target - water[cell]);
        water[cell] += change;
        added += change;
      }
    });
  }
  return added * grid.cell_volume();
}

/// One component of the velocity in a column of `count` faces.
template <int D>
void WaveZones<D>::blend_column(const Zone& zone, int component, const Index<D>& lowest, int count,
                                const CellField<D>& water, double time, double taken,
                                FaceField<D>& velocity) {
  const Grid<D>& grid = *grid_;
  const WaveZoneOptions& options = zone.options;
  const Vec<D> foot = grid.face_centre(component, lowest);
  const double ramp = ramp_share(options.ramp, time);
  const WavePlace place = place_in(zone, foot);
  const double surface = ramp * zone.motion->elevation(place, time);
  const auto wanted = static_cast<std::size_t>(count);
  Index<D> face = lowest;
  for (std::size_t n = 0; n < wanted; ++n, ++face[D - 1])
    heights_[n] = std::min(grid.face_centre(component, face)[D - 1] - options.still_level, surface);
  zone.motion->velocities(place, time, {heights_.data(), wanted}, {motions_.data(), wanted});
  const bool along = component == options.axis, up = component == D - 1;
  const double sign = along ? inward(options) : 1.0;
  const std::size_t entry = up ? 2 : along ? 0 : 1;
  const double current = along ? options.current : 0.0;
  face = lowest;
  for (std::size_t n = 0; n < wanted; ++n, ++face[D - 1]) {
    const bool wet = water[face] > 0.0 || water[face.shifted(component, -1)] > 0.0;
    const double foot_of_face = up ? grid.cell_centre(face.shifted(D - 1, -1))[D - 1]
                                   : grid.face_position(D - 1, face[D - 1]);
    if (!wet && foot_of_face > options.still_level + surface) continue;
    double& v = velocity[face];
    v += taken * (current + ramp * sign * motions_[n][entry] - v);
  }
}

template <int D>
void WaveZones<D>::blend_velocity(const CellField<D>& water, double time, double dt,
                                  FaceVector<D>& velocity) {
  const Grid<D>& grid = *grid_;
  for (const Zone& zone : zones_)
    for (int component = 0; component < D; ++component) {
      const IndexBox<D> faces = bounding_faces(grid, component);
      const int count = faces.upper[D - 1] - faces.lower[D - 1];
      for_each(columns_of(faces), [&](const Index<D>& lowest) {
        const double position = grid.face_centre(component, lowest)[zone.options.axis];
        const double taken = share(zone, position, dt);
        if (taken > 0.0)
          blend_column(zone, component, lowest, count, water, time, taken, velocity[component]);
      });
    }
}

template class WaveZones<2>;
template class WaveZones<3>;

}  // namespace mudlark

#include "flow/moving_grains.hpp"

#include "flow/flow_checks.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

struct Pair {
  double grains = 0.0, water = 0.0;
};

/// The momentum balance of one face; masses per volume, `drag` = dt b [kg/m3].
struct FaceSystem {
  double grain_mass, water_mass, drag;

  Pair solve(double grains, double water) const {
    if (water_mass + drag <= 0.0) return {grains / grain_mass, 0.0};
    const double determinant = grain_mass * water_mass + drag * (grain_mass + water_mass);
    return {(grains * (water_mass + drag) + drag * water) / determinant,
            (water * (grain_mass + drag) + drag * grains) / determinant};
  }
};

}  // namespace

template <int D>
GrainsInWater<D>::GrainsInWater(const Grid<D>& grid)
    : grid_(&grid),
      flux_(grid, "flux of the mixture", "m/s"),
      flux_mobility_(grid, "mobility of the mixture", "m2 s/kg"),
      grain_mobility_(grid, "mobility of the grains", "m2 s/kg"),
      whole_(grid, "whole", "1", 1.0) {}

template <int D>
void GrainsInWater<D>::couple(const FaceVector<D>& capacity, const CellField<D>& water,
                              const CellField<D>& porosity, const CellField<D>& unknown, double dt,
                              FaceVector<D>& velocity, FaceVector<D>& mobility,
                              MovingGrains<D>& grains) {
  const Grid<D>& grid = *grid_;
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    const double *w = water.data(), *room = porosity.data(), *governed = unknown.data();
    const double* theta = capacity[axis].data();
    double *v = velocity[axis].data(), *m = mobility[axis].data();
    double *grain_v = grains.velocity[axis].data(), *flux = flux_[axis].data();
    double *flux_m = flux_mobility_[axis].data(), *grain_m = grain_mobility_[axis].data();
    for_each_offset(grid, bounding_faces(grid, axis), [&](std::ptrdiff_t at) {
      const double inertia = grains.inertia[axis].data()[at], share = grains.share[axis].data()[at];
      if (inertia > 0.0) {
        // Where no pressure acts, water is what the cells hold: it pulls at grains by the square of
        // its share of the pores, and nothing pulls at them in air.
        const bool wet = governed[at] + governed[at - s] > 0.0, open = theta[at] > 0.0;
        const double filled = wet || !open ? 1.0 : (w[at] + w[at - s]) / (room[at] + room[at - s]);
        const double resistance = grains.resistance[axis].data()[at];
        const FaceSystem face{inertia, open ? filled * theta[at] * dt / m[at] : 0.0,
                              dt * filled * filled * theta[at] * theta[at] * resistance};
        const Pair now = face.solve(inertia * grain_v[at] + dt * grains.force[axis].data()[at],
                                    face.water_mass * v[at]);
        const Pair answer = face.solve(dt * share, dt * theta[at]);
        grain_v[at] = now.grains;
        grain_m[at] = answer.grains;
        if (open) v[at] = now.water, m[at] = answer.water;
      } else {
        grain_v[at] = grain_m[at] = 0.0;
      }
      flux[at] = theta[at] * v[at] + share * grain_v[at];
      flux_m[at] = theta[at] * m[at] + share * grain_m[at];
    });
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(axis, side) || grid.wall(axis, side) == Wall::open) continue;
      zero_wall(grid, axis, side, grains.velocity[axis]);
      zero_wall(grid, axis, side, flux_[axis]);
    }
  }
}

template class GrainsInWater<2>;
template class GrainsInWater<3>;

}  // namespace mudlark

#include "flow/moving_grains.hpp"

#include <algorithm>
#include <cmath>

#include "flow/flow_checks.hpp"
#include "flow/grains_at_surface.hpp"
#include "flow/partly_filled.hpp"
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

/// Less than this share of the pores goes as this share would, tied to the grains: what next to
/// nothing would do by itself is round-off, and what nothing does would not be defined.
constexpr double trace = 1e-6;

/// Shares of a face with which water has mass and drags at grains [-].
struct WaterOfFace {
  double mass, drag;
};

/// On the face of the surface, `level` cells beyond the last pressure. Where ground ends only water
/// under the surface drags at grains, of which `part` lies there, no denser than `solid` as in the
/// ground around; in ground that goes on (part = level) all of the face counts.
WaterOfFace water_under_surface(double theta, double share, double solid, double part,
                                double level) {
  const double ends = std::clamp(2.0 * (part / level - 1.0), 0.0, 1.0);
  const double grains = std::min(share * part / level, solid);
  const double water = level * std::max(theta + share - grains, 0.05 * theta);
  return {theta + ends * (water - theta), theta + ends * (water * grains / share - theta)};
}

/// What of a face moves with its grains, per volume: inertia [kg/m3], momentum before the step, and
/// the force on it.
struct GrainsOfFace {
  double inertia, momentum, force;

  void add(double part, double mass, double velocity, double push) {
    inertia += part * mass, momentum += part * mass * velocity, force += part * push;
  }
};

/// Faces of one axis that the surface may pass.
struct SurfaceFaces {
  const double *governed, *reach, *shares;
  std::ptrdiff_t stride;

  bool passes(std::ptrdiff_t at) const {
    return (governed[at] > 0.0) != (governed[at - stride] > 0.0);
  }
  WaterOfFace water(std::ptrdiff_t at, double theta, double part) const {
    if (!passes(at) || !(theta > 0.0) || !(shares[at] > 0.0)) return {theta, theta};
    const std::ptrdiff_t in = governed[at] > 0.0 ? stride : -stride;
    const double solid = std::max({shares[at], shares[at + in], shares[at + 2 * in]});
    return water_under_surface(theta, shares[at], solid, part, std::min(reach[at], 1.0));
  }
};

template <int D>
void hold_at_walls(const Grid<D>& grid, int axis, FaceVector<D>& grains, FaceVector<D>& water) {
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(axis, side) || grid.wall(axis, side) == Wall::open) continue;
    zero_wall(grid, axis, side, grains[axis]);
    zero_wall(grid, axis, side, water[axis]);
  }
}

}  // namespace

template <int D>
GrainsInWater<D>::GrainsInWater(const Grid<D>& grid)
    : grid_(&grid),
      flux_(grid, "flux of the mixture", "m/s"),
      flux_mobility_(grid, "mobility of the mixture", "m2 s/kg"),
      grain_mobility_(grid, "mobility of the grains", "m2 s/kg"),
      water_share_(grid, "water share", "1"),
      scratch_(grid, "force of menisci, then rims", "N/m3 or 1"),
      whole_(grid, "whole", "1", 1.0) {}

template <int D>
void GrainsInWater<D>::couple(const FaceVector<D>& capacity, const CellField<D>& water,
                              const CellField<D>& porosity, const CellField<D>& unknown,
                              const FaceVector<D>& reach, const ResidualWater<D>* residual,
                              double dt, FaceVector<D>& velocity, FaceVector<D>& mobility,
                              MovingGrains<D>& grains) {
  const Grid<D>& grid = *grid_;
  const double slow = undirected_speed(norm(grid.gravity()), dt);
  // Kept where each face puts the mobility of its grains once it has used it.
  find_part_under_water(grid, unknown, reach, grains.share, grain_mobility_);
  find_rims(grid, unknown, grains.share, grain_mobility_, scratch_);
  find_shares(capacity, mobility, grains);
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    const double *w = water.data(), *room = porosity.data(), *governed = unknown.data();
    const double *theta = capacity[axis].data(), *rest = water_share_[axis].data();
    double *v = velocity[axis].data(), *m = mobility[axis].data();
    double* grain_v = grains.velocity[axis].data();
    double *flux_m = flux_mobility_[axis].data(), *grain_m = grain_mobility_[axis].data();
    const double *rim = scratch_[axis].data(), *before = flux_[axis].data();
    flux_[axis].copy_values_from(grains.velocity[axis]);
    const double *inertia = grains.inertia[axis].data(), *force = grains.force[axis].data();
    const SurfaceFaces surface{governed, reach[axis].data(), grains.share[axis].data(), s};
    const double* free_share = residual ? residual->free_share()[axis].data() : nullptr;
    const double* held = residual ? residual->mass()[axis].data() : nullptr;
    const double* held_weight = residual ? residual->weight()[axis].data() : nullptr;
    for_each_offset(grid, bounding_faces(grid, axis), [&](std::ptrdiff_t at) {
      const double share = grains.share[axis].data()[at];
      const bool open = theta[at] > 0.0;
      if (inertia[at] > 0.0) {
        // Where no pressure acts, water is what the cell that it comes from holds, and k_r of the
        // permeability is left to it: S^2 theta^2 A / k_r pulls at the grains (NUMERICS C2).
        const bool wet = governed[at] + governed[at - s] > 0.0;
        const bool known = wet || !open || room[at] == 0.0 || room[at - s] == 0.0;
        const double filled = known ? 1.0
                                    : filled_upstream(w[at - s] / room[at - s], w[at] / room[at],
                                                      (v[at] - grain_v[at]) / slow);
        const double resistance = grains.resistance[axis].data()[at];
        const double loose = residual && !known ? free_share[at] : 1.0;
        GrainsOfFace moved{inertia[at], inertia[at] * grain_v[at], force[at]};
        const std::ptrdiff_t other = rim[at] > 0.0 ? at + s : at - s;
        if (rim[at] != 0.0)  // the rim moves with this face
          moved.add(std::abs(rim[at]), inertia[other], before[other], force[other]);
        if (residual && open) moved.add(1.0, held[at], grain_v[at], held_weight[at]);
        const WaterOfFace here = surface.water(at, theta[at], grain_m[at]);
        const auto system = [&](double part) {
          const double pull = known ? 1.0 : drag_of_part(grains.filling, part);
          return FaceSystem{moved.inertia, open ? loose * part * here.mass * dt / m[at] : 0.0,
                            loose * dt * pull * theta[at] * here.drag * resistance};
        };
        const FaceSystem face = system(filled);
        const double momentum = moved.momentum + dt * moved.force;
        Pair now = face.solve(momentum, face.water_mass * v[at]);
        if (filled < trace) {
          const FaceSystem some = system(trace);
          now.water = some.solve(momentum, some.water_mass * v[at]).water;
        }
        const Pair answer =
            face.solve(dt * share * grain_m[at], dt * (rest[at] + here.mass - theta[at]));
        grain_v[at] = now.grains;
        grain_m[at] = answer.grains;
        if (open) v[at] = now.water, m[at] = answer.water;
      } else {
        grain_v[at] = grain_m[at] = 0.0;
      }
      flux_m[at] = rest[at] * m[at] + share * grain_m[at];
    });
    hold_at_walls(grid, axis, grains.velocity, velocity);
  }
}

/// With `fill_faces` the two answer to all of the pressure on a face: grains to what the water of
/// its cells leaves, but to no more than twice what the points have there, or a few grains would
/// have the weight of many; water to the rest.
template <int D>
void GrainsInWater<D>::find_shares(const FaceVector<D>& capacity, FaceVector<D>& mobility,
                                   MovingGrains<D>& grains) {
  constexpr double most = 2.0;
  for (int axis = 0; axis < D; ++axis) {
    water_share_[axis].copy_values_from(capacity[axis]);
    if (!grains.fill_faces) continue;
    const double *theta = capacity[axis].data(), *inertia = grains.inertia[axis].data();
    const double* room = grains.room[axis].data();
    double *share = grains.share[axis].data(), *rest = water_share_[axis].data();
    double* m = mobility[axis].data();
    for_each_offset(*grid_, bounding_faces(*grid_, axis), [&](std::ptrdiff_t at) {
      if (theta[at] == 0.0) return;
      share[at] = std::clamp(room[at] - theta[at], 0.0, most * share[at]);
      rest[at] = room[at] - share[at];
      if (inertia[at] == 0.0) m[at] *= rest[at] / theta[at];
    });
  }
}

template <int D>
void GrainsInWater<D>::find_flux(const FaceVector<D>& velocity, const MovingGrains<D>& grains) {
  for (int axis = 0; axis < D; ++axis) {
    const double *rest = water_share_[axis].data(), *v = velocity[axis].data();
    const double *share = grains.share[axis].data(), *grain_v = grains.velocity[axis].data();
    double* flux = flux_[axis].data();
    for_each_offset(*grid_, bounding_faces(*grid_, axis), [&](std::ptrdiff_t at) {
      flux[at] = rest[at] * v[at] + share[at] * grain_v[at];
    });
  }
}

template class GrainsInWater<2>;
template class GrainsInWater<3>;

}  // namespace mudlark

#include "numerics/momentum_transport.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Below this share of water a donor gives at first order, and a face takes the mixture of what it
/// held and what came in: such spray has mass in one sweep and none in the next.
constexpr double thin = 0.01;
/// Less mass than this is round-off: it changes nothing on its face.
constexpr double dust = 1e-8;

/// What a face exchanged with its neighbours, relative to its own velocity and per volume.
struct Exchange {
  double change = 0.0;   ///< momentum lost relative to the face's own velocity [m/s]
  double gained = 0.0;   ///< of it, what came in [m/s]
  double came_in = 0.0;  ///< mass that came in [-]

  /// `solid` = 1: the quotient of momentum and mass. 0: the mixture of what the face held
  /// (`before`) and what came in, as if the mass that left had been mixed too: the same quotient
  /// where nothing left, else one that stays within its neighbours' range. The two blend: a switch,
  /// or a range that counts a donor as soon as anything comes from it, would turn round-off of the
  /// water (1e-24 in place of 0) into another velocity.
  double new_velocity(double velocity, double before, double left, double solid) const {
    const double mixture = velocity + gained / std::max(before + came_in, dust);
    return solid > 0.0 ? mixture + solid * (velocity - change / left - mixture) : mixture;
  }
};

/// Where only water has mass, a donor or face with next to none of it counts as spray.
struct WaterRule {
  static double slope_share(double mass, double, double room) {
    return mass > thin * room ? 1.0 : 0.0;
  }
  static double solid(const Exchange&, double left, double room) {
    return std::clamp(2.0 * left / (thin * room) - 1.0, 0.0, 1.0);
  }
};

/// Where all has mass: a donor that loses half of it or more (water, and gas remains) gives at
/// first order, or the slope of the heavy fluid would act on the light one; and where more came in
/// than is left, some of it passed through within the step, and the quotient is not a mean of
/// velocities any more.
struct WaterAndGasRule {
  static double slope_share(double mass, double left, double) {
    return std::clamp(2.0 * left / mass - 1.0, 0.0, 1.0);
  }
  static double solid(const Exchange& exchange, double left, double) {
    return exchange.came_in > left ? std::max(2.0 * left / exchange.came_in - 1.0, 0.0) : 1.0;
  }
};

double limited_slope(double behind, double ahead) {
  const double product = behind * ahead;
  return product > 0.0 ? 2.0 * product / (behind + ahead) : 0.0;
}

}  // namespace

template <int D>
IndexBox<D> inner_faces(const Grid<D>& grid, int axis) {
  IndexBox<D> box = grid.owned();
  if (grid.touches(axis, 0)) box.lower[axis] += 1;
  return box;
}

template <int D>
MomentumTransport<D>::MomentumTransport(const Grid<D>& grid, const NearWater<D>& near)
    : grid_(&grid), near_(&near), moved_(grid, "moved velocity", "m/s") {}

template <int D>
template <class Rule>
void MomentumTransport<D>::advance_component(int component, const CellField<D>& old_mass,
                                             const CellField<D>& new_mass,
                                             const CellField<D>& porosity,
                                             const FaceVector<D>& mass_flux,
                                             const FaceVector<D>& velocities) {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t sa = grid.stride(component);
  const auto at_face = [sa](const double* cells, std::ptrdiff_t at) {
    return 0.5 * (cells[at - sa] + cells[at]);
  };
  const double *old = old_mass.data(), *now = new_mass.data(), *theta = porosity.data();
  const double* velocity = velocities[component].data();
  double* moved = moved_[component].data();
  for_each_offset(*near_, inner_faces(grid, component), [&](std::ptrdiff_t at) {
    const double v = velocity[at];
    const double room = at_face(theta, at);
    Exchange exchange;
    bool still = true;
    for (int axis = 0; axis < D; ++axis) {
      const double* flux = mass_flux[axis].data();
      const std::ptrdiff_t s = grid.stride(axis);
      for (int side = 0; side < 2; ++side) {
        const std::ptrdiff_t here =
            at + side * s;  // the side lies between the faces here - s and here
        const double through =
            0.5 * (axis == component ? flux[here - s] + flux[here] : flux[here - sa] + flux[here]);
        if (through == 0.0) continue;
        still = false;
        const std::ptrdiff_t donor = through > 0.0 ? here - s : here, step = through > 0.0 ? s : -s;
        double carried = velocity[donor];
        const double donor_mass = at_face(old, donor);
        const double slope = Rule::slope_share(donor_mass, at_face(now, donor), room);
        if (slope > 0.0) {
          const double share = std::min(std::abs(through) / donor_mass, 1.0);
          carried +=
              slope * 0.5 * (1.0 - share) *
              limited_slope(carried - velocity[donor - step], velocity[donor + step] - carried);
        }
        const double momentum = std::abs(through) * (carried - v);
        exchange.change += donor == at ? momentum : -momentum;
        if (donor != at) exchange.gained += momentum, exchange.came_in += std::abs(through);
      }
    }
    if (still) {
      moved[at] = v;
      return;
    }
    const double left = at_face(now, at);
    moved[at] = exchange.new_velocity(v, at_face(old, at), left, Rule::solid(exchange, left, room));
  });
}

template <int D>
void MomentumTransport<D>::copy_to_open_walls(int component, double* values) const {
  const Grid<D>& grid = *grid_;
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(component, side) || grid.wall(component, side) != Wall::open) continue;
    IndexBox<D> wall = grid.owned();
    wall.lower[component] = side == 0 ? wall.lower[component] : wall.upper[component];
    wall.upper[component] = wall.lower[component] + 1;
    const std::ptrdiff_t inward = (side == 0 ? 1 : -1) * grid.stride(component);
    for_each_offset(grid, wall, [&](std::ptrdiff_t at) { values[at] = values[at + inward]; });
  }
}

template <int D>
void MomentumTransport<D>::advance(Inertia inertia, const CellField<D>& old_mass,
                                   const CellField<D>& new_mass, const CellField<D>& porosity,
                                   const FaceVector<D>& mass_flux, FaceVector<D>& velocity) {
  for (int component = 0; component < D; ++component) {
    if (inertia == Inertia::water)
      advance_component<WaterRule>(component, old_mass, new_mass, porosity, mass_flux, velocity);
    else
      advance_component<WaterAndGasRule>(component, old_mass, new_mass, porosity, mass_flux,
                                         velocity);
  }
  for (int component = 0; component < D; ++component) {
    const double* from = moved_[component].data();
    double* to = velocity[component].data();
    for_each_offset(*near_, inner_faces(*grid_, component),
                    [&](std::ptrdiff_t at) { to[at] = from[at]; });
    copy_to_open_walls(component, to);
  }
}

template IndexBox<2> inner_faces(const Grid<2>&, int);
template IndexBox<3> inner_faces(const Grid<3>&, int);
template class MomentumTransport<2>;
template class MomentumTransport<3>;

}  // namespace mudlark

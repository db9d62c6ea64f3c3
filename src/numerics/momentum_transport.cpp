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

  /// Mass that came in through one side, below zero what left, with a velocity relative to the
  /// face's own [m/s].
  void add(double mass, double velocity) {
    const double momentum = mass * velocity;
    change -= momentum;
    gained += mass > 0.0 ? momentum : 0.0;
    came_in += std::max(mass, 0.0);
  }

  /// `solid` = 1: the quotient of momentum and mass. 0: the mixture of what the face held
  /// (`before`) and what came in, as if the mass that left had been mixed too: the same quotient
  /// where nothing left, else one that stays within its neighbours' range. The two blend: a switch,
  /// or a range that counts a donor as soon as anything comes from it, would turn round-off of the
  /// water (1e-24 in place of 0) into another velocity.
  double new_velocity(double velocity, double before, double left, double solid) const {
    const double mixture = velocity + gained / std::max(before + came_in, dust);
    const double quotient = velocity - change / left;
    return solid > 0.0 ? mixture + solid * (quotient - mixture) : mixture;
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
  const double mean = 2.0 * product / (behind + ahead);
  return product > 0.0 ? mean : 0.0;
}

/// A quantity of the cells beside a face along the axis with this stride.
double at_face(const double* cells, std::ptrdiff_t at, std::ptrdiff_t stride) {
  return 0.5 * (cells[at - stride] + cells[at]);
}

/// What one component of the velocity is carried with; `stride` is that of its axis.
struct Component {
  const double *before, *after, *porosity, *velocity;
  std::ptrdiff_t stride;

  /// Velocity that passes the side between the faces at - s and at: that of the face that gives,
  /// with the limited slope there. Choices in place of branches: a vector of faces at a time.
  template <class Rule>
  double carried(double through, std::ptrdiff_t at, std::ptrdiff_t s) const {
    const auto of_donor = [through](double lower, double upper) {
      return through > 0.0 ? lower : upper;
    };
    const double upper = velocity[at], lower = velocity[at - s], across = upper - lower;
    const double behind = of_donor(lower - velocity[at - 2 * s], upper - velocity[at + s]);
    const double mass = of_donor(at_face(before, at - s, stride), at_face(before, at, stride));
    const double left = of_donor(at_face(after, at - s, stride), at_face(after, at, stride));
    const double room = of_donor(at_face(porosity, at - s, stride), at_face(porosity, at, stride));
    const double slope = Rule::slope_share(mass, left, room);
    const double share = std::min(std::abs(through) / mass, 1.0);
    const double more =
        slope * 0.5 * (1.0 - share) * limited_slope(behind, of_donor(across, -across));
    return of_donor(lower, upper) + (slope > 0.0 ? more : 0.0);
  }
};

}  // namespace

template <int D>
IndexBox<D> inner_faces(const Grid<D>& grid, int axis) {
  IndexBox<D> box = grid.owned();
  if (grid.touches(axis, 0)) box.lower[axis] += 1;
  return box;
}

template <int D>
MomentumTransport<D>::MomentumTransport(const Grid<D>& grid, const CellRuns<D>& near)
    : grid_(&grid), near_(&near), moved_(grid, "moved velocity", "m/s") {}

template <int D>
template <class Rule>
void MomentumTransport<D>::advance_component(int component, const Masses<D>& masses,
                                             const FaceVector<D>& velocities) {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t sa = grid.stride(component);
  const auto flux = masses.flux->data();
  const auto& strides = grid.strides();
  const Component all{masses.before->data(), masses.after->data(), masses.porosity->data(),
                      velocities[component].data(), sa};
  double* moved = moved_[component].data();
  for_each_apart(
      *near_, inner_faces(grid, component),
      [&](std::ptrdiff_t at) {
        const double v = all.velocity[at], left = at_face(all.after, at, sa);
        Exchange exchange;
#pragma GCC unroll 3
        for (std::size_t u = 0; u < D; ++u) {
          const std::ptrdiff_t s = strides[u], next = at + s;
          const double lower = at_face(flux[u], at, sa), upper = at_face(flux[u], next, sa);
          exchange.add(lower, all.carried<Rule>(lower, at, s) - v);
          exchange.add(-upper, all.carried<Rule>(upper, next, s) - v);
        }
        const double before = at_face(all.before, at, sa), room = at_face(all.porosity, at, sa);
        const double solid = Rule::solid(exchange, left, room);
        moved[at] = exchange.new_velocity(v, before, left, solid);
      },
      all.velocity + 2 * grid.stride(D - 1), all.before + grid.stride(D - 1),
      all.after + grid.stride(D - 1), all.porosity + grid.stride(D - 1), flux, moved);
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
void MomentumTransport<D>::advance(Inertia inertia, const Masses<D>& masses,
                                   FaceVector<D>& velocity) {
  for (int component = 0; component < D; ++component) {
    if (inertia == Inertia::water)
      advance_component<WaterRule>(component, masses, velocity);
    else
      advance_component<WaterAndGasRule>(component, masses, velocity);
  }
  for (int component = 0; component < D; ++component) {
    const double* from = moved_[component].data();
    double* to = velocity[component].data();
    for_each_apart(
        *near_, inner_faces(*grid_, component), [&](std::ptrdiff_t at) { to[at] = from[at]; }, from,
        to);
    copy_to_open_walls(component, to);
  }
}

template IndexBox<2> inner_faces(const Grid<2>&, int);
template IndexBox<3> inner_faces(const Grid<3>&, int);
template class MomentumTransport<2>;
template class MomentumTransport<3>;

}  // namespace mudlark

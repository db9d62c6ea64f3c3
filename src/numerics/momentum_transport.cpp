#include "numerics/momentum_transport.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Below this share of water a donor gives at first order, and a face takes the mixture of what it
/// held and what came in: such spray has mass in one sweep and none in the next.
constexpr double thin = 0.01;
/// Water of less volume per cell than this is round-off: it changes nothing on its face.
constexpr double dust = 1e-8;

/// New velocity of a face from the momentum per volume that it exchanged. With enough water `left`
/// it is the quotient of momentum and mass. Thin spray takes the mixture of what it held (`before`)
/// and what came in, as if the water that left had been mixed too: the same quotient where nothing
/// left, else one that stays within its neighbours' range. The two blend: a switch, or a range that
/// counts a donor as soon as anything comes from it, would turn round-off of the water (1e-24 in
/// place of 0) into another velocity.
struct Exchange {
  double change = 0.0;   ///< momentum lost relative to the face's own velocity [m/s]
  double gained = 0.0;   ///< of it, what came in [m/s]
  double came_in = 0.0;  ///< water that came in [-]

  double new_velocity(double velocity, double before, double left, double room) const {
    const double mixture = velocity + gained / std::max(before + came_in, dust);
    const double solid = std::clamp(2.0 * left / (thin * room) - 1.0, 0.0, 1.0);
    return solid > 0.0 ? mixture + solid * (velocity - change / left - mixture) : mixture;
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
MomentumTransport<D>::MomentumTransport(const Grid<D>& grid)
    : grid_(&grid), moved_(grid, "moved velocity", "m/s") {}

template <int D>
void MomentumTransport<D>::advance_component(int component, const double* old_water,
                                             const double* new_water, const double* porosity,
                                             const FaceVector<D>& water_flux,
                                             const double* velocity, double* moved) const {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t sa = grid.stride(component);
  const auto mass = [&](std::ptrdiff_t at) { return 0.5 * (old_water[at - sa] + old_water[at]); };
  for_each_offset(grid, inner_faces(grid, component), [&](std::ptrdiff_t at) {
    const double v = velocity[at];
    const double room = 0.5 * (porosity[at - sa] + porosity[at]);
    Exchange exchange;
    for (int axis = 0; axis < D; ++axis) {
      const double* flux = water_flux[axis].data();
      const std::ptrdiff_t s = grid.stride(axis);
      for (int side = 0; side < 2; ++side) {
        const std::ptrdiff_t here =
            at + side * s;  // the side lies between the faces here - s and here
        const double through =
            0.5 * (axis == component ? flux[here - s] + flux[here] : flux[here - sa] + flux[here]);
        if (through == 0.0) continue;
        const std::ptrdiff_t donor = through > 0.0 ? here - s : here, step = through > 0.0 ? s : -s;
        double carried = velocity[donor];
        const double donor_mass = mass(donor);
        if (donor_mass > thin * room) {
          const double share = std::min(std::abs(through) / donor_mass, 1.0);
          carried +=
              0.5 * (1.0 - share) *
              limited_slope(carried - velocity[donor - step], velocity[donor + step] - carried);
        }
        const double momentum = std::abs(through) * (carried - v);
        exchange.change += donor == at ? momentum : -momentum;
        if (donor != at) exchange.gained += momentum, exchange.came_in += std::abs(through);
      }
    }
    const double left = 0.5 * (new_water[at - sa] + new_water[at]);
    moved[at] = exchange.new_velocity(v, mass(at), left, room);
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
void MomentumTransport<D>::advance(const CellField<D>& old_water, const CellField<D>& new_water,
                                   const CellField<D>& porosity, const FaceVector<D>& water_flux,
                                   FaceVector<D>& velocity) {
  for (int component = 0; component < D; ++component)
    advance_component(component, old_water.data(), new_water.data(), porosity.data(), water_flux,
                      velocity[component].data(), moved_[component].data());
  for (int component = 0; component < D; ++component) {
    const double* from = moved_[component].data();
    double* to = velocity[component].data();
    for_each_offset(*grid_, inner_faces(*grid_, component),
                    [&](std::ptrdiff_t at) { to[at] = from[at]; });
    copy_to_open_walls(component, to);
  }
}

template IndexBox<2> inner_faces(const Grid<2>&, int);
template IndexBox<3> inner_faces(const Grid<3>&, int);
template class MomentumTransport<2>;
template class MomentumTransport<3>;

}  // namespace mudlark

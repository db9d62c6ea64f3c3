#include "flow/fixed_ground.hpp"

#include <algorithm>
#include <variant>

#include "numerics/ghosts.hpp"

namespace mudlark {
namespace {

using AnyDragLaw = std::variant<Darcy, DarcyForchheimer, Ergun, VanGent, Cadmas>;

AnyDragLaw law_of(const PorousGround& g, const FlowOptions& water) {
  switch (g.drag) {
    case DragLaw::darcy:
      return Darcy{water.viscosity, g.intrinsic_permeability};
    case DragLaw::darcy_forchheimer:
      return DarcyForchheimer{water.viscosity, g.intrinsic_permeability, g.forchheimer};
    case DragLaw::ergun:
      return Ergun{water.viscosity, water.density, g.grain_size};
    case DragLaw::cadmas:
      return Cadmas{water.density, g.drag_coefficient, g.drag_length};
    case DragLaw::van_gent:
      break;
  }
  return VanGent{water.viscosity, water.density, g.grain_size,
                 g.alpha,         g.beta,        g.keulegan_carpenter};
}

/// Share inside the shape of the box that belongs to a cell (axis -1) or to the face of an axis, as
/// far as it lies in the domain: ground ends with the domain, and a face on its edge has half a
/// box. At a periodic side the other half lies at the other end.
template <int D>
double share_around(const Grid<D>& grid, const Shape& shape, int axis, const Index<D>& place) {
  Vec<D> lower, upper;
  for (int a = 0; a < D; ++a) {
    const double start = grid.face_position(a, place[a]);
    lower[a] = a == axis ? start - 0.5 * grid.width(a, place[a] - 1) : start;
    upper[a] = start + (a == axis ? 0.5 : 1.0) * grid.width(a, place[a]);
  }
  const auto inside = [&] { return fraction_inside(shape, to_point3(lower), to_point3(upper), D); };
  if (axis < 0 || (place[axis] > 0 && place[axis] < grid.cells()[axis])) return inside();
  const double start = grid.lower()[axis], end = grid.upper()[axis];
  if (!grid.periodic(axis)) {
    lower[axis] = std::max(lower[axis], start), upper[axis] = std::min(upper[axis], end);
    return inside();
  }
  const double above = 0.5 * grid.width(axis, 0);
  const double below = 0.5 * grid.width(axis, grid.cells()[axis] - 1);
  lower[axis] = start, upper[axis] = start + above;
  const double first = above * inside();
  lower[axis] = end - below, upper[axis] = end;
  return (first + below * inside()) / (above + below);
}

/// What a ground adds to the inertia of all in a volume of it [kg/m3].
double added_mass_of(const PorousGround& ground, const FlowOptions& water) {
  return ground.inertia_coefficient * water.density * (1.0 - ground.porosity);
}

}  // namespace

DragCoefficients drag_of(const PorousGround& ground, const FlowOptions& water) {
  return std::visit([&](const auto& law) { return law(ground.porosity); }, law_of(ground, water));
}

template <int D>
void fill_fixed_ground(const Grid<D>& grid, const FlowOptions& options, PorousMedium<D>& medium) {
  if (options.porous.empty()) return;
  FaceVector<D> room(grid, "porosity", "1", 1.0);
  for (const PorousGround& ground : options.porous) {
    const DragCoefficients drag = drag_of(ground, options);
    const double added = added_mass_of(ground, options);
    const PoreFilling& filling = ground.filling;
    const bool drains = filling.residual > 0.0 || !same_curve(filling, PorousGround{}.filling);
    for_each(grid.owned(), [&](const Index<D>& cell) {
      const double share = share_around(grid, ground.shape, -1, cell);
      medium.porosity[cell] += share * (ground.porosity - medium.porosity[cell]);
      medium.suction[cell] += share * (filling.suction - medium.suction[cell]);
      medium.residual[cell] += share * (ground.porosity * filling.residual - medium.residual[cell]);
      medium.at_start[cell] += share * (ground.porosity * filling.at_start - medium.at_start[cell]);
      if (share >= 0.5) medium.drains[cell] = drains ? 1.0 : 0.0;
    });
    for (int axis = 0; axis < D; ++axis)
      for_each(grid.owned_faces(axis), [&](const Index<D>& face) {
        const double share = share_around(grid, ground.shape, axis, face);
        medium.linear_drag[axis][face] += share * (drag.linear - medium.linear_drag[axis][face]);
        medium.quadratic_drag[axis][face] +=
            share * (drag.quadratic - medium.quadratic_drag[axis][face]);
        medium.added_mass[axis][face] += share * (added - medium.added_mass[axis][face]);
        room[axis][face] += share * (ground.porosity - room[axis][face]);
      });
  }
  for (int axis = 0; axis < D; ++axis)
    for_each(grid.owned_faces(axis),
             [&](const Index<D>& face) { medium.added_mass[axis][face] /= room[axis][face]; });
  Ghosts<D> ghosts(grid);
  ghosts.update(medium.porosity);
  ghosts.update(medium.suction);
  ghosts.update(medium.residual);
  ghosts.update(medium.drains);
  ghosts.exchange(medium.linear_drag);
  ghosts.exchange(medium.quadratic_drag);
  ghosts.exchange(medium.added_mass);
}

template <int D>
void number_grounds(const Grid<D>& grid, const FlowOptions& options, FaceVector<D>& number) {
  double count = 0.0;
  for (const PorousGround& ground : options.porous) {
    count += 1.0;
    for (int axis = 0; axis < D; ++axis)
      for_each(grid.owned_faces(axis), [&](const Index<D>& face) {
        if (share_around(grid, ground.shape, axis, face) >= 0.5) number[axis][face] = count;
      });
  }
  Ghosts<D> ghosts(grid);
  ghosts.exchange(number);
}

template void number_grounds(const Grid<2>&, const FlowOptions&, FaceVector<2>&);
template void number_grounds(const Grid<3>&, const FlowOptions&, FaceVector<3>&);
template void fill_fixed_ground(const Grid<2>&, const FlowOptions&, PorousMedium<2>&);
template void fill_fixed_ground(const Grid<3>&, const FlowOptions&, PorousMedium<3>&);

}  // namespace mudlark

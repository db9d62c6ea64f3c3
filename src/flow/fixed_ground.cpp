#include "flow/fixed_ground.hpp"

#include <variant>

#include "numerics/ghosts.hpp"

namespace mudlark {
namespace {

using AnyDragLaw = std::variant<Darcy, DarcyForchheimer, Ergun, VanGent>;

AnyDragLaw law_of(const PorousGround& g, const FlowOptions& water) {
  switch (g.drag) {
    case DragLaw::darcy:
      return Darcy{water.viscosity, g.intrinsic_permeability};
    case DragLaw::darcy_forchheimer:
      return DarcyForchheimer{water.viscosity, g.intrinsic_permeability, g.forchheimer};
    case DragLaw::ergun:
      return Ergun{water.viscosity, water.density, g.grain_size};
    case DragLaw::van_gent:
      break;
  }
  return VanGent{water.viscosity, water.density, g.grain_size,
                 g.alpha,         g.beta,        g.keulegan_carpenter};
}

/// Share inside the shape of the cell-sized box around a point.
template <int D>
double share_around(const Shape& shape, const Vec<D>& centre, const Vec<D>& half) {
  return fraction_inside(shape, to_point3(centre - half), to_point3(centre + half), D);
}

}  // namespace

DragCoefficients drag_of(const PorousGround& ground, const FlowOptions& water) {
  return std::visit([&](const auto& law) { return law(ground.porosity); }, law_of(ground, water));
}

template <int D>
void fill_fixed_ground(const Grid<D>& grid, const FlowOptions& options, PorousMedium<D>& medium) {
  for (const PorousGround& ground : options.porous) {
    const DragCoefficients drag = drag_of(ground, options);
    for_each(grid.owned(), [&](const Index<D>& cell) {
      Vec<D> half;
      for (int a = 0; a < D; ++a) half[a] = 0.5 * grid.width(a, cell[a]);
      const double share = share_around(ground.shape, grid.cell_centre(cell), half);
      medium.porosity[cell] += share * (ground.porosity - medium.porosity[cell]);
    });
    for (int axis = 0; axis < D; ++axis)
      for_each(grid.owned_faces(axis), [&](const Index<D>& face) {
        Vec<D> half;
        for (int a = 0; a < D; ++a)
          half[a] = 0.5 * (a == axis ? grid.gap(a, face[a]) : grid.width(a, face[a]));
        const double share = share_around(ground.shape, grid.face_centre(axis, face), half);
        medium.linear_drag[axis][face] += share * (drag.linear - medium.linear_drag[axis][face]);
        medium.quadratic_drag[axis][face] +=
            share * (drag.quadratic - medium.quadratic_drag[axis][face]);
      });
  }
  Ghosts<D> ghosts(grid);
  ghosts.update(medium.porosity);
  ghosts.exchange(medium.linear_drag);
  ghosts.exchange(medium.quadratic_drag);
}

template void fill_fixed_ground(const Grid<2>&, const FlowOptions&, PorousMedium<2>&);
template void fill_fixed_ground(const Grid<3>&, const FlowOptions&, PorousMedium<3>&);

}  // namespace mudlark

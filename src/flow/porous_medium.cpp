#include "flow/porous_medium.hpp"

namespace mudlark {

template <int D>
PorousMedium<D>::PorousMedium(const Grid<D>& grid)
    : space(grid),
      porosity(grid, "porosity", "1", 1.0),
      grain_flux(grid, "grain flux", "m/s"),
      grain_velocity(grid, "grain velocity", "m/s"),
      linear_drag(grid, "linear drag", "Pa s/m2"),
      quadratic_drag(grid, "quadratic drag", "Pa s2/m3"),
      added_mass(grid, "added mass", "kg/m3"),
      suction(grid, "suction", "Pa"),
      residual(grid, "residual saturation", "1"),
      at_start(grid, "saturation at the start", "1"),
      drains(grid, "drains", "1"),
      give_way(grid, "give way", "1/(Pa s)") {}

template struct PorousMedium<2>;
template struct PorousMedium<3>;

}  // namespace mudlark

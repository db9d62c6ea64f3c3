#include "flow/grains_at_surface.hpp"

#include <algorithm>

#include "numerics/loops.hpp"

namespace mudlark {

double part_under_water(const GrainsAcrossSurface& grains, double reach) {
  const auto [deeper, within, here, beyond] = grains;
  const double level = std::min(reach, 1.0);
  if (here <= beyond) return level;
  const double solid = std::max({deeper, within, here});  // of the ground away from its end
  const double fits = (1.0 + level) * solid - within;
  const double sharp = std::min(fits, here + beyond) / here;
  // Where points merely scatter, ground goes on.
  const double ends = std::min(2.0 * (1.0 - beyond / here), 1.0);
  return level + ends * (sharp - level);
}

template <int D>
void find_part_under_water(const Grid<D>& grid, const CellField<D>& unknown,
                           const FaceVector<D>& reach, const FaceVector<D>& share,
                           FaceVector<D>& part) {
  const double* governed = unknown.data();
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    const double *falls = reach[axis].data(), *grains = share[axis].data();
    double* under = part[axis].data();
    for_each_place(grid, bounding_faces(grid, axis), [&](std::ptrdiff_t at, const Index<D>& face) {
      under[at] = 1.0;
      if (governed[at] == governed[at - s]) return;
      const bool side =
          !grid.periodic(axis) && (face[axis] == 0 || face[axis] == grid.cells()[axis]);
      const std::ptrdiff_t out = governed[at] > 0.0 ? -s : s;
      under[at] = side ? std::min(falls[at], 1.0)
                       : part_under_water(
                             {grains[at - 2 * out], grains[at - out], grains[at], grains[at + out]},
                             falls[at]);
    });
  }
}

template void find_part_under_water(const Grid<2>&, const CellField<2>&, const FaceVector<2>&,
                                    const FaceVector<2>&, FaceVector<2>&);
template void find_part_under_water(const Grid<3>&, const CellField<3>&, const FaceVector<3>&,
                                    const FaceVector<3>&, FaceVector<3>&);

}  // namespace mudlark

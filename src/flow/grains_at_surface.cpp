#include "flow/grains_at_surface.hpp"

#include <algorithm>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

template <int D>
bool on_side(const Grid<D>& grid, int axis, int face) {
  return !grid.periodic(axis) && (face == 0 || face == grid.cells()[axis]);
}

}  // namespace

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
      const bool down = governed[at] > 0.0;
      const std::ptrdiff_t out = down ? -s : s;
      const bool water_again = governed[down ? at - 2 * s : at + s] > 0.0;
      const bool ends = !on_side(grid, axis, face[axis]) && !water_again;
      under[at] = ends ? part_under_water(
                             {grains[at - 2 * out], grains[at - out], grains[at], grains[at + out]},
                             falls[at])
                       : std::min(falls[at], 1.0);
    });
  }
}

template <int D>
void find_rims(const Grid<D>& grid, const CellField<D>& unknown, const FaceVector<D>& share,
               const FaceVector<D>& part, FaceVector<D>& rims) {
  const double* governed = unknown.data();
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    const double *grains = share[axis].data(), *under = part[axis].data();
    double* rim = rims[axis].data();
    for_each_place(grid, bounding_faces(grid, axis), [&](std::ptrdiff_t at, const Index<D>& face) {
      rim[at] = 0.0;
      if (under[at] <= 1.0) return;
      const int direction = governed[at] > 0.0 ? -1 : 1;
      if (on_side(grid, axis, face[axis] + direction)) return;
      const double taken = (under[at] - 1.0) * grains[at] / grains[at + direction * s];
      rim[at] = direction * std::min(taken, 1.0);
    });
  }
}

template <int D>
void carry_rims(const Grid<D>& grid, const FaceVector<D>& rims, FaceVector<D>& velocity) {
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    const double* rim = rims[axis].data();
    double* v = velocity[axis].data();
    for_each_offset(grid, grid.owned_faces(axis), [&](std::ptrdiff_t at) {
      if (rim[at - s] > 0.0) v[at] += rim[at - s] * (v[at - s] - v[at]);
      if (rim[at + s] < 0.0) v[at] -= rim[at + s] * (v[at + s] - v[at]);
    });
  }
}

template void find_part_under_water(const Grid<2>&, const CellField<2>&, const FaceVector<2>&,
                                    const FaceVector<2>&, FaceVector<2>&);
template void find_part_under_water(const Grid<3>&, const CellField<3>&, const FaceVector<3>&,
                                    const FaceVector<3>&, FaceVector<3>&);
template void find_rims(const Grid<2>&, const CellField<2>&, const FaceVector<2>&,
                        const FaceVector<2>&, FaceVector<2>&);
template void find_rims(const Grid<3>&, const CellField<3>&, const FaceVector<3>&,
                        const FaceVector<3>&, FaceVector<3>&);
template void carry_rims(const Grid<2>&, const FaceVector<2>&, FaceVector<2>&);
template void carry_rims(const Grid<3>&, const FaceVector<3>&, FaceVector<3>&);

}  // namespace mudlark

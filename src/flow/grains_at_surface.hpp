#pragma once
/// Which grains the surface of the water leaves under it.
#include "grid/field.hpp"

namespace mudlark {

/// Grains along an axis through the surface of the water, as shares of faces: `here` on the face
/// between the wet cell and the dry one, the others on the next faces, into the water and out of
/// it.
struct GrainsAcrossSurface {
  double deeper, within, here, beyond;
};

/// Under water as a part of the grains of the face, where the surface lies `reach` cells beyond the
/// centre of the wet cell (at most 1).
///
/// In ground that goes on beyond the surface that is `reach`. Where ground ends, the kernel spreads
/// its rim over two cells on either side, and what it spreads out of the water would weigh as in
/// air: 0.29 phi rho g h with both surfaces on one face. But ground ends as sharply as its points
/// do: `within`, `here` and `beyond` are what it holds between a cell and a half below the face and
/// its end, and what does not fit under the surface is out of the water. `beyond` counts with
/// `here`, as no pressure acts on it.
double part_under_water(const GrainsAcrossSurface& grains, double reach);

/// That part on faces which the surface passes, 1 on all others. `unknown` (cells with a pressure),
/// `reach` (of the pressure at a face, in cells) and `share` need ghosts. Bounding faces.
template <int D>
void find_part_under_water(const Grid<D>& grid, const CellField<D>& unknown,
                           const FaceVector<D>& reach, const FaceVector<D>& share,
                           FaceVector<D>& part);

}  // namespace mudlark

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
/// `here`, as no pressure acts on it: more than 1 is the part of `beyond` that is under water.
double part_under_water(const GrainsAcrossSurface& grains, double reach);

/// That part on faces which the surface passes, 1 on all others. `unknown` (cells with a pressure)
/// and `share` need ghosts; `reach` is that of the pressure at a face [cells]. Bounding faces.
template <int D>
void find_part_under_water(const Grid<D>& grid, const CellField<D>& unknown,
                           const FaceVector<D>& reach, const FaceVector<D>& share,
                           FaceVector<D>& part);

/// Grains of the next face out of the water that are under it all the same, with the sign of the
/// direction to them: a part of those.
template <int D>
void find_rims(const Grid<D>& grid, const CellField<D>& unknown, const FaceVector<D>& share,
               const FaceVector<D>& part, FaceVector<D>& rims);

/// Gives grains of rims the velocity of the face of the surface. `rims` and `velocity` need ghosts.
/// Owned faces.
template <int D>
void carry_rims(const Grid<D>& grid, const FaceVector<D>& rims, FaceVector<D>& velocity);

}  // namespace mudlark

#pragma once
/// The part of a body's surface in one cell that lies in a box.
#include "grid/cut_cells.hpp"

namespace mudlark {

/// Surfaces that together are what of `cut` lies in the box: itself where the box holds its cell,
/// nothing where the box ends before it. A plane is cut exactly. Where an edge of the body lies in
/// the cell, each component of the normal has a surface of its own, which is cut as one across its
/// axis: exact for bodies along the axes.
template <int D>
std::vector<CutCell<D>> part_of_wall(const Grid<D>& grid, const CutCell<D>& cut,
                                     const BoxShape& box);

}  // namespace mudlark

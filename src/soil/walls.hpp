#pragma once
/// The soil at the sides of the domain: closed walls are mirrors.
#include "soil/nodes.hpp"

namespace mudlark {

/// Folds what points left behind closed walls back onto the nodes before them, as if every point
/// had a mirror image: scalars add; the component along the wall's normal changes sign (odd),
/// tangential ones keep it at slip walls (even) and change it at no-slip walls (odd). Layers behind
/// open sides stay as they are. Gravity of the images is a force like any other and changes sign with
/// them; since a node weighs all of its folded mass, the surplus is taken from its forces. Without
/// that, soil at rest under its own weight would not rest on a wall. `water_density` [kg/m3]: of the
/// pore water.
template <int D>
void fold_into_domain(const Grid<D>& grid, const IndexBox<D>& box, double water_density,
                      NodeField<NodeSums, D>& nodes);

/// Gives the nodes behind closed walls the mirrored motion, and the wall's own faces none along the
/// normal.
template <int D>
void mirror_motion(const Grid<D>& grid, const IndexBox<D>& box, NodeField<NodeMotion, D>& nodes);

/// The same fold for a scalar at cell centres.
template <int D>
void fold_cells(const Grid<D>& grid, const IndexBox<D>& box, CellField<D>& field);

}  // namespace mudlark

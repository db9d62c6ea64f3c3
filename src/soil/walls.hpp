#pragma once
/// The soil at the sides of the domain: closed walls are mirrors.
#include "soil/nodes.hpp"

namespace mudlark {

/// Folds what points left behind closed walls back onto the nodes before them, as if every point
/// had a mirror image: scalars add; the component along the wall's normal changes sign (odd),
/// tangential ones keep it at slip walls (even) and change it at no-slip walls (odd). Layers behind
/// open sides stay as they are. Weight is among the forces, so the images' weight changes sign with
/// them: otherwise soil would not rest on a wall.
template <int D>
void fold_into_domain(const Grid<D>& grid, const IndexBox<D>& box, NodeField<NodeSums, D>& nodes);

/// Gives the nodes behind closed walls the mirrored motion, and the wall's own faces none along the
/// normal.
template <int D>
void mirror_motion(const Grid<D>& grid, const IndexBox<D>& box, NodeField<NodeMotion, D>& nodes);

/// Faces whose motion this rank computes itself: its own, and those behind open sides, which are no
/// mirrors.
template <int D>
IndexBox<D> solved_faces(const Grid<D>& grid, int axis);

/// The same fold for a scalar at cell centres.
template <int D>
void fold_cells(const Grid<D>& grid, const IndexBox<D>& box, CellField<D>& field);

}  // namespace mudlark

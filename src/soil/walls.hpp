#pragma once
/// The soil at the sides of the domain: closed ones are mirrors.
#include "soil/nodes.hpp"
#include "soil/sides.hpp"

namespace mudlark {

/// Sum V p dW/dx [N], p the pressures of the sides of an axis and x the axis of the component, over
/// the points near them, for nodes on them and behind them; per axis, where it has such sides.
template <int D>
using SidePushes = std::vector<std::optional<FaceVector<D>>>;

/// Folds what points left behind closed sides back onto the nodes before them, as if every point
/// had a mirror image: scalars add; grains at rest against the side along its normal, and along it
/// where the side holds them, change sign (odd), otherwise they keep it (even). A side that moves
/// is at rest in its own frame. Seepage velocities are odd along the normal of a sealed side and
/// even where water goes through; there the pore pressure is odd about the side's own. Layers
/// behind open sides stay as they are. Weight is among the forces, so the images' weight changes
/// sign with them: otherwise soil would not rest on a side.
/// `pushes` are needed where sides have a pressure, the step's length `dt` [s] where they move.
template <int D>
void fold_into_domain(const SoilSides<D>& sides, const IndexBox<D>& box, double dt,
                      const SidePushes<D>* pushes, NodeField<NodeSums, D>& nodes);

/// The same where no side moves or has a pressure.
template <int D>
void fold_into_domain(const SoilSides<D>& sides, const IndexBox<D>& box,
                      NodeField<NodeSums, D>& nodes) {
  const SidePushes<D>* none = nullptr;
  fold_into_domain(sides, box, 1.0, none, nodes);
}

/// Gives the nodes behind closed sides the mirrored motion, and the faces on them the side's own
/// along the normal. The motion of water through faces on sides with a pressure must be set (see
/// side_water.hpp).
template <int D>
void mirror_motion(const SoilSides<D>& sides, const IndexBox<D>& box,
                   const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& nodes);

/// Empties the sums behind parts of sides that grains go through in other parts, where nodes behind
/// are solved themselves: what was folded into the domain counts only there.
template <int D>
void forget_images(const SoilSides<D>& sides, const IndexBox<D>& box,
                   NodeField<NodeSums, D>& nodes);

/// Only images of one component at the sides of one axis.
template <int D>
void mirror_component(const SoilSides<D>& sides, int axis, int component, const IndexBox<D>& box,
                      const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& nodes);

/// Faces whose motion this rank computes itself: its own, and those behind sides that grains go
/// through, which are no mirrors.
template <int D>
IndexBox<D> solved_faces(const SoilSides<D>& sides, int axis);

/// The same fold for a scalar at cell centres.
template <int D>
void fold_cells(const SoilSides<D>& sides, const IndexBox<D>& box, CellField<D>& field);

/// Flux of water relative to the grains on a side itself, of a component at a node before it [m/s]:
/// what a case gives, or what weight and the slope of the side's pressure drive along it.
template <int D>
double flux_on_side(const SoilSides<D>& sides, int axis, int component, const SideNode& side,
                    const Index<D>& before, const NodeSums& sums);
/// Push of a side's pressure on the node of a component behind it [N].
template <int D>
double push_behind(const SoilSides<D>& sides, const SidePushes<D>* pushes, int axis, int component,
                   const Index<D>& behind);

/// Share of pores on a face [-].
inline double face_porosity(const NodeSums& sums, double water_density) {
  if (sums.water_mass <= 0.0) return 0.0;
  const double share = sums.water_mass / (water_density * sums.volume);
  return share < 1.0 ? share : 1.0;
}

}  // namespace mudlark

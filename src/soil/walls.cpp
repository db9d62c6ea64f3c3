#include "soil/walls.hpp"

namespace mudlark {
namespace {

enum class OnSide { no, closed, pressure };

/// Does a face of a component lie on a side across the component, and of which kind?
template <int D>
OnSide lies_on_side(const SoilSides<D>& sides, int component, const Index<D>& face) {
  const Grid<D>& grid = sides.grid();
  for (const int side : {0, 1})
    if (face[component] == (side == 0 ? 0 : grid.cells()[component]) &&
        grid.touches(component, side))
      return sides.node(component, side, component, face).water == WaterSide::pressure
                 ? OnSide::pressure
                 : OnSide::closed;
  return OnSide::no;
}

/// Flux along a side of given pressure [m/s]: what weight and the pressure's slope drive. None
/// through another side that lets no water through.
template <int D>
double flux_along(const SoilSides<D>& sides, const SideNode& node, int component,
                  const Index<D>& face, const NodeSums& sums) {
  if (node.water != WaterSide::pressure || sums.drag <= 0.0 || sums.volume <= 0.0) return 0.0;
  if (lies_on_side(sides, component, face) == OnSide::closed) return 0.0;
  const double porosity = face_porosity(sums, sides.water_density());
  const double mobility = porosity * porosity * sums.volume / sums.drag;  // kappa / mu
  return mobility * (sides.water_density() * sides.grid().gravity()[component] - node.water_value);
}

/// What is the same for all nodes of a component and side.
struct Around {
  bool normal;  ///< is the component that along the side's normal?
  double gravity, water_density, inertia, dt;
};

void fold_node(const SideNode& side, const Around& around, double push, const NodeSums& from,
               NodeSums& to) {
  const auto& [normal, gravity, water_density, inertia, dt] = around;
  to.grain_mass += from.grain_mass;
  to.water_mass += from.water_mass;
  to.volume += from.volume;
  to.drag += from.drag;
  to.grain_momentum += side.grain_sign * from.grain_momentum;
  to.mixture_force += side.grain_sign * from.mixture_force;
  to.water_momentum += side.flux_sign * from.water_momentum;
  to.water_force += side.flux_sign * from.water_force;
  if (side.velocity != 0.0 || side.velocity_before != 0.0) {
    // In the lab the image of v is 2 V - v, and momenta are those of the step's start.
    to.grain_momentum += 2.0 * side.velocity_before * from.grain_mass;
    to.water_momentum += 2.0 * side.velocity_before * from.water_mass;
    const double twice = 2.0 * inertia * (side.velocity - side.velocity_before) / dt;
    to.mixture_force += twice * (from.grain_mass + from.water_mass);
    to.water_force += twice * water_density * from.volume;
  }
  if (from.water_mass <= 0.0) return;
  if (side.grain_sign != side.flux_sign)  // v_f = v_s + w / n, both images by their own rule
    to.water_momentum += (side.grain_sign - side.flux_sign) * from.water_mass *
                         from.grain_momentum / from.grain_mass;
  if (side.water == WaterSide::inflow && normal) {  // and what drives the flux, by Darcy's law
    const double porosity = face_porosity(from, water_density);
    to.water_momentum += 2.0 * side.water_value * water_density * from.volume;
    to.water_force += 2.0 * side.water_value * from.drag / (porosity * porosity);
  }
  if (side.water == WaterSide::pressure) {
    if (normal)
      to.water_force -= 2.0 * push;
    else
      to.water_force += 2.0 * (from.volume * water_density * gravity + push);
  }
}

/// Motion of a mirrored node. `on_side`: flux of water, relative to the grains, on the side itself
/// [m/s].
NodeMotion image_of(const SideNode& side, double on_side, double porosity,
                    const NodeMotion& before) {
  NodeMotion image;
  image.grain_velocity = side.grain_sign * before.grain_velocity + 2.0 * side.velocity;
  image.grain_change =
      side.grain_sign * before.grain_change + 2.0 * (side.velocity - side.velocity_before);
  double flux = side.flux_sign * (before.total_flux - before.grain_velocity);
  double slip = side.flux_sign * (before.water_velocity - before.grain_velocity);
  if (on_side != 0.0) {
    flux += 2.0 * on_side;
    if (porosity > 0.0) slip += 2.0 * on_side / porosity;
  }
  image.water_velocity = image.grain_velocity + slip;
  image.water_change =
      image.grain_change + side.flux_sign * (before.water_change - before.grain_change);
  image.total_flux = image.grain_velocity + flux;
  return image;
}

}  // namespace

template <int D>
double flux_on_side(const SoilSides<D>& sides, int axis, int component, const SideNode& side,
                    const Index<D>& before, const NodeSums& sums) {
  if (component != axis) return flux_along(sides, side, component, before, sums);
  return side.water == WaterSide::inflow ? side.water_value : 0.0;
}

template <int D>
double push_behind(const SoilSides<D>& sides, const SidePushes<D>* pushes, int axis, int component,
                   const Index<D>& behind) {
  if (!pushes || !(*pushes)[static_cast<std::size_t>(axis)]) return 0.0;
  // A face on a side folded before has the push of that side only.
  if (component < axis && lies_on_side(sides, component, behind) == OnSide::pressure) return 0.0;
  return (*(*pushes)[static_cast<std::size_t>(axis)])[component][behind];
}

template <int D>
void fold_into_domain(const SoilSides<D>& sides, const IndexBox<D>& box, double dt,
                      const SidePushes<D>* pushes, NodeField<NodeSums, D>& nodes) {
  const Grid<D>& grid = sides.grid();
  for (int axis = 0; axis < D; ++axis) {
    const FaceVector<D>* push = nullptr;
    if (pushes && (*pushes)[static_cast<std::size_t>(axis)])
      push = &*(*pushes)[static_cast<std::size_t>(axis)];
    for (int d = 0; d < D; ++d) {
      auto& field = nodes[static_cast<std::size_t>(d)];
      const Around around{d == axis, grid.gravity()[d], sides.water_density(), sides.inertia(), dt};
      for_each_image(sides, box, axis, d,
                     [&](const SideNode& node, const Index<D>& behind, const Index<D>& before) {
                       fold_node(node, around, push_behind(sides, pushes, axis, d, behind),
                                 field[behind], field[before]);
                     });
    }
    if (!push) continue;
    for_each_face_on_sides(sides, box, axis, [&](int, const SideNode& node, const Index<D>& face) {
      if (node.water == WaterSide::pressure)
        nodes[static_cast<std::size_t>(axis)][face].water_force -= (*push)[axis][face];
    });
  }
}

template <int D>
void mirror_component(const SoilSides<D>& sides, int axis, int component, const IndexBox<D>& box,
                      const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& nodes) {
  const auto u = static_cast<std::size_t>(component);
  for_each_image(
      sides, box, axis, component,
      [&](const SideNode& node, const Index<D>& behind, const Index<D>& before) {
        const double on_side = flux_on_side(sides, axis, component, node, before, sums[u][before]);
        nodes[u][behind] = image_of(
            node, on_side, face_porosity(sums[u][before], sides.water_density()), nodes[u][before]);
      });
}

template <int D>
void mirror_motion(const SoilSides<D>& sides, const IndexBox<D>& box,
                   const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& nodes) {
  // All sides come to rest before any is mirrored: in a domain one cell wide they see each other.
  for (int axis = 0; axis < D; ++axis) {
    const auto u = static_cast<std::size_t>(axis);
    for_each_face_on_sides(sides, box, axis, [&](int, const SideNode& node, const Index<D>& face) {
      NodeMotion& motion = nodes[u][face];
      const double change = node.velocity - node.velocity_before;
      if (node.water == WaterSide::pressure) {  // the water's part is there already
        motion.grain_velocity = node.velocity;
        motion.grain_change = change;
        return;
      }
      motion = {node.velocity, change, node.velocity, change, node.velocity};
      if (node.water != WaterSide::inflow) return;
      const double porosity = face_porosity(sums[u][face], sides.water_density());
      if (porosity <= 0.0) return;
      motion.water_velocity += node.water_value / porosity;
      motion.total_flux += node.water_value;
    });
  }
  for (int axis = 0; axis < D; ++axis)
    for (int d = 0; d < D; ++d) mirror_component(sides, axis, d, box, sums, nodes);
}

template <int D>
IndexBox<D> solved_faces(const SoilSides<D>& sides, int axis) {
  const Grid<D>& grid = sides.grid();
  IndexBox<D> faces = grid.owned_faces(axis);
  for (int a = 0; a < D; ++a) {
    if (sides.lets_through(a, 0)) faces.lower[a] = grid.local().lower[a];
    if (sides.lets_through(a, 1)) faces.upper[a] = grid.local().upper[a];
  }
  return faces;
}

template <int D>
void forget_images(const SoilSides<D>& sides, const IndexBox<D>& box,
                   NodeField<NodeSums, D>& nodes) {
  const Grid<D>& grid = sides.grid();
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int d = 0; d < D && sides.lets_through(axis, side); ++d) {
        if (sides.plain(axis, side, d)) break;  // open all over: no images
        for_each_mirror_pair(grid, box, axis, side, d == axis,
                             [&](const Index<D>& behind, const Index<D>& before) {
                               if (sides.node(axis, side, d, before).mirrored)
                                 nodes[static_cast<std::size_t>(d)][behind] = NodeSums{};
                             });
      }
}

template <int D>
void fold_cells(const SoilSides<D>& sides, const IndexBox<D>& box, CellField<D>& field) {
  const Grid<D>& grid = sides.grid();
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(axis, side)) continue;
      for_each_mirror_pair(grid, box, axis, side, false,
                           [&](const Index<D>& behind, const Index<D>& before) {
                             // The normal component's node has the cell's place along the side.
                             if (sides.node(axis, side, axis, before).mirrored)
                               field[before] += field[behind];
                           });
    }
}

template void fold_into_domain(const SoilSides<2>&, const IndexBox<2>&, double,
                               const SidePushes<2>*, NodeField<NodeSums, 2>&);
template void fold_into_domain(const SoilSides<3>&, const IndexBox<3>&, double,
                               const SidePushes<3>*, NodeField<NodeSums, 3>&);
template void mirror_motion(const SoilSides<2>&, const IndexBox<2>&, const NodeField<NodeSums, 2>&,
                            NodeField<NodeMotion, 2>&);
template void mirror_motion(const SoilSides<3>&, const IndexBox<3>&, const NodeField<NodeSums, 3>&,
                            NodeField<NodeMotion, 3>&);
template void forget_images(const SoilSides<2>&, const IndexBox<2>&, NodeField<NodeSums, 2>&);
template void forget_images(const SoilSides<3>&, const IndexBox<3>&, NodeField<NodeSums, 3>&);
template void mirror_component(const SoilSides<2>&, int, int, const IndexBox<2>&,
                               const NodeField<NodeSums, 2>&, NodeField<NodeMotion, 2>&);
template void mirror_component(const SoilSides<3>&, int, int, const IndexBox<3>&,
                               const NodeField<NodeSums, 3>&, NodeField<NodeMotion, 3>&);
template void fold_cells(const SoilSides<2>&, const IndexBox<2>&, CellField<2>&);
template void fold_cells(const SoilSides<3>&, const IndexBox<3>&, CellField<3>&);
template double flux_on_side(const SoilSides<2>&, int, int, const SideNode&, const Index<2>&,
                             const NodeSums&);
template double flux_on_side(const SoilSides<3>&, int, int, const SideNode&, const Index<3>&,
                             const NodeSums&);
template double push_behind(const SoilSides<2>&, const SidePushes<2>*, int, int, const Index<2>&);
template double push_behind(const SoilSides<3>&, const SidePushes<3>*, int, int, const Index<3>&);
template IndexBox<2> solved_faces(const SoilSides<2>&, int);
template IndexBox<3> solved_faces(const SoilSides<3>&, int);

}  // namespace mudlark

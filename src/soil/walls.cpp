#include "soil/walls.hpp"

namespace mudlark {
namespace {

/// Flux along a side of given pressure [m/s]: what weight and the pressure's slope drive.
double flux_along(const SideNode& node, double gravity, double water_density,
                  const NodeSums& sums) {
  if (sums.drag <= 0.0 || sums.volume <= 0.0) return 0.0;
  const double porosity = face_porosity(sums, water_density);
  const double mobility = porosity * porosity * sums.volume / sums.drag;  // kappa / mu
  return mobility * (water_density * gravity - node.water_value);
}

/// What is the same for all nodes of a component and side.
struct Around {
  bool normal;  ///< is the component that along the side's normal?
  double gravity, water_density, inertia, dt;
};

void fold_node(const SideNode& side, const Around& around, double slope, const NodeSums& from,
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
  if (side.water == WaterSide::inflow && normal)
    to.water_momentum += 2.0 * side.water_value * water_density * from.volume;
  if (side.water == WaterSide::pressure) {
    if (normal)
      to.water_force -= 2.0 * side.water_value * slope;
    else
      to.water_force += 2.0 * from.volume * (water_density * gravity - side.water_value);
  }
}

/// Motion of a mirrored node.
NodeMotion image_of(const SideNode& side, bool normal, double gravity, double water_density,
                    const NodeSums& sums, const NodeMotion& before) {
  NodeMotion image;
  image.grain_velocity = side.grain_sign * before.grain_velocity + 2.0 * side.velocity;
  image.grain_change =
      side.grain_sign * before.grain_change + 2.0 * (side.velocity - side.velocity_before);
  double flux = side.flux_sign * (before.total_flux - before.grain_velocity);
  double slip = side.flux_sign * (before.water_velocity - before.grain_velocity);
  if (side.water != WaterSide::sealed) {
    double given = 0.0;
    if (normal && side.water == WaterSide::inflow) given = 2.0 * side.water_value;
    if (!normal) given = 2.0 * flux_along(side, gravity, water_density, sums);
    const double porosity = face_porosity(sums, water_density);
    flux += given;
    if (porosity > 0.0) slip += given / porosity;
  }
  image.water_velocity = image.grain_velocity + slip;
  image.water_change =
      image.grain_change + side.flux_sign * (before.water_change - before.grain_change);
  image.total_flux = image.grain_velocity + flux;
  return image;
}

}  // namespace

template <int D>
void fold_into_domain(const SoilSides<D>& sides, const IndexBox<D>& box, double dt,
                      const FaceVector<D>* slopes, NodeField<NodeSums, D>& nodes) {
  const Grid<D>& grid = sides.grid();
  for (int d = 0; d < D; ++d) {
    auto& field = nodes[static_cast<std::size_t>(d)];
    for_each_image(sides, box, d,
                   [&](int axis, int side, const SideNode& node, const Index<D>& behind,
                       const Index<D>& before) {
                     NodeSums& from = field[behind];
                     const double slope = slopes && d == axis ? (*slopes)[d][behind] : 0.0;
                     fold_node(
                         node,
                         {d == axis, grid.gravity()[d], sides.water_density(), sides.inertia(), dt},
                         slope, from, field[before]);
                     // Beside parts that grains go through nodes behind are solved themselves.
                     if (sides.lets_through(axis, side)) from = NodeSums{};
                   });
  }
  if (!slopes) return;
  for_each_face_on_sides(sides, box,
                         [&](int axis, int, const SideNode& node, const Index<D>& face) {
                           if (node.water != WaterSide::pressure) return;
                           NodeSums& sums = nodes[static_cast<std::size_t>(axis)][face];
                           sums.water_force -= node.water_value * (*slopes)[axis][face];
                         });
}

template <int D>
void mirror_motion(const SoilSides<D>& sides, const IndexBox<D>& box,
                   const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& nodes) {
  const Grid<D>& grid = sides.grid();
  // All sides come to rest before any is mirrored: in a domain one cell wide they see each other.
  for_each_face_on_sides(
      sides, box, [&](int axis, int, const SideNode& node, const Index<D>& face) {
        NodeMotion& motion = nodes[static_cast<std::size_t>(axis)][face];
        const double change = node.velocity - node.velocity_before;
        if (node.water == WaterSide::pressure) {  // the water's part is there already
          motion.grain_velocity = node.velocity;
          motion.grain_change = change;
          return;
        }
        motion = {node.velocity, change, node.velocity, change, node.velocity};
        if (node.water != WaterSide::inflow) return;
        const double porosity =
            face_porosity(sums[static_cast<std::size_t>(axis)][face], sides.water_density());
        if (porosity <= 0.0) return;
        motion.water_velocity += node.water_value / porosity;
        motion.total_flux += node.water_value;
      });
  for (int d = 0; d < D; ++d) {
    const auto u = static_cast<std::size_t>(d);
    for_each_image(
        sides, box, d,
        [&](int axis, int, const SideNode& node, const Index<D>& behind, const Index<D>& before) {
          nodes[u][behind] = image_of(node, d == axis, grid.gravity()[d], sides.water_density(),
                                      sums[u][before], nodes[u][before]);
        });
  }
}

template <int D>
void mirror_component_beside(const SoilSides<D>& sides, int axis, const IndexBox<D>& box,
                             const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& nodes) {
  const auto u = static_cast<std::size_t>(axis);
  for_each_image(
      sides, box, axis,
      [&](int other, int, const SideNode& node, const Index<D>& behind, const Index<D>& before) {
        if (other != axis)
          nodes[u][behind] = image_of(node, false, sides.grid().gravity()[axis],
                                      sides.water_density(), sums[u][before], nodes[u][before]);
      });
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
                               const FaceVector<2>*, NodeField<NodeSums, 2>&);
template void fold_into_domain(const SoilSides<3>&, const IndexBox<3>&, double,
                               const FaceVector<3>*, NodeField<NodeSums, 3>&);
template void mirror_motion(const SoilSides<2>&, const IndexBox<2>&, const NodeField<NodeSums, 2>&,
                            NodeField<NodeMotion, 2>&);
template void mirror_motion(const SoilSides<3>&, const IndexBox<3>&, const NodeField<NodeSums, 3>&,
                            NodeField<NodeMotion, 3>&);
template void mirror_component_beside(const SoilSides<2>&, int, const IndexBox<2>&,
                                      const NodeField<NodeSums, 2>&, NodeField<NodeMotion, 2>&);
template void mirror_component_beside(const SoilSides<3>&, int, const IndexBox<3>&,
                                      const NodeField<NodeSums, 3>&, NodeField<NodeMotion, 3>&);
template void fold_cells(const SoilSides<2>&, const IndexBox<2>&, CellField<2>&);
template void fold_cells(const SoilSides<3>&, const IndexBox<3>&, CellField<3>&);

}  // namespace mudlark

#include "soil/body_force.hpp"

namespace mudlark {

template <int D>
void add_body_force(const Grid<D>& grid, const SoilOptions& options, double time,
                    const IndexBox<D>& box, NodeField<NodeSums, D>& nodes) {
  if (!options.body_acceleration) return;
  for (int d = 0; d < D; ++d) {
    const Varying& given =
        (*options.body_acceleration)[static_cast<std::size_t>(D == 2 && d == 1 ? 2 : d)];
    auto& field = nodes[static_cast<std::size_t>(d)];
    for_each(box, [&](const Index<D>& face) {
      NodeSums& node = field[face];
      if (node.volume <= 0.0) return;
      Vec<D> place;
      for (int a = 0; a < D; ++a)
        place[a] = grid.lower()[a] + (face[a] + (a == d ? 0.0 : 0.5)) * grid.spacing()[a];
      const double acceleration = given(to_point3(place), time);
      node.mixture_force += (node.grain_mass + node.water_mass) * acceleration;
      node.water_force += options.water_density * node.volume * acceleration;
    });
  }
}

template void add_body_force(const Grid<2>&, const SoilOptions&, double, const IndexBox<2>&,
                             NodeField<NodeSums, 2>&);
template void add_body_force(const Grid<3>&, const SoilOptions&, double, const IndexBox<3>&,
                             NodeField<NodeSums, 3>&);

}  // namespace mudlark

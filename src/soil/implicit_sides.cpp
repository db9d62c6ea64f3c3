#include "soil/implicit_sides.hpp"

namespace mudlark {

template <int D>
void ImplicitSides<D>::complete(FaceVector<D>& grains, FaceVector<D>& water,
                                CellField<D>& pressure) const {
  const IndexBox<D>& box = sides_->grid().local();
  for (int axis = 0; axis < D; ++axis)
    for_each_face_on_sides(
        *sides_, box, axis, [&](int, const SideNode& node, const Index<D>& face) {
          grains[axis][face] = dt_ * node.velocity;
          if (node.water == WaterSide::pressure) return;  // the water's way is unknown
          water[axis][face] = node.water == WaterSide::inflow ? dt_ * node.water_value : 0.0;
        });
  for (int axis = 0; axis < D; ++axis) {
    for (int d = 0; d < D; ++d) {
      const NodeSums* sums = (*sums_)[static_cast<std::size_t>(d)].data();
      for_each_image(*sides_, box, axis, d,
                     [&](const SideNode& node, const Index<D>& behind, const Index<D>& before) {
                       grains[d][behind] =
                           node.grain_sign * grains[d][before] + 2.0 * dt_ * node.velocity;
                       const double on_side = flux_on_side(*sides_, axis, d, node, before,
                                                           sums[sides_->grid().offset(before)]);
                       water[d][behind] = node.flux_sign * water[d][before] + 2.0 * dt_ * on_side;
                     });
    }
    for_each_image_of_cells(
        *sides_, box, axis,
        [&](int side, const SideNode& node, const Index<D>& behind, const Index<D>& before) {
          pressure[behind] = pressure_sign(node) * pressure[before];
          if (node.water == WaterSide::pressure)
            pressure[behind] += 2.0 * water_->rise(*sides_, axis, side, before);
        });
  }
}

template <int D>
void ImplicitSides<D>::fold(FaceVector<D>& grains, FaceVector<D>& water,
                            CellField<D>& pressure) const {
  const Grid<D>& grid = sides_->grid();
  const IndexBox<D>& box = grid.local();
  for (int axis = 0; axis < D; ++axis) {
    for (int d = 0; d < D; ++d) {
      const NodeSums* sums = (*sums_)[static_cast<std::size_t>(d)].data();
      for_each_image(*sides_, box, axis, d,
                     [&](const SideNode& node, const Index<D>& behind, const Index<D>& before) {
                       grains[d][before] += node.grain_sign * grains[d][behind];
                       water[d][before] += node.flux_sign * water[d][behind];
                       if (node.water != WaterSide::pressure) return;
                       const double push = push_behind(*sides_, water_->pushes(), axis, d, behind);
                       if (d == axis) {
                         water[d][before] += 2.0 * push;
                         return;
                       }
                       // What drives the flux on the side has no image: see fold_into_domain.
                       const NodeSums& sum = sums[grid.offset(behind)];
                       const double porosity = face_porosity(sum, sides_->water_density());
                       const double drag = porosity > 0.0 ? sum.drag / (porosity * porosity) : 0.0;
                       const double on_side =
                           flux_on_side(*sides_, axis, d, node, before, sums[grid.offset(before)]);
                       water[d][before] +=
                           2.0 *
                           (drag * on_side -
                            (sum.volume * sides_->water_density() * grid.gravity()[d] + push));
                     });
    }
    for_each_face_on_sides(
        *sides_, box, axis, [&](int, const SideNode& node, const Index<D>& face) {
          if (node.water == WaterSide::pressure)
            water[axis][face] += (*(*water_->pushes())[static_cast<std::size_t>(axis)])[axis][face];
        });
    for_each_image_of_cells(
        *sides_, box, axis,
        [&](int, const SideNode& node, const Index<D>& behind, const Index<D>& before) {
          pressure[before] += pressure_sign(node) * pressure[behind];
        });
  }
}

template class ImplicitSides<2>;
template class ImplicitSides<3>;

}  // namespace mudlark

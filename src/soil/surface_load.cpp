#include "soil/surface_load.hpp"

#include <algorithm>

namespace mudlark {

template <int D>
SurfaceLoads<D>::SurfaceLoads(const Grid<D>& grid, std::vector<SurfaceLoad> loads)
    : grid_(&grid),
      all_loads_(std::move(loads)),
      traction_(grid, "surface pressure", "Pa"),
      drained_(grid, "drainage pressure", "Pa") {
  set_active({});
}

template <int D>
void SurfaceLoads<D>::set_active(std::optional<std::vector<bool>> active) {
  loads_.clear();
  for (std::size_t i = 0; i < all_loads_.size(); ++i)
    if (!active || active->at(i)) loads_.push_back(all_loads_[i]);
  on_water_ = std::any_of(loads_.begin(), loads_.end(),
                          [](const SurfaceLoad& load) { return load.on == LoadedPhase::water; });
}

template <int D>
void SurfaceLoads<D>::begin_step(double begin, double length, const FluidLoad<D>* water,
                                 const IndexBox<D>& box) {
  begin_ = begin;
  length_ = length;
  water_ = water;
  box_ = box;
  steady_ = !water && std::none_of(loads_.begin(), loads_.end(),
                                   [](const SurfaceLoad& load) { return load.pressure.in_time; });
  filled_ = false;
}

/// Loads and water at `time`, on the cells of the box.
template <int D>
void SurfaceLoads<D>::fill(double time, bool against_flow) {
  const double late = length_ > 0.0 ? std::clamp((time - begin_) / length_, 0.0, 1.0) : 1.0;
  for_each(box_, [&](const Index<D>& cell) {
    const double water =
        water_ ? (1.0 - late) * water_->pressure_begin[cell] + late * water_->pressure_end[cell]
               : 0.0;
    traction_[cell] = water;
    drained_[cell] = against_flow ? water : 0.0;
  });
  for (const SurfaceLoad& load : loads_) {
    const bool on_water = load.on == LoadedPhase::water;
    const double everywhere = load.pressure.in_space ? 0.0 : load.pressure({}, time);
    for_each(box_, [&](const Index<D>& cell) {
      const double pressure = load.pressure.in_space
                                  ? load.pressure(to_point3(grid_->cell_centre(cell)), time)
                                  : everywhere;
      traction_[cell] += pressure;
      if (on_water) drained_[cell] += pressure;
    });
  }
}

template <int D>
SurfacePressure<D> SurfaceLoads<D>::at(double time) {
  if (!loaded()) return {};
  const bool against_flow = water_ && water_->outlet != PoreOutlet::at_zero_pressure;
  if (!steady_ || !filled_) fill(time, against_flow);
  filled_ = true;
  return {&traction_, against_flow || on_water_ ? &drained_ : nullptr};
}

template <int D>
void mark_occupied(const Grid<D>& grid, const SoilParticles<D>& points, CellField<D>& occupied) {
  for (std::size_t p = 0; p < points.size(); ++p)
    occupied[grid.cell_at(points.position_of(p))] = 1.0;
}

namespace {

/// Mean of a cell field over the corners of a facet: corners are means of the cells around them, so
/// the mean weighs the facet's two cells and their neighbours along the facet as 1:2:1 per
/// tangential axis.
template <int D>
double facet_mean(const CellField<D>& field, const Index<D>& face, int axis) {
  double sum = 0.0, weights = 0.0;
  IndexBox<D> around{face, face};
  for (int a = 0; a < D; ++a) {
    around.lower[a] = a == axis ? face[a] - 1 : face[a] - 1;
    around.upper[a] = a == axis ? face[a] + 1 : face[a] + 2;
  }
  for_each(around, [&](const Index<D>& cell) {
    double weight = 1.0;
    for (int a = 0; a < D; ++a)
      if (a != axis && cell[a] == face[a]) weight *= 2.0;
    sum += weight * field[cell];
    weights += weight;
  });
  return sum / weights;
}

}  // namespace

template <int D>
void add_facet_forces(const Grid<D>& grid, const CellField<D>& occupied,
                      const SurfacePressure<D>& surface, const IndexBox<D>& box,
                      NodeField<NodeSums, D>& nodes) {
  if (!surface.traction) return;
  for (int axis = 0; axis < D; ++axis) {
    const double area = grid.cell_volume() / grid.spacing()[axis];
    for_each(box.intersected(grid.owned_faces(axis)), [&](const Index<D>& face) {
      const Index<D> below = face.shifted(axis, -1);
      const double normal =
          occupied[below] - occupied[face];  // +1: soil below, normal points up the axis
      if (normal == 0.0) return;
      NodeSums& node = nodes[static_cast<std::size_t>(axis)][face];
      node.mixture_force -= normal * area * facet_mean(*surface.traction, face, axis);
      if (surface.drained)
        node.water_force -= normal * area * facet_mean(*surface.drained, face, axis);
    });
  }
}

template class SurfaceLoads<2>;
template class SurfaceLoads<3>;
template void mark_occupied(const Grid<2>&, const SoilParticles<2>&, CellField<2>&);
template void mark_occupied(const Grid<3>&, const SoilParticles<3>&, CellField<3>&);
template void add_facet_forces(const Grid<2>&, const CellField<2>&, const SurfacePressure<2>&,
                               const IndexBox<2>&, NodeField<NodeSums, 2>&);
template void add_facet_forces(const Grid<3>&, const CellField<3>&, const SurfacePressure<3>&,
                               const IndexBox<3>&, NodeField<NodeSums, 3>&);

}  // namespace mudlark

#include "soil/surface_load.hpp"

#include <algorithm>

namespace mudlark {

template <int D>
SurfaceLoads<D>::SurfaceLoads(const Grid<D>& grid, std::vector<SurfaceLoad> loads)
    : grid_(&grid),
      all_loads_(std::move(loads)),
      loads_begin_(grid, "load", "Pa"),
      loads_end_(grid, "load", "Pa"),
      water_begin_(grid, "load on water", "Pa"),
      water_end_(grid, "load on water", "Pa"),
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
  steady_ = !water;
  filled_ = false;
  if (loads_.empty()) return;
  for_each(box_, [&](const Index<D>& cell) {
    const Point3 place = to_point3(grid_->cell_centre(cell));
    double first = 0.0, last = 0.0, water_first = 0.0, water_last = 0.0;
    for (const SurfaceLoad& load : loads_) {
      const double now = load.pressure(place, begin), then = load.pressure(place, begin + length);
      first += now;
      last += then;
      if (load.on == LoadedPhase::water) water_first += now, water_last += then;
    }
    loads_begin_[cell] = first;
    loads_end_[cell] = last;
    water_begin_[cell] = water_first;
    water_end_[cell] = water_last;
    steady_ = steady_ && first == last && water_first == water_last;
  });
}

template <int D>
SurfacePressure<D> SurfaceLoads<D>::at(double time) {
  if (!loaded()) return {};
  const bool against_flow = water_ && water_->outlet != PoreOutlet::at_zero_pressure;
  if (!steady_ || !filled_) {
    const double late = length_ > 0.0 ? std::clamp((time - begin_) / length_, 0.0, 1.0) : 1.0;
    const double early = 1.0 - late;
    for_each(box_, [&](const Index<D>& cell) {
      const double load =
          loads_.empty() ? 0.0 : early * loads_begin_[cell] + late * loads_end_[cell];
      const double water =
          water_ ? early * water_->pressure_begin[cell] + late * water_->pressure_end[cell] : 0.0;
      traction_[cell] = load + water;
      drained_[cell] = (against_flow ? water : 0.0) +
                       (on_water_ ? early * water_begin_[cell] + late * water_end_[cell] : 0.0);
    });
    filled_ = true;
  }
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

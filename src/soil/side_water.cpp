#include "soil/side_water.hpp"

#include <algorithm>

#include "soil/side_slopes.hpp"
#include "soil/walls.hpp"

namespace mudlark {

template <int D>
SideWater<D>::SideWater(const SoilSides<D>& sides)
    : grid_(&sides.grid()),
      drains_(sides.has(WaterSide::pressure) || sides.has(WaterSide::seepage_face)),
      first_rank_(sides.grid().rank() == 0),
      slopes_(sides.grid(), "slopes at sides", "m^(D-1)") {
  for (std::size_t b = 0; b < sides.boundaries().size(); ++b) {
    const SoilBoundary& boundary = sides.boundaries()[b];
    if (!boundary.for_water) continue;
    names_.push_back(boundary.name);
    boundary_.push_back(b);
    where_.push_back({boundary.axis, boundary.side});
    if (boundary.water == WaterSide::seepage_face && !face_on(boundary.axis, boundary.side))
      faces_.push_back(
          {boundary.axis, boundary.side, CellField<D>(*grid_, "seepage face", "1", 1.0)});
  }
  volume_.assign(names_.size(), 0.0);
}

template <int D>
typename SideWater<D>::SeepageFace* SideWater<D>::face_on(int axis, int side) {
  const auto found = std::find_if(faces_.begin(), faces_.end(), [&](const SeepageFace& face) {
    return face.axis == axis && face.side == side;
  });
  return found == faces_.end() ? nullptr : &*found;
}

template <int D>
void SideWater<D>::measure(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                           const std::vector<SoilParticles<D>>& bodies) {
  for (int axis = 0; axis < D; ++axis) {
    const auto here = [&](const SoilBoundary& b) { return b.for_water && b.axis == axis; };
    if (std::any_of(sides.boundaries().begin(), sides.boundaries().end(), here))
      measure_side_slopes(sides, halo, kernel, bodies, axis, axis, Behind::folded, slopes_[axis]);
  }
}

/// Momentum of the water on a face whose grains are held, drag implicit.
template <int D>
void SideWater<D>::solve(SoilSides<D>& sides, Halo<D>& halo, double dt,
                         const std::array<IndexBox<D>, D>& faces,
                         const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion) {
  for_each_face_on_sides(
      sides, grid_->local(), [&](int axis, int side, const SideNode& node, const Index<D>& face) {
        if (!faces[static_cast<std::size_t>(axis)].contains(face)) return;
        const Index<D> cell = face.shifted(axis, -side);
        const bool seepage = sides.is_seepage_face(axis, side, cell);
        if (node.water != WaterSide::pressure && !seepage) return;
        const NodeSums& sum = sums[static_cast<std::size_t>(axis)][face];
        NodeMotion& moves = motion[static_cast<std::size_t>(axis)][face];
        moves = {node.velocity, node.velocity - node.velocity_before, node.velocity,
                 node.velocity - node.velocity_before, node.velocity};
        if (sum.water_mass <= 0.0) return;
        const double porosity = face_porosity(sum, sides.water_density());
        const double mass = sides.inertia() * sum.water_mass, drag = dt * sum.drag;
        const double old = sum.water_momentum / sum.water_mass;
        const double velocity =
            (mass * old + dt * porosity * sum.water_force + drag * node.velocity) / (mass + drag);
        const double out = (side == 0 ? -1.0 : 1.0) * (velocity - node.velocity);
        if (seepage) set_open(axis, side, cell, out > 0.0);
        if (seepage && out <= 0.0) return;
        moves.water_velocity = velocity;
        moves.water_change = velocity - old;
        moves.total_flux = node.velocity + porosity * (velocity - node.velocity);
      });
  if (has_seepage_faces()) spread(sides, halo);
}

template <int D>
void SideWater<D>::set_open(int axis, int side, const Index<D>& cell, bool open) {
  face_on(axis, side)->open[cell] = open ? 1.0 : 0.0;
}

template <int D>
void SideWater<D>::spread(SoilSides<D>& sides, Halo<D>& halo) {
  for (SeepageFace& face : faces_) {
    halo.exchange(face.open);
    sides.set_open(face.axis, face.side, face.open);
  }
}

template <int D>
void SideWater<D>::begin_outer_step(double length) {
  std::fill(volume_.begin(), volume_.end(), 0.0);
  length_ = length;
}

template <int D>
double SideWater<D>::total(double mine) const {
  return sum_over_ranks(*grid_, mine);
}

template <int D>
double SideWater<D>::discharge(const std::string& boundary) const {
  const auto found = std::find(names_.begin(), names_.end(), boundary);
  if (found == names_.end() || length_ == 0.0) return 0.0;
  return total(volume_[static_cast<std::size_t>(found - names_.begin())]) / length_;
}

template class SideWater<2>;
template class SideWater<3>;

}  // namespace mudlark

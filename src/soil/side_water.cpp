#include "soil/side_water.hpp"

#include <algorithm>
#include <utility>

#include "soil/side_slopes.hpp"
#include "soil/walls.hpp"

namespace mudlark {

template <int D>
SideWater<D>::SideWater(const SoilSides<D>& sides)
    : grid_(&sides.grid()), first_rank_(sides.grid().rank() == 0) {
  for (std::size_t b = 0; b < sides.boundaries().size(); ++b) {
    const SoilBoundary& boundary = sides.boundaries()[b];
    if (!boundary.for_water) continue;
    names_.push_back(boundary.name);
    boundary_.push_back(b);
    where_.push_back({boundary.axis, boundary.side});
    const bool drain =
        boundary.water == WaterSide::pressure || boundary.water == WaterSide::seepage_face;
    if (drain && !drain_on(boundary.axis, boundary.side))
      drains_.push_back({boundary.axis, boundary.side,
                         CellField<D>(*grid_, "pressure on side", "Pa"),
                         CellField<D>(*grid_, "seepage face", "1", 1.0)});
  }
  volume_.assign(names_.size(), 0.0);
  pushes_.resize(drains() ? D : 0);
  for (const Drain& drain : drains_)
    if (auto& push = pushes_[static_cast<std::size_t>(drain.axis)]; !push)
      push.emplace(*grid_, "push of a side on water", "N");
}

template <int D>
const typename SideWater<D>::Drain* SideWater<D>::drain_on(int axis, int side) const {
  const auto found = std::find_if(drains_.begin(), drains_.end(), [&](const Drain& drain) {
    return drain.axis == axis && drain.side == side;
  });
  return found == drains_.end() ? nullptr : &*found;
}
template <int D>
typename SideWater<D>::Drain* SideWater<D>::drain_on(int axis, int side) {
  return const_cast<Drain*>(std::as_const(*this).drain_on(axis, side));
}

template <int D>
void SideWater<D>::measure(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                           const std::vector<SoilParticles<D>>& bodies) {
  for (int axis = 0; axis < D; ++axis) {
    auto& push = pushes_[static_cast<std::size_t>(axis)];
    if (!push) continue;
    const auto pressure = [&](int side, const Vec<D>& position) {
      return sides.pressure_opposite(axis, side, position);
    };
    for (int d = 0; d < D; ++d)
      measure_side_slopes<D>(sides, halo, kernel, bodies, {axis, d, d, axis}, pressure, (*push)[d]);
  }
}

/// Momentum of the water on a face whose grains are held, drag implicit.
template <int D>
void SideWater<D>::solve(SoilSides<D>& sides, Halo<D>& halo, double dt,
                         const std::array<IndexBox<D>, D>& faces,
                         const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion) {
  for (Drain& drain : drains_) {
    const int axis = drain.axis;
    const auto u = static_cast<std::size_t>(axis);
    for_each_face_on_sides(
        sides, faces[u], axis, [&](int side, const SideNode& node, const Index<D>& face) {
          if (side != drain.side) return;
          const Index<D> cell = face.shifted(axis, -side);
          const bool seepage = sides.is_seepage_face(axis, side, cell);
          if (node.water != WaterSide::pressure && !seepage) return;
          const NodeSums& sum = sums[u][face];
          NodeMotion& moves = motion[u][face];
          const double change = node.velocity - node.velocity_before;
          moves = {node.velocity, change, node.velocity, change, node.velocity};
          if (sum.water_mass <= 0.0) return;
          const double porosity = face_porosity(sum, sides.water_density());
          const double mass = sides.inertia() * sum.water_mass, drag = dt * sum.drag;
          const double old = sum.water_momentum / sum.water_mass;
          const double velocity =
              (mass * old + dt * porosity * sum.water_force + drag * node.velocity) / (mass + drag);
          const double out = (side == 0 ? -1.0 : 1.0) * (velocity - node.velocity);
          if (seepage) drain.open[cell] = out > 0.0 ? 1.0 : 0.0;
          if (seepage && out <= 0.0) return;
          moves.water_velocity = velocity;
          moves.water_change = velocity - old;
          moves.total_flux = node.velocity + porosity * (velocity - node.velocity);
        });
  }
  if (sides.has(WaterSide::seepage_face)) spread(sides, halo);
}

namespace {

/// Straight line through the pressures of points beside a cell's part of a side, by distance.
struct Line {
  double count = 0.0, distance = 0.0, square = 0.0, value = 0.0, product = 0.0;

  void add(double d, double p) {
    count += 1.0, distance += d, square += d * d, value += p, product += d * p;
  }
  double at_zero() const {
    const double spread = count * square - distance * distance;
    if (!(spread > 1e-6 * count * square)) return count > 0.0 ? value / count : 0.0;
    return (square * value - distance * product) / spread;
  }
};

}  // namespace

/// Reads the pressure on the sides off the points in the two rows of cells next to them.
template <int D>
void SideWater<D>::start(const SoilSides<D>& sides, const std::vector<SoilParticles<D>>& bodies) {
  const Grid<D>& grid = *grid_;
  for (Drain& drain : drains_) {
    if (!grid.touches(drain.axis, drain.side)) continue;
    std::vector<Line> lines(grid.local_size());
    const double side = drain.side == 0 ? grid.lower()[drain.axis] : grid.upper()[drain.axis];
    for (const auto& points : bodies)
      for (std::size_t p = 0; p < points.size(); ++p) {
        const double away = (drain.side == 0 ? 1.0 : -1.0) *
                            (points.position[drain.axis][p] - side) / grid.spacing()[drain.axis];
        if (away > 2.0) continue;
        Index<D> cell = grid.cell_at(points.position_of(p));
        for (int a = 0; a < D; ++a) cell[a] = std::clamp(cell[a], 0, grid.cells()[a] - 1);
        cell[drain.axis] = drain.side == 0 ? 0 : grid.cells()[drain.axis] - 1;
        lines[static_cast<std::size_t>(grid.offset(cell))].add(away, points.pore_pressure[p]);
      }
    for_each_cell_at(sides, drain.axis, drain.side, [&](const Index<D>& cell) {
      drain.pressure[cell] = lines[static_cast<std::size_t>(grid.offset(cell))].at_zero();
    });
  }
  started_ = true;
}

template <int D>
void SideWater<D>::mirror_fluxes(const SoilSides<D>& sides, double dt, double water_bulk_modulus,
                                 const std::vector<SoilParticles<D>>& bodies,
                                 const NodeField<NodeSums, D>& sums,
                                 NodeField<NodeMotion, D>& motion) {
  if (!started_) start(sides, bodies);
  for (Drain& drain : drains_) {
    for_each_cell_at(sides, drain.axis, drain.side, [&](const Index<D>& cell) {
      mirror_flux(sides, drain, cell, dt, water_bulk_modulus, sums, motion);
    });
    for (int other = 0; other < D; ++other)
      if (other != drain.axis)
        mirror_component(sides, other, drain.axis, grid_->local(), sums, motion);
  }
}

template <int D>
void SideWater<D>::mirror_flux(const SoilSides<D>& sides, Drain& drain, const Index<D>& cell,
                               double dt, double water_bulk_modulus,
                               const NodeField<NodeSums, D>& sums,
                               NodeField<NodeMotion, D>& motion) {
  const int axis = drain.axis, inwards = drain.side == 0 ? 1 : -1;
  auto& normal = motion[static_cast<std::size_t>(axis)];
  const Index<D> face = cell.shifted(axis, drain.side);
  const double porosity =
      face_porosity(sums[static_cast<std::size_t>(axis)][face], sides.water_density());
  if (porosity <= 0.0) return;
  const auto along = [&](const Index<D>& at) {  // divergence of what flows along the side
    double sum = 0.0;
    for (int d = 0; d < D; ++d) {
      if (d == axis) continue;
      const auto& field = motion[static_cast<std::size_t>(d)];
      sum += (field[at.shifted(d, 1)].total_flux - field[at].total_flux) / grid_->spacing()[d];
    }
    return sum;
  };
  const auto across = [&](const Index<D>& at) {
    return (normal[at.shifted(axis, 1)].total_flux - normal[at].total_flux) /
           grid_->spacing()[axis];
  };
  const double storage = porosity / water_bulk_modulus;
  if (sides.water(axis, drain.side, cell) != WaterSide::pressure) {  // a closed seepage face
    drain.pressure[cell] -= dt / storage * (across(cell) + along(cell));
    return;
  }
  const double pressure = sides.water_value(axis, drain.side, cell);
  const double on_side = -storage * (pressure - drain.pressure[cell]) / dt;
  drain.pressure[cell] = pressure;
  for (int layer = 0; layer < ghost_layers - 1; ++layer) {
    const Index<D> before = cell.shifted(axis, inwards * layer);
    const Index<D> behind = cell.shifted(axis, -inwards * (layer + 1));
    const double divergence = 2.0 * on_side - across(before) - along(before) - along(behind);
    // The outer face of the cell behind.
    const Index<D> outer = behind.shifted(axis, drain.side), inner = outer.shifted(axis, inwards);
    NodeMotion& image = normal[outer];
    const NodeMotion& origin = normal[inner.shifted(axis, inwards * (2 * layer + 1))];
    image.total_flux = normal[inner].total_flux - inwards * grid_->spacing()[axis] * divergence;
    const double n = face_porosity(
        sums[static_cast<std::size_t>(axis)][inner.shifted(axis, inwards * (2 * layer + 1))],
        sides.water_density());
    const double slip = n > 0.0 ? (image.total_flux - image.grain_velocity) / n : 0.0;
    image.water_velocity = image.grain_velocity + slip;
    image.water_change = origin.water_change;
  }
}

template <int D>
void SideWater<D>::spread(SoilSides<D>& sides, Halo<D>& halo) {
  for (Drain& drain : drains_) {
    halo.exchange(drain.open);
    sides.set_open(drain.axis, drain.side, drain.open);
  }
}

template <int D>
void SideWater<D>::begin_implicit_step(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                                       const std::vector<SoilParticles<D>>& bodies) {
  if (!drains()) return;
  if (!started_) start(sides, bodies);
  measure(sides, halo, kernel, bodies);
  for (Drain& drain : drains_) halo.exchange(drain.pressure);
}

template <int D>
double SideWater<D>::rise(const SoilSides<D>& sides, int axis, int side,
                          const Index<D>& cell) const {
  const Index<D> at = sides.original_on_rank(axis, side, cell);
  return sides.water_value(axis, side, at) - drain_on(axis, side)->pressure[at];
}

template <int D>
bool SideWater<D>::review(SoilSides<D>& sides, Halo<D>& halo, const FaceVector<D>& way,
                          const CellField<D>& rise) {
  if (!sides.has(WaterSide::seepage_face)) return true;
  double switched = 0.0;
  for (Drain& drain : drains_)
    for_each_cell_at(sides, drain.axis, drain.side, [&](const Index<D>& cell) {
      if (!sides.is_seepage_face(drain.axis, drain.side, cell)) return;
      const double outwards = drain.side == 0 ? -1.0 : 1.0;
      const Index<D> face = cell.shifted(drain.axis, drain.side);
      double& open = drain.open[cell];
      const bool right = open != 0.0 ? outwards * way[drain.axis][face] >= 0.0
                                     : drain.pressure[cell] + rise[cell] <= 0.0;
      if (right) return;
      open = 1.0 - open;
      switched = 1.0;
    });
  if (max_over_ranks(*grid_, switched) == 0.0) return true;
  spread(sides, halo);
  return false;
}

template <int D>
void SideWater<D>::end_implicit_step(const SoilSides<D>& sides, const CellField<D>& rise) {
  for (Drain& drain : drains_)
    for_each_cell_at(sides, drain.axis, drain.side, [&](const Index<D>& cell) {
      const WaterSide kind = sides.water(drain.axis, drain.side, cell);
      if (kind == WaterSide::pressure)
        drain.pressure[cell] = sides.water_value(drain.axis, drain.side, cell);
      else
        drain.pressure[cell] += rise[cell];  // even about the side
    });
}

template <int D>
typename SideWater<D>::State SideWater<D>::state() const {
  State state{{}, volume_};
  for (const Drain& drain : drains_) {
    state.fields.push_back(drain.pressure.copy());
    state.fields.push_back(drain.open.copy());
  }
  return state;
}

template <int D>
void SideWater<D>::restore(const State& state, SoilSides<D>& sides, Halo<D>& halo) {
  volume_ = state.volume;
  for (std::size_t i = 0; i < drains_.size(); ++i) {
    drains_[i].pressure.copy_values_from(state.fields[2 * i]);
    drains_[i].open.copy_values_from(state.fields[2 * i + 1]);
  }
  spread(sides, halo);
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

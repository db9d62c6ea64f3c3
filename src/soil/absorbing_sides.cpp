#include "soil/absorbing_sides.hpp"

#include <algorithm>
#include <cmath>

#include "soil/side_slopes.hpp"

namespace mudlark {
namespace {

template <int D>
Index<D> inside(const Grid<D>& grid, Index<D> cell) {
  for (int a = 0; a < D; ++a) cell[a] = std::clamp(cell[a], 0, grid.cells()[a] - 1);
  return cell;
}

/// Adds the mass and stiffness of one body's points to their cells.
template <int D>
void add_stiffness(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                   const SoilModel& law, double water_bulk_modulus, SoilStiffness<D>& soil) {
  std::vector<double> history(points.history.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Index<D> cell = inside(grid, grid.cell_at(points.position_of(p)));
    const double volume = points.volume[p];
    const double solid = points.grain_mass[p] / (body.grain_density * volume);
    const bool wet = body.water_density > 0.0;
    const SymTensor stress = get_tensor(points.stress, p);
    for (std::size_t h = 0; h < history.size(); ++h) history[h] = points.history[h][p];
    const double modulus = law.wave_modulus({&stress, 1}, history);
    soil.volume[cell] += volume;
    soil.density[cell] +=
        points.grain_mass[p] + (wet ? (1.0 - solid) * volume * body.water_density : 0.0);
    soil.compression[cell] += volume * (modulus + (wet ? water_bulk_modulus / (1.0 - solid) : 0.0));
    soil.shear[cell] += volume * law.shear_modulus();
  }
}

}  // namespace

template <int D>
AbsorbingSides<D>::AbsorbingSides(const SoilSides<D>& sides)
    : grid_(&sides.grid()), any_(sides.has(GrainSide::absorbing)) {
  if (!any_) return;
  const Grid<D>& grid = *grid_;
  for (int axis = 0; axis < D; ++axis) slopes_.emplace_back(grid, "slopes at sides", "m^(D-1)");
  for (const SoilBoundary& boundary : sides.boundaries())
    if (boundary.grains == GrainSide::absorbing && boundary.for_grains)
      across_[static_cast<std::size_t>(boundary.axis)] = true;
  std::map<std::int64_t, std::size_t> known;
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(axis, side) || !sides.lets_through(axis, side)) continue;
      const int outwards = side == 0 ? -1 : 1;
      IndexBox<D> row = grid.local();
      row.lower[axis] = side == 0 ? 0 : grid.cells()[axis] - 1;
      row.upper[axis] = row.lower[axis] + 1;
      for_each(row, [&](const Index<D>& cell) {
        for (int d = 0; d < D; ++d) {
          if (d == axis) {
            const Index<D> on = cell.shifted(axis, side), behind = on.shifted(axis, outwards);
            add_node(sides, axis, side, d, on, on, false, known);
            add_node(sides, axis, side, d, behind, behind, false, known);
            add_node(sides, axis, side, d, on.shifted(axis, -outwards), behind, true, known);
          } else {
            const Index<D> behind = cell.shifted(axis, outwards);
            add_node(sides, axis, side, d, behind, behind, false, known);
            add_node(sides, axis, side, d, cell, behind, true, known);
          }
        }
      });
    }
}

/// Joins a node to a side where the side absorbs. A node in a corner belongs to two sides.
template <int D>
void AbsorbingSides<D>::add_node(const SoilSides<D>& sides, int axis, int side, int component,
                                 const Index<D>& index, const Index<D>& behind, bool inner,
                                 std::map<std::int64_t, std::size_t>& known) {
  const Grid<D>& grid = *grid_;
  if (sides.node(axis, side, component, index).mirrored) return;
  const bool here = sides.absorber(axis, side, index);
  const bool there = component != axis && sides.absorber(axis, side, index.shifted(component, -1));
  if (!here && !there) return;
  // Nodes that this rank solves: its own, and those behind sides that grains go through.
  IndexBox<D> solved = grid.owned_faces(component);
  for (int a = 0; a < D; ++a) {
    if (sides.lets_through(a, 0)) solved.lower[a] = grid.local().lower[a];
    if (sides.lets_through(a, 1)) solved.upper[a] = grid.local().upper[a];
  }
  if (!solved.contains(index)) return;
  const auto [place, first] = known.emplace(key_of(component, index), nodes_.size());
  if (first) {
    nodes_.emplace_back();
    nodes_.back().component = component;
    nodes_.back().index = index;
    nodes_.back().at = grid.offset(index);
    nodes_.back().share.fill(-1);
  }
  Node& node = nodes_[place->second];
  node.share[static_cast<std::size_t>(axis)] = grid.offset(behind);
  node.sign[axis] = side == 0 ? -1.0 : 1.0;
  if (component != axis) return;
  node.normal = true;
  if (inner) node.inner = grid.offset(behind);
}

template <int D>
void AbsorbingSides<D>::measure(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                                const std::vector<SoilParticles<D>>& bodies) {
  const auto area = [](int, const Vec<D>&) { return 1.0; };
  for (int axis = 0; axis < D; ++axis)
    if (across_[static_cast<std::size_t>(axis)])
      for (int d = 0; d < D; ++d)
        measure_side_slopes<D>(sides, halo, kernel, bodies, {axis, d, axis, D}, area,
                               slopes_[static_cast<std::size_t>(axis)][d]);
}

template <int D>
void AbsorbingSides<D>::set_stiffness(const SoilSides<D>& sides, const SoilStiffness<D>& soil,
                                      Node& node, int axis) const {
  const int side = node.sign[axis] < 0.0 ? 0 : 1;
  double volume = 0.0, density = 0.0, modulus = 0.0;
  const Absorber* absorber = nullptr;
  for (const int back : {0, 1}) {
    if (back == 1 && node.component == axis) break;
    const Index<D> cell = node.index.shifted(node.component, -back);
    const Absorber* own = sides.absorber(axis, side, cell);
    if (!own) continue;
    absorber = own;
    Index<D> at = inside(*grid_, cell);
    at[axis] = side == 0 ? 0 : grid_->cells()[axis] - 1;
    if (!grid_->local().contains(at)) continue;
    volume += soil.volume[at];
    density += soil.density[at];
    modulus += node.component == axis ? soil.compression[at] : soil.shear[at];
  }
  if (!absorber || volume <= 0.0) return;
  density /= volume, modulus /= volume;
  const double share = node.component == axis ? absorber->normal : absorber->tangential;
  node.dashpot[axis] = share * std::sqrt(density * modulus);
  node.spring[axis] = modulus / absorber->thickness;
}

template <int D>
void AbsorbingSides<D>::start(const SoilSides<D>& sides, Halo<D>& halo,
                              const std::vector<SoilParticles<D>>& bodies,
                              const std::vector<BodyConstants>& constants,
                              const std::vector<std::unique_ptr<SoilModel>>& laws,
                              double water_bulk_modulus, const NodeField<NodeSums, D>& sums) {
  SoilStiffness<D> soil(*grid_);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    add_stiffness(*grid_, bodies[b], constants[b], *laws[b], water_bulk_modulus, soil);
  const std::array<double*, 4> all{soil.volume.data(), soil.density.data(), soil.compression.data(),
                                   soil.shear.data()};
  halo.exchange(all);
  for (Node& node : nodes_) {
    const NodeSums& sum = sums[static_cast<std::size_t>(node.component)].data()[node.at];
    for (int axis = 0; axis < D; ++axis)
      if (node.share[static_cast<std::size_t>(axis)] >= 0) set_stiffness(sides, soil, node, axis);
    const double mass = sum.grain_mass + sum.water_mass;
    node.water_share = mass > 0.0 ? sum.water_mass / mass : 0.0;
    node.reaction = -sum.mixture_force;
    node.stretch = 0.0;
  }
  started_ = true;
}

template <int D>
void AbsorbingSides<D>::add_forces(NodeField<NodeSums, D>& sums) const {
  for (const Node& node : nodes_) {
    auto& field = sums[static_cast<std::size_t>(node.component)];
    NodeSums& sum = field.data()[node.at];
    if (sum.volume <= 0.0) continue;
    sum.mixture_force += node.reaction;
    for (int a = 0; a < D; ++a) sum.mixture_force -= area(node, a) * node.spring[a] * node.stretch;
    // The wall's push on the water that it seals in, as images would give it.
    if (node.inner >= 0) sum.water_force -= field.data()[node.inner].water_force;
  }
}

/// Seepage velocities are odd about a side that is sealed.
template <int D>
void AbsorbingSides<D>::seal(NodeField<NodeMotion, D>& motion) const {
  for (const Node& node : nodes_) {
    if (node.inner < 0) continue;
    auto& field = motion[static_cast<std::size_t>(node.component)];
    const NodeMotion& before = field.data()[node.at];
    NodeMotion& behind = field.data()[node.inner];
    behind.total_flux = behind.grain_velocity - (before.total_flux - before.grain_velocity);
  }
}

/// One number for each node of the domain, those behind its sides included.
template <int D>
std::int64_t AbsorbingSides<D>::key_of(int component, const Index<D>& index) const {
  std::int64_t key = component;
  for (int a = 0; a < D; ++a)
    key = key * (grid_->cells()[a] + 2 * ghost_layers + 1) + index[a] + ghost_layers;
  return key;
}

template <int D>
std::vector<double> AbsorbingSides<D>::pack() const {
  std::vector<double> values;
  for (const Node& node : nodes_) {
    values.push_back(static_cast<double>(key_of(node.component, node.index)));
    values.push_back(node.reaction);
    values.push_back(node.stretch);
    values.push_back(node.water_share);
    for (int a = 0; a < D; ++a) values.push_back(node.dashpot[a]), values.push_back(node.spring[a]);
  }
  return values;
}

template <int D>
void AbsorbingSides<D>::unpack(const std::vector<double>& mine) {
  int length = static_cast<int>(mine.size()), total = 0;
  std::vector<int> lengths(static_cast<std::size_t>(grid_->ranks())), places(lengths.size());
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, grid_->comm());
  for (std::size_t r = 0; r < lengths.size(); ++r) places[r] = total, total += lengths[r];
  std::vector<double> all(static_cast<std::size_t>(total));
  MPI_Allgatherv(mine.data(), length, MPI_DOUBLE, all.data(), lengths.data(), places.data(),
                 MPI_DOUBLE, grid_->comm());
  std::map<std::int64_t, const double*> found;
  for (std::size_t at = 0; at < all.size(); at += saved)
    found[static_cast<std::int64_t>(all[at])] = &all[at];
  for (Node& node : nodes_) {
    const auto entry = found.find(key_of(node.component, node.index));
    if (entry == found.end()) continue;
    const double* values = entry->second;
    node.reaction = values[1], node.stretch = values[2], node.water_share = values[3];
    for (int a = 0; a < D; ++a)
      node.dashpot[a] = values[4 + 2 * a], node.spring[a] = values[5 + 2 * a];
  }
}

template class AbsorbingSides<2>;
template class AbsorbingSides<3>;

}  // namespace mudlark

#include "coupling/unified_coupling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "flow/flow_checks.hpp"

namespace mudlark {
namespace {

/// Faces with fewer grains than this share of a cell carry none: their velocity is round-off.
constexpr double least_share = 1e-12;
/// Cells with more grains than this are soil for water that falls in them, not open space.
constexpr double rim = 0.2;

}  // namespace

template <int D>
UnifiedCoupling<D>::UnifiedCoupling(const Grid<D>& grid, const SoilSolver<D>& soil,
                                    GrainShare share)
    : grid_(&grid),
      halo_(grid),
      room_(grid),
      end_(grid),
      drag_(grid, soil.options()),
      pressure_(grid, "pressure", "Pa"),
      open_(grid, "open", "1"),
      wet_(grid, "wet", "1"),
      grains_(grid),
      change_(grid, "grain change", "m/s"),
      before_(grid, "grain velocity before", "m/s") {
  if (!soil.options().solids.empty()) extension_.emplace(grid);
  const auto& bodies = soil.options().bodies;
  grains_.filling = bodies.front().filling;
  grains_.fill_faces = share == GrainShare::cells;
  for (const SoilBody& body : bodies)
    strongest_suction_ = std::max(strongest_suction_, body.filling.suction);
  grains_.hold_water = strongest_suction_ > 0.0;
}

template <int D>
void UnifiedCoupling<D>::map_soil_to_grid(SoilSolver<D>& soil, const PorousMedium<D>& fixed,
                                          PorousMedium<D>& medium) {
  room_.find(soil, fixed, medium);
  map_partly_filled(soil, fixed, medium);
  if (grains_.fill_faces) find_room(fixed, medium.space);
  if (drag_.active()) return;
  for (int a = 0; a < D; ++a)
    room_.for_each_inner_face(a, [&](const Index<D>& face) {
      const double open = medium.space.aperture[a][face];  // only there water resists
      grains_.resistance[a][face] = open > 0.0 ? room_.resistance_at(a, face) / open : 0.0;
    });
  resist_at_sides(medium.space);
}

/// On closed sides, which may let water through, there is the ground of the cells before them.
template <int D>
void UnifiedCoupling<D>::resist_at_sides(const Space<D>& space) {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid_->touches(axis, side) || grid_->wall(axis, side) == Wall::open) continue;
      for_each(wall_faces(*grid_, axis, side), [&](const Index<D>& face) {
        const Index<D> before = face.shifted(axis, side == 0 ? 1 : -1);
        double& here = grains_.resistance[axis][face];
        if (drag_.active()) {
          if (grid_->cells()[axis] > 1) here = grains_.resistance[axis][before];
          return;
        }
        const double open = space.aperture[axis][face];
        const Index<D> cell = side == 0 ? face : before;
        here = open > 0.0 ? room_.resistance_in(cell) / open : 0.0;
      });
    }
}

template <int D>
void UnifiedCoupling<D>::find_room(const PorousMedium<D>& fixed, const Space<D>& space) {
  for (int a = 0; a < D; ++a)
    room_.for_each_inner_face(a, [&](const Index<D>& face) {
      const auto ground = [&](const Index<D>& cell) {
        return space.volume[cell] > 0.0 ? fixed.porosity[cell] : 1.0;
      };
      grains_.room[a][face] =
          space.aperture[a][face] * 0.5 * (ground(face) + ground(face.shifted(a, -1)));
    });
}

/// Where water in pores that are not full goes by a relative permeability, and how it is held.
template <int D>
void UnifiedCoupling<D>::map_partly_filled(SoilSolver<D>& soil, const PorousMedium<D>& fixed,
                                           PorousMedium<D>& medium) {
  for_each(grid_->local(), [&](const Index<D>& cell) {
    medium.drains[cell] = std::max(fixed.drains[cell], room_.fraction()[cell] > rim ? 1.0 : 0.0);
  });
  const auto suction = [](const SoilBody& body) { return body.filling.suction; };
  spread(suction, strongest_suction_, soil, fixed.suction, medium.suction);
  const auto held = [](const SoilBody& body) { return body.filling.residual * body.porosity; };
  spread(held, 1.0, soil, fixed.residual, medium.residual);
}

template <int D>
void UnifiedCoupling<D>::map_start(SoilSolver<D>& soil, const PorousMedium<D>& fixed,
                                   PorousMedium<D>& medium) const {
  const auto filled = [](const SoilBody& body) { return body.filling.at_start * body.porosity; };
  spread(filled, 1.0, soil, fixed.at_start, medium.at_start);
}

/// Beside bodies as much as far from them, where grains were squeezed no more than `most`.
template <int D>
void UnifiedCoupling<D>::spread(double (*value)(const SoilBody&), double most, SoilSolver<D>& soil,
                                const CellField<D>& fixed, CellField<D>& field) const {
  const auto& bodies = soil.options().bodies;
  if (std::none_of(bodies.begin(), bodies.end(),
                   [&](const SoilBody& body) { return value(body) > 0.0; }))
    return;
  soil.spread_over_grains(value, field);
  for_each(grid_->local(), [&](const Index<D>& cell) {
    field[cell] = std::min(field[cell] / room_.reach_at(cell), most) + fixed[cell];
  });
}

template <int D>
void UnifiedCoupling<D>::move_grains(SoilSolver<D>& soil, double dt) {
  soil.move_with(grains_.velocity, change_, dt);
}

/// What was not in balance in the last step [N/m3]: what moved the grains, less the damping that it
/// had.
template <int D>
double UnifiedCoupling<D>::unbalanced_force(int axis, const Index<D>& face, double damping) const {
  const double change = change_[axis][face];
  const double before = grains_.velocity[axis][face] - change;
  const double had = before == 0.0 ? 1.0 : change * before > 0.0 ? 1.0 - damping : 1.0 + damping;
  return grains_.inertia[axis][face] * std::abs(change) / (had * last_step_);
}

/// Local damping (Cundall 1987) [N/m3]: a share of the force that is not in balance, against the
/// motion; that of the last step, as pressure and drag of the coming one, which the water has a
/// part in, are found after.
template <int D>
double UnifiedCoupling<D>::damping_force(int axis, const Index<D>& face, double velocity,
                                         double damping) const {
  if (last_step_ <= 0.0 || velocity == 0.0) return 0.0;
  return -std::copysign(damping * unbalanced_force(axis, face, damping), velocity);
}

/// Sums of the points as densities. The share of the grains is that of their mass on the same
/// face, not one minus the cells' porosity: then grains at rest in water at rest weigh exactly what
/// they weigh under water, wherever the points stand (docs/decisions/0070).
template <int D>
void UnifiedCoupling<D>::load_grains(const FlowSolver<D>& flow, const Space<D>& space,
                                     SoilSolver<D>& soil, double dt) {
  const NodeField<NodeSums, D>& sums = soil.load_faces(dt);
  const double per_volume = 1.0 / grid_->cell_volume();
  const double damping = soil.options().damping, inertia = soil.options().mass_scaling;
  for (int a = 0; a < D; ++a) {
    const auto& field = sums[static_cast<std::size_t>(a)];
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      const bool inside = soil.active().contains(face);
      const NodeSums sum = inside ? field[face] : NodeSums{};
      const double share = sum.volume * per_volume;
      const bool carries = share > least_share;
      const double velocity = carries ? sum.grain_momentum / sum.grain_mass : 0.0;
      grains_.share[a][face] = carries ? share : 0.0;
      grains_.inertia[a][face] = carries ? inertia * sum.grain_mass * per_volume : 0.0;
      const double damped = damping > 0.0 ? damping_force(a, face, velocity, damping) : 0.0;
      grains_.force[a][face] = carries ? sum.mixture_force * per_volume + damped : 0.0;
      grains_.velocity[a][face] = velocity;
    });
    before_[a].copy_values_from(grains_.velocity[a]);
  }
  if (extension_) push_beside_solids(space);
  std::array<double*, std::size_t{4} * D> fields{};
  std::size_t number = 0;
  for (FaceVector<D>* field : {&grains_.share, &grains_.inertia, &grains_.force, &grains_.velocity})
    for (int a = 0; a < D; ++a) fields[number++] = (*field)[a].data();
  halo_.exchange(fields);
  if (drag_.active()) {
    drag_.find(room_, space, flow.velocity(), grains_);
    resist_at_sides(space);
    std::array<double*, std::size_t{D}> resistance{};
    for (int a = 0; a < D; ++a)
      resistance[static_cast<std::size_t>(a)] = grains_.resistance[a].data();
    halo_.exchange(resistance);
  }
  last_step_ = dt;
}

template <int D>
void UnifiedCoupling<D>::end_ground(const FlowSolver<D>& flow, const Space<D>& space,
                                    SoilSolver<D>& soil) {
  if (drag_.active()) return;
  end_.find(soil, room_, space);
  end_.sharpen(flow.velocity(), flow.saturation(), grains_);
}

/// On the part of a face that lies in a body grains share no flux with the water, only its
/// pressure: that of the last step, continued into the body. So they keep their weight under water.
template <int D>
void UnifiedCoupling<D>::push_beside_solids(const Space<D>& space) {
  for (int a = 0; a < D; ++a) {
    const double per_length = 1.0 / grid_->spacing()[a];
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      const double open = space.aperture[a][face];
      double& share = grains_.share[a][face];
      if (open == 1.0 || share == 0.0) return;
      const double gradient = (pressure_[face] - pressure_[face.shifted(a, -1)]) * per_length;
      grains_.force[a][face] -= (1.0 - open) * share * gradient;
      share *= open;
    });
  }
}

template <int D>
void UnifiedCoupling<D>::follow_water(const FlowSolver<D>& flow, SoilSolver<D>& soil, double dt) {
  soil.press_solids(grains_.velocity, dt);
  soil.rub_walls(before_, dt, grains_.velocity);
  for (int a = 0; a < D; ++a)
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      change_[a][face] = grains_.velocity[a][face] - before_[a][face];
    });
  note_pore_pressure(flow, soil);
}

/// Two layers deep: as far as the kernels of points beside a body reach.
template <int D>
void UnifiedCoupling<D>::extend_into_solids(const FlowSolver<D>& flow) {
  const CellField<D>& room = flow.porosity();
  for_each(grid_->local(), [&](const Index<D>& cell) {
    open_[cell] = room[cell] > 0.0 ? 1.0 : 0.0;
    wet_[cell] = flow.saturation()[cell] >= 0.5 ? 1.0 : 0.0;
  });
  extension_->extend(open_, wet_, flow.density(), grid_->global(), pressure_, 2);
}

/// What points show as pore pressure. Behind closed sides it goes on straight, or points beside a
/// floor would show less than their depth.
template <int D>
void UnifiedCoupling<D>::note_pore_pressure(const FlowSolver<D>& flow, SoilSolver<D>& soil) {
  pressure_.copy_values_from(flow.pressure());
  if (extension_) extend_into_solids(flow);
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid_->touches(axis, side) || grid_->wall(axis, side) == Wall::open) continue;
      IndexBox<D> behind = grid_->local();
      behind.lower[axis] = side == 0 ? -2 : grid_->cells()[axis];
      behind.upper[axis] = behind.lower[axis] + 2;
      for_each(behind, [&](const Index<D>& cell) {
        Index<D> first = cell, second = cell;
        first[axis] = side == 0 ? 0 : grid_->cells()[axis] - 1;
        second[axis] = first[axis] + (side == 0 ? 1 : -1);
        const bool wet = flow.saturation()[first] >= 0.5 && flow.saturation()[second] >= 0.5;
        if (grid_->cells()[axis] < 2 || !wet) return;
        const int layer = std::abs(cell[axis] - first[axis]);
        pressure_[cell] = pressure_[first] + layer * (pressure_[first] - pressure_[second]);
      });
    }
  soil.set_pore_pressure(pressure_);
}

template <int D>
Vec<D> UnifiedCoupling<D>::grain_momentum() const {
  Vec<D> sum{};
  for (int a = 0; a < D; ++a) {
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      sum[a] += grains_.inertia[a][face] * grains_.velocity[a][face];
    });
    sum[a] = sum_over_ranks(*grid_, sum[a]) * grid_->cell_volume();
  }
  return sum;
}

/// As after a step in which nothing changed.
template <int D>
void UnifiedCoupling<D>::initialise(const FlowSolver<D>& flow, const Space<D>& space,
                                    SoilSolver<D>& soil) {
  note_pore_pressure(flow, soil);
  load_grains(flow, space, soil, 1.0);
  for (Solid& solid : soil.solids())
    if (solid.free()) solid.start(false);  // that was no step
  change_.fill(0.0);
  last_step_ = 0.0;
}

template class UnifiedCoupling<2>;
template class UnifiedCoupling<3>;

}  // namespace mudlark

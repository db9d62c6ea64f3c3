#include "flow/ground_sides.hpp"

#include <algorithm>
#include <cmath>

#include "flow/flow_checks.hpp"
#include "flow/partly_filled.hpp"
#include "numerics/interface_advection.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// What heads mean in a case without gravity [m/s2].
constexpr double standard_gravity = 9.81;

}  // namespace

template <int D>
GroundSides<D>::GroundSides(const Grid<D>& grid, const std::vector<GroundSideOptions>& options,
                            double density)
    : grid_(&grid),
      halo_(grid),
      density_(density),
      passes_(grid, "passes", "1"),
      two_ways_(grid, "passes both ways", "1"),
      open_(grid, "open water", "1"),
      inflow_(grid, "share of water in inflow", "1"),
      pressure_(grid, "pressure on sides", "Pa"),
      through_(grid, "velocity on sides", "m/s"),
      alone_(grid, "mobility on sides", "m2 s/kg") {
  for (const GroundSideOptions& one : options)
    sides_.push_back(
        {one, 0.0,
         one.water == GroundSideWater::head && one.axis < D - 1 && grid.gravity()[D - 1] < 0.0});
}

/// Those of the ghost layers across the side's axis included, unless only `owned` ones are asked
/// for.
template <int D>
template <class Body>
void GroundSides<D>::for_each_face(const Side& side, bool owned, Body&& body) const {
  for_each_face_of(*grid_, side.options, owned ? grid_->owned() : grid_->local(), body);
}

template <int D>
std::ptrdiff_t GroundSides<D>::inside(const Side& side) const {
  return side.options.side == 0 ? 0 : -grid_->stride(side.options.axis);
}
template <int D>
std::ptrdiff_t GroundSides<D>::inner_face(const Side& side) const {
  return (side.options.side == 0 ? 1 : -1) * grid_->stride(side.options.axis);
}
/// Whether water behind the side presses into a cell that has no pressure.
template <int D>
bool GroundSides<D>::comes_in(const Side& side, std::ptrdiff_t at) const {
  const int axis = side.options.axis;
  return two_ways_[axis].data()[at] > 0.0 && pressure_[axis].data()[at] > 0.0;
}
template <int D>
double GroundSides<D>::gap(const Side& side) const {
  const int axis = side.options.axis;
  return 0.5 * grid_->width(axis, side.options.side == 0 ? 0 : grid_->cells()[axis] - 1);
}

/// Open water is held from both sides at every height, as by an open wall; above the level what
/// comes in is air.
template <int D>
void GroundSides<D>::find_face(const Side& side, std::ptrdiff_t at, const Index<D>& face,
                               bool ground, double pressure, double time) {
  const int axis = side.options.axis;
  const GroundSideWater kind = side.options.water;
  const Vec<D> centre = grid_->face_centre(axis, face);
  const bool open = side.holds_level && !ground, holds = ground || open;
  double value = 0.0, share = 1.0;
  if (kind != GroundSideWater::seepage_face) value = side.options.value(to_point3(centre), time);
  if (open) share = share_below(*grid_, face, value);
  if (kind == GroundSideWater::head) {
    const double gravity = std::abs(grid_->gravity()[D - 1]);
    value = std::max(gravity > 0.0 ? density_ * gravity * (value - centre[D - 1])
                                   : density_ * standard_gravity * value,
                     0.0);
  }
  const bool flux = kind == GroundSideWater::inflow;
  const bool both =
      kind == GroundSideWater::pressure || (kind == GroundSideWater::head && value > 0.0);
  const double weight = -side.options.inwards() * density_ * grid_->gravity()[axis] * gap(side);
  const bool driven_out = pressure + weight > 0.0;
  open_[axis].data()[at] = open ? 1.0 : 0.0;
  two_ways_[axis].data()[at] = holds && both ? 1.0 : 0.0;
  passes_[axis].data()[at] = holds && !flux && (both || open || driven_out) ? 1.0 : 0.0;
  inflow_[axis].data()[at] = holds && (both || flux || open) ? share : 0.0;
  pressure_[axis].data()[at] = value;
  if (!holds) through_[axis].data()[at] = 0.0;
}

template <int D>
void GroundSides<D>::find(const CellField<D>& ground, const CellField<D>& pressure,
                          const FaceVector<D>& capacity, double time) {
  for (const Side& side : sides_) {
    const int axis = side.options.axis;
    const std::ptrdiff_t in = inside(side);
    const bool flux = side.options.water == GroundSideWater::inflow;
    for_each_face(side, false, [&](std::ptrdiff_t at, const Index<D>& face) {
      const bool holds = ground.data()[at + in] > 0.0;
      find_face(side, at, face, holds, pressure.data()[at + in], time);
      if (!flux) return;
      double& value = pressure_[axis].data()[at];  // the flux
      const double open = capacity[axis].data()[at];
      // Nothing is drawn out of pores that are not full.
      const bool there = value > 0.0 || pressure.data()[at + in] != 0.0;
      through_[axis].data()[at] =
          holds && open > 0.0 && there ? side.options.inwards() * value / open : 0.0;
      value = 0.0;
    });
  }
  halo_.exchange(through_);
  fill_rows_behind_sides();
}

/// Rows behind other sides have no owner: they are as the last ones in the domain.
template <int D>
void GroundSides<D>::fill_rows_behind_sides() {
  const IndexBox<D> owned = grid_->owned();
  for (const Side& side : sides_) {
    FaceField<D>& v = through_[side.options.axis];
    for_each_face(side, false, [&](std::ptrdiff_t at, const Index<D>& face) {
      Index<D> from = face;
      for (int a = 0; a < D; ++a) {
        if (a == side.options.axis) continue;
        if (grid_->touches(a, 0)) from[a] = std::max(from[a], owned.lower[a]);
        if (grid_->touches(a, 1)) from[a] = std::min(from[a], owned.upper[a] - 1);
      }
      v.data()[at] = v[from];
    });
  }
}

/// Open water that comes in does not move along the side: walls mirror what is inside, and water
/// that falls there would come in falling, ever faster.
template <int D>
void GroundSides<D>::apply(const CellField<D>& porosity, CellField<D>& water,
                           FaceVector<D>& velocity) const {
  for (const Side& side : sides_) {
    const int axis = side.options.axis;
    const std::ptrdiff_t out = side.options.outward(*grid_);
    const double *through = through_[axis].data(), *share = inflow_[axis].data();
    const double* open = open_[axis].data();
    double* v = velocity[axis].data();
    for_each_face(side, false, [&](std::ptrdiff_t at, const Index<D>&) {
      const std::ptrdiff_t behind = side.options.side == 0 ? at + out : at;
      v[at] = through[at];
      v[at + out] = through[at];
      if (through[at] != 0.0 || open[at] > 0.0)
        water.data()[behind] = share[at] * porosity.data()[behind];
      if (open[at] == 0.0 || side.options.inwards() * through[at] <= 0.0) return;
      for (int along = 0; along < D; ++along)
        if (along != axis)
          for (int layer = 0; layer < ghost_layers; ++layer)
            velocity[along].data()[behind + layer * out] = 0.0;
    });
  }
}

template <int D>
void GroundSides<D>::add_inflow(FaceVector<D>& inflow) const {
  for (const Side& side : sides_)
    for_each_face(side, false, [&](std::ptrdiff_t at, const Index<D>&) {
      inflow[side.options.axis].data()[at] = inflow_[side.options.axis].data()[at];
    });
}

template <int D>
void GroundSides<D>::carry_momentum(const CellField<D>& water, const CellField<D>& porosity,
                                    const FaceVector<D>& velocity) {
  for (const Side& side : sides_) {
    if (!side.holds_level) continue;
    const int axis = side.options.axis;
    const std::ptrdiff_t in = inside(side), inner = inner_face(side);
    for_each_face(side, true, [&](std::ptrdiff_t at, const Index<D>&) {
      if (open_[axis].data()[at] == 0.0) return;
      double& v = through_[axis].data()[at];
      const double sign = side.options.inwards(), behind = velocity[axis].data()[at + inner];
      // What presses into a cell without pressure has its motion from the side.
      const bool fills = comes_in(side, at) && !InterfaceAdvection<D>::dilates(
                                                   water.data()[at + in], porosity.data()[at + in]);
      v = fills ? sign * std::max(sign * v, sign * behind) : behind;
    });
  }
}

template <int D>
void GroundSides<D>::follow_surface(const CellField<D>& unknown, const FaceVector<D>& velocity) {
  if (std::none_of(sides_.begin(), sides_.end(), [](const Side& s) { return s.holds_level; }))
    return;
  for (const Side& side : sides_) {
    if (!side.holds_level) continue;
    const int axis = side.options.axis;
    const std::ptrdiff_t in = inside(side), inner = inner_face(side);
    for_each_face(side, true, [&](std::ptrdiff_t at, const Index<D>&) {
      const bool at_surface = open_[axis].data()[at] > 0.0 && unknown.data()[at + in] == 0.0;
      if (at_surface && !comes_in(side, at))
        through_[axis].data()[at] = velocity[axis].data()[at + inner];
    });
  }
  halo_.exchange(through_);
  fill_rows_behind_sides();
}

/// Where the cell behind is not full there is no pressure in it: water of the side comes in against
/// none, and the cell's own falls out by its relative permeability.
template <int D>
void GroundSides<D>::move(const WaterAtSides<D>& at_sides) const {
  for (const Side& side : sides_) {
    const int axis = side.options.axis;
    const std::ptrdiff_t in = inside(side);
    const double dt = at_sides.dt, sign = side.options.inwards(),
                 fall = dt * grid_->gravity()[axis];
    for_each_face(side, true, [&](std::ptrdiff_t at, const Index<D>&) {
      double &v = at_sides.velocity[axis].data()[at], &m = at_sides.mobility[axis].data()[at];
      at_sides.grain_velocity[axis].data()[at] = at_sides.grain_mobility[axis].data()[at] = 0.0;
      const double theta = at_sides.capacity[axis].data()[at];
      at_sides.water_share[axis].data()[at] = theta;
      const double before = through_[axis].data()[at], alone = alone_[axis].data()[at];
      m = at_sides.flux_mobility[axis].data()[at] = 0.0;
      v = side.options.water == GroundSideWater::inflow ? before : 0.0;
      if (side.options.water == GroundSideWater::inflow || theta == 0.0) return;
      const bool wet = at_sides.unknown.data()[at + in] > 0.0;
      const bool comes = comes_in(side, at);
      if (alone == 0.0) return;  // far from all water
      if (wet && passes_[axis].data()[at] == 0.0) return;
      const double room = at_sides.room.data()[at + in];
      const bool part = !wet && !comes && room > 0.0;
      const double filled = part ? std::min(at_sides.water.data()[at + in] / room, 1.0) : 1.0;
      const double pull = part ? drag_of_part(at_sides.filling, filled) : 1.0;
      const double mass = filled * theta * dt / alone;
      const double drag = dt * pull * theta * theta * at_sides.resistance[axis].data()[at];
      if (mass + drag <= 0.0) return;
      v = mass * (density_ * (before + fall) * alone / dt) / (mass + drag);
      const double answer = dt * theta / (mass + drag);
      if (wet) {
        m = answer;
        at_sides.flux_mobility[axis].data()[at] = theta * answer;
      } else if (comes) {
        const double head = pressure_[axis].data()[at];
        // From rest behind the side, it gains speed up to what all of its head makes.
        const double gains = v + sign * answer * head / gap(side);
        const double fastest = std::max(std::sqrt(2.0 * head / density_), sign * v);
        v = open_[axis].data()[at] > 0.0 ? sign * std::min(sign * gains, fastest) : gains;
      } else if (sign * v > 0.0) {
        v = 0.0;
      }
    });
  }
}

template <int D>
void GroundSides<D>::weigh(FaceVector<D>& velocity) const {
  for (const Side& side : sides_) {
    const int axis = side.options.axis;
    for_each_face(side, true, [&](std::ptrdiff_t at, const Index<D>&) {
      if (passes_[axis].data()[at] > 0.0) velocity[axis].data()[at] = grid_->gravity()[axis];
    });
  }
}

template <int D>
void GroundSides<D>::push(const FaceVector<D>& mobility, const CellField<D>& unknown,
                          FaceVector<D>& velocity) const {
  for (const Side& side : sides_) {
    const int axis = side.options.axis;
    const std::ptrdiff_t in = inside(side);
    const double per_gap = side.options.inwards() / gap(side);
    for_each_face(side, true, [&](std::ptrdiff_t at, const Index<D>&) {
      if (unknown.data()[at + in] == 0.0 || passes_[axis].data()[at] == 0.0) return;
      double& v = velocity[axis].data()[at];
      const bool open = open_[axis].data()[at] > 0.0;
      const double lost = open ? lost_to_inflow(density_, side.options.inwards() * v) : 0.0;
      v += mobility[axis].data()[at] * (pressure_[axis].data()[at] - lost) * per_gap;
    });
  }
}

template <int D>
void GroundSides<D>::note_velocity(const FaceVector<D>& velocity) {
  for (const Side& side : sides_)
    for_each_face(side, true, [&](std::ptrdiff_t at, const Index<D>&) {
      through_[side.options.axis].data()[at] = velocity[side.options.axis].data()[at];
    });
  halo_.exchange(through_);
  fill_rows_behind_sides();
}

template <int D>
void GroundSides<D>::count(const FaceVector<D>& carried, double dt) {
  for (Side& side : sides_) {
    double in = 0.0;
    for_each_face(side, true, [&](std::ptrdiff_t at, const Index<D>&) {
      in += carried[side.options.axis].data()[at];
    });
    side.discharge = -side.options.inwards() * in * grid_->cell_volume() / dt;
  }
}

template <int D>
double GroundSides<D>::discharge(const std::string& name) const {
  for (const Side& side : sides_)
    if (side.options.name == name) return sum_over_ranks(*grid_, side.discharge);
  return 0.0;
}

template class GroundSides<2>;
template class GroundSides<3>;

}  // namespace mudlark

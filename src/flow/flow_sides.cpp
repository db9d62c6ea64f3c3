#include "flow/flow_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "flow/flow_checks.hpp"
#include "numerics/loops.hpp"

namespace mudlark {

template <int D>
FlowSides<D>::FlowSides(const Grid<D>& grid, const std::vector<FlowSideOptions>& options,
                        double density)
    : grid_(&grid),
      gravity_(std::max(-grid.gravity()[D - 1], 0.0)),
      density_(density),
      speed_(grid, "speed of sides", "m/s"),
      inflow_(grid, "share of water in inflow", "1"),
      pressure_(grid, "pressure on sides", "Pa") {
  for (const FlowSideOptions& one : options) {
    Side side{one, nullptr, {}};
    if (one.flow == SideFlow::wave) side.motion = make_wave(one.wave, gravity_);
    std::size_t columns = 1;
    for (int a = 0; a < D - 1; ++a)
      if (a != one.axis) columns *= static_cast<std::size_t>(grid.cells()[a]);
    side.levels.resize(columns);
    sides_.push_back(std::move(side));
  }
}

/// Those in the ghost layers across the side's axis included.
template <int D>
template <class Body>
void FlowSides<D>::for_each_face(const Side& side, Body&& body) const {
  for_each_face_of(*grid_, side.options, grid_->local(), body);
}

template <int D>
std::size_t FlowSides<D>::column(const Side& side, const Index<D>& index) const {
  if (D == 2 || side.options.axis == D - 1) return 0;
  const int across = 1 - side.options.axis;
  return static_cast<std::size_t>(std::clamp(index[across], 0, grid_->cells()[across] - 1));
}

/// Height of the water in each column of cells beside the side, as if it stood on the bottom.
template <int D>
void FlowSides<D>::measure_levels(Side& side, const CellField<D>& water,
                                  const CellField<D>& porosity) const {
  const Grid<D>& grid = *grid_;
  std::fill(side.levels.begin(), side.levels.end(), 0.0);
  const int axis = side.options.axis;
  if (grid.touches(axis, side.options.side) && axis != D - 1) {
    IndexBox<D> box = grid.owned();
    (side.options.side == 0 ? box.upper : box.lower)[axis] =
        side.options.side == 0 ? box.lower[axis] + 1 : box.upper[axis] - 1;
    for_each_place(grid, box, [&](std::ptrdiff_t at, const Index<D>& index) {
      const double room = porosity.data()[at];
      side.levels[column(side, index)] +=
          (room > 0.0 ? water.data()[at] / room : 1.0) * grid.width(D - 1, index[D - 1]);
    });
  }
  MPI_Allreduce(MPI_IN_PLACE, side.levels.data(), static_cast<int>(side.levels.size()), MPI_DOUBLE,
                MPI_SUM, grid.comm());
  for (double& level : side.levels) level += grid.lower()[D - 1];
}

/// Level of what comes in; sides that are level themselves take all they are given as water.
template <int D>
double FlowSides<D>::level_at(const Side& side, const Index<D>& face, double time) const {
  const FlowSideOptions& options = side.options;
  if (options.level)
    return (*options.level)(to_point3(grid_->face_centre(options.axis, face)), time);
  return options.axis == D - 1 ? FlowSideOptions::infinite : side.levels[column(side, face)];
}

/// Inward speed that carries the discharge through the wetted part.
template <int D>
double FlowSides<D>::discharge_speed(const Side& side, const FaceVector<D>& capacity,
                                     double time) const {
  const FlowSideOptions& options = side.options;
  const Grid<D>& grid = *grid_;
  const IndexBox<D> owned = grid.owned();
  double area = 0.0;
  for_each_face(side, [&](std::ptrdiff_t at, const Index<D>& face) {
    for (int a = 0; a < D; ++a)
      if (a != options.axis && (face[a] < owned.lower[a] || face[a] >= owned.upper[a])) return;
    area += capacity[options.axis].data()[at] *
            share_below(grid, face, level_at(side, face, time)) *
            (grid.cell_volume() / grid.spacing()[options.axis]);
  });
  area = sum_over_ranks(grid, area);
  const double discharge = options.value({}, time);
  if (area > 0.0) return discharge / area;
  if (discharge != 0.0)
    throw DivergenceError(
        fmt::format("Opening \"{}\" has to carry {:.4g} m{}/s and none of it is open and wet: give "
                    "it a level, or place it "
                    "where the water stands.",
                    options.name, discharge, D == 3 ? "3" : "2"));
  return 0.0;
}

template <int D>
void FlowSides<D>::find_flow(const Side& side, const FaceVector<D>& capacity, double time) {
  const FlowSideOptions& options = side.options;
  const int axis = options.axis;
  const double mean =
      options.flow == SideFlow::discharge ? discharge_speed(side, capacity, time) : 0.0;
  for_each_face(side, [&](std::ptrdiff_t at, const Index<D>& face) {
    const double level = level_at(side, face, time);
    const double share = options.axis == D - 1 ? 1.0 : share_below(*grid_, face, level);
    const Vec<D> centre = grid_->face_centre(axis, face);
    inflow_[axis].data()[at] = share;
    if (options.flow == SideFlow::level) {
      pressure_[axis].data()[at] = density_ * gravity_ * std::max(level - centre[D - 1], 0.0);
      return;
    }
    const double speed =
        options.flow == SideFlow::discharge ? mean : options.value(to_point3(centre), time);
    speed_[axis].data()[at] = share > 0.0 ? options.inwards() * speed : 0.0;
  });
}

/// The motion's velocity, and the long wave that would bring the level to the motion's: what comes
/// from inside leaves with U = -sqrt(g/d) (eta - eta_wave) (Schaeffer & Klopman 2000; in shallow
/// water all of it).
template <int D>
void FlowSides<D>::find_wave(const Side& side, double time) {
  const FlowSideOptions& options = side.options;
  const WaveZoneOptions& wave = options.wave;
  const Grid<D>& grid = *grid_;
  const int axis = options.axis;
  const double ramp = ramp_share(wave.ramp, time), sign = options.inwards();
  for_each_face(side, [&](std::ptrdiff_t at, const Index<D>& face) {
    const Vec<D> centre = grid.face_centre(axis, face);
    const WavePlace place{0.0, D == 3 ? centre[1 - axis] : 0.0};
    const double eta = ramp * side.motion->elevation(place, time);
    const double found = side.levels[column(side, face)];
    const double excess = found - wave.still_level - eta;
    const double share = share_below(grid, face, wave.still_level + eta);
    inflow_[axis].data()[at] = share;
    if (share == 0.0 && share_below(grid, face, found) == 0.0) return;
    const double z = std::min(centre[D - 1] - wave.still_level, eta);
    const WaveVelocity comes = side.motion->velocity(place, z, time);
    speed_[axis].data()[at] =
        wave.current + sign * (ramp * comes[0] - std::sqrt(gravity_ / wave.depth) * excess);
    const std::ptrdiff_t behind = side.options.side == 0 ? at + side.options.outward(*grid_) : at;
    const double foot = grid.face_position(D - 1, face[D - 1]) - wave.still_level;
    speed_[D - 1].data()[behind] =
        ramp * side.motion->velocity(place, std::min(foot, eta), time)[2];
    if constexpr (D == 3) speed_[1 - axis].data()[behind] = ramp * comes[1];
  });
}

template <int D>
void FlowSides<D>::find(const CellField<D>& water, const CellField<D>& porosity,
                        const FaceVector<D>& capacity, double time) {
  speed_.fill(0.0);
  inflow_.fill(0.0);
  for (Side& side : sides_) {
    const bool asks =
        side.options.flow == SideFlow::wave || (!side.options.level && side.options.axis != D - 1);
    if (asks) measure_levels(side, water, porosity);
    if (side.options.flow == SideFlow::wave)
      find_wave(side, time);
    else
      find_flow(side, capacity, time);
  }
}

template <int D>
void FlowSides<D>::apply(const CellField<D>& porosity, CellField<D>& water,
                         FaceVector<D>& velocity) const {
  for (const Side& side : sides_) {
    const int axis = side.options.axis;
    const std::ptrdiff_t out = side.options.outward(*grid_);
    const double* speed = speed_[axis].data();
    double* v = velocity[axis].data();
    const bool given = side.options.flow != SideFlow::level;
    for_each_face(side, [&](std::ptrdiff_t at, const Index<D>&) {
      const std::ptrdiff_t behind = side.options.side == 0 ? at + out : at;
      water.data()[behind] = inflow_[axis].data()[at] * porosity.data()[behind];
      if (!given) return;
      v[at] = speed[at];
      v[at + out] = speed[at];
    });
    bring_motion(side, velocity);
  }
}

/// Water that comes in moves along the side as the wave does, or not at all. Walls mirror what is
/// inside, and water that falls along the side would come in falling, ever faster.
template <int D>
void FlowSides<D>::bring_motion(const Side& side, FaceVector<D>& velocity) const {
  const int axis = side.options.axis;
  const std::ptrdiff_t out = side.options.outward(*grid_);
  const double sign = side.options.inwards();
  const double* v = velocity[axis].data();
  for (int d = 0; d < D; ++d) {
    if (d == axis) continue;
    const double* along = speed_[d].data();
    double* w = velocity[d].data();
    for_each_face(side, [&](std::ptrdiff_t at, const Index<D>&) {
      if (sign * v[at] <= 0.0) return;
      const std::ptrdiff_t behind = side.options.side == 0 ? at + out : at;
      for (int layer = 0; layer < ghost_layers; ++layer) w[behind + layer * out] = along[behind];
    });
  }
}

template <int D>
void FlowSides<D>::push(const FaceVector<D>& mobility, const CellField<D>& unknown,
                        FaceVector<D>& velocity) const {
  for (const Side& side : sides_) {
    if (side.options.flow != SideFlow::level) continue;
    const int axis = side.options.axis;
    const std::ptrdiff_t inside = side.options.side == 0 ? 0 : -grid_->stride(axis);
    const double sign = side.options.inwards();
    for_each_face(side, [&](std::ptrdiff_t at, const Index<D>& face) {
      if (unknown.data()[at + inside] == 0.0) return;
      const double gap = 0.5 * grid_->gap(axis, face[axis]);  // as the projection has it
      double& v = velocity[axis].data()[at];
      const double pressure = pressure_[axis].data()[at] - lost_to_inflow(density_, sign * v);
      v += sign * mobility[axis].data()[at] * pressure / gap;
    });
  }
}

template class FlowSides<2>;
template class FlowSides<3>;

}  // namespace mudlark

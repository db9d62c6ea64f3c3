#include "soil/sides.hpp"

#include <algorithm>
#include <limits>

namespace mudlark {
namespace {

/// Acceleration that a head is turned into a pressure with where a case has no gravity [m/s2], as
/// conductivity is.
constexpr double standard_gravity = 9.81;

GrainSide kind_of_wall(Wall wall) {
  switch (wall) {
    case Wall::slip:
      return GrainSide::slip;
    case Wall::no_slip:
      return GrainSide::fixed;
    case Wall::friction:
      return GrainSide::friction;
    case Wall::open:
    case Wall::periodic:
      break;
  }
  return GrainSide::open;
}

bool mirrors(GrainSide kind) { return kind >= GrainSide::slip; }

std::size_t coordinate(int axis, int dimension) {
  return static_cast<std::size_t>(dimension == 2 && axis == 1 ? 2 : axis);
}

}  // namespace

template <int D>
SoilSides<D>::SoilSides(const Grid<D>& grid, const std::vector<SoilBoundary>& boundaries,
                        double water_density, double inertia)
    : grid_(&grid), boundaries_(boundaries), water_density_(water_density), inertia_(inertia) {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      const bool used = grid.touches(axis, side);
      at(axis, side).varies =
          used && std::any_of(boundaries.begin(), boundaries.end(), [&](const SoilBoundary& b) {
            return b.axis == axis && b.side == side;
          });
      if (at(axis, side).varies) assign_parts(axis, side);
      const GrainSide kind = kind_of_wall(grid.wall(axis, side));
      for (int d = 0; d < D; ++d) {
        SideNode& node = at(axis, side).plain[static_cast<std::size_t>(d)];
        node.mirrored = mirrors(kind);
        node.grain_sign = d == axis || kind == GrainSide::fixed ? -1.0 : 1.0;
        node.flux_sign = d == axis ? -1.0 : 1.0;
      }
    }
}

/// Position of a cell of this rank's local box, or of the one nearest to it, in the arrays of a
/// side.
template <int D>
std::size_t SoilSides<D>::place(int axis, const Index<D>& index) const {
  const IndexBox<D>& local = grid_->local();
  std::ptrdiff_t at = 0, stride = 1;
  for (int a = 0; a < D; ++a) {
    if (a == axis) continue;
    at += stride * (std::clamp(index[a], local.lower[a], local.upper[a] - 1) - local.lower[a]);
    stride *= local.upper[a] - local.lower[a];
  }
  return static_cast<std::size_t>(at);
}

/// The cell next to the side that belongs to a cell; of one beyond other sides, that of its image.
template <int D>
Index<D> SoilSides<D>::original(int axis, int side, Index<D> cell) const {
  for (int a = 0; a < D; ++a) {
    const int cells = grid_->cells()[a];
    int& i = cell[a];
    if (grid_->periodic(a))
      i = (i % cells + cells) % cells;
    else
      i = std::clamp(i < 0 ? -1 - i : i >= cells ? 2 * cells - 1 - i : i, 0, cells - 1);
  }
  cell[axis] = side == 0 ? 0 : grid_->cells()[axis] - 1;
  return cell;
}

template <int D>
Index<D> SoilSides<D>::original_on_rank(int axis, int side, const Index<D>& cell) const {
  Index<D> at = original(axis, side, cell);
  for (int a = 0; a < D; ++a)
    if (a != axis && grid_->periodic(a)) at[a] = cell[a];
  return at;
}

/// Centre of the face on the side by a cell; of one beyond other sides where it would be, so that
/// pressures go on.
template <int D>
Point3 SoilSides<D>::centre_on_side(int axis, int side, Index<D> cell) const {
  for (int a = 0; a < D; ++a)
    if (a != axis && grid_->periodic(a)) cell[a] = original(axis, side, cell)[a];
  cell[axis] = side == 0 ? 0 : grid_->cells()[axis];
  return to_point3(grid_->face_centre(axis, cell));
}

template <int D>
void SoilSides<D>::assign_parts(int axis, int side) {
  Side& on = at(axis, side);
  IndexBox<D> row = grid_->local();
  row.upper[axis] = row.lower[axis] + 1;
  std::size_t count = 1;
  for (int a = 0; a < D; ++a)
    count *= a == axis ? 1u : static_cast<std::size_t>(row.upper[a] - row.lower[a]);
  on.grains.assign(count, walls);
  on.water.assign(count, walls);
  on.now.assign(count, Now{});
  for_each(row, [&](const Index<D>& cell) {
    const Point3 centre = centre_on_side(axis, side, original(axis, side, cell));
    for (std::size_t b = 0; b < boundaries_.size(); ++b) {
      const SoilBoundary& boundary = boundaries_[b];
      if (boundary.axis != axis || boundary.side != side) continue;
      bool inside = true;
      for (int a = 0; a < D; ++a) {
        const std::size_t c = coordinate(a, D);
        inside =
            inside && (a == axis || (centre[c] >= boundary.from[c] && centre[c] < boundary.to[c]));
      }
      if (!inside) continue;
      if (boundary.for_grains) on.grains[place(axis, cell)] = static_cast<int>(b);
      if (boundary.for_water) on.water[place(axis, cell)] = static_cast<int>(b);
    }
  });
  find_nearest(axis, side);
}

template <int D>
bool SoilSides<D>::has_pressure(const Side& side, std::size_t place) const {
  const int boundary = side.water[place];
  if (boundary == walls) return false;
  const WaterSide kind = boundaries_[static_cast<std::size_t>(boundary)].water;
  return kind == WaterSide::pressure || kind == WaterSide::seepage_face;
}

/// For each cell the nearest one with a pressure, itself if it has one, among those two cells away
/// along each axis; an index below all others where there is none.
template <int D>
void SoilSides<D>::find_nearest(int axis, int side) {
  Side& on = at(axis, side);
  Index<D> none;
  none.component.fill(std::numeric_limits<int>::min());
  on.nearest.assign(on.water.size(), none);
  IndexBox<D> row = grid_->local();
  row.upper[axis] = row.lower[axis] + 1;
  for_each(row, [&](const Index<D>& cell) {
    IndexBox<D> around{cell, cell};
    around = around.grown(2);
    for (int a = 0; a < D; ++a) ++around.upper[a];
    int least = std::numeric_limits<int>::max();
    for_each(around.intersected(row), [&](const Index<D>& other) {
      int distance = 0;
      for (int a = 0; a < D; ++a) distance += (other[a] - cell[a]) * (other[a] - cell[a]);
      if (distance >= least || !has_pressure(on, place(axis, other))) return;
      least = distance;
      on.nearest[place(axis, cell)] = other;
    });
  });
}

template <int D>
void SoilSides<D>::update(double time, double dt) {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      if (at(axis, side).varies) {
        update_side(axis, side, time, dt);
        update_slopes(axis, side);
      }
}

/// From the neighbours that belong to the same boundary.
template <int D>
void SoilSides<D>::update_slopes(int axis, int side) {
  Side& on = at(axis, side);
  IndexBox<D> row = grid_->local();
  row.upper[axis] = row.lower[axis] + 1;
  for_each(row, [&](const Index<D>& cell) {
    const std::size_t here = place(axis, cell);
    if (!has_pressure(on, here)) return;
    for (int a = 0; a < D; ++a) {
      if (a == axis) continue;
      double rise = 0.0, run = 0.0;
      for (const int step : {-1, 1}) {
        const Index<D> next = cell.shifted(a, step);
        if (!row.contains(next) || on.water[place(axis, next)] != on.water[here]) continue;
        rise += step * (on.now[place(axis, next)].water - on.now[here].water);
        run += grid_->spacing()[a];
      }
      on.now[here].slope[a] = run > 0.0 ? rise / run : 0.0;
    }
  });
}

template <int D>
double SoilSides<D>::pressure_opposite(int axis, int side, const Vec<D>& position) const {
  const Side& on = at(axis, side);
  if (!on.varies) return 0.0;
  const Index<D> cell = on.nearest[place(axis, grid_->cell_at(position))];
  if (cell[axis] == std::numeric_limits<int>::min()) return 0.0;
  const Now& now = on.now[place(axis, cell)];
  const Vec<D> centre = grid_->cell_centre(cell);
  double pressure = now.water;
  for (int a = 0; a < D; ++a)
    if (a != axis) pressure += now.slope[a] * (position[a] - centre[a]);
  return pressure;
}

template <int D>
void SoilSides<D>::update_side(int axis, int side, double time, double dt) {
  Side& on = at(axis, side);
  IndexBox<D> row = grid_->local();
  row.upper[axis] = row.lower[axis] + 1;
  const double gravity = -grid_->gravity()[D - 1];
  for_each(row, [&](const Index<D>& cell) {
    const std::size_t i = place(axis, cell);
    Now& now = on.now[i];
    if (on.grains[i] == walls && on.water[i] == walls) return;
    const Point3 centre = centre_on_side(axis, side, cell);
    const auto boundary = [&](int b) -> const SoilBoundary& {
      return boundaries_[static_cast<std::size_t>(b)];
    };
    if (on.grains[i] != walls && boundary(on.grains[i]).grains == GrainSide::moving)
      for (int d = 0; d < D; ++d) {
        const SoilBoundary& part = boundary(on.grains[i]);
        const Varying& given = part.motion[coordinate(d, D)];
        // Mean velocity of this step and of one as long before it; sides rest before time zero.
        const auto mean = [&](double begin) {
          const double from = std::max(begin, 0.0), to = std::max(begin + dt, 0.0);
          if (part.motion_is_displacement) return (given(centre, to) - given(centre, from)) / dt;
          return begin + 0.5 * dt < 0.0 ? 0.0 : 0.5 * (given(centre, from) + given(centre, to));
        };
        now.velocity[d] = still_ ? 0.0 : mean(time);
        now.velocity_before[d] = still_ ? 0.0 : mean(time - dt);
      }
    if (on.water[i] == walls) return;
    const SoilBoundary& part = boundary(on.water[i]);
    if (part.water == WaterSide::pressure) {
      now.water = part.value(centre, time + dt);
      if (part.is_head)
        now.water = water_density_ * (gravity > 0.0 ? gravity * (now.water - centre[2])
                                                    : standard_gravity * now.water);
    } else if (part.water == WaterSide::inflow) {
      now.water = 0.5 * (part.value(centre, time) + part.value(centre, time + dt));
    }
  });
}

template <int D>
GrainSide SoilSides<D>::kind_of(int axis, int side, int boundary) const {
  if (boundary == walls) return kind_of_wall(grid_->wall(axis, side));
  const GrainSide kind = boundaries_[static_cast<std::size_t>(boundary)].grains;
  return still_ && kind == GrainSide::absorbing ? GrainSide::slip : kind;
}

template <int D>
bool SoilSides<D>::holds_along(int axis, int side, int boundary) const {
  const GrainSide kind = kind_of(axis, side, boundary);
  return kind == GrainSide::fixed ||
         (kind == GrainSide::moving && boundaries_[static_cast<std::size_t>(boundary)].holds_along);
}

template <int D>
WaterSide SoilSides<D>::water_of(const Side& side, std::size_t place) const {
  const int boundary = side.water[place];
  if (boundary == walls) return WaterSide::sealed;
  const WaterSide kind = boundaries_[static_cast<std::size_t>(boundary)].water;
  if (kind != WaterSide::seepage_face) return kind;
  return side.now[place].open ? WaterSide::pressure : WaterSide::sealed;
}

template <int D>
const SideNode* SoilSides<D>::plain(int axis, int side, int component) const {
  const Side& on = at(axis, side);
  return on.varies ? nullptr : &on.plain[static_cast<std::size_t>(component)];
}

template <int D>
SideNode SoilSides<D>::node(int axis, int side, int component, const Index<D>& index) const {
  const Side& on = at(axis, side);
  if (!on.varies) return on.plain[static_cast<std::size_t>(component)];
  SideNode node;
  const std::size_t here = place(axis, index);
  const int boundary = on.grains[here];
  if (component == axis) {
    node.mirrored = mirrors(kind_of(axis, side, boundary));
    node.grain_sign = -1.0;
    node.velocity = on.now[here].velocity[axis];
    node.velocity_before = on.now[here].velocity_before[axis];
    node.water = water_of(on, here);
    node.flux_sign = node.water == WaterSide::pressure ? 1.0 : -1.0;
    node.water_value = on.now[here].water;
    if (node.water == WaterSide::inflow && side == 1) node.water_value = -node.water_value;
    return node;
  }
  // A face along the side lies between two of its cells; the stronger one holds it.
  const std::size_t there = place(axis, index.shifted(component, -1));
  const bool second = kind_of(axis, side, on.grains[there]) > kind_of(axis, side, boundary);
  const std::size_t stronger = second ? there : here;
  const int holder = on.grains[stronger];
  node.mirrored = mirrors(kind_of(axis, side, holder));
  if (holds_along(axis, side, holder)) {
    node.grain_sign = -1.0;
    node.velocity = on.now[stronger].velocity[component];
    node.velocity_before = on.now[stronger].velocity_before[component];
  }
  if (water_of(on, here) == WaterSide::pressure && water_of(on, there) == WaterSide::pressure) {
    node.water = WaterSide::pressure;
    node.flux_sign = -1.0;
    node.water_value = (on.now[here].water - on.now[there].water) / grid_->spacing()[component];
  }
  return node;
}

template <int D>
bool SoilSides<D>::lets_through(int axis, int side) const {
  const Side& on = at(axis, side);
  if (!on.varies) return grid_->touches(axis, side) && !on.plain[0].mirrored;
  return std::any_of(on.grains.begin(), on.grains.end(),
                     [&](int boundary) { return !mirrors(kind_of(axis, side, boundary)); });
}

template <int D>
GrainSide SoilSides<D>::grains(int axis, int side, const Index<D>& cell) const {
  const Side& on = at(axis, side);
  return kind_of(axis, side, on.varies ? on.grains[place(axis, cell)] : walls);
}

template <int D>
double SoilSides<D>::friction(int axis, int side, const Index<D>& cell) const {
  if (grains(axis, side, cell) != GrainSide::friction) return 0.0;
  const Side& on = at(axis, side);
  const int boundary = on.varies ? on.grains[place(axis, cell)] : walls;
  return boundary == walls ? grid_->wall_friction(axis, side)
                           : boundaries_[static_cast<std::size_t>(boundary)].friction;
}

template <int D>
const Absorber* SoilSides<D>::absorber(int axis, int side, const Index<D>& cell) const {
  if (grains(axis, side, cell) != GrainSide::absorbing) return nullptr;
  return &boundaries_[static_cast<std::size_t>(at(axis, side).grains[place(axis, cell)])].absorber;
}

template <int D>
WaterSide SoilSides<D>::water(int axis, int side, const Index<D>& cell) const {
  const Side& on = at(axis, side);
  return on.varies ? water_of(on, place(axis, cell)) : WaterSide::sealed;
}

template <int D>
double SoilSides<D>::water_value(int axis, int side, const Index<D>& cell) const {
  const Side& on = at(axis, side);
  return on.varies ? on.now[place(axis, cell)].water : 0.0;
}

template <int D>
bool SoilSides<D>::has(GrainSide kind) const {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      if (!grid_->periodic(axis) && kind_of_wall(grid_->wall(axis, side)) == kind) return true;
  return std::any_of(boundaries_.begin(), boundaries_.end(), [&](const SoilBoundary& boundary) {
    return boundary.for_grains && boundary.grains == kind;
  });
}

template <int D>
bool SoilSides<D>::has(WaterSide kind) const {
  return std::any_of(boundaries_.begin(), boundaries_.end(), [&](const SoilBoundary& boundary) {
    return boundary.for_water && boundary.water == kind;
  });
}

template <int D>
bool SoilSides<D>::belongs_to(std::size_t boundary, const Index<D>& cell) const {
  const SoilBoundary& part = boundaries_[boundary];
  const Side& on = at(part.axis, part.side);
  return on.varies && on.water[place(part.axis, cell)] == static_cast<int>(boundary);
}

template <int D>
bool SoilSides<D>::is_seepage_face(int axis, int side, const Index<D>& cell) const {
  const Side& on = at(axis, side);
  const int boundary = on.varies ? on.water[place(axis, cell)] : walls;
  return boundary != walls &&
         boundaries_[static_cast<std::size_t>(boundary)].water == WaterSide::seepage_face;
}

template <int D>
void SoilSides<D>::set_open(int axis, int side, const CellField<D>& open) {
  Side& on = at(axis, side);
  if (!on.varies) return;
  IndexBox<D> row = grid_->local();
  row.upper[axis] = row.lower[axis] + 1;
  for_each(row, [&](const Index<D>& cell) {
    const Index<D> from = original_on_rank(axis, side, cell);
    if (grid_->local().contains(from)) on.now[place(axis, cell)].open = open[from] != 0.0;
  });
}

template class SoilSides<2>;
template class SoilSides<3>;

}  // namespace mudlark

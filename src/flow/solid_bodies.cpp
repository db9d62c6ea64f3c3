#include "flow/solid_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "flow/flow_checks.hpp"
#include "grid/shape_volume.hpp"
#include "numerics/loops.hpp"
#include "parallel/collective_error.hpp"

namespace mudlark {
namespace {

/// Cells with less open volume are joined to a neighbour: water that passes them would dictate the
/// step to all others.
constexpr double smallest_volume = 0.1;
/// No cell smaller than that stands alone: round-off of its water would count.
constexpr double smallest_standing = 0.02;
/// Water that a closing cell may keep when no neighbour can take it, as a share of its size: what a
/// body leaves that moves by a quarter of a cell.
constexpr double thickest_film = 0.4;

template <int D>
BoxShape box_of(const Grid<D>& grid) {
  BoxShape domain{{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}};
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(axis_in_space<D>(a));
    domain.lower[u] = grid.lower()[a], domain.upper[u] = grid.upper()[a];
  }
  return domain;
}

RigidPose start_pose(const FlowSolid& solid, int dimension) {
  if (solid.centre) return {solid.shape, *solid.centre, dimension};
  const auto volume = volume_of(solid.shape, dimension);
  return {solid.shape, volume ? volume->centre : Point3{}, dimension};
}

/// A free body that swings about where it floats answers a step late or early, as the added mass of
/// its place is known (docs/methods/bodies-in-water.md): over a share of sqrt(L/g), L the side of a
/// square or cube of its size, that is some percent of a swing.
template <int D>
double longest_step(const Grid<D>& grid, const FlowSolid& body) {
  constexpr double share = 0.06, any = std::numeric_limits<double>::infinity();
  const auto* free = std::get_if<FreeSolid>(&body.motion);
  const double gravity = norm(grid.gravity());
  if (!free || gravity == 0.0) return any;
  const BoxShape box = bounds(body.shape), domain = box_of(grid);
  double size = 1.0;
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(axis_in_space<D>(a));
    size *= std::min(box.upper[u], domain.upper[u]) - std::max(box.lower[u], domain.lower[u]);
  }
  return size > 0.0 ? share * std::sqrt(std::pow(size, 1.0 / D) / gravity) : any;
}

}  // namespace

template <int D>
SolidBodies<D>::SolidBodies(const Grid<D>& grid, const std::vector<FlowSolid>& options,
                            double density)
    : grid_(&grid),
      options_(options),
      velocities_(options.size()),
      next_(options.size()),
      open_(grid),
      cut_(grid),
      stands_(grid, "small cell that stands alone", "1"),
      walls_(grid),
      ghosts_(grid) {
  for (const FlowSolid& solid : options) {
    poses_.push_back(start_pose(solid, D));
    no_slip_ = no_slip_ || solid.no_slip;
    moving_ = moving_ || !std::holds_alternative<FixedSolid>(solid.motion);
    const auto* motion = std::get_if<FreeSolid>(&solid.motion);
    if (!motion) continue;
    free_.emplace_back(SolidOptions{solid.name, solid.shape, solid.centre, *motion, solid.friction},
                       D, to_point3(grid.gravity()), 1.0);
    free_.back().put_in_water(density, box_of(grid));
  }
  if (!free_.empty()) collisions_.emplace(grid, true, poses_);
  follow(free_);
  velocities_ = next_;
}

template <int D>
void SolidBodies<D>::follow(const std::vector<Solid>& leaders) {
  for (const Solid& leader : leaders)
    if (const auto body = find(leader.options().name); body && leader.free())
      next_[*body] = {leader.velocity(), leader.spin()};
  if (&leaders != &free_) free_.clear(), collisions_.reset();
}

/// Where a free body is the water sees a step later, so bodies with given motion are taken where
/// they will be then.
template <int D>
void SolidBodies<D>::collide(double time, double dt) {
  if (!collisions_) return;
  std::vector<RigidPose> ahead;
  ahead.reserve(poses_.size());
  std::vector<SolidCollisions::Body> bodies;
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    bodies.push_back({&poses_[b], {}, options_[b].friction, nullptr});
    if (const auto* given = std::get_if<PrescribedSolid>(&options_[b].motion)) {
      bodies[b].velocity = poses_[b].prescribed(*given, time, dt);
      ahead.push_back(poses_[b]);
      ahead.back().move(bodies[b].velocity, dt);
      bodies[b].pose = &ahead.back();
    }
  }
  for (Solid& solid : free_) {
    SolidCollisions::Body& body = bodies[*find(solid.options().name)];
    body.pose = &solid.pose(), body.free = &solid;
    body.velocity = {solid.velocity(), solid.spin()};
  }
  collisions_->settle(bodies, dt);
}

template <int D>
std::optional<std::size_t> SolidBodies<D>::find(const std::string& name) const {
  for (std::size_t b = 0; b < options_.size(); ++b)
    if (options_[b].name == name) return b;
  return {};
}

template <int D>
Eigen::Vector3d SolidBodies<D>::collision_force(std::size_t body) const {
  for (const Solid& solid : free_)
    if (solid.options().name == options_[body].name) return solid.collision_force();
  return Eigen::Vector3d::Zero();
}

template <int D>
void SolidBodies<D>::move(double time, double dt) {
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    if (const auto* given = std::get_if<PrescribedSolid>(&options_[b].motion))
      next_[b] = velocities_[b] = poses_[b].prescribed(*given, time, dt);
    poses_[b].move(velocities_[b], dt);
    velocities_[b] = next_[b];
  }
  for (Solid& solid : free_) solid.move(dt);
  lead(free_, dt);
}

/// The leader has moved already, by a step of another length than the water will move the body by.
template <int D>
void SolidBodies<D>::lead(std::vector<Solid>& leaders, double dt) const {
  for (Solid& leader : leaders) {
    const auto body = find(leader.options().name);
    if (!body || !leader.free()) continue;
    leader.place_ahead(poses_[*body], velocities_[*body], dt);
  }
}

template <int D>
double SolidBodies<D>::limited_step(double time, double step) const {
  const BoxShape domain = box_of(*grid_);
  const double farthest = 0.25 * grid_->smallest_spacing();
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    if (std::holds_alternative<FixedSolid>(options_[b].motion)) continue;
    step = std::min(step, longest_step(*grid_, options_[b]));
    const auto* given = std::get_if<PrescribedSolid>(&options_[b].motion);
    for (int pass = 0; pass < 2; ++pass) {  // its speed over the shorter step may be another
      const RigidVelocity motion =
          given ? poses_[b].prescribed(*given, time, step) : velocities_[b];
      const double turning =
          motion.spin.squaredNorm() > 0.0 ? motion.spin.norm() * poses_[b].reach(domain) : 0.0;
      const double way = (motion.velocity.norm() + turning) * step;
      if (way > farthest) step *= farthest / way;
    }
  }
  return step;
}

template <int D>
Vec<D> SolidBodies<D>::velocity_at(std::size_t body, const Vec<D>& place) const {
  const RigidVelocity& motion = velocities_[body];
  return to_axes<D>(Eigen::Vector3d(motion.velocity +
                                    motion.spin.cross(to_space<D>(place) - poses_[body].centre())));
}

template <int D>
void SolidBodies<D>::fill(PorousMedium<D>& medium, const MayStand& stands) {
  if (empty()) return;
  Space<D>& space = medium.space;
  cut_.find(poses_);
  if (moving_) find_standing(stands);
  for_each_offset(*grid_, grid_->local(), [&](std::ptrdiff_t at) {
    space.volume.data()[at] = open_.volume.data()[at] * cut_.volume().data()[at];
    for (int a = 0; a < D; ++a)
      space.aperture[a].data()[at] = open_.aperture[a].data()[at] * cut_.aperture()[a].data()[at];
  });
  if (moving_) find_flux(medium.grain_flux);
  join_small_cells(space);
  close_faces(space);
  close_lone_cells(space);
  if (moving_) {
    // What a joined cell gains or loses passes to its host through the face between them.
    for (const JoinedCell<D>& joined : joined_) hand_on_flux(joined, medium.grain_flux);
  }
  walls_.find_cells(space);
  walls_.find_faces(space, [&](WallFace<D>& wall) {
    const Vec<D> place = grid_->face_centre(wall.axis, wall.face);
    std::size_t body = 0;
    const SurfaceDistance away =
        cut_.nearest(poses_, to_point3(place), 4.0 * norm(grid_->spacing()), body);
    if (body == poses_.size()) return;
    for (int a = 0; a < D; ++a)
      wall.normal[a] = away.normal[static_cast<std::size_t>(axis_in_space<D>(a))];
    wall.velocity = velocity_at(body, place);
  });
}

template <int D>
bool SolidBodies<D>::is_inside(const Index<D>& cell) const {
  for (int a = 0; a < D; ++a)
    if (!grid_->periodic(a) && (cell[a] < 0 || cell[a] >= grid_->cells()[a])) return false;
  return true;
}

/// The neighbour behind the widest face, else the largest of the cells around; none if all of them
/// are too small as well.
template <int D>
std::optional<Index<D>> SolidBodies<D>::host_of(const Index<D>& cell) const {
  std::optional<Index<D>> best;
  double widest = 0.0;
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      const Index<D> other = cell.shifted(axis, side == 0 ? -1 : 1);
      if (!is_inside(other) || cut_.volume()[other] < smallest_volume) continue;
      const double width = cut_.aperture()[axis][side == 0 ? cell : other];
      if (width > widest * (1.0 + 1e-9)) widest = width, best = other;
    }
  if (best) return best;
  const IndexBox<D> around{cell, cell};
  IndexBox<D> box = around.grown(1);
  for (int a = 0; a < D; ++a) box.upper[a] += 1;
  for_each(box, [&](const Index<D>& other) {
    if (other == cell || !is_inside(other)) return;
    const double volume = cut_.volume()[other];
    if (volume >= smallest_volume && volume > widest * (1.0 + 1e-9)) widest = volume, best = other;
  });
  return best;
}

template <int D>
void SolidBodies<D>::find_standing(const MayStand& stands) {
  stands_.fill(0.0);
  for_each(grid_->owned(), [&](const Index<D>& cell) {
    const double volume = cut_.volume()[cell];
    if (volume < smallest_standing || volume >= smallest_volume) return;
    const auto host = host_of(cell);
    if (host && stands(cell, *host)) stands_[cell] = 1.0;
  });
  ghosts_.update(stands_);
}

template <int D>
void SolidBodies<D>::join_small_cells(Space<D>& space) {
  std::swap(joined_, joined_before_);
  joined_.clear();
  const IndexBox<D> box = grid_->local().grown(-1);
  for_each(box, [&](const Index<D>& cell) {
    const double volume = cut_.volume()[cell];
    if (volume <= 0.0 || volume >= smallest_volume || stands_[cell] > 0.0) return;
    space.volume[cell] = 0.0;
    if (!is_inside(cell)) return;
    if (const auto host = host_of(cell)) {
      joined_.push_back({cell, *host});
      if (box.contains(*host)) space.volume[*host] += open_.volume[cell] * volume;
    }
  });
  ghosts_.update(space.volume);
}

template <int D>
void SolidBodies<D>::close_faces(Space<D>& space) const {
  const double* volume = space.volume.data();
  for (int axis = 0; axis < D; ++axis) {
    IndexBox<D> inner = grid_->local();
    inner.lower[axis] += 1;
    const std::ptrdiff_t s = grid_->stride(axis);
    double* aperture = space.aperture[axis].data();
    for_each_offset(*grid_, inner, [&](std::ptrdiff_t at) {
      if (volume[at] == 0.0 || volume[at - s] == 0.0) aperture[at] = 0.0;
    });
  }
}

/// Pores without any open face hold nothing that could move.
template <int D>
void SolidBodies<D>::close_lone_cells(Space<D>& space) {
  const Grid<D>& grid = *grid_;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    if (space.volume[cell] == 0.0) return;
    for (int axis = 0; axis < D; ++axis)
      for (int side = 0; side < 2; ++side) {
        const Index<D> face = side == 0 ? cell : cell.shifted(axis, 1);
        const bool wall =
            !grid.periodic(axis) && face[axis] == (side == 0 ? 0 : grid.cells()[axis]);
        if (wall && grid.wall(axis, side) != Wall::open) continue;
        if (space.aperture[axis][face] > 0.0) return;
      }
    space.volume[cell] = 0.0;
  });
  ghosts_.update(space.volume);
}

/// (1 - aperture) v of the body on the faces of cells that are not all body: its divergence is the
/// rate at which the open volume of a cell shrinks.
template <int D>
void SolidBodies<D>::find_flux(FaceVector<D>& flux) const {
  const Grid<D>& grid = *grid_;
  flux.fill(0.0);
  for (int axis = 0; axis < D; ++axis) {
    IndexBox<D> inner = grid.local();
    inner.lower[axis] += 1;
    for_each(inner, [&](const Index<D>& face) {
      const double closed = 1.0 - cut_.aperture()[axis][face];
      const bool beside = cut_.volume()[face] > 0.0 || cut_.volume()[face.shifted(axis, -1)] > 0.0;
      if (closed <= 0.0 || !beside) return;
      const Vec<D> place = grid.face_centre(axis, face);
      std::size_t body = 0;
      cut_.nearest(poses_, to_point3(place), 2.0 * norm(grid.spacing()), body);
      if (body < poses_.size())
        flux[axis][face] = open_.aperture[axis][face] * closed * velocity_at(body, place)[axis];
    });
  }
}

template <int D>
void SolidBodies<D>::hand_on_flux(const JoinedCell<D>& joined, FaceVector<D>& flux) const {
  double gain = 0.0;
  int between = -1;
  for (int axis = 0; axis < D; ++axis) {
    gain += (flux[axis][joined.cell.shifted(axis, 1)] - flux[axis][joined.cell]) /
            grid_->spacing()[axis];
    for (const int step : {-1, 1})
      if (joined.cell.shifted(axis, step) == joined.host) between = axis;
  }
  if (between < 0) return;  // a host across an edge: the drift of its room is taken back later
  const bool above = joined.host[between] > joined.cell[between];
  flux[between][above ? joined.host : joined.cell] +=
      (above ? -gain : gain) * grid_->spacing()[between];
}

template <int D>
template <class Body>
void SolidBodies<D>::for_each_standing(Body&& body) const {
  for_each(grid_->local().grown(-1), [&](const Index<D>& cell) {
    if (stands_[cell] == 0.0 || !is_inside(cell)) return;
    const auto host = host_of(cell);
    if (host && grid_->local().contains(*host)) body(cell, *host);
  });
}

template <int D>
void SolidBodies<D>::begin() {
  std::vector<SmallCell>& small = walls_.small();
  small.clear();
  for_each_standing([&](const Index<D>& cell, const Index<D>& host) {
    small.push_back({grid_->offset(cell), grid_->offset(host)});
  });
}

template <int D>
void SolidBodies<D>::regroup(const Space<D>& space, CellField<D>& capacity, CellField<D>& water) {
  const IndexBox<D>& local = grid_->local();
  const IndexBox<D> box = local.grown(-1);
  const auto pass = [&](const Index<D>& from, const Index<D>& to, double share) {
    if (!local.contains(from) || !local.contains(to)) return;
    const double moved = share * water[from], room = share * capacity[from];
    water[from] = share < 1.0 ? water[from] - moved : 0.0;
    capacity[from] = share < 1.0 ? capacity[from] - room : 0.0;
    water[to] += moved, capacity[to] += room;
  };
  const auto host_now = [&](const Index<D>& cell) -> std::optional<Index<D>> {
    for (const JoinedCell<D>& now : joined_)
      if (now.cell == cell) return now.host;
    return {};
  };
  const auto take_back = [&](const Index<D>& cell, const Index<D>& host) {
    if (local.contains(host) && capacity[host] > 0.0)
      pass(host, cell, std::min(open_.volume[cell] * cut_.volume()[cell] / capacity[host], 0.5));
  };
  // First out of the old hosts, while they still hold it; then out of cells that close.
  for (const JoinedCell<D>& old : joined_before_)
    if (cut_.volume()[old.cell] > 0.0 && host_now(old.cell) != old.host)
      take_back(old.cell, old.host);
  for_each(box, [&](const Index<D>& cell) {
    if (space.volume[cell] == 0.0 || capacity[cell] != 0.0 || !is_inside(cell)) return;
    if (const auto host = host_of(cell)) take_back(cell, *host);
  });
  for_each(box, [&](const Index<D>& cell) {
    if (space.volume[cell] > 0.0 || capacity[cell] == 0.0 || !is_inside(cell)) return;
    if (const auto host = host_of(cell)) pass(cell, *host, 1.0);
  });
  // Small cells that stand alone and their hosts transport as one: what theirs lack or have too
  // much of, the host gives or takes.
  for_each_standing([&](const Index<D>& cell, const Index<D>& host) { pass(cell, host, 1.0); });
  for_each_standing(take_back);
  begin();
  check_shut_in(space, capacity, water);
  ghosts_.update(capacity);
  ghosts_.update(water);
}

/// Water in a cell that bodies closed and no neighbour took stays there as a film, until a cell
/// opens beside it; more than a film ends the run.
template <int D>
void SolidBodies<D>::check_shut_in(const Space<D>& space, CellField<D>& capacity,
                                   const CellField<D>& water) const {
  std::string problem;
  for_each(grid_->owned(), [&](const Index<D>& cell) {
    if (space.volume[cell] > 0.0 || capacity[cell] == 0.0) return;
    if (water[cell] > thickest_film * open_.volume[cell])
      problem = fmt::format(
          "A body closes a cell with water at {}, and no open cell beside it can take the water. "
          "Leave a gap of more than a cell between moving bodies, walls and other bodies.",
          place_text(grid_->cell_centre(cell)));
    capacity[cell] = 4.0 * water[cell];  // too empty for a pressure: no face is open
  });
  throw_divergence_if_any(grid_->comm(), problem);
}

template class SolidBodies<2>;
template class SolidBodies<3>;

}  // namespace mudlark

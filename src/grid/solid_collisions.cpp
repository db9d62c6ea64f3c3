#include "grid/solid_collisions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Share of a gap that a step may close: the next one may be longer than this.
constexpr double closing = 0.5;
/// Share of an overlap that a step takes back.
constexpr double opening = 0.1;
/// Between bodies in water: two surfaces in one cell, or on both its sides, are none.
constexpr double cells_between = 1.25;
constexpr double far_out = 10.0;  ///< of a body's size
constexpr int sweeps = 200;
constexpr double tolerance = 1e-12;  ///< of the largest speed

/// Parts that are cut away up to the surface leave one with no body on either side.
bool has_body_under(const RigidPose& pose, const Eigen::Vector3d& on,
                    const Eigen::Vector3d& normal) {
  if (!std::holds_alternative<DifferenceShape>(pose.shape().form)) return true;
  const double little = 1e-6 * (on - pose.centre()).norm();
  return pose.distance(to_point(on - little * normal)).distance < 0.0;
}

}  // namespace

template <int D>
SolidCollisions::SolidCollisions(const Grid<D>& grid, bool in_water,
                                 const std::vector<RigidPose>& start) {
  BoxShape room{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
  for (int a = 0; a < D; ++a) {
    const int axis = axis_in_space<D>(a);
    const auto u = static_cast<std::size_t>(axis);
    room.lower[u] = grid.lower()[a], room.upper[u] = grid.upper()[a];
    for (int i = 0; in_water && i < grid.cells()[a]; ++i)
      margin_ = std::max(margin_, cells_between * grid.width(a, i));
    for (int side = 0; side < 2; ++side) {
      if (grid.wall(a, side) == Wall::open || grid.periodic(a)) continue;
      const double width = grid.width(a, side == 0 ? 0 : grid.cells()[a] - 1);
      sides_.push_back({axis, side == 0 ? room.lower[u] : room.upper[u], side == 0 ? 1.0 : -1.0,
                        grid.wall(a, side) == Wall::friction ? grid.wall_friction(a, side) : 0.0,
                        in_water ? 0.5 * width : 0.0});
    }
  }
  others_ = start.size() + sides_.size();
  for (const RigidPose& pose : start) {
    surface_.push_back(surface_places(pose.shape(), room, D));
    double farthest = 0.0;
    for (const SurfacePlace& one : surface_.back())
      farthest = std::max(farthest, (one.place - pose.start_centre()).norm());
    farthest_.push_back(farthest);
  }
  find_gaps(start);
}

/// Bodies that start closer to another than the margin, or in it, keep that much.
void SolidCollisions::find_gaps(const std::vector<RigidPose>& start) {
  std::vector<const RigidPose*> poses;
  for (const RigidPose& pose : start) poses.push_back(&pose);
  gaps_.assign(start.size() * others_, margin_);
  for (std::size_t b = 0; b < start.size(); ++b)
    for (std::size_t o = 0; o < others_; ++o) {
      const bool side = o >= start.size();
      double& kept = gap(b, o);
      if (side) kept = sides_[o - start.size()].margin;
      for_each_touch(poses, b, o, kept, [&](const SurfacePlace&, const SurfaceDistance& away) {
        kept = std::min(kept, away.distance);
      });
      if (!side && o < b) kept = gap(o, b) = std::min(kept, gap(o, b));
    }
}

/// Calls f(place, distance and normal of the other) for the places of a body that are closer than
/// `reach` to another body or side.
template <class F>
void SolidCollisions::for_each_touch(const std::vector<const RigidPose*>& poses, std::size_t body,
                                     std::size_t other, double reach, F&& f) const {
  if (body == other) return;
  const RigidPose& pose = *poses[body];
  const auto all = [&](auto&& close, auto&& distance) {
    const auto try_place = [&](const SurfacePlace& at) {
      if (!close(at.place)) return;
      const SurfaceDistance away = distance(at.place);
      if (away.distance <= reach) f(at, away);
    };
    for (const SurfacePlace& at : surface_[body])
      try_place({pose.place(at.place), pose.turn() * at.normal});
    // Of a round body the very place that touches: the nearest to one far out on that side.
    const Vector way = to_vector(distance(pose.centre()).normal);
    const Vector out = pose.centre() - far_out * farthest_[body] * way;
    const SurfaceDistance back = pose.distance(to_point(out));
    const Vector round = out - back.distance * to_vector(back.normal);
    if (has_body_under(pose, round, to_vector(back.normal)))
      try_place({round, to_vector(back.normal)});
  };
  if (other >= poses.size()) {
    const Side& side = sides_[other - poses.size()];
    const auto u = static_cast<std::size_t>(side.axis);
    const double nearest = side.inward > 0.0 ? pose.box().lower[u] : -pose.box().upper[u];
    if (nearest - side.inward * side.place > reach) return;
    SurfaceDistance away{0.0, {0.0, 0.0, 0.0}};
    away.normal[u] = side.inward;
    all([](const Vector&) { return true; },
        [&](const Vector& place) {
          away.distance = side.inward * (place[side.axis] - side.place);
          return away;
        });
    return;
  }
  const RigidPose& against = *poses[other];
  const double wide = std::max(reach, 0.0);
  for (std::size_t a = 0; a < 3; ++a)
    if (pose.box().lower[a] > against.box().upper[a] + wide ||
        pose.box().upper[a] < against.box().lower[a] - wide)
      return;
  all([&](const Vector& place) { return against.near(to_point(place), wide); },
      [&](const Vector& place) { return against.distance(to_point(place)); });
}

/// The normal of what a place meets on another body, or nothing where it will not come closer than
/// it may. Where two faces lie on each other that is the other's face. Else it is what the place
/// will find after a step in which nothing stops it: a body that slides along another passes the
/// places on that one's face; now its corner is nearest to them, at an angle, then its face is.
std::optional<SolidCollisions::Vector> SolidCollisions::meets(const Body& other,
                                                              const SurfacePlace& at,
                                                              const Vector& velocity,
                                                              const SurfaceDistance& away,
                                                              double kept, double dt) {
  constexpr double face_on_face = -0.998, from_the_side = -0.1;  // cosines
  const RigidPose& pose = *other.pose;
  const Vector now = to_vector(away.normal);
  if (now.dot(at.normal) < face_on_face) return now;
  const Vector moved =
      velocity - other.velocity.velocity - other.velocity.spin.cross(at.place - pose.centre());
  const Vector ahead = at.place + dt * moved;
  const SurfaceDistance then = pose.distance(to_point(ahead));
  const double allowed = std::min(0.0, (1.0 - opening) * (away.distance - kept));
  const Vector normal = to_vector(then.normal);
  if (then.distance - kept >= allowed || normal.dot(at.normal) > from_the_side) return {};
  return normal;
}

void SolidCollisions::find_contacts(const std::vector<Body>& bodies, double dt) {
  contacts_.clear();
  std::vector<const RigidPose*> poses;
  std::vector<double> speeds;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    poses.push_back(bodies[b].pose);
    speeds.push_back(bodies[b].velocity.velocity.norm() +
                     bodies[b].velocity.spin.norm() * farthest_[b]);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t o = 0; o < others_; ++o) {
      const bool side = o >= bodies.size();
      if (!bodies[b].free && (side || !bodies[o].free)) continue;
      const double kept = gap(b, o), speed = speeds[b] + (side ? 0.0 : speeds[o]);
      const double friction = std::max(
          bodies[b].friction, side ? sides_[o - bodies.size()].friction : bodies[o].friction);
      const double reach = kept + 2.0 * dt * speed / closing + 1e-9 * farthest_[b];
      const std::size_t first = contacts_.size();
      for_each_touch(poses, b, o, reach, [&](const SurfacePlace& at, const SurfaceDistance& away) {
        const Vector& place = at.place;
        const Vector velocity = bodies[b].velocity.velocity +
                                bodies[b].velocity.spin.cross(place - bodies[b].pose->centre());
        const std::optional<Vector> normal =
            side ? to_vector(away.normal) : meets(bodies[o], at, velocity, away, kept, dt);
        const Vector on = place - away.distance * to_vector(away.normal);
        if (!normal || (!side && !has_body_under(*poses[o], on, to_vector(away.normal)))) return;
        const double left = away.distance - kept;
        contacts_.push_back(
            {b, o, place, *normal, (left > 0.0 ? closing : opening) * left / dt, friction});
      });
      keep_outermost(first);
    }
}

/// Of contacts with one normal the nearest and those farthest out carry as much as all of them; the
/// fewer there are, the faster the iteration.
void SolidCollisions::keep_outermost(std::size_t first) {
  constexpr std::size_t most = 9;
  constexpr double same = 1.0 - 1e-9;  // cosine
  std::vector<Contact> kept;
  std::vector<bool> taken(contacts_.size(), false);
  for (std::size_t c = first; c < contacts_.size(); ++c) {
    if (taken[c]) continue;
    const Vector normal = contacts_[c].normal;
    std::vector<std::size_t> group;
    for (std::size_t o = c; o < contacts_.size(); ++o)
      if (!taken[o] && normal.dot(contacts_[o].normal) > same) group.push_back(o), taken[o] = true;
    std::set<std::size_t> chosen(group.begin(), group.size() <= most ? group.end() : group.begin());
    const Vector one = normal.unitOrthogonal(), other = normal.cross(one);
    for (int way = 0; way < 9 && group.size() > most; ++way) {  // the last: the nearest
      const double angle = 0.25 * way * std::numbers::pi;
      const Vector out =
          way < 8 ? Vector(std::cos(angle) * one + std::sin(angle) * other) : Vector::Zero();
      const auto score = [&](std::size_t at) {
        return out.dot(contacts_[at].place) - normal.dot(contacts_[at].place);
      };
      chosen.insert(*std::max_element(group.begin(), group.end(),
                                      [&](auto a, auto b) { return score(a) < score(b); }));
    }
    for (const std::size_t at : chosen) kept.push_back(contacts_[at]);
  }
  contacts_.resize(first);
  contacts_.insert(contacts_.end(), kept.begin(), kept.end());
}

SolidCollisions::Vector SolidCollisions::speed(const Contact& contact,
                                               const std::vector<Body>& bodies) const {
  const auto of = [&](std::size_t b) {
    return Vector(now_[b].velocity + now_[b].spin.cross(contact.place - bodies[b].pose->centre()));
  };
  return contact.other < bodies.size() ? Vector(of(contact.body) - of(contact.other))
                                       : of(contact.body);
}

/// Velocity along a unit vector per impulse along it [1/kg].
double SolidCollisions::mobility(const Contact& contact, const Vector& way,
                                 const std::vector<Body>& bodies) const {
  double sum = 0.0;
  for (const std::size_t b : {contact.body, contact.other}) {
    if (b >= bodies.size() || !bodies[b].free) continue;
    const Vector arm = contact.place - bodies[b].pose->centre();
    const RigidVelocity answer = bodies[b].free->response(way, arm.cross(way));
    sum += way.dot(answer.velocity + answer.spin.cross(arm));
  }
  return sum;
}

void SolidCollisions::give(const Contact& contact, const Vector& impulse,
                           const std::vector<Body>& bodies) {
  const auto push = [&](std::size_t b, const Vector& given) {
    if (b >= bodies.size() || !bodies[b].free) return;
    const Vector moment = (contact.place - bodies[b].pose->centre()).cross(given);
    const RigidVelocity answer = bodies[b].free->response(given, moment);
    now_[b].velocity += answer.velocity, now_[b].spin += answer.spin;
    loads_[b].impulse += given, loads_[b].moment += moment;
  };
  push(contact.body, impulse), push(contact.other, -impulse);
}

/// Did it change anything?
bool SolidCollisions::relax(Contact& contact, const std::vector<Body>& bodies) {
  double changed = 0.0, fastest = 0.0;
  const double across = mobility(contact, contact.normal, bodies);
  if (across > 0.0) {
    const double miss = -contact.approach - contact.normal.dot(speed(contact, bodies));
    const double pressed = std::max(0.0, contact.pressed + miss / across);
    changed = across * std::abs(pressed - contact.pressed);
    give(contact, (pressed - contact.pressed) * contact.normal, bodies);
    contact.pressed = pressed;
  }
  const Vector speed_now = speed(contact, bodies);
  const Vector slip = speed_now - contact.normal.dot(speed_now) * contact.normal;
  fastest = speed_now.norm() + std::abs(contact.approach);
  if (contact.friction > 0.0 && slip.norm() > 0.0) {
    const double easy = mobility(contact, slip.normalized(), bodies);
    Vector along = easy > 0.0 ? Vector(contact.along - slip / easy) : contact.along;
    const double most = contact.pressed > 0.0 ? contact.friction * contact.pressed : 0.0;
    if (along.norm() > most) along *= most / along.norm();
    changed = std::max(changed, easy * (along - contact.along).norm());
    give(contact, along - contact.along, bodies);
    contact.along = along;
  }
  return changed > tolerance * fastest;
}

void SolidCollisions::settle(const std::vector<Body>& bodies, double dt) {
  find_contacts(bodies, dt);
  if (contacts_.empty()) return;
  now_.clear();
  for (const Body& body : bodies) now_.push_back(body.velocity);
  loads_.assign(bodies.size(), Load{});
  bool changed = true;
  for (int i = 0; i < sweeps && changed; ++i) {
    changed = false;
    for (Contact& contact : contacts_) changed = relax(contact, bodies) || changed;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].free) bodies[b].free->collide(loads_[b].impulse, loads_[b].moment);
}

void SolidCollisions::settle(std::vector<Solid>& solids, double dt) {
  std::vector<Body> bodies;
  for (Solid& solid : solids)
    bodies.push_back({&solid.pose(),
                      {solid.velocity(), solid.spin()},
                      solid.options().friction,
                      solid.free() ? &solid : nullptr});
  settle(bodies, dt);
}

template SolidCollisions::SolidCollisions(const Grid<2>&, bool, const std::vector<RigidPose>&);
template SolidCollisions::SolidCollisions(const Grid<3>&, bool, const std::vector<RigidPose>&);

}  // namespace mudlark

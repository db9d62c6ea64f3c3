#include "grid/rigid_pose.hpp"

#include <cmath>
#include <limits>

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Eigen::Quaterniond turn_by(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

/// The rotation vector of a turn, at most half a turn long.
Eigen::Vector3d rotation_of(Eigen::Quaterniond turn) {
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  if (sine == 0.0) return Eigen::Vector3d::Zero();
  return turn.vec() * (2.0 * std::atan2(sine, turn.w()) / sine);
}

std::array<double, 3> values(const std::array<Varying, 3>& given, const Eigen::Vector3d& place,
                             double time) {
  const Point3 at = to_point(place);
  return {given[0](at, time), given[1](at, time), given[2](at, time)};
}

Eigen::Vector3d planar_rotation(const std::array<double, 3>& given, int dimension) {
  if (dimension == 2) return {0.0, -given[1], 0.0};
  return {given[0], given[1], given[2]};
}

RigidPose::RigidPose(const Shape& shape, const Point3& centre, int dimension)
    : shape_(shape),
      dimension_(dimension),
      start_box_(bounds(shape)),
      start_centre_(to_vector(centre)),
      centre_(start_centre_) {
  update_box();
}

void RigidPose::update_box() {
  turned_at_all_ = !(turn_.vec().norm() == 0.0);
  for (int a = 0; a < 3; ++a)
    box_.lower[static_cast<std::size_t>(a)] = infinity,
    box_.upper[static_cast<std::size_t>(a)] = -infinity;
  for (int corner = 0; corner < 8; ++corner) {
    Vector place;
    for (int a = 0; a < 3; ++a) {
      const auto u = static_cast<std::size_t>(a);
      place[a] = ((corner >> a) & 1 ? start_box_.upper[u] : start_box_.lower[u]) - start_centre_[a];
    }
    if (dimension_ == 2) place[1] = 0.0;
    const bool finite = place.allFinite();
    if (turned_at_all_ && finite) place = turn_ * place;
    place += centre_;
    for (int a = 0; a < 3; ++a) {
      const auto u = static_cast<std::size_t>(a);
      box_.lower[u] = std::min(box_.lower[u], finite || !turned_at_all_ ? place[a] : -infinity);
      box_.upper[u] = std::max(box_.upper[u], finite || !turned_at_all_ ? place[a] : infinity);
    }
  }
  if (dimension_ == 2) box_.lower[1] = -infinity, box_.upper[1] = infinity;
}

bool RigidPose::near(const Point3& place, double reach) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (place[a] < box_.lower[a] - reach || place[a] > box_.upper[a] + reach) return false;
  return true;
}

SurfaceDistance RigidPose::distance(const Point3& place) const {
  Vector local = to_vector(place) - centre_;
  if (turned_at_all_) local = turn_.conjugate() * local;
  SurfaceDistance found = distance_to(shape_, to_point(local + start_centre_));
  if (turned_at_all_) found.normal = to_point(turn_ * to_vector(found.normal));
  return found;
}

double RigidPose::reach(const BoxShape& within) const {
  double reach2 = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (dimension_ == 2 && a == 1) continue;
    const double middle = centre_[static_cast<int>(a)];
    const double way = std::max(std::min(box_.upper[a], within.upper[a]) - middle,
                                middle - std::max(box_.lower[a], within.lower[a]));
    reach2 += way * way;
  }
  return std::sqrt(reach2);
}

RigidVelocity RigidPose::prescribed(const PrescribedSolid& motion, double time, double dt) const {
  const double end = time + dt, middle = time + 0.5 * dt;
  const auto translation =
      values(motion.translation, start_centre_, motion.by_displacement ? end : middle);
  const auto rotation = planar_rotation(
      values(motion.rotation, start_centre_, motion.by_rotation ? end : middle), dimension_);
  RigidVelocity found{to_vector(translation), rotation};
  if (dimension_ == 2) found.velocity[1] = 0.0;
  if (motion.by_displacement) found.velocity = (start_centre_ + found.velocity - centre_) / dt;
  if (!motion.by_rotation) return found;
  // In the plane the sum of all turns knows more than the turn itself: a wheel turns often.
  found.spin = dimension_ == 2 ? Vector((rotation - turned_) / dt)
                               : Vector(rotation_of(turn_by(rotation) * turn_.conjugate()) / dt);
  return found;
}

void RigidPose::stand_where(const RigidPose& other) {
  centre_ = other.centre_, turn_ = other.turn_, turned_ = other.turned_;
  update_box();
}

void RigidPose::move(const RigidVelocity& motion, double dt) {
  centre_ += dt * motion.velocity;
  if (motion.spin.squaredNorm() > 0.0) {
    turned_ += dt * motion.spin;
    turn_ = (turn_by(dt * motion.spin) * turn_).normalized();
  }
  if (motion.spin.squaredNorm() > 0.0 || motion.velocity.squaredNorm() > 0.0) update_box();
}

}  // namespace mudlark

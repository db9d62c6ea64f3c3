#include "soil/solid.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "base/errors.hpp"

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

/// Inverse of a symmetric matrix on the axes that are free, zero on the others.
Eigen::Matrix3d inverse_on(const Eigen::Matrix3d& matrix, const std::array<bool, 3>& held) {
  Eigen::Matrix3d padded = matrix;
  for (int i = 0; i < 3; ++i) {
    if (!held[static_cast<std::size_t>(i)]) continue;
    padded.row(i).setZero(), padded.col(i).setZero();
    padded(i, i) = 1.0;
  }
  Eigen::Matrix3d inverse = padded.inverse();
  for (int i = 0; i < 3; ++i)
    if (held[static_cast<std::size_t>(i)]) inverse(i, i) = 0.0;
  return inverse;
}

std::array<bool, 3> held_rotations(const FreeSolid& motion, int dimension) {
  if (dimension == 2) return {true, motion.locked_rotation[1], true};
  return motion.locked_rotation;
}

}  // namespace

Solid::Solid(const SolidOptions& options, int dimension, const Point3& gravity,
             double inertia_factor)
    : options_(options),
      dimension_(dimension),
      gravity_(to_vector(gravity)),
      inertia_factor_(inertia_factor) {
  const auto* motion = std::get_if<FreeSolid>(&options.motion);
  const bool needs_volume = !options.centre || (motion && !(motion->mass && motion->inertia));
  const auto volume = needs_volume ? volume_of(options.shape, dimension) : std::nullopt;
  start_centre_ = options.centre ? to_vector(*options.centre)
                  : volume       ? to_vector(volume->centre)
                                 : Vector::Zero();
  centre_ = origin_ = start_centre_;
  if (motion) set_mass(*motion, volume);
  update_pose();
  if (motion)
    turning_mobility_ =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(turning_).eigenvalues().maxCoeff();
}

void Solid::set_mass(const FreeSolid& motion, const std::optional<SolidVolume>& volume) {
  const auto held = held_rotations(motion, dimension_);
  const bool turns = !(held[0] && held[1] && held[2]);
  if (!volume && (!motion.mass || !options_.centre || (turns && !motion.inertia)))
    throw InputError(
        fmt::format("solid {}: its shape has no finite volume, so mass, centre and inertia cannot "
                    "follow from it. Write all three in `motion`, or a shape with an end.",
                    options_.name));
  mass_ = motion.mass ? *motion.mass : motion.density * volume->volume;
  mobility_ = 0.0;
  for (int a = 0; a < 3; ++a) {
    const bool free = !motion.locked[static_cast<std::size_t>(a)] && !(dimension_ == 2 && a == 1);
    free_axes_[a] = free ? 1.0 : 0.0;
    if (free) mobility_ = 1.0 / (inertia_factor_ * mass_);
  }
  if (motion.inertia) {
    for (int a = 0; a < 3; ++a) inertia_(a, a) = (*motion.inertia)[static_cast<std::size_t>(a)];
  } else if (volume) {
    Eigen::Matrix3d second;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        second(a, b) = volume->moments[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
    // About another centre than that of the volume (Steiner).
    const Vector off = to_vector(volume->centre) - start_centre_;
    second += volume->volume * off * off.transpose();
    inertia_ = mass_ / volume->volume * (second.trace() * Eigen::Matrix3d::Identity() - second);
  }
  velocity_ = free_axes_.cwiseProduct(to_vector(motion.velocity));
  spin_ = planar_rotation(motion.angular_velocity);
  for (int a = 0; a < 3; ++a)
    if (held[static_cast<std::size_t>(a)]) spin_[a] = 0.0;
}

/// A vector about axes; in the plane the second component counts, counter-clockwise with x to the
/// right and z upwards, which is about -y.
Solid::Vector Solid::planar_rotation(const std::array<double, 3>& given) const {
  if (dimension_ == 2) return {0.0, -given[1], 0.0};
  return {given[0], given[1], given[2]};
}

void Solid::update_pose() {
  turned_at_all_ = !(turn_.vec().norm() == 0.0);
  if (const auto* motion = std::get_if<FreeSolid>(&options_.motion)) {
    const Eigen::Matrix3d matrix = turn_.toRotationMatrix();
    inertia_now_ = inertia_factor_ * (matrix * inertia_ * matrix.transpose());
    turning_ = inverse_on(inertia_now_, held_rotations(*motion, dimension_));
  }
  const BoxShape start = bounds(options_.shape);
  for (int a = 0; a < 3; ++a)
    box_.lower[static_cast<std::size_t>(a)] = infinity,
    box_.upper[static_cast<std::size_t>(a)] = -infinity;
  for (int corner = 0; corner < 8; ++corner) {
    Vector place;
    for (int a = 0; a < 3; ++a) {
      const auto u = static_cast<std::size_t>(a);
      place[a] = ((corner >> a) & 1 ? start.upper[u] : start.lower[u]) - start_centre_[a];
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

bool Solid::near(const Point3& place, double reach) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (place[a] < box_.lower[a] - reach || place[a] > box_.upper[a] + reach) return false;
  return true;
}

SurfaceDistance Solid::distance(const Point3& place) const {
  Vector local = to_vector(place) - centre_;
  if (turned_at_all_) local = turn_.conjugate() * local;
  SurfaceDistance found = distance_to(options_.shape, to_point(local + start_centre_));
  if (turned_at_all_) found.normal = to_point(turn_ * to_vector(found.normal));
  return found;
}

double Solid::largest_speed(const BoxShape& within) const {
  double reach2 = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (dimension_ == 2 && a == 1) continue;
    const double middle = centre_[static_cast<int>(a)];
    const double way = std::max(std::min(box_.upper[a], within.upper[a]) - middle,
                                middle - std::max(box_.lower[a], within.lower[a]));
    reach2 += way * way;
  }
  return velocity_.norm() + spin_.norm() * std::sqrt(reach2);
}

void Solid::begin_outer_step() {
  impulse_sum_.setZero(), moment_sum_.setZero();
  elapsed_ = 0.0;
}

void Solid::begin_step(double time, double dt, bool held) {
  impulse_.setZero(), moment_.setZero();
  if (const auto* motion = std::get_if<FreeSolid>(&options_.motion)) {
    begin_free_step(*motion, time, dt);
  } else if (const auto* given = std::get_if<PrescribedSolid>(&options_.motion); given && !held) {
    begin_prescribed_step(*given, time, dt);
  } else {
    predicted_velocity_.setZero(), predicted_spin_.setZero();
  }
  velocity_ = predicted_velocity_, spin_ = predicted_spin_;
}

/// Given places are met at the end of the step, given velocities are those of its middle.
void Solid::begin_prescribed_step(const PrescribedSolid& motion, double time, double dt) {
  const double end = time + dt, middle = time + 0.5 * dt;
  const auto translation =
      values(motion.translation, start_centre_, motion.by_displacement ? end : middle);
  const auto rotation =
      planar_rotation(values(motion.rotation, start_centre_, motion.by_rotation ? end : middle));
  predicted_velocity_ = to_vector(translation);
  if (dimension_ == 2) predicted_velocity_[1] = 0.0;
  if (motion.by_displacement)
    predicted_velocity_ = (start_centre_ + predicted_velocity_ - centre_) / dt;
  predicted_spin_ = rotation;
  if (!motion.by_rotation) return;
  // In the plane the sum of all turns knows more than the turn itself: a wheel turns often.
  predicted_spin_ = dimension_ == 2 ? Vector((rotation - turned_) / dt)
                                    : rotation_of(turn_by(rotation) * turn_.conjugate()) / dt;
}

void Solid::begin_free_step(const FreeSolid& motion, double time, double dt) {
  const Vector force = mass_ * gravity_ + to_vector(values(motion.force, centre_, time));
  const Vector moment = planar_rotation(values(motion.moment, centre_, time));
  predicted_velocity_ = velocity_ + dt / (inertia_factor_ * mass_) * free_axes_.cwiseProduct(force);
  predicted_spin_ = turning_ * (inertia_now_ * spin_ + dt * moment);
}

void Solid::set_impulse(const Vector& impulse, const Vector& moment) {
  impulse_ = impulse, moment_ = moment;
  if (!free()) return;
  velocity_ = predicted_velocity_ + free_axes_.cwiseProduct(impulse) / (inertia_factor_ * mass_);
  spin_ = predicted_spin_ + turning_ * moment;
}

void Solid::move(double dt) {
  impulse_sum_ += impulse_, moment_sum_ += moment_;
  elapsed_ += dt;
  centre_ += dt * velocity_;
  if (spin_.squaredNorm() > 0.0) {
    const Vector angular_momentum = inertia_now_ * spin_;
    turned_ += dt * spin_;
    turn_ = (turn_by(dt * spin_) * turn_).normalized();
    update_pose();
    if (free()) spin_ = turning_ * angular_momentum;
  } else if (velocity_.squaredNorm() > 0.0) {
    update_pose();
  }
}

void Solid::stop() { velocity_.setZero(), spin_.setZero(); }

void Solid::start(bool reset_displacement) {
  stop();
  begin_outer_step();
  if (const auto* motion = std::get_if<FreeSolid>(&options_.motion)) {
    velocity_ = free_axes_.cwiseProduct(to_vector(motion->velocity));
    spin_ = turning_ * (inertia_now_ * planar_rotation(motion->angular_velocity));
  }
  if (!reset_displacement) return;
  origin_ = centre_, first_turn_ = turn_;
  if (free()) turned_.setZero();
}

Solid::Vector Solid::rotation() const {
  return dimension_ == 2 ? turned_ : rotation_of(turn_ * first_turn_.conjugate());
}

double Solid::kinetic_energy() const {
  return 0.5 *
         (inertia_factor_ * mass_ * velocity_.squaredNorm() + spin_.dot(inertia_now_ * spin_));
}

}  // namespace mudlark

#include "grid/solid.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"

namespace mudlark {
namespace {

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

/// Added inertia in wide water of a body with these sides about each of them, over the water's
/// density [m5]: no more than 0.06 a^4 l for sections across the side l whose longer side is a (as
/// below), nor, for a body that is slender across l, than what 1.2 times the water around its width
/// has, strip by strip: 0.1 w^2 a^3 with w the larger of l and the shorter side of the section.
Eigen::Vector3d added_inertias(const std::array<double, 3>& size) {
  Eigen::Vector3d found;
  for (std::size_t i = 0; i < 3; ++i) {
    const double longer = std::max(size[(i + 1) % 3], size[(i + 2) % 3]);
    const double shorter = std::min(size[(i + 1) % 3], size[(i + 2) % 3]);
    const double width = std::max(size[i], shorter);
    found[static_cast<Eigen::Index>(i)] =
        std::min(0.06 * std::pow(longer, 4) * size[i], 0.1 * width * width * std::pow(longer, 3));
  }
  return found;
}

/// The same as shares of the largest, for a shape where it is given; all 1 in the plane, and
/// without ends.
Eigen::Vector3d shares_of_added_inertia(const Shape& shape, int dimension) {
  const BoxShape box = bounds(shape);
  std::array<double, 3> size{};
  for (std::size_t a = 0; a < 3; ++a) size[a] = box.upper[a] - box.lower[a];
  const bool ends = std::all_of(size.begin(), size.end(),
                                [](double side) { return std::isfinite(side) && side > 0.0; });
  if (dimension == 2 || !ends) return Eigen::Vector3d::Ones();
  const Eigen::Vector3d inertias = added_inertias(size);
  return inertias / inertias.maxCoeff();
}

std::array<bool, 3> held_rotations(const FreeSolid& motion, int dimension) {
  if (dimension == 2) return {true, motion.locked_rotation[1], true};
  return motion.locked_rotation;
}

}  // namespace

namespace {

std::optional<SolidVolume> needed_volume(const SolidOptions& options, int dimension) {
  const auto* motion = std::get_if<FreeSolid>(&options.motion);
  if (options.centre && !(motion && !(motion->mass && motion->inertia))) return {};
  return volume_of(options.shape, dimension);
}

}  // namespace

Solid::Solid(const SolidOptions& options, int dimension, const Point3& gravity,
             double inertia_factor)
    : Solid(options, dimension, gravity, inertia_factor, needed_volume(options, dimension)) {}

Solid::Solid(const SolidOptions& options, int dimension, const Point3& gravity,
             double inertia_factor, const std::optional<SolidVolume>& volume)
    : options_(options),
      dimension_(dimension),
      gravity_(to_vector(gravity)),
      pose_(options.shape,
            options.centre ? *options.centre
            : volume       ? volume->centre
                           : Point3{},
            dimension),
      inertia_factor_(inertia_factor),
      origin_(pose_.centre()) {
  const auto* motion = std::get_if<FreeSolid>(&options.motion);
  if (motion) set_mass(*motion, volume);
  update_inertia();
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
    const Vector off = to_vector(volume->centre) - pose_.start_centre();
    second += volume->volume * off * off.transpose();
    inertia_ = mass_ / volume->volume * (second.trace() * Eigen::Matrix3d::Identity() - second);
  }
  velocity_ = free_axes_.cwiseProduct(to_vector(motion.velocity));
  spin_ = planar_rotation(motion.angular_velocity, dimension_);
  for (int a = 0; a < 3; ++a)
    if (held[static_cast<std::size_t>(a)]) spin_[a] = 0.0;
}

void Solid::update_inertia() {
  const auto* motion = std::get_if<FreeSolid>(&options_.motion);
  if (!motion) return;
  const Eigen::Matrix3d matrix = turn().toRotationMatrix();
  inertia_now_ = inertia_factor_ * (matrix * inertia_ * matrix.transpose());
  const auto held = held_rotations(*motion, dimension_);
  turning_ = inverse_on(inertia_now_, held);
  answer_ = turning_;
  if (!in_water()) return;
  const Vector shares = shares_of_added_inertia(options_.shape, dimension_);
  answer_ = inverse_on(
      inertia_now_ + added_inertia_ * (matrix * shares.asDiagonal() * matrix.transpose()), held);
}

/// Upper bounds rather than the added mass of potential flow: 1.2 times the water in a square as
/// wide as the body is long, that of a square in a wide tank is as much, of a circle and a plate
/// two thirds (Newman 1977, Marine Hydrodynamics, table 4.3). In space the same about its two
/// longest sides, strip by strip along the longest; about each axis as its own sides say, since a
/// hull that is ten times as long as wide would hardly answer to what rolls it with the inertia
/// that it has in pitch. The water may answer with up to twice as much and the body's own mass
/// before the step is unstable.
void Solid::put_in_water(double density, const BoxShape& domain) {
  if (!free()) return;
  std::array<double, 3> size{1.0, 1.0, 1.0};
  for (std::size_t a = 0; a < 3; ++a)
    if (dimension_ == 3 || a != 1)
      size[a] = std::max(0.0, std::min(box().upper[a], domain.upper[a]) -
                                  std::max(box().lower[a], domain.lower[a]));
  if (dimension_ == 3) {
    wide_inertia_ = density * added_inertias(size).maxCoeff();
    std::sort(size.begin(), size.end());
    wide_mass_ = 1.2 * density * size[1] * size[1] * size[2];
  } else {
    const double longest = std::max(size[0], size[2]);  // per metre
    wide_mass_ = 1.2 * density * longest * longest;
    wide_inertia_ = 0.06 * density * std::pow(longest, 4);
  }
  set_added_mass();
  moved_velocity_ = velocity_, moved_spin_ = spin_;  // the water starts with it
}

void Solid::set_added_mass() {
  added_mass_ = growth_ * wide_mass_, added_inertia_ = growth_ * wide_inertia_;
  if (mobility_ > 0.0) mobility_ = 1.0 / inertial_mass();
  update_inertia();
  turning_mobility_ =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(answer_).eigenvalues().maxCoeff();
}

void Solid::feel_water(const Vector& force, const Vector& moment, double dt) {
  if (!in_water()) return;
  const Vector push = force + added_mass_ * acceleration_;
  const Eigen::Matrix3d turned = turn().toRotationMatrix();
  const Vector shares = shares_of_added_inertia(options_.shape, dimension_);
  const Vector turning =
      moment +
      added_inertia_ * (turned * shares.cwiseProduct(turned.transpose() * turning_acceleration_));
  predicted_velocity_ += dt / inertial_mass() * free_axes_.cwiseProduct(push - push_);
  predicted_spin_ += dt * (answer_ * (turning - turning_push_));
  push_ = push, turning_push_ = turning;
  set_impulse(impulse_, moment_);
}

void Solid::begin_outer_step() {
  impulse_sum_.setZero(), moment_sum_.setZero(), collision_sum_.setZero();
  elapsed_ = 0.0;
}

void Solid::begin_step(double time, double dt, bool held) {
  impulse_.setZero(), moment_.setZero(), collision_.setZero();
  if (free()) {
    begin_free_step(time, dt);
  } else if (const auto* given = std::get_if<PrescribedSolid>(&options_.motion); given && !held) {
    const RigidVelocity motion_now = pose_.prescribed(*given, time, dt);
    predicted_velocity_ = motion_now.velocity, predicted_spin_ = motion_now.spin;
  } else {
    predicted_velocity_.setZero(), predicted_spin_.setZero();
  }
  velocity_ = predicted_velocity_, spin_ = predicted_spin_;
}

Solid::Vector Solid::given_force(double time) const {
  const auto* motion = std::get_if<FreeSolid>(&options_.motion);
  if (!motion) return Vector::Zero();
  const Vector frame = to_vector(values(motion->acceleration, centre(), time));
  return mass_ * (gravity_ + frame) + to_vector(values(motion->force, centre(), time));
}

Solid::Vector Solid::given_moment(double time) const {
  const auto* motion = std::get_if<FreeSolid>(&options_.motion);
  if (!motion) return Vector::Zero();
  return planar_rotation(values(motion->moment, centre(), time), dimension_);
}

Solid::Vector Solid::free_turns() const {
  Vector free = Vector::Zero();
  if (const auto* motion = std::get_if<FreeSolid>(&options_.motion)) {
    const auto held = held_rotations(*motion, dimension_);
    for (int a = 0; a < 3; ++a) free[a] = held[static_cast<std::size_t>(a)] ? 0.0 : 1.0;
  }
  return free;
}

void Solid::begin_static_step(double time, double dt, bool held) {
  if (free()) stop();
  begin_step(time, dt, held);
  if (free()) stop();
}

void Solid::follow(const RigidVelocity& motion, const Vector& impulse, const Vector& moment) {
  impulse_ = impulse, moment_ = moment;
  if (free()) velocity_ = motion.velocity, spin_ = motion.spin;
}

void Solid::begin_free_step(double time, double dt) {
  const Vector force = given_force(time) + push_, moment = given_moment(time) + turning_push_;
  predicted_velocity_ = velocity_ + dt / inertial_mass() * free_axes_.cwiseProduct(force);
  predicted_spin_ = turning_ * (inertia_now_ * spin_) + dt * (answer_ * moment);
}

void Solid::set_impulse(const Vector& impulse, const Vector& moment) {
  impulse_ = impulse, moment_ = moment;
  if (!free()) return;
  velocity_ = predicted_velocity_ + free_axes_.cwiseProduct(impulse) / inertial_mass();
  spin_ = predicted_spin_ + answer_ * moment;
}

RigidVelocity Solid::response(const Vector& impulse, const Vector& moment) const {
  if (!free()) return {};
  return {free_axes_.cwiseProduct(impulse) / inertial_mass(), answer_ * moment};
}

namespace {

/// The part of a change that a stop has made: none of what goes another way, and no more than it.
Eigen::Vector3d part_of(const Eigen::Vector3d& change, const Eigen::Vector3d& stop) {
  const double size = stop.norm();
  if (size == 0.0) return Eigen::Vector3d::Zero();
  return std::clamp(change.dot(stop) / size, 0.0, size) / size * stop;
}

}  // namespace

/// The added mass is not stopped: the water answers to that in the next step, and what the added
/// mass let through then would throw the body back. So the part of the change of velocity that the
/// collision made is none that it lets through.
void Solid::collide(const Vector& impulse, const Vector& moment) {
  if (!free()) return;
  const RigidVelocity change = response(impulse, moment);
  velocity_ += change.velocity, spin_ += change.spin;
  collision_ = impulse;
  if (!in_water()) return;
  stopped_ = part_of(velocity_ - moved_velocity_, change.velocity);
  stopped_spin_ = part_of(spin_ - moved_spin_, change.spin);
  collision_ -= added_mass_ * stopped_;
}

void Solid::book(double dt) {
  impulse_sum_ += impulse_, moment_sum_ += moment_, collision_sum_ += collision_;
  elapsed_ += dt;
}

void Solid::move(double dt) {
  const Vector before = acceleration_, turning_before = turning_acceleration_;
  acceleration_ = (velocity_ - moved_velocity_ - stopped_) / dt, moved_velocity_ = velocity_;
  turning_acceleration_ = (spin_ - moved_spin_ - stopped_spin_) / dt, moved_spin_ = spin_;
  stopped_.setZero(), stopped_spin_.setZero();
  if (in_water()) watch_growth(before, turning_before);
  const Vector angular_momentum = inertia_now_ * spin_;
  const bool turns = spin_.squaredNorm() > 0.0;
  pose_.move({velocity_, spin_}, dt);
  if (!turns) return;
  update_inertia();
  if (free()) spin_ = turning_ * angular_momentum;
}

void Solid::place_ahead(const RigidPose& pose, const RigidVelocity& motion, double dt) {
  pose_.stand_where(pose);
  pose_.move(motion, dt);
  update_inertia();
}

/// Acceleration that changes its sign from step to step and hardly falls says that the water
/// answers with more than the added mass takes (narrow gaps): then it grows, and shrinks again
/// afterwards. What is small beside weight is noise.
void Solid::watch_growth(const Vector& before, const Vector& turning_before) {
  constexpr double hardly = 0.5, faster = 1.5, slower = 0.98, most = 32.0, noise = 0.05;
  const auto swings = [&](const Vector& now, const Vector& last, double arm) {
    return arm * now.norm() > noise * gravity_.norm() &&
           now.dot(last) < -hardly * last.squaredNorm();
  };
  const double arm = wide_mass_ > 0.0 ? std::sqrt(wide_inertia_ / wide_mass_) : 0.0;
  const double old = growth_;
  if (swings(acceleration_, before, 1.0) || swings(turning_acceleration_, turning_before, arm))
    growth_ = std::min(most, faster * growth_);
  else
    growth_ = std::max(1.0, slower * growth_);
  if (growth_ != old) set_added_mass();
}

void Solid::stop() { velocity_.setZero(), spin_.setZero(); }

void Solid::start(bool reset_displacement) {
  stop();
  begin_outer_step();
  if (const auto* motion = std::get_if<FreeSolid>(&options_.motion)) {
    velocity_ = free_axes_.cwiseProduct(to_vector(motion->velocity));
    spin_ = turning_ * (inertia_now_ * planar_rotation(motion->angular_velocity, dimension_));
  }
  if (!reset_displacement) return;
  origin_ = centre(), first_turn_ = turn();
  if (free()) pose_.forget_turns();
}

Solid::Vector Solid::rotation() const {
  return dimension_ == 2 ? pose_.turned() : rotation_of(turn() * first_turn_.conjugate());
}

double Solid::kinetic_energy() const {
  return 0.5 *
         (inertia_factor_ * mass_ * velocity_.squaredNorm() + spin_.dot(inertia_now_ * spin_));
}

}  // namespace mudlark

#pragma once
/// One rigid body: where it is, how it moves, what soil and water do to it.
#include "grid/rigid_pose.hpp"
#include "grid/shape_volume.hpp"
#include "grid/solid_options.hpp"

namespace mudlark {

/// Always in three dimensions; in the plane the axes are x and z, and rotation is about y. All
/// ranks hold the same bodies and move them alike.
class Solid {
 public:
  using Vector = Eigen::Vector3d;

  /// `inertia_factor` scales inertia but not weight (mass scaling of the soil). Throws InputError
  /// when a free body has no volume to take mass, inertia or centre from.
  Solid(const SolidOptions& options, int dimension, const Point3& gravity, double inertia_factor);

  const SolidOptions& options() const { return options_; }
  const RigidPose& pose() const { return pose_; }
  /// Within a box around the body that has `reach` [m] to spare on each side?
  bool near(const Point3& place, double reach) const { return pose_.near(place, reach); }
  /// Smallest box around the body where it is now.
  const BoxShape& box() const { return pose_.box(); }
  SurfaceDistance distance(const Point3& place) const { return pose_.distance(place); }
  Vector velocity_at(const Vector& place) const {
    return velocity_ + spin_.cross(place - centre());
  }
  /// Largest speed of its surface within a box [m/s].
  double largest_speed(const BoxShape& within) const {
    return velocity_.norm() + spin_.norm() * pose_.reach(within);
  }

  /// In water of a density [kg/m3] in a domain: a free body's inertia is also that of a mass of
  /// water, of its size or more, and what that mass lets through of the last step's acceleration is
  /// a force. The two cancel but for the delay of the water's answer
  /// (docs/methods/bodies-in-water.md, Bodies that are free). Before the first step.
  void put_in_water(double density, const BoxShape& domain);
  /// The water's force [N] and moment [N m] over a step of dt [s] in which it saw the body move as
  /// in the last move(): corrects the velocity that begin_step() and set_impulse() left.
  void feel_water(const Vector& force, const Vector& moment, double dt);

  /// Opens an outer step: force and moment are means over it.
  void begin_outer_step();
  /// Velocity in a step of dt [s] from `time` on, without the soil. `held`: given motion waits.
  void begin_step(double time, double dt, bool held);
  /// Velocity with an impulse [N s] and its moment about the centre [N m s] by the soil.
  void set_impulse(const Vector& impulse, const Vector& moment);
  /// Change of velocity by an impulse [N s] and its moment [N m s].
  RigidVelocity response(const Vector& impulse, const Vector& moment) const;
  /// Impulse of other bodies and sides in the step, after all others.
  void collide(const Vector& impulse, const Vector& moment);
  /// Opens a step without inertia: a free body waits for follow().
  void begin_static_step(double time, double dt, bool held);
  /// Weight and given force [N] at a time, and its moment about the centre [N m].
  Vector given_force(double time) const;
  Vector given_moment(double time) const;
  /// 1 for axes along, and about, which a free body may move.
  Vector free_axes() const { return free_axes_; }
  Vector free_turns() const;
  /// Velocity of a free body in a step without inertia, and the soil's impulse and its moment.
  void follow(const RigidVelocity& motion, const Vector& impulse, const Vector& moment);
  /// Books the impulses of a step of dt [s].
  void book(double dt);
  /// Moves with the present velocity.
  void move(double dt);
  /// Stands where another pose will be that moves for dt [s], as after move().
  void place_ahead(const RigidPose& pose, const RigidVelocity& motion, double dt);
  /// Stands still, until the forces on it or start() move it.
  void stop();
  /// Takes on its velocity of time zero; counts displacement and rotation from here where asked.
  void start(bool reset_displacement);

  /// Largest velocity per impulse, and angular velocity per moment; zero for given motion.
  double mobility() const { return mobility_; }
  double turning_mobility() const { return turning_mobility_; }
  bool free() const { return std::holds_alternative<FreeSolid>(options_.motion); }

  const Vector& centre() const { return pose_.centre(); }
  Vector displacement() const { return centre() - origin_; }  ///< since the start [m]
  /// Since the start [rad]: rotation vector, in the plane (0, -angle, 0) with the angle
  /// counter-clockwise.
  Vector rotation() const;
  const Eigen::Quaterniond& turn() const { return pose_.turn(); }  ///< from the shape as given
  const Vector& velocity() const { return velocity_; }             ///< of the centre [m/s]
  const Vector& spin() const { return spin_; }                     ///< [rad/s]
  double mass() const { return mass_; }                            ///< [kg]; 0 for given motion
  /// Of the soil on the body, mean over the outer step [N]; its moment about the centre [N m].
  Vector force() const { return elapsed_ > 0.0 ? Vector(impulse_sum_ / elapsed_) : Vector::Zero(); }
  Vector moment() const { return elapsed_ > 0.0 ? Vector(moment_sum_ / elapsed_) : Vector::Zero(); }
  /// Of other bodies and the domain's sides, mean over the outer step [N].
  Vector collision_force() const {
    return elapsed_ > 0.0 ? Vector(collision_sum_ / elapsed_) : Vector::Zero();
  }
  double kinetic_energy() const;  ///< [J]
  Vector momentum() const { return mass_ * velocity_; }

  template <class Archive>
  void archive(Archive& a) {
    const std::string at = "solid/" + options_.name + "/";
    const auto vector = [&](const char* name, Vector& v) {
      for (int i = 0; i < 3; ++i) a.number(at + name + " " + std::to_string(i), v[i]);
    };
    pose_.archive(a, at);
    vector("origin", origin_), vector("velocity", velocity_), vector("spin", spin_);
    vector("impulse", impulse_sum_), vector("moment", moment_sum_);
    vector("collision", collision_sum_);
    a.number(at + "elapsed", elapsed_);
    for (int i = 0; i < 4; ++i)
      a.number(at + "first turn " + std::to_string(i), first_turn_.coeffs()[i]);
    if (in_water()) {
      vector("push", push_), vector("turning push", turning_push_);
      vector("moved velocity", moved_velocity_), vector("moved spin", moved_spin_);
      vector("stopped", stopped_), vector("stopped spin", stopped_spin_);
      vector("acceleration", acceleration_), vector("turning acceleration", turning_acceleration_);
      a.number(at + "growth", growth_);
      set_added_mass();
    }
    update_inertia();
  }

 private:
  Solid(const SolidOptions& options, int dimension, const Point3& gravity, double inertia_factor,
        const std::optional<SolidVolume>& volume);
  void set_mass(const FreeSolid& motion, const std::optional<SolidVolume>& volume);
  void begin_free_step(double time, double dt);
  void update_inertia();
  void set_added_mass();
  void watch_growth(const Vector& before, const Vector& turning_before);
  bool in_water() const { return added_mass_ > 0.0; }
  double inertial_mass() const { return inertia_factor_ * mass_ + added_mass_; }

  SolidOptions options_;
  int dimension_;
  Vector gravity_;
  RigidPose pose_;
  double inertia_factor_, mass_ = 0.0, mobility_ = 0.0, turning_mobility_ = 0.0;
  Vector free_axes_ = Vector::Zero();                  ///< 1 where translation is free
  Eigen::Matrix3d inertia_ = Eigen::Matrix3d::Zero();  ///< in the shape's frame [kg m2]
  Eigen::Matrix3d inertia_now_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d turning_ = Eigen::Matrix3d::Zero();  ///< inverse of it on the free axes
  Eigen::Matrix3d answer_ = Eigen::Matrix3d::Zero();   ///< the same with that of added water
  double added_mass_ = 0.0, added_inertia_ = 0.0;      ///< of water [kg], [kg m2]
  double wide_mass_ = 0.0, wide_inertia_ = 0.0;        ///< the same in wide water
  double growth_ = 1.0;                                ///< of the added mass over that
  /// Of the water, and what the added mass lets through of the acceleration that the water saw [N].
  Vector push_ = Vector::Zero(), turning_push_ = Vector::Zero();
  Vector moved_velocity_ = Vector::Zero(), moved_spin_ = Vector::Zero();  ///< of the last move
  Vector acceleration_ = Vector::Zero(), turning_acceleration_ = Vector::Zero();  ///< in it
  Vector stopped_ = Vector::Zero(), stopped_spin_ = Vector::Zero();  ///< by collisions in the step
  Vector origin_, velocity_ = Vector::Zero(), spin_ = Vector::Zero();
  Vector predicted_velocity_ = Vector::Zero(), predicted_spin_ = Vector::Zero();
  Eigen::Quaterniond first_turn_ = Eigen::Quaterniond::Identity();
  Vector impulse_ = Vector::Zero(), moment_ = Vector::Zero();  ///< of the present step
  Vector impulse_sum_ = Vector::Zero(), moment_sum_ = Vector::Zero();
  Vector collision_ = Vector::Zero(), collision_sum_ = Vector::Zero();
  double elapsed_ = 0.0;  ///< of the outer step [s]
};

}  // namespace mudlark

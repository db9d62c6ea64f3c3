#pragma once
/// Where a rigid body is, and motion that is given as a function of time: what bodies in soil and
/// bodies in water share.
#include <Eigen/Geometry>
#include <string>

#include "base/varying.hpp"
#include "grid/shape_distance.hpp"

namespace mudlark {

struct FixedSolid {};

/// Motion that is given as functions of time. Vectors have components x, y, z; in the plane only x
/// and z count, and rotation has one component, the second, positive counter-clockwise with x to
/// the right and z upwards.
struct PrescribedSolid {
  bool by_displacement = false;          ///< else by velocity
  bool by_rotation = false;              ///< else by angular velocity
  std::array<Varying, 3> translation{};  ///< of the centre: displacement [m] or velocity [m/s]
  std::array<Varying, 3> rotation{};     ///< rotation vector [rad] or angular velocity [rad/s]
};

/// Velocity of the centre [m/s] and angular velocity [rad/s].
struct RigidVelocity {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
};

/// Always in three dimensions; in the plane the axes are x and z, and rotation is about y.
class RigidPose {
 public:
  using Vector = Eigen::Vector3d;

  /// The shape as given, which turns about `centre` [m].
  RigidPose(const Shape& shape, const Point3& centre, int dimension);

  const Shape& shape() const { return shape_; }  ///< as given
  const Vector& start_centre() const { return start_centre_; }
  const Vector& centre() const { return centre_; }          ///< [m]
  const Eigen::Quaterniond& turn() const { return turn_; }  ///< from the shape as given
  const Vector& turned() const { return turned_; }          ///< sum of all steps' rotations [rad]
  void forget_turns() { turned_.setZero(); }
  /// Smallest box around the body where it is now.
  const BoxShape& box() const { return box_; }
  /// Within a box around the body that has `reach` [m] to spare on each side?
  bool near(const Point3& place, double reach) const;
  SurfaceDistance distance(const Point3& place) const;
  /// Where a place of the shape as given is now [m].
  Vector place(const Vector& as_given) const {
    return centre_ + turn_ * (as_given - start_centre_);
  }
  /// Farthest way from the centre to places of the body within a box [m].
  double reach(const BoxShape& within) const;

  /// Velocity over a step of dt [s] from `time` on: given places are met at the end of the step,
  /// given velocities are those of its middle.
  RigidVelocity prescribed(const PrescribedSolid& motion, double time, double dt) const;
  /// Where another pose of the same body is.
  void stand_where(const RigidPose& other);
  /// Moves with a velocity for dt [s].
  void move(const RigidVelocity& motion, double dt);

  template <class Archive>
  void archive(Archive& a, const std::string& at) {
    for (int i = 0; i < 3; ++i) {
      a.number(at + "centre " + std::to_string(i), centre_[i]);
      a.number(at + "turned " + std::to_string(i), turned_[i]);
    }
    for (int i = 0; i < 4; ++i) a.number(at + "turn " + std::to_string(i), turn_.coeffs()[i]);
    update_box();
  }

 private:
  void update_box();

  Shape shape_;
  int dimension_;
  BoxShape start_box_;
  Vector start_centre_, centre_;
  Vector turned_ = Vector::Zero();
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
  bool turned_at_all_ = false;
  BoxShape box_;
};

/// A vector about axes; in the plane the second component counts, counter-clockwise with x to the
/// right and z upwards, which is about -y.
Eigen::Vector3d planar_rotation(const std::array<double, 3>& given, int dimension);
Eigen::Quaterniond turn_by(const Eigen::Vector3d& rotation);
/// The rotation vector of a turn, at most half a turn long.
Eigen::Vector3d rotation_of(Eigen::Quaterniond turn);
std::array<double, 3> values(const std::array<Varying, 3>& given, const Eigen::Vector3d& place,
                             double time);

/// The axis of space that an axis of the problem is.
template <int D>
constexpr int axis_in_space(int axis) {
  return D == 2 && axis == 1 ? 2 : axis;
}
template <int D>
Vec<D> to_axes(const Eigen::Vector3d& v) {
  Vec<D> out;
  for (int a = 0; a < D; ++a) out[a] = v[axis_in_space<D>(a)];
  return out;
}
template <int D>
Eigen::Vector3d to_space(const Vec<D>& v) {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (int a = 0; a < D; ++a) out[axis_in_space<D>(a)] = v[a];
  return out;
}
inline Eigen::Vector3d to_vector(const Point3& p) { return {p[0], p[1], p[2]}; }
inline Point3 to_point(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace mudlark

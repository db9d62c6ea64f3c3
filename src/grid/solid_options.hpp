#pragma once
/// Rigid bodies as the case file gives them, plain data (SI units).
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "grid/rigid_pose.hpp"

namespace mudlark {

/// Motion under weight, given forces, soil and water. In the plane what is per body is per metre of
/// thickness.
struct FreeSolid {
  std::optional<double> mass;                    ///< [kg]; else from the density
  double density = 0.0;                          ///< [kg/m3]
  std::optional<std::array<double, 3>> inertia;  ///< about x, y, z through the centre [kg m2]
  std::array<double, 3> velocity{};              ///< at time zero [m/s]
  std::array<double, 3> angular_velocity{};      ///< at time zero [rad/s]
  std::array<Varying, 3> force{};                ///< at the centre, beside the weight [N]
  std::array<Varying, 3> acceleration{};         ///< beside gravity, of a frame that moves [m/s2]
  std::array<Varying, 3> moment{};               ///< about the centre [N m]
  std::array<bool, 3> locked{};                  ///< no translation along x, y, z
  std::array<bool, 3> locked_rotation{};         ///< no rotation about x, y, z; plane: the second
};

struct SolidOptions {
  std::string name;
  Shape shape;                   ///< where it is at time zero
  std::optional<Point3> centre;  ///< what it turns about; else the shape's centre of mass [m]
  std::variant<FixedSolid, PrescribedSolid, FreeSolid> motion;
  double friction = 0.0;     ///< Coulomb's coefficient [-]; infinite: soil sticks while it presses
  double adhesion = 0.0;     ///< shear strength of the contact without pressure [Pa]
  bool sharp_edges = false;  ///< soil beyond its edges is not held by those beside them
};

}  // namespace mudlark

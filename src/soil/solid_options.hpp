#pragma once
/// Rigid bodies in soil as the case file gives them, plain data (SI units).
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/varying.hpp"
#include "grid/shape.hpp"

namespace mudlark {

/// Vectors have components x, y, z. In the plane only x and z count, rotation has one component,
/// the second, positive counter-clockwise with x to the right and z upwards, and what is per body
/// is per metre of thickness.
struct FixedSolid {};

/// Motion that is given as functions of time.
struct PrescribedSolid {
  bool by_displacement = false;          ///< else by velocity
  bool by_rotation = false;              ///< else by angular velocity
  std::array<Varying, 3> translation{};  ///< of the centre: displacement [m] or velocity [m/s]
  std::array<Varying, 3> rotation{};     ///< rotation vector [rad] or angular velocity [rad/s]
};

/// Motion under weight, given forces and the soil.
struct FreeSolid {
  std::optional<double> mass;                    ///< [kg]; else from the density
  double density = 0.0;                          ///< [kg/m3]
  std::optional<std::array<double, 3>> inertia;  ///< about x, y, z through the centre [kg m2]
  std::array<double, 3> velocity{};              ///< at time zero [m/s]
  std::array<double, 3> angular_velocity{};      ///< at time zero [rad/s]
  std::array<Varying, 3> force{};                ///< at the centre, beside the weight [N]
  std::array<Varying, 3> moment{};               ///< about the centre [N m]
  std::array<bool, 3> locked{};                  ///< no translation along x, y, z
  std::array<bool, 3> locked_rotation{};         ///< no rotation about x, y, z; plane: the second
};

struct SolidOptions {
  std::string name;
  Shape shape;                   ///< where it is at time zero
  std::optional<Point3> centre;  ///< what it turns about; else the shape's centre of mass [m]
  std::variant<FixedSolid, PrescribedSolid, FreeSolid> motion;
  double friction = 0.0;  ///< Coulomb's coefficient [-]; infinite: soil sticks while it presses
  double adhesion = 0.0;  ///< shear strength of the contact without pressure [Pa]
};

/// Volume [m^D], its centre [m] and its second moments about the centre.
struct SolidVolume {
  double volume = 0.0;
  Point3 centre{};
  std::array<std::array<double, 3>, 3> moments{};  ///< integral of r r^T [m^(D+2)]
};
/// Exact for boxes and surfaces of triangles, to some 1e-4 for other shapes. Nothing for a shape
/// without end (in the plane: along x or z) and for an empty one.
std::optional<SolidVolume> volume_of(const Shape& shape, int dimension);

}  // namespace mudlark

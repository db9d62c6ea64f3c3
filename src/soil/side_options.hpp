#pragma once
/// What the case file says about parts of the domain's sides, for soil and the water in it.
#include <array>
#include <limits>
#include <string>

#include "base/varying.hpp"

namespace mudlark {

/// How a side meets the grains, weakest hold first: where parts meet, the stronger one holds what
/// lies between them.
/// open: they leave. absorbing: dashpots and springs. slip: free along the side. friction: Coulomb.
/// fixed: no motion. moving: the side moves in a given way.
enum class GrainSide { open, absorbing, slip, friction, fixed, moving };

/// How a side meets the pore water.
/// sealed: nothing flows through. pressure: a given pressure. seepage_face: water may leave at
/// atmospheric pressure and cannot enter. inflow: a given flux.
enum class WaterSide { sealed, pressure, seepage_face, inflow };

/// Kelvin-Voigt (NUMERICS A6; Lysmer & Kuhlemeyer 1969 without springs): traction of the side
/// -a rho c_p v - (M/d) u along its normal, -b rho c_s v - (G/d) u along the side.
struct Absorber {
  double normal = 1.0, tangential = 1.0;  ///< a, b [-]
  /// d, of the soil that the springs stand for [m]; infinite: no springs.
  double thickness = std::numeric_limits<double>::infinity();
};

/// A part of a side of the domain.
struct SoilBoundary {
  std::string name;
  int axis = 0, side = 0;  ///< 0: lower side, 1: upper side
  /// Along the side [m]; the entry of the side's own axis is not used.
  std::array<double, 3> from, to;

  bool for_grains = false;  ///< otherwise grains meet what [domain.walls] says
  GrainSide grains = GrainSide::slip;
  double friction = 0.0;  ///< coefficient [-]
  Absorber absorber;
  std::array<Varying, 3> motion{};  ///< of the side, x y z [m/s] or [m]
  bool motion_is_displacement = false;
  bool holds_along = true;  ///< does a moving side carry the grains along with it?

  bool for_water = false;  ///< otherwise pore water is sealed in
  WaterSide water = WaterSide::sealed;
  Varying value;         ///< pressure [Pa], head [m], or flux into the soil [m/s]
  bool is_head = false;  ///< level to which the water stands, on the vertical axis

  SoilBoundary() {
    from.fill(-std::numeric_limits<double>::infinity());
    to.fill(std::numeric_limits<double>::infinity());
  }
};

}  // namespace mudlark

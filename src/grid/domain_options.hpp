#pragma once
/// What the case file says about the domain, as plain data.
#include <array>
#include <vector>

namespace mudlark {

/// How a side of the domain behaves.
/// slip: no flow through, free along. no_slip: no motion at all. open: water and soil may leave,
/// water stands under atmospheric pressure there. periodic: joined to the opposite side. friction:
/// slip for water, Coulomb friction for soil.
enum class Wall { slip, no_slip, open, periodic, friction };

struct DomainOptions {
  int dimension = 2;  ///< 2 (plane strain, axes x and z) or 3
  std::array<double, 3> lower{},
      upper{};                        ///< [m], first `dimension` entries used; last one vertical
  std::array<int, 3> cells{1, 1, 1};  ///< number of cells per axis
  /// Positions of the faces of stretched axes, cells + 1 of them [m]; empty: all cells are equal.
  std::array<std::vector<double>, 3> faces;
  std::array<double, 3> gravity{};  ///< acceleration [m/s2] per axis, usually (0, .., -9.81)
  std::array<std::array<Wall, 2>, 3> walls{};            ///< [axis][0: lower side, 1: upper side]
  std::array<std::array<double, 2>, 3> wall_friction{};  ///< coefficients of friction walls [-]
};

}  // namespace mudlark

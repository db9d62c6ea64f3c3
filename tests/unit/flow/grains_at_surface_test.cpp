// Grains that the surface of the water leaves under it, beside the end of the ground.
#include "flow/grains_at_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mudlark {
namespace {

/// The kernel of the grains along an axis, in cells.
double cubic_spline(double x) {
  const double d = std::abs(x);
  if (d >= 2.0) return 0.0;
  return d < 1.0 ? 2.0 / 3.0 - d * d + 0.5 * d * d * d : std::pow(2.0 - d, 3) / 6.0;
}

/// What a face has of ground that ends `top` cells beyond it, as two rows of points per cell leave
/// it, over that of ground without an end.
double share(double top) {
  double sum = 0.0;
  for (int row = 0; row < 20; ++row) sum += 0.5 * cubic_spline(top - 0.25 - 0.5 * row);
  return sum;
}

/// Face of the surface at 0, the wet cell below it; ground and water end at `top` and `level`.
GrainsAcrossSurface ground(double top) {
  return {share(top + 2.0), share(top + 1.0), share(top), share(top - 1.0)};
}

TEST(GrainsAtSurface, AreUnderWaterAsFarAsItReachesWhereGroundGoesOn) {
  for (const double reach : {0.05, 0.3, 0.5, 0.9, 1.0})
    EXPECT_NEAR(part_under_water(ground(5.0), reach), reach, 1e-12);
  EXPECT_EQ(part_under_water({0.5, 0.49, 0.51, 0.52}, 0.4), 0.4);
  EXPECT_EQ(part_under_water({0.5, 0.5, 0.0, 0.0}, 0.4), 0.4);
}

/// Faces up to that of the surface lift all of the sharp ground under the level.
TEST(GrainsAtSurface, AreThoseOfSharpGroundWhereItEnds) {
  for (double top = -0.5; top < 2.6; top += 0.25)
    for (double reach = 0.1; reach < 1.0; reach += 0.1) {
      const double level = reach - 0.5;
      const GrainsAcrossSurface grains = ground(top);
      // The two faces before it have their own and begin 2.5 cells below it.
      const double exact = std::min(top, level) + 2.5 - grains.within - grains.deeper;
      EXPECT_NEAR(part_under_water(grains, reach) * grains.here, exact, 0.01)
          << "top " << top << ", reach " << reach;
    }
}

TEST(GrainsAtSurface, PartIsNeverLessThanReachNorMoreThanTwice) {
  for (const double beyond : {0.0, 0.01, 0.2, 0.4})
    for (const double within : {0.0, 0.1, 0.5})
      for (const double here : {1e-9, 0.01, 0.25, 0.5}) {
        const double part = part_under_water({0.5, within, here, beyond}, 0.3);
        EXPECT_GE(part, 0.3);
        EXPECT_LE(part, 2.0);
      }
}

}  // namespace
}  // namespace mudlark

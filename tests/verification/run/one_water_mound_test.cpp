// ranks: 1
// A mound of soil settles in one water: pressure has no checkerboard (NUMERICS C2, evidence).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, density = 1000.0;

/// Pressure above that of water at rest, largest of all full cells, and how far a cell departs most
/// from the mean of its four neighbours: anywhere, and in cells with grains two cells around.
struct Roughness {
  double peak = 0.0, anywhere = 0.0, inside = 0.0;
};
Roughness roughness(World<2>& world, double level) {
  const auto& grid = world.grid();
  const auto& p = world.flow()->pressure();
  const auto& porosity = world.flow()->porosity();
  const auto excess = [&](const Index<2>& cell) {
    return p[cell] - density * gravity * (level - grid.cell_centre(cell)[1]);
  };
  Roughness found;
  IndexBox<2> inner = grid.owned();
  for (int a = 0; a < 2; ++a) ++inner.lower[a], --inner.upper[a];
  for_each(inner, [&](const Index<2>& cell) {
    if (grid.cell_centre(cell)[1] > level - 2.0 * grid.spacing()[1]) return;
    double mean = 0.0;
    bool among_grains = true;
    for (int a = 0; a < 2; ++a) {
      mean += 0.25 * (excess(cell.shifted(a, -1)) + excess(cell.shifted(a, 1)));
      among_grains = among_grains && porosity[cell.shifted(a, -2)] < 0.45 &&
                     porosity[cell.shifted(a, 2)] < 0.45;
    }
    const double deviation = std::abs(excess(cell) - mean);
    found.peak = std::max(found.peak, std::abs(excess(cell)));
    found.anywhere = std::max(found.anywhere, deviation);
    if (among_grains) found.inside = std::max(found.inside, deviation);
  });
  return found;
}

/// Largest over 0.05 s in which a mound without stress is let go in water: it settles, and water
/// goes out of it. A pressure that alternated from cell to cell would depart from its neighbours'
/// mean by as much as it is high.
Roughness of_a_mound(GrainShare share, double conductivity) {
  const double level = 1.5;
  PolygonShape mound;  // half of one, beside a wall that is its axis
  mound.corners.push_back({-1.0, 0.0});
  for (int i = 24; i >= 0; --i)
    mound.corners.push_back(
        {i / 24.0, 0.8 * std::pow(std::cos(0.5 * std::numbers::pi * i / 24.0), 2)});
  mound.corners.push_back({-1.0, 0.8});
  CaseOptions c = soil_in_water(Shape{mound}, level, conductivity, 5e5);
  c.domain.cells = {24, 32, 1};
  c.domain.upper = {1.2, 1.6, 0.0};
  c.coupling.grain_share = share;
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  Roughness worst;
  while (world.clock().time() < 0.05) {
    world.advance(0.9 * world.stable_step());
    const Roughness now = roughness(world, level);
    worst.peak = std::max(worst.peak, now.peak);
    worst.anywhere = std::max(worst.anywhere, now.anywhere);
    worst.inside = std::max(worst.inside, now.inside);
  }
  std::printf("k = %g m/s: departs by %.1f %% of the peak, among grains %.1f %%\n", conductivity,
              100.0 * worst.anywhere / worst.peak, 100.0 * worst.inside / worst.peak);
  EXPECT_GT(worst.peak, 1000.0);
  return worst;
}

TEST(OneWaterMound, PressureHasNoCheckerboard) {
  for (const double conductivity : {1e-2, 1e-4, 1e-9}) {
    const Roughness found = of_a_mound(GrainShare::cells, conductivity);
    EXPECT_LT(found.anywhere, 0.05 * found.peak) << "k = " << conductivity;
  }
}

/// What the points have of a face and what the water of its cells leaves differ most at the surface
/// of the soil: there pressure departs by 9 % where the soil lets little through.
TEST(OneWaterMound, PressureHasNoCheckerboardAmongGrainsWithTheSharesOfPoints) {
  for (const double conductivity : {1e-2, 1e-9}) {
    const Roughness found = of_a_mound(GrainShare::points, conductivity);
    EXPECT_LT(found.inside, 0.05 * found.peak) << "k = " << conductivity;
    EXPECT_LT(found.anywhere, 0.12 * found.peak) << "k = " << conductivity;
  }
}

}  // namespace
}  // namespace mudlark

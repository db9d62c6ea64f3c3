// ranks: 1 3
// Coulomb friction on the sides of the domain.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

/// A layer on a floor of friction, joined to itself along the slope; gravity acts as on a slope.
template <int D>
double sliding_speed(double along, double friction, double time, bool wet = false) {
  DomainOptions domain;
  domain.dimension = D;
  domain.cells = {9, D == 2 ? 8 : 3, 8};
  const double h = 0.1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a)
    domain.upper[a] = domain.cells[a] * h;
  domain.walls[0] = {Wall::periodic, Wall::periodic};
  domain.walls[D - 1] = {Wall::friction, Wall::open};
  domain.wall_friction[D - 1][0] = friction;
  domain.gravity[0] = along;
  domain.gravity[D - 1] = -10.0;
  const Grid<D> grid(domain, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 0.4}, wet);
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].law = LinearElasticOptions{1e8, 0.3};  // swings far faster than it slides
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double now = 0.0;
  const int steps = static_cast<int>(std::ceil(time / soil.stable_step()));
  soil_runs::run(soil, now, steps, time / steps);
  const auto totals = soil.totals();
  return totals.momentum[0] / (totals.grain_mass + totals.water_mass);
}

TEST(WallFriction, HoldsALayerBelowTheAngleOfFriction) {
  EXPECT_NEAR(sliding_speed<2>(3.0, 0.4, 0.2), 0.0, 0.01 * 3.0 * 0.2);
  EXPECT_NEAR(sliding_speed<3>(3.0, 0.4, 0.1), 0.0, 0.01 * 3.0 * 0.1);
}

// a = g_x - mu g_z
TEST(WallFriction, LetsALayerSlideAboveItAsABlockOnASlope) {
  const double time = 0.2;
  for (const double friction : {0.0, 0.2, 0.4}) {
    const double exact = (6.0 - 10.0 * friction) * time,
                 speed = sliding_speed<2>(6.0, friction, time);
    std::printf("friction %.1f: %.4f m/s, exact %.4f m/s\n", friction, speed, exact);
    EXPECT_NEAR(speed, exact, 0.01 * 6.0 * time);
  }
  EXPECT_NEAR(sliding_speed<3>(6.0, 0.4, 0.1), 0.2, 0.012);
}

}  // namespace
}  // namespace mudlark

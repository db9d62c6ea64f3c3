// ranks: 1 3
#include <gtest/gtest.h>

#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

TEST(UniformFlow, OfADropInEmptySpaceStaysUniformToRoundOff) {
  FlowOptions options;
  options.viscosity = 0.0;
  WaterBody drop;
  drop.shape.form = SphereShape{{0.4, 0.0, 0.5}, 0.22, true};
  drop.velocity[0] = Varying(0.7);
  drop.velocity[2] = Varying(0.3);
  options.bodies = {drop};
  FlowRun<2> run(flow_domain({32, 32, 1}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}, Wall::periodic),
                 options);
  for (int step = 0; step < 120; ++step) run.step(run.flow.stable_step(run.medium));
  double worst = 0.0;
  for (int axis = 0; axis < 2; ++axis)
    for_each(run.grid.owned(), [&](const Index<2>& face) {
      if (run.flow.water_fraction()[face] > 1e-3)
        worst =
            std::max(worst, std::abs(run.flow.velocity()[axis][face] - (axis == 0 ? 0.7 : 0.3)));
    });
  EXPECT_LT(max_over_ranks(run.grid, worst), 1e-12);
  EXPECT_GT(run.time, 0.6);
}

/// Ground that gives way: a source of grains in the lowest cell lifts the column above it by U.
/// Pressure under it rises by rho L U / dt with L from that cell's centre to the surface, and the
/// ground takes back h G rho L U / dt, so U = Q h / (1 + h G rho L / dt).
TEST(MovingGround, GivesWayToARiseOfPressureByTheStatedVolume) {
  FlowOptions options;
  options.viscosity = 0.0;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.63})};
  FlowRun<2> run(flow_domain({4, 10, 1}, {0.4, 1.0, 1.0}, {0.0, -9.81, 0.0}), options);
  const double h = 0.1, dt = 1e-3, source = 0.02, length = 0.63 - 0.05, yielding = 1e-5;
  for_each(run.grid.owned().extended(1, 1), [&](const Index<2>& face) {
    if (face[1] == 0) run.medium.give_way[face] = yielding;
    // -div(grain flux) = source in the lowest row of cells.
    run.medium.grain_flux[1][face] = face[1] == 1 ? -source * h : 0.0;
  });
  for_each(run.grid.owned().extended(1, 1), [&](const Index<2>& face) {
    if (face[1] > 1) run.medium.grain_flux[1][face] = -source * h;
  });
  run.step(dt);
  const double expected = source * h / (1.0 + h * yielding * 1000.0 * length / dt);
  for_each(run.grid.owned(), [&](const Index<2>& face) {
    if (face[1] >= 1 && face[1] <= 6) {
      EXPECT_NEAR(run.flow.velocity()[1][face], expected, 1e-6 * expected);
    }
  });
}

/// A smooth heap of ground slides to and fro under a pond; the medium is renewed before each step,
/// as the soil does it. The water must keep its volume and bounds, and the porosity that it carries
/// must follow.
TEST(MovingGround, SlidesUnderAPondWithoutLossOfWater) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.62})};
  const Grid<2> grid(flow_domain({40, 32, 1}, {1.0, 0.8, 1.0}, {0.0, -9.81, 0.0}), MPI_COMM_WORLD);
  PorousMedium<2> medium(grid);
  const auto solid = [](const Vec<2>& x, double centre) {
    const double r2 = (x[0] - centre) * (x[0] - centre) + x[1] * x[1];
    return 0.6 * std::exp(-r2 / 0.02);
  };
  const auto renew = [&](double time) {
    const double centre = 0.5 + 0.1 * std::sin(2.0 * time), speed = 0.2 * std::cos(2.0 * time);
    for_each(grid.local(), [&](const Index<2>& cell) {
      medium.porosity[cell] = 1.0 - solid(grid.cell_centre(cell), centre);
    });
    for_each(grid.local(), [&](const Index<2>& face) {
      const double grains = solid(grid.face_centre(0, face), centre);
      const bool wall = face[0] <= 0 || face[0] >= grid.cells()[0];
      medium.grain_flux[0][face] = wall ? 0.0 : grains * speed;
      medium.grain_velocity[0][face] = wall ? 0.0 : speed;
      medium.linear_drag[0][face] = medium.linear_drag[1][face] = 1e6 * grains;
    });
  };
  renew(0.0);
  FlowSolver<2> flow(grid, options);
  flow.initialise(medium);
  double time = 0.0, drift = 0.0, bounds = 0.0;
  while (time < 4.0) {
    renew(time);
    const double dt = std::min(flow.stable_step(medium), 0.01);
    flow.advance(medium, dt);
    time += dt;
    for_each(grid.owned(), [&](const Index<2>& cell) {
      drift = std::max(drift, std::abs(flow.porosity()[cell] - medium.porosity[cell]));
      const double w = flow.water_fraction()[cell];
      bounds = std::max({bounds, -w, w - flow.porosity()[cell]});
    });
  }
  EXPECT_LT(max_over_ranks(grid, bounds), 1e-12);
  EXPECT_LT(max_over_ranks(grid, drift), 0.02);
  const WaterLedger water = flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
  EXPECT_LT(flow.max_speed().speed, 1.0);
}

}  // namespace
}  // namespace mudlark

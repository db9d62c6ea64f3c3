// ranks: 1 3
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "verification/flow/two_fluids_setup.hpp"

namespace mudlark {
namespace {

template <int D>
double fastest_face(const FlowRun<D>& run, const Vec<D>& mean = {}) {
  double fastest = 0.0;
  for (int axis = 0; axis < D; ++axis)
    for_each(run.grid.owned(), [&](const Index<D>& face) {
      fastest = std::max(fastest, std::abs(run.flow.velocity()[axis][face] - mean[axis]));
    });
  return max_over_ranks(run.grid, fastest);
}

TEST(TwoFluids, ADropAThousandTimesHeavierThanItsGasKeepsItsVelocityInUniformFlow) {
  FlowOptions options = with_gas();
  WaterBody drop;
  drop.shape.form = SphereShape{{0.4, 0.0, 0.5}, 0.22, true};
  drop.velocity[0] = options.gas->velocity[0] = Varying(0.7);
  drop.velocity[2] = options.gas->velocity[2] = Varying(0.3);
  options.bodies = {drop};
  FlowRun<2> run(flow_domain({32, 32, 1}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}, Wall::periodic),
                 options);
  const double start = run.flow.ledger().initial;
  for (int step = 0; step < 200; ++step) run.step(run.flow.stable_step(run.medium));
  EXPECT_LT(fastest_face(run, Vec<2>{{0.7, 0.3}}), 1e-12);
  EXPECT_NEAR(run.flow.ledger().present, start, 1e-12 * start);
  EXPECT_GT(run.time, 1.0);
}

TEST(TwoFluids, APondUnderGasOverAStepOfPorosityStaysAtRest) {
  FlowOptions options = with_gas();
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.537})};
  PorousGround ground;
  ground.shape.form = BoxShape{{0.7, -1.0, -1.0}, {2.0, 1.0, 0.7}};
  ground.porosity = 0.35;
  ground.drag = DragLaw::ergun;
  ground.grain_size = 0.02;
  options.porous = {ground};
  FlowRun<2> run(flow_domain({32, 24, 1}, {1.0, 0.75, 1.0}, {0.0, -9.81, 0.0}), options);
  for (int step = 0; step < 300; ++step) run.step(0.5 * run.flow.stable_step(run.medium));
  EXPECT_LT(fastest_face(run), 1e-12);
  // Above that of gas at rest: weighed without the gas that the water displaces.
  EXPECT_NEAR(run.flow.pressure_at(Vec<2>{{0.2, 0.2}}), 999.0 * 9.81 * (0.537 - 0.2), 1e-6);
  EXPECT_NEAR(run.flow.pressure_at(Vec<2>{{0.2, 0.7}}), 0.0, 1e-9);
}

/// Water under a plane at right angles to gravity, in a box that is tilted by 1/5 along x (and by
/// 1/8 along y).
template <int D>
void stays_at_rest_when_tilted() {
  constexpr int up = D - 1;
  const Vec<D> slope = D == 2 ? Vec<D>{{0.2}} : Vec<D>{{0.2, 0.125}};
  const double down = -9.81 / std::sqrt(1.0 + dot(slope, slope));
  const std::array<double, 3> gravity = D == 2 ? std::array{slope[0] * down, down, 0.0}
                                               : std::array{slope[0] * down, slope[1] * down, down};
  FlowOptions options = with_gas();
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.4})};
  const auto domain = D == 2 ? flow_domain({40, 40, 1}, {1.0, 1.0, 1.0}, gravity)
                             : flow_domain({16, 12, 16}, {1.0, 0.75, 1.0}, gravity);
  FlowRun<D> run(domain, options);
  const auto fraction = [&](const Index<D>& cell) {  // exact, by the plane's own formula
    Plane<D> plane;
    double below = 0.611 - (run.grid.cell_centre(cell)[up] - 0.5 * run.grid.spacing()[up]);
    for (int a = 0; a < up; ++a) {
      below -= slope[a] * (run.grid.cell_centre(cell)[a] - 0.5 * run.grid.spacing()[a]);
      plane.normal[a] = slope[a] * run.grid.spacing()[a];
    }
    plane.normal[up] = run.grid.spacing()[up];
    plane.constant = below;
    return volume_below(plane);
  };
  run.flow.archive(*std::make_unique<WaterSetter<D, decltype(fraction)>>(
      WaterSetter<D, decltype(fraction)>{run.grid, fraction}));
  for (int step = 0; step < 100; ++step) run.step(1e-3);
  EXPECT_LT(fastest_face(run), 1e-8);
  EXPECT_NEAR(run.flow.ledger().present, D == 2 ? 0.511 : 0.75 * (0.511 - 0.046875), 1e-3);
}

TEST(TwoFluids, ATiltedSurfaceStaysAtRestIn2D) { stays_at_rest_when_tilted<2>(); }
TEST(TwoFluids, ATiltedSurfaceStaysAtRestIn3D) { stays_at_rest_when_tilted<3>(); }

TEST(TwoFluids, ADamBreakIsTheSameOnAnyNumberOfRanks) {
  expect_same(gauges<2>(MPI_COMM_WORLD, tank<2>(8), 60, 1.5e-3),
              gauges<2>(MPI_COMM_SELF, tank<2>(8), 60, 1.5e-3), 1e-9);
}

}  // namespace
}  // namespace mudlark

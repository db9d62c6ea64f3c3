// ranks: 1 3
#include "flow/turbulence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "flow/wall_friction.hpp"
#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

using C = KEpsilonConstants;

/// A velocity given on all faces, ghosts included.
template <int D, class Motion>
void set(const Grid<D>& grid, FaceVector<D>& velocity, Motion motion) {
  for (int a = 0; a < D; ++a)
    for_each(grid.local(), [&](const Index<D>& face) {
      velocity[a][face] = motion(grid.face_centre(a, face))[a];
    });
}

template <int D>
void smagorinsky_in_shear() {
  const Grid<D> grid(D == 2 ? flow_domain({12, 9, 1}, {1.2, 0.45, 1.0}, {})
                            : flow_domain({12, 6, 9}, {1.2, 0.3, 0.45}, {}),
                     MPI_COMM_WORLD);
  FlowOptions options;
  options.turbulence.model = TurbulenceModel::smagorinsky;
  Turbulence<D> turbulence(grid, options);
  const PorousMedium<D> medium(grid);
  const CellField<D> full(grid, "saturation", "1", 1.0);
  FaceVector<D> velocity(grid, "velocity", "m/s");
  set(grid, velocity, [](const Vec<D>& x) { return Vec<D>{{3.0 * x[D - 1]}}; });
  turbulence.find(medium, full, velocity);
  const double length = D == 2 ? std::sqrt(0.1 * 0.05) : std::cbrt(0.1 * 0.05 * 0.05);
  const double exact = 0.15 * 0.15 * length * length * 3.0;  // |S| = du/dz
  for_each(grid.owned(), [&](const Index<D>& cell) {
    ASSERT_NEAR(turbulence.eddy_viscosity()[cell], exact, 1e-12 * exact);
  });
  EXPECT_NEAR(turbulence.largest(), exact, 1e-12 * exact);
}

TEST(Smagorinsky, TheViscosityOfLinearShearIsThatOfTheClosedFormIn2D) { smagorinsky_in_shear<2>(); }
TEST(Smagorinsky, TheViscosityOfLinearShearIsThatOfTheClosedFormIn3D) { smagorinsky_in_shear<3>(); }

TEST(Smagorinsky, EddiesAreSmallerNearWallsAndEndInGround) {
  const Grid<2> grid(flow_domain({6, 60, 1}, {0.6, 0.6, 1.0}, {}, Wall::no_slip), MPI_COMM_SELF);
  FlowOptions options;
  options.turbulence.model = TurbulenceModel::smagorinsky;
  options.turbulence.constant = 0.2;
  Turbulence<2> turbulence(grid, options);
  PorousMedium<2> medium(grid);
  medium.porosity[Index<2>{{3, 40}}] = 0.5;
  medium.porosity[Index<2>{{3, 41}}] = 0.9;
  const CellField<2> full(grid, "saturation", "1", 1.0);
  FaceVector<2> velocity(grid, "velocity", "m/s");
  set(grid, velocity, [](const Vec<2>& x) { return Vec<2>{{2.0 * x[1]}}; });
  turbulence.find(medium, full, velocity);
  const double filter = 0.2 * 0.2 * 0.1 * 0.01 * 2.0;
  const auto at = [&](int i, int j) { return turbulence.eddy_viscosity()[Index<2>{{i, j}}]; };
  EXPECT_NEAR(at(3, 30), filter, 1e-12);
  EXPECT_NEAR(at(3, 0), std::pow(0.41 * 0.005, 2) * 2.0, 1e-12);
  EXPECT_EQ(at(3, 40), 0.0);
  EXPECT_NEAR(at(3, 41), 0.5 * filter, 1e-12);
  EXPECT_EQ(at(3, -1), -at(3, 0));  // zero on the wall
}

/// k = k0 (1 + (C2 - 1) t eps0/k0)^(-1/(C2 - 1)): the law of grid turbulence.
TEST(KEpsilonModel, HomogeneousTurbulenceDecaysByThePowerLaw) {
  FlowOptions options;
  options.turbulence = {TurbulenceModel::k_epsilon, 0.15, 0.02, 50.0};
  options.bodies = {water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away})};
  FlowRun<2> run(flow_domain({12, 8, 1}, {1.0, 1.0, 1.0}, {}, Wall::periodic), options);
  const double k0 = 0.02, epsilon0 = 0.09 * k0 * k0 / (50.0 * 1.002e-6);
  for (int step = 0; step < 50; ++step) run.step(0.02);
  const double k = run.flow.turbulence()->fields()[1]->operator[](run.grid.owned().lower);
  const double exact = k0 * std::pow(1.0 + 0.92 * run.time * epsilon0 / k0, -1.0 / 0.92);
  EXPECT_NEAR(k, exact, 1e-10 * exact);
  EXPECT_LT(k, 0.05 * k0);
}

/// Strain without rotation, as under waves: the plain model makes turbulence that grows for ever.
TEST(KEpsilonModel, WavesWithoutRotationMakeNoTurbulence) {
  const Grid<2> grid(flow_domain({8, 8, 1}, {1.0, 1.0, 1.0}, {}), MPI_COMM_SELF);
  FlowOptions options;
  options.turbulence = {TurbulenceModel::k_epsilon, 0.15, 1e-4, 10.0};
  Turbulence<2> turbulence(grid, options);
  const PorousMedium<2> medium(grid);
  const CellField<2> full(grid, "saturation", "1", 1.0);
  FaceVector<2> velocity(grid, "velocity", "m/s");
  set(grid, velocity, [](const Vec<2>& x) { return Vec<2>{{2.0 * x[0], -2.0 * x[1]}}; });
  double before = 1e-4;
  for (int step = 0; step < 100; ++step) {
    turbulence.find(medium, full, velocity);
    turbulence.advance(medium, full, velocity, 0.01);
    const double k = (*turbulence.fields()[1])[grid.owned().lower];
    ASSERT_LT(k, before);
    before = k;
  }
  // The same strain with as much rotation, simple shear, is not cut.
  const KEpsilon state{1e-4, 1e-4};
  EXPECT_EQ(limited_eddy_viscosity(state, 4.0, 4.0), 0.09 * 1e-4);
  EXPECT_EQ(limited_eddy_viscosity(state, 4.0, 0.0), 0.0);
}

/// Half of a channel driven by a body force, first row of cells at y+ = 125, Re_tau = 5000:
/// u+ = ln(y+)/0.41 + 5.57, the smooth law with E = 9.8.
TEST(KEpsilonModel, AChannelHasTheLogarithmicProfile) {
  const double u_tau = 0.05, nu = 1e-5, depth = 1.0;
  FlowOptions options;
  options.viscosity = 1000.0 * nu;
  options.turbulence = {TurbulenceModel::k_epsilon, 0.15, 5e-3, 1000.0};
  options.wall_law = WallLaw::logarithmic;
  WaterBody water = water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away});
  water.velocity[0] = Varying(
      [=](const Point3& x, double) { return u_tau * std::log(9.8 * x[2] * u_tau / nu) / 0.41; },
      "u");
  options.bodies = {water};
  auto domain = flow_domain({4, 20, 1}, {1.0, depth, 1.0}, {u_tau * u_tau / depth, 0.0, 0.0});
  domain.walls[0] = {Wall::periodic, Wall::periodic};
  domain.walls[1][0] = Wall::no_slip;
  FlowRun<2> run(domain, options);
  while (run.time < 200.0) run.step(std::min(0.1, run.flow.stable_step(run.medium)));
  double worst = 0.0;
  for_each(run.grid.owned(), [&](const Index<2>& cell) {
    if (cell[0] != 0) return;
    const double y = run.grid.cell_centre(cell)[1];
    const double exact = u_tau * std::log(9.8 * y * u_tau / nu) / 0.41;
    const double u = run.flow.velocity()[0][cell];
    if (run.grid.ranks() == 1)
      std::printf("y = %.3f m: u = %.4f m/s, log law %.4f m/s\n", y, u, exact);
    if (y < 0.9) worst = std::max(worst, std::abs(u / exact - 1.0));
  });
  EXPECT_LT(max_over_ranks(run.grid, worst), 0.05);
}

/// Nakayama & Kuwahara (1999): flow through ground settles at k and epsilon of its pores.
TEST(KEpsilonModel, FlowInPoresHasTheTurbulenceOfThePores) {
  FlowOptions options;
  options.turbulence = {TurbulenceModel::k_epsilon, 0.15, 1e-4, 10.0};
  options.bodies = {water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away})};
  PorousGround ground;
  ground.shape.form = BoxShape{{-far_away, -far_away, -far_away}, {far_away, far_away, far_away}};
  ground.porosity = 0.45;
  ground.drag = DragLaw::van_gent;
  ground.grain_size = 0.02;
  options.porous = {ground};
  FlowRun<2> run(flow_domain({6, 6, 1}, {0.6, 0.6, 1.0}, {2.0, 0.0, 0.0}, Wall::periodic), options,
                 MPI_COMM_SELF);
  while (run.time < 2.0) run.step(0.002);
  const Index<2> cell = run.grid.owned().lower;
  const double v = run.flow.velocity()[0][cell], n = 0.45;
  const double k = 3.7 * (1.0 - n) / std::sqrt(n) * (n * v) * (n * v);
  const double epsilon = 39.0 * std::pow(1.0 - n, 2.5) / n * std::pow(n * v, 3.0) / 0.02;
  EXPECT_GT(v, 0.01);
  EXPECT_NEAR((*run.flow.turbulence()->fields()[1])[cell], k, 0.02 * k);
  EXPECT_NEAR((*run.flow.turbulence()->fields()[2])[cell], epsilon, 0.02 * epsilon);
}

/// A dam break over a mound: k and epsilon stay positive and finite, water keeps its volume, and
/// ranks change nothing.
template <int D>
std::array<double, 3> violent(MPI_Comm comm, TurbulenceModel model, bool gas) {
  FlowOptions options = column_and_mound<D>();
  options.turbulence.model = model;
  options.wall_law = model == TurbulenceModel::k_epsilon ? WallLaw::logarithmic : WallLaw::resolved;
  if (gas) options.gas.emplace();
  auto domain = tank<D>(8);
  for (auto& axis : domain.walls) axis = {Wall::no_slip, Wall::no_slip};
  FlowRun<D> run(domain, options, comm);
  for (int step = 0; step < 50; ++step) run.step(run.flow.stable_step(run.medium));
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
  return {run.flow.front(), run.flow.kinetic_energy(), run.flow.turbulence()->largest()};
}

TEST(Turbulence, ADamBreakIsTheSameOnAnyNumberOfRanks) {
  for (const auto model : {TurbulenceModel::smagorinsky, TurbulenceModel::k_epsilon})
    for (const bool gas : {false, true}) {
      const auto together = violent<2>(MPI_COMM_WORLD, model, gas);
      const auto alone = violent<2>(MPI_COMM_SELF, model, gas);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(together[i], alone[i], 1e-8 * alone[i]) << i << gas;
      EXPECT_GT(alone[2], 1e-6);
    }
}

}  // namespace
}  // namespace mudlark

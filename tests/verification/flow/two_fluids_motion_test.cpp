// ranks: 1
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "verification/flow/two_fluids_setup.hpp"

namespace mudlark {
namespace {

constexpr double pi = std::numbers::pi;

/// Two layers of fluid between walls 1 m apart, in the first mode (Lamb 1932, art. 231):
/// omega^2 = g k (rho1 - rho2) / (rho1 coth k h1 + rho2 coth k h2), of small amplitude.
TEST(TwoFluids, StandingWavesBetweenLayersHaveTheirPeriod) {
  for (const double density : {1.2, 300.0}) {
    FlowOptions options = with_gas();
    options.viscosity = options.gas->viscosity = 0.0;
    options.gas->density = density;
    options.bodies = {water_box({-1.0, -1.0, -1.0}, {2.0, 2.0, 0.4})};
    FlowRun<2> run(flow_domain({48, 40, 1}, {1.0, 0.8, 1.0}, {0.0, -9.81, 0.0}), options);
    const auto fraction = [&](const Index<2>& cell) {
      const double x = run.grid.cell_centre(cell)[0], h = run.grid.spacing()[0];
      const double level =
          0.413 + 0.008 * std::cos(pi * x) * std::sin(0.5 * pi * h) / (0.5 * pi * h);
      return std::clamp((level - run.grid.cell_centre(cell)[1]) / run.grid.spacing()[1] + 0.5, 0.0,
                        1.0);
    };
    WaterSetter<2, decltype(fraction)> setter{run.grid, fraction};
    run.flow.archive(setter);
    const double omega2 = 9.81 * pi * (1000.0 - density) /
                          (1000.0 / std::tanh(pi * 0.413) + density / std::tanh(pi * 0.387));
    const double period = 2.0 * pi / std::sqrt(omega2);
    // Zeros at 1/4, 3/4 and 5/4 of the period.
    std::vector<double> zeros;
    double before = 1.0, earlier = 0.0;
    while (run.time < 1.35 * period) {
      run.step(std::min(run.flow.stable_step(run.medium), period / 200.0));
      const double level = run.flow.surface_height(Vec<2>{{0.01, 0.0}}) - 0.413;
      if (level * before < 0.0)
        zeros.push_back(earlier + (run.time - earlier) * before / (before - level));
      before = level;
      earlier = run.time;
    }
    ASSERT_EQ(zeros.size(), 3U);
    std::printf("density %g: period %.5f s, exact %.5f s\n", density, zeros[2] - zeros[0], period);
    EXPECT_NEAR(zeros[2] - zeros[0], period, 0.01 * period);
  }
}

/// A slug of water between two closed pockets of gas that give way, suddenly under gravity g:
/// its displacement is -g/omega^2 (1 - cos omega t), omega^2 = K (1/L1 + 1/L2) / (mass per area).
TEST(TwoFluids, WaterSwingsOnClosedPocketsOfGas) {
  FlowOptions options = with_gas();
  options.gas->bulk_modulus = 1e4;
  options.bodies = {water_box({-1.0, -1.0, 0.3}, {2.0, 2.0, 0.7})};
  const double gravity = 0.2;
  FlowRun<2> run(flow_domain({4, 50, 1}, {0.08, 1.0, 1.0}, {0.0, -gravity, 0.0}), options);
  struct {  // no pressure that holds the slug already
    void number(const std::string&, double&) {}
    void integer(const std::string&, std::int64_t&) {}
    void faces(const std::string&, FaceVector<2>&) {}
    void cells(const std::string& name, CellField<2>& field) {
      if (name == "flow pressure") field.fill(0.0);
    }
  } released;
  run.flow.archive(released);
  const double omega = std::sqrt(1e4 * (1.0 / 0.3 + 1.0 / 0.3) / 400.0);
  const double swing = gravity / (omega * omega);
  double worst = 0.0;
  while (omega * run.time < 2.0 * pi) {
    run.step(2.5e-4);
    const double exact = 0.70 - swing * (1.0 - std::cos(omega * run.time));
    worst = std::max(worst, std::abs(run.flow.surface_height(Vec<2>{{0.01, 0.0}}) - exact));
  }
  EXPECT_LT(worst, 0.03 * swing);
  EXPECT_NEAR(run.flow.ledger().present, run.flow.ledger().initial,
              1e-12 * run.flow.ledger().initial);
}

template <int D>
void breaks_with_exact_volume(int cells_per_length, double end) {
  FlowRun<D> run(tank<D>(cells_per_length), column_under_gas<D>());
  double worst = 0.0, farthest = 0.0;
  while (run.time < end) {
    run.step(run.flow.stable_step(run.medium));
    for_each(run.grid.owned(), [&](const Index<D>& cell) {
      const double w = run.flow.water_fraction()[cell];
      worst = std::max({worst, -w, w - run.flow.porosity()[cell]});
    });
    farthest = std::max(farthest, run.flow.front());
  }
  EXPECT_LT(worst, 1e-12);
  const WaterLedger water = run.flow.ledger();
  EXPECT_NEAR(water.present, water.initial, 1e-12 * water.initial);
  EXPECT_GT(farthest, 0.35);  // into the mound
}

TEST(TwoFluids, ADamBreakKeepsItsVolumeAndItsBoundsIn2D) { breaks_with_exact_volume<2>(8, 0.5); }
TEST(TwoFluids, ADamBreakKeepsItsVolumeAndItsBoundsIn3D) { breaks_with_exact_volume<3>(4, 0.3); }

/// But for the normals of the interface, whose formulas in the plane and in space differ.
TEST(TwoFluids, ADamBreakOneCellThickIsThatOfThePlane) {
  const auto thin = flow_domain({48, 1, 40}, {0.6, 0.01, 0.5}, {0.0, 0.0, -9.81});
  expect_same(gauges<3>(MPI_COMM_SELF, thin, 60, 1.5e-3),
              gauges<2>(MPI_COMM_SELF, tank<2>(8), 60, 1.5e-3), 1e-3);
}

}  // namespace
}  // namespace mudlark

// Clay of Sekiguchi & Ohta in the engine: one-dimensional compression under a growing load.
#include <gtest/gtest.h>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

constexpr double lambda = 0.15, kappa = 0.03, k0 = 0.5, porosity = 0.6, before = 50e3;

template <int D>
SoilOptions clay(Transfer transfer, TimeMethod method) {
  SoilOptions soil = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 1.0}, false);
  SoilBody& body = soil.bodies[0];
  SekiguchiOhtaOptions law;
  law.compression_index = lambda, law.swelling_index = kappa;
  law.critical_stress_ratio = 1.2, law.poisson_ratio = 0.3;
  body.law = law;
  body.strain = StrainMeasure::jaumann;
  body.porosity = porosity;
  body.initial_stress = SymTensor{-k0 * before, -k0 * before, -before, 0, 0, 0};
  soil.transfer = transfer;
  soil.method = method;
  soil.step_tolerance = 1e-3;
  return soil;
}

/// From 50 to 200 kPa in a second, then held: p grows fourfold along the K0 line, v falls by
/// lambda ln 4, and every point keeps its ratio of stresses.
template <int D>
void expect_virgin_compression(TimeMethod method) {
  const int cells = D == 2 ? 8 : 5;
  const Grid<D> grid = soil_runs::make_grid<D>({3, D == 2 ? cells + 2 : 3, cells + 2}, 1.0 / cells,
                                               D == 2 ? "ssso" : "ssssso");
  SoilOptions options = clay<D>(Transfer::flip, method);
  options.damping = method == TimeMethod::explicit_steps ? 0.5 : 0.0;
  options.loads.push_back(
      {"q", Varying([](const Point3&, double t) { return before * (1.0 + 3.0 * std::min(t, 1.0)); },
                    "ramp")});
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  const double end = method == TimeMethod::explicit_steps ? 1.3 : 1.1;
  for (double time = 0.0; time < end - 1e-9;) {
    const double dt = std::min({soil.outer_step(), 0.1, end - time});
    soil.begin_step(time, dt, nullptr);
    const int steps = soil.is_implicit() ? 1 : static_cast<int>(std::ceil(dt / soil.stable_step()));
    for (int i = 0; i < steps; ++i) soil.advance(dt / steps);
    time += dt;
  }
  const double volume = 1.0 / (1.0 - porosity);
  const double strain = lambda * std::log(4.0) / volume;  // of the height
  const auto& points = soil.points(0);
  ASSERT_GT(points.size(), 0u);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SymTensor stress = get_tensor(points.stress, p);
    EXPECT_NEAR(stress.zz, -4.0 * before, 0.003 * 4.0 * before) << points.start[D - 1][p];
    EXPECT_NEAR(stress.xx / stress.zz, k0, 0.003);
    EXPECT_NEAR(stress.yy / stress.zz, k0, 0.003);
    EXPECT_NEAR(1.0 + points.history[7][p], volume - lambda * std::log(4.0), 0.002);
    const double settlement = points.start[D - 1][p] - points.position[D - 1][p];
    EXPECT_NEAR(settlement, strain * points.start[D - 1][p], 0.01 * strain);
  }
}

TEST(SekiguchiOhtaInTheEngine, FollowsTheLineOfVirginCompressionInImplicitSteps) {
  expect_virgin_compression<2>(TimeMethod::implicit_steps);
}

TEST(SekiguchiOhtaInTheEngine, FollowsTheLineOfVirginCompressionInExplicitSteps) {
  expect_virgin_compression<2>(TimeMethod::explicit_steps);
  expect_virgin_compression<3>(TimeMethod::explicit_steps);
}

}  // namespace
}  // namespace mudlark

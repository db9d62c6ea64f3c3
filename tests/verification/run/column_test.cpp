// A saturated column of 1 m under water: what each liquid condition at the mudline makes of the
// same water.
#include <gtest/gtest.h>

#include <cmath>

#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

CaseOptions column(double water_height, Mudline mudline) {
  CaseOptions c;
  const double h = 0.05;
  const int n = static_cast<int>(std::ceil((1.0 + water_height) / h)) + 6;
  c.domain.cells = {1, n, 1};
  c.domain.upper = {h, n * h, 0};
  c.domain.gravity = {0, -9.81, 0};
  c.domain.walls[1][0] = Wall::no_slip;
  c.domain.walls[1][1] = Wall::open;
  c.time.end = 1.0;
  FlowOptions flow;
  flow.bodies.push_back({Shape{BoxShape{{0, -1, 0}, {0.1, 1, 1.0 + water_height}}}, {}});
  c.flow = flow;
  SoilOptions soil;
  SoilBody body;
  body.name = "column";
  body.shape.form = BoxShape{{0, -1, 0}, {0.1, 1, 1.0}};
  body.intrinsic_permeability = 1e-4 * 1.002e-3 / 9810.0;
  body.law = LinearElasticOptions{1e6, 0.3};
  body.strain = StrainMeasure::hencky;
  body.initial_stress = GeostaticStress{};
  soil.bodies.push_back(body);
  soil.water_bulk_modulus = 2.15e7;
  soil.courant = 0.8;
  c.soil = soil;
  c.coupling.mode = CouplingMode::surface;
  c.coupling.mudline = mudline;
  c.coupling.ramp = 0.05;
  return c;
}

struct Answer {
  double mean_settlement = 0.0,
         largest_settlement = 0.0;  ///< over the last fifth of the run, and of all of it [m]
  double water_error = 0.0, grain_error = 0.0;
};

Answer run(const CaseOptions& options) {
  World<2> world(options, MPI_COMM_WORLD);
  world.initialise();
  GaugeOptions top;
  top.quantity = GaugeQuantity::settlement;
  top.at = {0.025, 0.0, 1.0};
  Answer answer;
  int samples = 0;
  while (!world.clock().finished()) {
    world.advance(world.clock().choose_step(world.stable_step()));
    const double settlement = read_gauge(world, top)[0];
    answer.largest_settlement = std::max(answer.largest_settlement, std::abs(settlement));
    if (world.clock().time() < 0.8 * options.time.end) continue;
    answer.mean_settlement += settlement;
    ++samples;
  }
  answer.mean_settlement /= samples;
  const auto errors = conservation_errors(world);
  answer.water_error = errors[0].second;
  answer.grain_error = errors[1].second;
  return answer;
}

TEST(Mudline, ConsistentLetsNoDepthOfWaterSettleTheBed) {
  for (const double depth : {2.0, 40.775}) {
    const Answer answer = run(column(depth, Mudline::consistent));
    std::printf("consistent, %g m of water: settlement %.2g m\n", depth, answer.largest_settlement);
    EXPECT_LT(answer.largest_settlement, 1e-6);
    EXPECT_LT(answer.water_error, 1e-12);
    EXPECT_EQ(answer.grain_error, 0.0);
  }
}

TEST(Mudline, LoadOnlySettlesLikeTheSoilAloneUnderTheSameLoad) {
  const Answer coupled = run(column(40.775, Mudline::load_only));
  CaseOptions alone = column(40.775, Mudline::load_only);
  alone.flow.reset();
  alone.coupling.mode = CouplingMode::none;
  alone.soil->loads.push_back(
      {"q", Varying(
                [](const Point3&, double t) {
                  return t < 0.05 ? 2e5 * (1.0 - std::cos(3.14159265358979 * t / 0.05)) : 4e5;
                },
                "ramp")});
  const Answer load = run(alone);
  std::printf("load-only: %.6f m coupled, %.6f m alone\n", coupled.mean_settlement,
              load.mean_settlement);
  EXPECT_NEAR(coupled.mean_settlement, load.mean_settlement,
              0.01 * 0.20937);  // 1 % of the final settlement
  EXPECT_LT(coupled.water_error, 1e-12);
}

// No flux through the mudline: only the undrained compression of the pore water, q H / (M + K_w /
// n) = 7.26 mm at small strain, 7.3 mm with the strain measure of this case.
TEST(Mudline, MembraneKeepsTheSoilUndrained) {
  const Answer answer = run(column(40.775, Mudline::membrane));
  std::printf("membrane: settlement %.5f m, undrained 0.00726 m\n", answer.mean_settlement);
  EXPECT_NEAR(answer.mean_settlement, 0.00726, 0.0003);
}

TEST(Mudline, PressureConstantOverAStepAsInThePaperEndsAlike) {
  CaseOptions constant = column(40.775, Mudline::load_only);
  constant.coupling.pressure_in_time = PressureInTime::constant;
  const Answer paper = run(constant), linear = run(column(40.775, Mudline::load_only));
  std::printf("pressure in time: constant %.6f m, linear %.6f m\n", paper.mean_settlement,
              linear.mean_settlement);
  EXPECT_NEAR(paper.mean_settlement, linear.mean_settlement, 0.01 * 0.20937);
}

}  // namespace
}  // namespace mudlark

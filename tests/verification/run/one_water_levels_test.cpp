// ranks: 1
// Sides that hold the ground and the open water over it at one level (docs/methods/coupling.md).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, weight = 1000.0 * gravity;

Shape box(double x0, double z0, double x1, double z1) {
  return Shape{BoxShape{{x0, -9, z0}, {x1, 9, z1}}};
}

/// Soil of a shape in a box of square cells with closed sides, water up to a level.
CaseOptions soil_box(int columns, int rows, double h, const Shape& soil, double level, double k,
                     double modulus = 1e7) {
  CaseOptions c = soil_in_water(soil, level, k, modulus);
  c.domain.dimension = 2;
  c.domain.cells = {columns, rows, 1};
  c.domain.upper = {columns * h, rows * h, 0.0};
  c.time.end = 1e4;
  c.soil->bodies[0].points_per_cell = 4;
  c.soil->bodies[0].law = LinearElasticOptions{modulus, 0.0};
  c.soil->bodies[0].strain = StrainMeasure::small;
  c.soil->bodies[0].initial_stress = GeostaticStress{};
  return c;
}

void hold_level(CaseOptions& c, const char* name, int side, const Varying& level,
                double from = -PartOfSide::infinite, double to = PartOfSide::infinite) {
  GroundSideOptions part;
  part.name = name, part.axis = 0, part.side = side;
  part.from[2] = from, part.to[2] = to;
  part.water = GroundSideWater::head, part.value = level;
  c.flow->ground_sides.push_back(part);
}

double read(World<2>& world, GaugeQuantity quantity, double x, double z) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.at = {x, 0.0, z};
  return read_gauge(world, gauge)[0];
}

/// Wherever the level cuts a cell. What moves is the bed's own start, which is out of balance by
/// round-off of its stress: stiff, it moves little.
TEST(OneWaterLevels, ABedUnderWaterBetweenEqualLevelsStaysAtRest) {
  const double h = 0.05, modulus = 1e11;
  for (const double level : {10 * h, 10.3 * h, 10.7 * h})
    for (const bool held : {false, true}) {
      CaseOptions c = soil_box(12, 14, h, box(-9, -9, 9, 6 * h), level, 1e-3, modulus);
      c.soil->mass_scaling = 1e6;
      if (held) {
        hold_level(c, "left", 0, Varying(level));
        hold_level(c, "right", 1, Varying(level));
      }
      World<2> world(c, MPI_COMM_WORLD);
      world.initialise();
      run_until(world, 2.0);
      EXPECT_LT(world.flow()->max_speed().speed, 1e-9) << (held ? "held" : "closed");
      EXPECT_LT(std::abs(world.flow()->ground_discharge("left")), 1e-10);
      EXPECT_NEAR(read(world, GaugeQuantity::pressure, 6 * h, 2 * h), weight * (level - 2 * h),
                  1e-6 * weight * level);
      expect_conservation(world);
    }
}

/// Charny (1951): q = k (h1^2 - h2^2)/(2 L) between vertical faces, the seepage face over the lower
/// water included; here between two pools whose far sides hold their levels.
TEST(OneWaterLevels, ADamBetweenTwoPoolsLetsThroughWhatDupuitSays) {
  const double h = 0.04, k = 1e-2, first = 10 * h, second = 4 * h;
  const int pool = 3, cells = 18;
  const double face = pool * h, length = cells * h;
  CaseOptions c = soil_box(cells + 2 * pool, 12, h, box(face, -9, face + length, 11 * h), 0.0, k);
  c.domain.walls[1][0] = Wall::no_slip;  // or the water would push the dam away
  c.flow->bodies.clear();
  c.flow->bodies.push_back({box(-9, -9, face, first), {}});
  for (int i = 0; i < cells; ++i) {
    const double way = (i + 0.5) / cells;
    const double level = std::sqrt(first * first + way * (second * second - first * first));
    c.flow->bodies.push_back({box(face + i * h, -9, face + (i + 1) * h, level), {}});
  }
  c.flow->bodies.push_back({box(face + length, -9, 9, second), {}});
  c.soil->flooded.clear();
  for (const WaterBody& body : c.flow->bodies) c.soil->flooded.push_back(body.shape);
  c.soil->mass_scaling = 1000.0;
  hold_level(c, "reservoir", 0, Varying(first));
  hold_level(c, "tailwater", 1, Varying(second));
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 25.0);
  double in = 0.0, out = 0.0;
  const double begin = world.clock().time();
  while (world.clock().time() < 30.0) {
    const double before = world.clock().time();
    world.advance(world.stable_step());
    in -= world.flow()->ground_discharge("reservoir") * (world.clock().time() - before);
    out += world.flow()->ground_discharge("tailwater") * (world.clock().time() - before);
  }
  const double time = world.clock().time() - begin;
  const double exact = k * (first * first - second * second) / (2.0 * length);
  EXPECT_NEAR(in / time, exact, 0.02 * exact);
  EXPECT_NEAR(out / time, exact, 0.02 * exact);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 1.5 * h, 0.0), first, 0.01 * h);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, face + length + 1.5 * h, 0.0), second,
              0.1 * h);
  expect_conservation(world);
}

/// A slow tide over a bed that goes on beyond the side: water and pore pressure follow, but for the
/// seiche that a surface sets off whenever it passes a row of cells: a fifth of their height at the
/// far end. Its period is 4 L / sqrt(g H), a second; what came in is a mean over that.
TEST(OneWaterLevels, WaterAndBedFollowASlowTide) {
  const double h = 0.05, length = 12 * h, low = 8.7 * h, range = 3 * h, period = 20.0;
  CaseOptions c = soil_box(12, 16, h, box(-9, -9, 9, 6 * h), low, 1e-3);
  c.soil->mass_scaling = 100.0;
  const auto tide = [=](const Point3&, double t) {
    return low + 0.5 * range * (1.0 - std::cos(2.0 * std::numbers::pi * t / period));
  };
  hold_level(c, "sea", 0, Varying(tide, "tide"));
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  double seiche = 0.0;
  /// Mean over a second until `end` [s] of what came in beyond the tide's prism [m2].
  const auto beyond_prism = [&](double end) {
    constexpr int readings = 20;
    double sum = 0.0;
    for (int i = 1; i <= readings; ++i) {
      run_until(world, end - 1.0 + static_cast<double>(i) / readings);
      const double level = tide({}, world.clock().time());
      seiche = std::max(seiche,
                        std::abs(read(world, GaugeQuantity::water_level, 11.5 * h, 0.0) - level));
      sum += -world.flow()->ledger().outflow - length * (level - low);
    }
    return sum / readings;
  };
  for (int quarter = 1; quarter <= 4; ++quarter) {
    const double prism = beyond_prism(quarter * 0.25 * period);
    const double level = tide({}, world.clock().time());
    for (const double x : {0.5 * h, 11.5 * h})
      EXPECT_NEAR(read(world, GaugeQuantity::water_level, x, 0.0), level, 0.15 * h) << quarter;
    EXPECT_NEAR(read(world, GaugeQuantity::pressure, 6 * h, 2 * h) / weight + 2 * h, level, 0.1 * h)
        << quarter;
    if (quarter % 2 == 0) {  // the tide turns
      EXPECT_NEAR(prism, 0.0, 0.01 * length * range);
    }
    expect_conservation(world);
  }
  EXPECT_LT(seiche, 0.25 * h);
}

/// When the level falls below the bed the water over it runs off, though the ground lets next to
/// nothing through. What stays is half a row of cells, which has no pressure, and more of it far
/// from the side.
TEST(OneWaterLevels, WaterOverABedRunsOffToALevelBelowIt) {
  const double h = 0.05, top = 6 * h, k = 1e-6;
  CaseOptions c = soil_box(12, 12, h, box(-9, -9, 9, top), 9 * h, k);
  c.soil->mass_scaling = 100.0;
  hold_level(c, "sea", 0, Varying(3 * h));
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 5.0);
  EXPECT_LT(read(world, GaugeQuantity::water_level, 0.5 * h, 0.0), top + h);
  EXPECT_LT(read(world, GaugeQuantity::water_level, 11.5 * h, 0.0), top + 1.5 * h);
  EXPECT_GT(world.flow()->ledger().outflow, 0.7 * 12 * h * 3 * h);
  expect_conservation(world);
}

/// A part that ends at the ground leaves the water over it to the wall.
TEST(OneWaterLevels, AHeadOfTheGroundAloneKeepsTheWaterOverIt) {
  const double h = 0.05, top = 6 * h;
  CaseOptions c = soil_box(12, 12, h, box(-9, -9, 9, top), 9 * h, 1e-9);
  c.soil->mass_scaling = 100.0;
  hold_level(c, "polder", 0, Varying(7 * h), -PartOfSide::infinite, top);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 1.0);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 6 * h, 0.0), 9 * h, 0.01 * h);
  expect_conservation(world);
}

}  // namespace
}  // namespace mudlark

// ranks: 1
// Soil that is dry, wet and in between (NUMERICS C2, "partial saturation"): suction, relative
// permeability and sides that water flows through, with grains that move and in fixed ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, viscosity = 1e-3, porosity = 0.4, conductivity = 1e-2;
constexpr double permeability = conductivity * viscosity / (1000.0 * gravity);
constexpr double held = 0.2;  ///< suction, in metres of water
constexpr double h = 0.04;

/// A column of n cells.
CaseOptions column(int n) {
  CaseOptions c;
  c.domain.dimension = 2;
  c.domain.cells = {9, n, 1};
  c.domain.upper = {9 * h, n * h, 0.0};
  c.domain.gravity = {0.0, -gravity, 0.0};
  c.time.end = 100.0;
  FlowOptions flow;
  flow.viscosity = viscosity;
  c.flow = flow;
  return c;
}

Shape between(double lower, double upper) {
  return Shape{BoxShape{{-9, -9, lower}, {9, 9, upper}}};
}

PorousGround ground(double upper) {
  PorousGround sand;
  sand.shape = between(-9, upper);
  sand.porosity = porosity;
  sand.intrinsic_permeability = permeability;
  sand.filling.suction = held * 1000.0 * gravity;
  return sand;
}

/// With one water: grains between two heights.
void add_soil(CaseOptions& c, double lower, double upper, double suction) {
  SoilBody body;
  body.name = "sand";
  body.shape = between(lower, upper);
  body.pore_water = PoreWater::unified;
  body.porosity = porosity;
  body.intrinsic_permeability = permeability;
  body.filling.suction = suction;
  body.law = LinearElasticOptions{1e6, 0.0};
  body.strain = StrainMeasure::small;
  body.initial_stress = GeostaticStress{};
  SoilOptions soil;
  soil.bodies.push_back(body);
  for (const WaterBody& water : c.flow->bodies) soil.flooded.push_back(water.shape);
  c.soil = soil;
  c.coupling.mode = CouplingMode::unified;
}

double read(World<2>& world, GaugeQuantity quantity, double height) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.at = {4.5 * h, 0.0, height};
  return read_gauge(world, gauge)[0];
}

void run_until(World<2>& world, double time) {
  while (world.clock().time() < time * (1.0 - 1e-9)) {
    const double left = time - world.clock().time();
    world.advance(left / std::ceil(left / world.stable_step()));
  }
}

double lost_water(World<2>& world) { return conservation_errors(world)[0].second; }

/// Time in which water rises by L into dry ground that holds it `held` high, over ground that is
/// wet to the depth d: n dL/dt = k (held - L)/(d + L).
double time_to_rise(double L, double d) {
  return porosity / conductivity * (-L - (held + d) * std::log(1.0 - L / held));
}

TEST(PartlyFilled, WaterRisesIntoDryGround) {
  CaseOptions c = column(10);
  c.flow->bodies.push_back({between(-9, 0.08), {}});
  c.flow->porous.push_back(ground(9));
  c.domain.walls[1][0] = Wall::open;
  FlowSideOptions table;
  table.name = "table", table.axis = 1, table.flow = SideFlow::level, table.level = Varying(0.08);
  c.flow->sides.push_back(table);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  for (const double rise : {0.06, 0.12}) {
    run_until(world, time_to_rise(rise, 0.08));
    EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.0) - 0.08, rise, 0.03 * held);
  }
  run_until(world, 30.0);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.0) - 0.08, held, 0.3 * h);
  EXPECT_LT(lost_water(world), 1e-12);
}

/// Green & Ampt (1911) under a pond of H0 that sinks: n dL/dt = k (H0 + held + (1 - n) L)/L.
double time_to_infiltrate(double L, double H0) {
  const double a = H0 + held, b = 1.0 - porosity;
  return porosity / conductivity * (L / b - a / (b * b) * std::log(1.0 + b * L / a));
}

TEST(PartlyFilled, APondSinksIntoDrySoil) {
  const double top = 0.6, pond = 0.16;
  CaseOptions c = column(20);
  c.flow->bodies.push_back({between(top, top + pond), {}});
  add_soil(c, -9, top, held * 1000.0 * gravity);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double depth = 0.2;
  run_until(world, time_to_infiltrate(depth, pond));
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.0), top + pond - porosity * depth, 0.01);
  EXPECT_LT(lost_water(world), 1e-12);
}

/// Dry grains over a fringe that hangs at its surface: pressure is below that of the air, and
/// nothing moves.
void a_fringe_hangs(bool beside_a_wall) {
  CaseOptions c = column(20);
  c.flow->bodies.push_back({between(-9, 0.4), {}});
  add_soil(c, -9, 0.6, 1000.0);
  if (beside_a_wall) {
    FlowSolid wall;
    wall.name = "wall";
    wall.shape = Shape{BoxShape{{6 * h, -9, -9}, {9, 9, 9}}};
    c.flow->solids.push_back(wall);
    SolidOptions same;
    same.name = wall.name;
    same.shape = wall.shape;
    c.soil->solids.push_back(same);
  }
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.2);
  EXPECT_NEAR(read(world, GaugeQuantity::pressure, 0.2), 1000.0 * gravity * 0.2 - 1000.0, 10.0);
  const double self_weight = 0.5 * (1.0 - porosity) * 2650.0 * gravity * 0.36 / 1e6;
  // Points beside a wall reach into it, where no meniscus pulls at them.
  const double settled = beside_a_wall ? 5e-3 : 1e-3;
  EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, 0.58)), settled * self_weight);
  EXPECT_LT(read(world, GaugeQuantity::max_speed, 0.0), 1e-4);
}
TEST(PartlyFilled, AFringeHangsInSoilAtRest) { a_fringe_hangs(false); }
TEST(PartlyFilled, AFringeHangsBesideAWallAtRest) { a_fringe_hangs(true); }

/// Ground that is 0.3 full drains into dry ground by k_r = S^3: the front falls at k S^2 / n, and
/// S = sqrt(n z / (3 k t)) at a depth z below the top, that nothing flows through.
void a_wet_band_drains(bool grains_move) {
  const double filled = 0.3, top = 20 * h;
  CaseOptions c = column(20);
  for (int i = 0; i < 9; ++i)
    c.flow->bodies.push_back({Shape{BoxShape{{i * h, -9, 0.4}, {(i + filled) * h, 9, 9}}}, {}});
  if (grains_move) {
    add_soil(c, -9, top, 0.0);
    c.soil->flooded.clear();  // no pressure holds these grains up
  } else {
    PorousGround sand = ground(9);
    sand.filling = {PermeabilityCurve::power, 3.0, 0.0};
    c.flow->porous.push_back(sand);
  }
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double speed = conductivity * filled * filled / porosity, time = 2.0;
  run_until(world, time);
  const CellField<2>& found = world.flow()->saturation();
  double below = 0.0;  // what has come out of the band, over what it held in a cell
  for_each(world.grid().owned(), [&](const Index<2>& cell) {
    const double depth = top - (cell[1] + 0.5) * h;
    const double fan = std::sqrt(depth * porosity / (3.0 * conductivity * time));
    if (depth < 0.38 && std::abs(fan - filled) > 0.05) {
      EXPECT_NEAR(found[cell], std::min(fan, filled), 0.03) << depth;
    }
    if (depth > 0.4) below += found[cell] / 9.0;
  });
  EXPECT_NEAR(sum_over_ranks(world.grid(), below), speed * time / h * filled, 0.01);
  EXPECT_LT(lost_water(world), 1e-12);
}
TEST(PartlyFilled, AWetBandDrainsInFixedGround) { a_wet_band_drains(false); }
TEST(PartlyFilled, AWetBandDrainsInSoil) { a_wet_band_drains(true); }

/// Water stands at different levels before both faces of a dam of soil: q = k (h1^2 - h2^2)/(2 L).
TEST(PartlyFilled, WaterSeepsThroughADam) {
  CaseOptions c = column(12);
  c.domain.cells = {18, 12, 1};
  c.domain.upper = {18 * h, 12 * h, 0.0};
  const double first = 10 * h, second = 8 * h, left = 4 * h, right = 14 * h;
  for (int side = 0; side < 2; ++side) {
    c.domain.walls[0][static_cast<std::size_t>(side)] = Wall::open;
    FlowSideOptions level;
    level.name = side == 0 ? "reservoir" : "tailwater";
    level.axis = 0, level.side = side, level.flow = SideFlow::level;
    level.level = Varying(side == 0 ? first : second);
    c.flow->sides.push_back(level);
  }
  c.domain.walls[1][0] = Wall::no_slip;
  for (int i = 0; i < 18; ++i) {  // the parabola of Dupuit, near the state at the end
    const double way = std::clamp(((i + 0.5) * h - left) / (right - left), 0.0, 1.0);
    const double level = std::sqrt(first * first + way * (second * second - first * first));
    c.flow->bodies.push_back({Shape{BoxShape{{i * h, -9, -9}, {(i + 1) * h, 9, level}}}, {}});
  }
  add_soil(c, -9, 11 * h, 0.0);
  c.soil->bodies[0].shape = Shape{BoxShape{{left, -9, -9}, {right, 9, 11 * h}}};
  c.soil->flip_fraction = 0.0;
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 1.5);
  double passed = 0.0;
  while (world.clock().time() < 2.5) {
    world.advance(world.stable_step());
    for_each(world.grid().owned(), [&](const Index<2>& cell) {
      if (cell[0] == 9) passed += world.flow()->water_flux()[0][cell] * h * h;
    });
  }
  const double discharge = sum_over_ranks(world.grid(), passed) / (world.clock().time() - 1.5);
  const double exact = conductivity * (first * first - second * second) / (2.0 * (right - left));
  EXPECT_NEAR(discharge, exact, 0.03 * exact);
  EXPECT_LT(lost_water(world), 1e-12);
}

}  // namespace
}  // namespace mudlark

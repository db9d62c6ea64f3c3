// ranks: 1
// Pores that drain keep their residual saturation, in soil whose grains move and in fixed ground.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, viscosity = 1e-3, porosity = 0.4, conductivity = 0.5;
constexpr double permeability = conductivity * viscosity / (1000.0 * gravity);
constexpr double residue = 0.2, grain_density = 2650.0, water_weight = 1000.0 * gravity;
constexpr double h = 0.04;
constexpr int across = 9;

Shape between(double lower, double upper) {
  return Shape{BoxShape{{-9, -9, lower}, {9, 9, upper}}};
}

/// A column of n cells, water up to a height.
CaseOptions column(int n, double level) {
  CaseOptions c;
  c.domain.dimension = 2;
  c.domain.cells = {across, n, 1};
  c.domain.upper = {across * h, n * h, 0.0};
  c.domain.gravity = {0.0, -gravity, 0.0};
  c.time.end = 100.0;
  FlowOptions flow;
  flow.viscosity = viscosity;
  if (level > 0.0) flow.bodies.push_back({between(-9, level), {}});
  c.flow = flow;
  return c;
}

PoreFilling filling() {
  PoreFilling pores;
  pores.residual = pores.at_start = residue;
  return pores;
}

void add_ground(CaseOptions& c) {
  PorousGround sand;
  sand.shape = between(-9, 9);
  sand.porosity = porosity;
  sand.intrinsic_permeability = permeability;
  sand.filling = filling();
  c.flow->porous.push_back(sand);
}

void add_soil(CaseOptions& c, double lower, double upper, double modulus) {
  SoilBody body;
  body.name = "sand";
  body.shape = between(lower, upper);
  body.pore_water = PoreWater::unified;
  body.grain_density = grain_density;
  body.porosity = porosity;
  body.intrinsic_permeability = permeability;
  body.filling = filling();
  body.law = LinearElasticOptions{modulus, 0.0};
  body.strain = StrainMeasure::small;
  body.initial_stress = GeostaticStress{};
  SoilOptions soil;
  soil.bodies.push_back(body);
  for (const WaterBody& water : c.flow->bodies) soil.flooded.push_back(water.shape);
  c.soil = soil;
  c.coupling.mode = CouplingMode::unified;
}

std::vector<double> read(World<2>& world, GaugeQuantity quantity, double height) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.at = {4.5 * h, 0.0, height};
  return read_gauge(world, gauge);
}

void run_until(World<2>& world, double time) {
  while (world.clock().time() < time * (1.0 - 1e-9)) {
    const double left = time - world.clock().time();
    world.advance(left / std::ceil(left / world.stable_step()));
  }
}

/// Share of the pores that water fills in the middle of a row of cells.
double saturation(World<2>& world, int row) {
  const Index<2> cell{across / 2, row};
  return world.flow()->water_fraction()[cell] / world.flow()->porosity()[cell];
}

void add_drain(CaseOptions& c, SideFlow flow, double value) {
  FlowSideOptions drain;
  drain.name = "drain", drain.axis = 1, drain.flow = flow;
  drain.value = drain.level.emplace(value);
  c.domain.walls[1][0] = flow == SideFlow::level ? Wall::open : Wall::no_slip;
  c.flow->sides.push_back(drain);
}

/// Water leaves through the floor at a given velocity v in the pores: the table falls at
/// v / (1 - S_r), and behind it the pores hold S_r, whose weight the grains carry.
void a_table_falls(bool grains_move) {
  constexpr double level = 0.38, speed = 0.1, time = 1.0, top = 0.48;
  CaseOptions c = column(14, level);
  if (grains_move)
    add_soil(c, -9, top, 2e6);
  else
    add_ground(c);
  add_drain(c, SideFlow::velocity, -speed);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, time);
  const double table = level - speed * time / (1.0 - residue);
  EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.0)[0], table, 0.04 * h);
  for (int row = static_cast<int>(table / h) + 1; (row + 2.5) * h < top; ++row)
    EXPECT_NEAR(saturation(world, row), residue, 1e-3) << row;
  EXPECT_LT(conservation_errors(world)[0].second, 1e-12);
  if (!grains_move) return;
  const double place = 0.25 * h;  // of the lowest points
  const double grains = (1.0 - porosity) * grain_density * gravity * (top - place);
  const double water = water_weight * porosity * (table - place + residue * (top - table));
  const double pressure = water_weight * (table - place) * (1.0 - speed * porosity / conductivity);
  const double stress = read(world, GaugeQuantity::effective_stress, place)[2];
  EXPECT_NEAR(-stress, grains + water - pressure, 0.01 * grains);
}
TEST(ResidualWater, ATableFallsInSoil) { a_table_falls(true); }
TEST(ResidualWater, ATableFallsInFixedGround) { a_table_falls(false); }

/// A column that drains through its floor to water at a height d: n (1 - S_r) dL/dt = -k (L - d)/L,
/// and in the end n (1 - S_r) per metre has come out.
TEST(ResidualWater, AColumnDrains) {
  constexpr double level = 0.5, below = 0.1;
  CaseOptions c = column(14, level);
  add_ground(c);
  c.flow->porous[0].intrinsic_permeability *= 0.1;
  add_drain(c, SideFlow::level, below);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const double start = read(world, GaugeQuantity::total_water, 0.0)[0];
  const double yield = porosity * (1.0 - residue), k = 0.1 * conductivity;
  for (const double L : {0.4, 0.3, 0.2}) {
    run_until(world, yield / k * (level - L + below * std::log((level - below) / (L - below))));
    EXPECT_NEAR(read(world, GaugeQuantity::water_level, 0.0)[0], L, 0.02 * level);
  }
  run_until(world, 30.0);
  const double out = (start - read(world, GaugeQuantity::total_water, 0.0)[0]) / (across * h);
  EXPECT_NEAR(out, yield * (level - below), 0.01 * yield * (level - below));
  EXPECT_LT(conservation_errors(world)[0].second, 1e-12);
}

/// Grains that carry their residue, over a water table or without one, stay where they are.
TEST(ResidualWater, MoistSoilRests) {
  constexpr double top = 0.48, table = 0.2;
  CaseOptions c = column(14, table);
  add_soil(c, -9, top, 1e6);
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.2);
  const double self_weight = 0.5 * (1.0 - porosity) * grain_density * gravity * top * top / 1e6;
  EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, top - 0.25 * h)[0]),
            2e-3 * self_weight);
}

/// Moist grains that fall freely take their water along.
TEST(ResidualWater, FallsWithTheGrains) {
  CaseOptions c = column(20, 0.0);
  add_soil(c, 0.44, 0.68, 1e5);
  c.soil->bodies[0].initial_stress = {};
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  const auto height = [&] {
    double sum = 0.0, first = 0.0;
    for_each(world.grid().owned(), [&](const Index<2>& cell) {
      const double water = world.flow()->water_fraction()[cell];
      sum += water, first += water * world.grid().cell_centre(cell)[1];
    });
    return first / sum;
  };
  const double before = height(), time = 0.2;
  run_until(world, time);
  const double fall = 0.5 * gravity * time * time;
  EXPECT_NEAR(before - height(), fall, 0.02 * fall);
  EXPECT_LT(conservation_errors(world)[0].second, 1e-12);
}

}  // namespace
}  // namespace mudlark

// ranks: 1
// Rigid bodies in soil whose pore water is the flow's: rest, seepage around them, motion.
#include <gtest/gtest.h>

#include <cmath>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double water_density = 1000.0, grain_density = 2650.0, porosity = 0.4, gravity = 9.81;
constexpr double viscosity = 1e-3;

SoilBody soil_up_to(double height, double conductivity) {
  SoilBody body;
  body.name = "bed";
  body.shape.form = BoxShape{{-9, -9, -9}, {9, 9, height}};
  body.porosity = porosity;
  body.grain_density = grain_density;
  body.pore_water = PoreWater::unified;
  body.intrinsic_permeability = conductivity * viscosity / (water_density * gravity);
  body.points_per_cell = 9;
  body.law = LinearElasticOptions{5e6, 0.3};
  body.initial_stress = GeostaticStress{};
  return body;
}

/// A tank under gravity with a body in it, water up to `level` and no soil yet.
template <int D>
CaseOptions tank(double width, double height, double h, double level, const Shape& body) {
  CaseOptions c;
  constexpr std::size_t up = D - 1;
  c.domain.dimension = D;
  for (std::size_t a = 0; a < D; ++a) {
    c.domain.upper[a] = a == up ? height : width;
    c.domain.cells[a] = static_cast<int>(std::lround(c.domain.upper[a] / h));
  }
  c.domain.gravity = {};
  c.domain.gravity[up] = -gravity;
  FlowOptions flow;
  flow.viscosity = viscosity;
  flow.bodies.push_back({Shape{BoxShape{{-9, -9, -9}, {99, 99, level}}}, {}});
  FlowSolid solid;
  solid.name = "body";
  solid.shape = body;
  flow.solids.push_back(solid);
  c.flow = flow;
  return c;
}

void add_soil(CaseOptions& c, const SoilBody& soil, double friction) {
  SoilOptions options;
  options.bodies.push_back(soil);
  options.flooded.push_back(c.flow->bodies.front().shape);
  SolidOptions solid;
  solid.name = "body";
  solid.shape = c.flow->solids.front().shape;
  std::visit([&](const auto& motion) { solid.motion = motion; }, c.flow->solids.front().motion);
  solid.friction = friction;
  options.solids.push_back(solid);
  c.soil = options;
  c.coupling.mode = CouplingMode::unified;
}

template <int D>
std::vector<double> read(World<D>& world, GaugeQuantity quantity, std::array<double, 3> at = {}) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.at = at;
  gauge.of = "body";
  return read_gauge(world, gauge);
}

/// A box stands in the bed, its top in the water above: what it carries is the water's lift and the
/// effective weight of the soil that it stands in for.
template <int D>
void stands_in_a_bed_at_rest(double h, double until) {
  const Shape box{D == 2 ? BoxShape{{0.4, -9, 0.4}, {0.8, 9, 1.0}}
                         : BoxShape{{0.4, 0.4, 0.4}, {0.8, 0.8, 1.0}}};
  CaseOptions c = tank<D>(1.2, 1.4, h, 1.3, box);
  SoilBody soil = soil_up_to(0.8, 1e-3);
  if (D == 3) soil.points_per_cell = 8;
  add_soil(c, soil, 0.4);
  World<D> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, until);
  const double effective = (1.0 - porosity) * (grain_density - water_density) * gravity;
  const double self_weight = 0.5 * effective * 0.8 * 0.8 / 6.7e6;
  for (const double x : {0.2, 0.39})
    EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, {x, 0.5, 0.78})[0]),
              1e-3 * self_weight);
  // What is left of the first contact dies away; on the coarse cells of the box in space later.
  EXPECT_LT(read(world, GaugeQuantity::max_speed)[0], D == 2 ? 1e-6 : 2e-5);
  const std::vector<double> force = read(world, GaugeQuantity::solid_force);
  const double section = D == 2 ? 0.4 : 0.16;
  const double carried = section * (water_density * gravity * 0.6 + effective * 0.4);
  EXPECT_NEAR(force[D - 1], carried, 2e-3 * carried);
  EXPECT_LT(std::abs(force[0]), 1e-4 * carried);
  expect_conservation(world);
}
TEST(OneWaterAroundBodies, StandsInABedAtRest) { stands_in_a_bed_at_rest<2>(0.05, 0.4); }
TEST(OneWaterAroundBodies, StandsInABedAtRestIn3D) { stands_in_a_bed_at_rest<3>(0.1, 0.2); }

/// What seeps under a wall is what seeps through fixed ground of the same permeability, in the mean
/// over the shaking that the sudden start leaves in the skeleton. The smeared surface of the bed
/// costs 2 to 3 % of it on these cells, 0.2 % on cells of half the size.
TEST(OneWaterAroundBodies, LetsWaterSeepUnderAWallAsFixedGroundDoes) {
  const Shape wall{BoxShape{{1.4, -9, 0.5}, {1.6, 9, 9}}};
  const auto discharge = [&](bool points) {
    CaseOptions c = tank<2>(3.0, 1.4, 0.1, 1.1, wall);
    c.flow->bodies.push_back({Shape{BoxShape{{-9, -9, 1.1}, {1.5, 9, 1.3}}}, {}});
    SoilBody soil = soil_up_to(1.0, 3e-3);
    soil.points_per_cell = 4;
    if (points) {
      add_soil(c, soil, 0.0);
    } else {
      PorousGround ground;
      ground.name = "bed";
      ground.shape = soil.shape;
      ground.porosity = porosity;
      ground.intrinsic_permeability = soil.intrinsic_permeability;
      c.flow->porous.push_back(ground);
    }
    GaugeOptions section;
    section.name = "under";
    section.quantity = GaugeQuantity::section_flux;
    section.range.place = 1.5;
    c.gauges.push_back(section);
    World<2> world(c, MPI_COMM_WORLD);
    world.initialise();
    run_until(world, 0.8);
    const double dt = 0.4 / std::ceil(0.4 / world.stable_step());
    double volume = 0.0;
    while (world.clock().time() < 1.2 - 0.5 * dt) {
      world.advance(dt);
      volume += dt * read_gauge(world, section)[0];
    }
    return volume / 0.4;
  };
  const double fixed = discharge(false);
  EXPECT_GT(fixed, 1.5e-4);
  EXPECT_NEAR(discharge(true), fixed, 0.04 * fixed);
}

/// Clay under a rough block that is pushed into it keeps to the block, and nothing is lost.
TEST(OneWaterAroundBodies, FollowsABlockThatIsPushedIntoClay) {
  const Shape block{BoxShape{{0.4, -9, 0.8}, {0.8, 9, 1.6}}};
  CaseOptions c = tank<2>(1.2, 1.6, 0.05, 1.2, block);
  PrescribedSolid down;
  down.translation[2] = Varying(-0.05);
  c.flow->solids.front().motion = down;
  SoilBody clay = soil_up_to(0.8, 1e-6);
  clay.law = TrescaOptions{1e6, 0.3, 5e3};
  add_soil(c, clay, std::numeric_limits<double>::infinity());
  World<2> world(c, MPI_COMM_WORLD);
  world.initialise();
  run_until(world, 0.6);
  EXPECT_NEAR(read(world, GaugeQuantity::settlement, {0.6, 0.0, 0.78})[0], 0.03, 0.001);
  // Between the bearing of a strip with smooth and rough sides, and the lift of the water.
  const double bearing = 0.4 * 5e3, lift = 0.4 * water_density * gravity * 0.43;
  const double force = read(world, GaugeQuantity::solid_force)[1];
  EXPECT_GT(force, 5.14 * bearing * 0.9 + lift);
  EXPECT_LT(force, 5.14 * bearing * 1.5 + lift);
  expect_conservation(world);
}

}  // namespace
}  // namespace mudlark

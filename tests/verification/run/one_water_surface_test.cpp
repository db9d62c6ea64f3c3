// ranks: 1
// Water that ends near the end of the ground: what lies under it weighs less by the water that it
// takes the place of, however close to each other the two surfaces are.
#include <algorithm>

#include "run/gauges.hpp"
#include "verification/run/one_water.hpp"

namespace mudlark {
namespace {

constexpr double h = 0.05, top = 0.5, gravity = 9.81, modulus = 1e6;
constexpr double grains = 0.6 * 2650.0 * gravity, lift = 0.6 * 1000.0 * gravity;  ///< [N/m3]

CaseOptions column(double level) {
  CaseOptions c = soil_in_water(Shape{BoxShape{{-9, -9, -9}, {9, 9, top}}}, level, 1e-2, modulus);
  c.domain.cells = {3, 14, 1};
  c.domain.upper = {3 * h, 14 * h, 0.0};
  c.soil->bodies[0].points_per_cell = 4;
  c.soil->bodies[0].law = LinearElasticOptions{modulus, 0.0};
  c.soil->bodies[0].strain = StrainMeasure::small;
  c.soil->bodies[0].initial_stress = GeostaticStress{};
  return c;
}

double read(World<2>& world, GaugeQuantity quantity, double height, std::size_t component = 0) {
  GaugeOptions gauge;
  gauge.quantity = quantity;
  gauge.at = {1.25 * h, 0.0, height};
  return read_gauge(world, gauge)[component];
}

/// Effective vertical stress [Pa], compression positive, that grains should carry at a height.
double weight_above(double height, double level) {
  return grains * (top - height) - lift * std::max(0.0, std::min(level, top) - height);
}

/// Lift of a cell of grains [Pa].
constexpr double cell = lift * h;

TEST(OneWaterSurface, GrainsWeighWhatTheyDoUnderWaterUpToTheirTop) {
  for (const double over : {-2.7, -1.3, -1.0, -0.8, -0.3, 0.0, 0.2, 0.4, 0.8}) {
    CaseOptions c = column(top + over * h);
    EquilibriumStart start;
    start.longest = 20.0;
    start.rest.unbalanced_force = 1e-5;
    c.soil->start_in_equilibrium = start;
    World<2> world(c, MPI_COMM_WORLD);
    world.initialise();
    world.find_equilibrium();
    double mean = 0.0;  // points of a row share what the grid knows of their stress
    for (int row = 0; row < 4; ++row) {
      const double height = 0.2 + (row + 0.5) * 0.5 * h;
      mean -= 0.25 * read(world, GaugeQuantity::effective_stress, height, 2);
    }
    EXPECT_NEAR(mean, weight_above(0.25, top + over * h), 0.01 * cell) << over << " cells";
  }
}

TEST(OneWaterSurface, ABedUnderWaterUpToItsTopStaysAtRest) {
  for (const double over : {0.0, 0.3}) {
    World<2> world(column(top + over * h), MPI_COMM_WORLD);
    world.initialise();
    run_until(world, 0.25);
    const double self_weight = 0.5 * (grains - lift) * top * top / modulus;
    EXPECT_LT(std::abs(read(world, GaugeQuantity::settlement, 0.4)), 1e-3 * self_weight);
    for (const double height : {0.4875, 0.4625}) {  // that the rim does not hang on its neighbours
      const double stress = -read(world, GaugeQuantity::effective_stress, height, 2);
      EXPECT_NEAR(stress, weight_above(height, top + over * h), 0.1 * cell) << height;
    }
    expect_conservation(world);
  }
}

}  // namespace
}  // namespace mudlark

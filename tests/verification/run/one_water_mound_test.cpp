// ranks: 1
// One water where it is easily disturbed: a mound that settles in it, and a soft bed that rocks
// under deep water.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81, density = 1000.0;

CaseOptions soil_in_water(const Shape& shape, double level, double conductivity, double modulus) {
  CaseOptions c;
  c.domain.gravity = {0.0, -gravity, 0.0};
  c.domain.walls[1][1] = Wall::open;
  c.time.end = 1.0;
  FlowOptions flow;
  flow.density = density;
  flow.bodies.push_back({Shape{BoxShape{{-9, -9, -9}, {9, 9, level}}}, {}});
  c.flow = flow;
  SoilBody body;
  body.name = "soil";
  body.shape = shape;
  body.porosity = 0.4;
  body.pore_water = PoreWater::unified;
  body.intrinsic_permeability = conductivity * flow.viscosity / (density * gravity);
  body.points_per_cell = 9;
  body.law = LinearElasticOptions{modulus, 0.3};
  body.strain = StrainMeasure::hencky;
  SoilOptions soil;
  soil.bodies.push_back(body);
  soil.flooded.push_back(flow.bodies.front().shape);
  c.soil = soil;
  c.coupling.mode = CouplingMode::unified;
  return c;
}

/// Pressure above that of water at rest, largest of all full cells, and how far a cell departs most
/// from the mean of its four neighbours.
struct Roughness {
  double peak = 0.0, deviation = 0.0;
};
Roughness roughness(World<2>& world, double level) {
  const auto& grid = world.grid();
  const auto& p = world.flow()->pressure();
  const auto excess = [&](const Index<2>& cell) {
    return p[cell] - density * gravity * (level - grid.cell_centre(cell)[1]);
  };
  Roughness found;
  IndexBox<2> inner = grid.owned();
  for (int a = 0; a < 2; ++a) ++inner.lower[a], --inner.upper[a];
  for_each(inner, [&](const Index<2>& cell) {
    if (grid.cell_centre(cell)[1] > level - 2.0 * grid.spacing()[1]) return;
    double mean = 0.0;
    for (int a = 0; a < 2; ++a)
      mean += 0.25 * (excess(cell.shifted(a, -1)) + excess(cell.shifted(a, 1)));
    found.peak = std::max(found.peak, std::abs(excess(cell)));
    found.deviation = std::max(found.deviation, std::abs(excess(cell) - mean));
  });
  return found;
}

/// A mound without stress is let go in water: it settles, and water goes out of it. A pressure that
/// alternated from cell to cell would depart from its neighbours' mean by as much as it is high.
TEST(OneWaterMound, PressureHasNoCheckerboard) {
  const double level = 1.5;
  PolygonShape mound;
  for (int i = 0; i <= 24; ++i) {
    const double x = 0.1 + i / 24.0;
    mound.corners.push_back({x, 0.5 * std::pow(std::sin(std::numbers::pi * i / 24.0), 2)});
  }
  for (const double conductivity : {1e-2, 1e-4, 1e-9}) {
    CaseOptions c = soil_in_water(Shape{mound}, level, conductivity, 5e5);
    c.domain.cells = {24, 32, 1};
    c.domain.upper = {1.2, 1.6, 0.0};
    World<2> world(c, MPI_COMM_WORLD);
    world.initialise();
    Roughness worst;
    while (world.clock().time() < 0.05) {
      world.advance(0.9 * world.stable_step());
      const Roughness now = roughness(world, level);
      worst.peak = std::max(worst.peak, now.peak);
      worst.deviation = std::max(worst.deviation, now.deviation);
    }
    EXPECT_GT(worst.peak, 100.0);
    EXPECT_LT(worst.deviation, 0.05 * worst.peak) << "k = " << conductivity;
  }
}

/// The bed of added_mass_test.cpp: loose coupling diverges below 5 ms, here every step will do.
TEST(OneWaterMound, ABedRocksUnderDeepWaterAtAnyStep) {
  for (const double step : {4e-3, 1e-3, 2.5e-4, 5e-5}) {
    CaseOptions c = soil_in_water(Shape{BoxShape{{-9, -9, -9}, {9, 9, 0.5}}}, 10.5, 1e-6, 1e5);
    c.domain.cells = {10, 55, 1};
    c.domain.upper = {2.0, 11.0, 0.0};
    SoilBody& bed = c.soil->bodies.front();
    bed.initial_stress = GeostaticStress{};
    bed.points_per_cell = 4;
    bed.initial_velocity[2] =
        Varying([](const Point3& x,
                   double) { return 0.01 * std::cos(std::numbers::pi * x[0] / 2.0) * x[2]; },
                "rocking");
    World<2> world(c, MPI_COMM_WORLD);
    world.initialise();
    const double start = world.soil()->totals().kinetic_energy;
    double largest = 0.0;
    for (int i = 0; i < 100; ++i) {
      world.advance(step);
      largest = std::max(largest, world.soil()->totals().kinetic_energy);
    }
    EXPECT_LT(largest, 1.05 * start) << step;
  }
}

}  // namespace
}  // namespace mudlark

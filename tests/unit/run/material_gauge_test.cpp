// ranks: 1 3
#include "run/material_gauge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudlark {
namespace {

/// A block of 1.2 m x (0.8 m x) 0.7 m in a box with room around it.
template <int D>
Grid<D> make_grid(Wall sides) {
  DomainOptions domain;
  domain.dimension = D;
  for (std::size_t a = 0; a < 3; ++a) {
    domain.upper[a] = 1.2;
    domain.cells[a] = 12;
    domain.walls[a] = {sides, sides};
  }
  return Grid<D>(domain, MPI_COMM_WORLD);
}

SoilOptions make_soil(int points_per_cell) {
  SoilBody body;
  body.name = "block";
  body.shape.form = BoxShape{{-1.0, -1.0, 0.2}, {9.0, 9.0, 0.9}};
  body.points_per_cell = points_per_cell;
  body.law = LinearElasticOptions{1e6, 0.3};
  SoilOptions soil;
  soil.bodies.push_back(body);
  return soil;
}

template <int D>
double linear(const Vec<D>& x, int number) {
  double sum = 0.1 * number;
  for (int a = 0; a < D; ++a) sum += (0.3 * number - 0.7 * a + 0.2) * x[a];
  return sum;
}

/// Gives the points of a solver linear fields of their place at time zero.
template <int D>
void give_linear_fields(SoilSolver<D>& soil) {
  auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    Vec<D> start;
    for (int a = 0; a < D; ++a) start[a] = points.start[a][p];
    for (int a = 0; a < D; ++a) points.position[a][p] = start[a] + 0.01 * linear(start, a);
    points.pore_pressure[p] = 1e3 * linear(start, 5);
    for (int c = 0; c < 6; ++c) points.stress[c][p] = 1e3 * linear(start, 6 + c);
    // Porosity linear in place: volume = grains / (density (1 - n)).
    const double n = 0.3 + 0.01 * linear(start, 1);
    points.volume[p] = points.grain_mass[p] / (2650.0 * (1.0 - n));
  }
}

template <int D>
void expect_exact_readings(int points_per_cell) {
  const Grid<D> grid = make_grid<D>(Wall::slip);
  SoilSolver<D> soil(grid, make_soil(points_per_cell));
  soil.initialise();
  give_linear_fields(soil);
  std::vector<Vec<D>> places(4);
  for (Vec<D>& at : places)
    for (int a = 0; a < D; ++a) at[a] = 0.55 + 0.013 * a;
  places[1][D - 1] = 0.9;  // on the surface
  places[2][0] = 0.0;      // at a wall
  places[3][0] = 1.2;      // in a corner
  places[3][D - 1] = 0.2;
  for (const Vec<D>& at : places) {
    const auto displacement = read_material(grid, soil, MaterialQuantity::displacement, at);
    ASSERT_EQ(displacement.size(), static_cast<std::size_t>(D));
    for (int a = 0; a < D; ++a)
      EXPECT_NEAR(displacement[static_cast<std::size_t>(a)], 0.01 * linear(at, a), 1e-12);
    const auto pressure = read_material(grid, soil, MaterialQuantity::pore_pressure, at);
    ASSERT_EQ(pressure.size(), 1u);
    EXPECT_NEAR(pressure[0], 1e3 * linear(at, 5), 1e-8);
    const auto stress = read_material(grid, soil, MaterialQuantity::effective_stress, at);
    ASSERT_EQ(stress.size(), 4u);  // xx, yy, zz, zx
    EXPECT_NEAR(stress[0], 1e3 * linear(at, 6), 1e-8);
    EXPECT_NEAR(stress[1], 1e3 * linear(at, 7), 1e-8);
    EXPECT_NEAR(stress[2], 1e3 * linear(at, 8), 1e-8);
    EXPECT_NEAR(stress[3], 1e3 * linear(at, 11), 1e-8);
    const auto porosity = read_material(grid, soil, MaterialQuantity::porosity, at);
    ASSERT_EQ(porosity.size(), 1u);
    EXPECT_NEAR(porosity[0], 0.3 + 0.01 * linear(at, 1), 1e-11);
  }
}

TEST(MaterialGauge, ReadsLinearFieldsExactlyInsideOnTheSurfaceAndInCorners) {
  expect_exact_readings<2>(4);
  expect_exact_readings<2>(9);
  expect_exact_readings<3>(8);
}

TEST(MaterialGauge, ReadsLinearFieldsExactlyInsideFromOnePointPerCell) {
  const Grid<2> grid = make_grid<2>(Wall::slip);
  SoilSolver<2> soil(grid, make_soil(1));
  soil.initialise();
  give_linear_fields(soil);
  const Vec<2> at{{0.57, 0.53}};
  EXPECT_NEAR(read_material(grid, soil, MaterialQuantity::pore_pressure, at)[0],
              1e3 * linear(at, 5), 1e-8);
}

TEST(MaterialGauge, IsEmptyWhereNoSoilStarted) {
  const Grid<2> grid = make_grid<2>(Wall::slip);
  SoilSolver<2> soil(grid, make_soil(4));
  soil.initialise();
  EXPECT_TRUE(
      read_material(grid, soil, MaterialQuantity::pore_pressure, Vec<2>{{0.5, 1.19}}).empty());
}

TEST(MaterialGauge, FollowsTheMaterialThroughAPeriodicSeam) {
  const Grid<2> grid = make_grid<2>(Wall::periodic);
  SoilSolver<2> soil(grid, make_soil(4));
  soil.initialise();
  auto& points = soil.points(0);
  const double drift = 0.31;
  for (std::size_t p = 0; p < points.size(); ++p) {
    points.pore_pressure[p] = std::sin(2.0 * 3.14159265358979323846 * points.start[0][p] / 1.2);
    points.position[0][p] += drift;
  }
  const Vec<2> far{{1.13, 0.55}}, near{{0.55, 0.55}};
  const double before = read_material(grid, soil, MaterialQuantity::pore_pressure, far)[0];
  soil.redistribute();
  for (const Vec<2>& at : {far, near}) {
    const auto displacement = read_material(grid, soil, MaterialQuantity::displacement, at);
    ASSERT_EQ(displacement.size(), 2u);
    EXPECT_NEAR(displacement[0], drift, 1e-12);
  }
  EXPECT_NEAR(read_material(grid, soil, MaterialQuantity::pore_pressure, far)[0], before, 1e-2);
}

/// Ground that has moved and fill that is placed upon it later.
TEST(MaterialGauge, FollowsTheSoilThatStartedNearestAndNotWhatWasPlacedBesideIt) {
  const Grid<2> grid = make_grid<2>(Wall::slip);
  SoilOptions options = make_soil(4);
  options.stages.resize(2);
  options.bodies.push_back(options.bodies[0]);
  options.bodies[1].stage = 1;
  options.bodies[1].shape.form = BoxShape{{-1.0, -1.0, 0.9}, {9.0, 9.0, 1.1}};
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const auto settlement = [&](double height) {
    return read_material(grid, soil, MaterialQuantity::displacement, Vec<2>{0.6, height}).at(1);
  };
  for (double& z : soil.points(0).position[1]) z += 0.002;
  EXPECT_NEAR(settlement(0.95), 0.002, 1e-12)
      << "the ground's surface goes on where nothing else is";
  soil.begin_stage(1);
  EXPECT_NEAR(settlement(0.85), 0.002, 1e-12);
  EXPECT_NEAR(settlement(0.9), 0.002, 1e-12) << "as near to both: the older one";
  EXPECT_NEAR(settlement(0.95), 0.0, 1e-12);
}

}  // namespace
}  // namespace mudlark

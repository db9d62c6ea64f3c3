// ranks: 1 3
#include "soil/seeding.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/errors.hpp"
#include "grid/halo.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81;

/// 3 m wide, 4 m high; three layers and air: 1 m wet clay, 1 m wet sand, 1 m dry sand.
template <int D>
Grid<D> make_grid(MPI_Comm comm) {
  DomainOptions domain;
  domain.dimension = D;
  if constexpr (D == 2) {
    domain.upper = {3.0, 4.0, 0.0};
    domain.cells = {12, 16, 1};
    domain.gravity = {0.0, -gravity, 0.0};
  } else {
    domain.upper = {3.0, 3.0, 4.0};
    domain.cells = {12, 6, 16};
    domain.gravity = {0.0, 0.0, -gravity};
  }
  return Grid<D>(domain, comm);
}

SoilBody make_layer(const std::string& name, double from, double to, double porosity, bool wet,
                    int points_per_cell) {
  SoilBody body;
  body.name = name;
  body.shape.form = BoxShape{{-1.0, -1.0, from}, {10.0, 10.0, to}};
  body.porosity = porosity;
  body.pore_water = wet ? PoreWater::two_phase : PoreWater::none;
  body.points_per_cell = points_per_cell;
  body.law = LinearElasticOptions{1e6, 0.25};
  body.initial_stress = GeostaticStress{};
  return body;
}

template <int D>
SoilOptions make_layers() {
  SoilOptions soil;
  const int few = D == 2 ? 4 : 8, many = D == 2 ? 9 : 27;
  soil.bodies = {make_layer("clay", 0.0, 1.0, 0.5, true, few),
                 make_layer("sand", 1.0, 2.0, 0.4, true, many),
                 make_layer("dry sand", 2.0, 3.0, 0.4, false, few)};
  soil.bodies[0].initial_stress = GeostaticStress{0.8};
  return soil;
}

template <int D>
std::vector<SoilParticles<D>> seed(const Grid<D>& grid, const SoilOptions& options) {
  std::vector<SoilParticles<D>> bodies;
  for (std::size_t b = 0; b < options.bodies.size(); ++b)
    bodies.push_back(seed_points(grid, options.bodies[b], b, Transfer::flip));
  return bodies;
}

template <int D>
void expect_counts_and_masses() {
  const Grid<D> grid = make_grid<D>(MPI_COMM_WORLD);
  const SoilOptions options = make_layers<D>();
  const auto bodies = seed<D>(grid, options);
  const double area = D == 2 ? 3.0 : 9.0, cells = D == 2 ? 12 * 4 : 12 * 6 * 4;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    double mass = 0.0, volume = 0.0;
    for (std::size_t p = 0; p < bodies[b].size(); ++p) {
      mass += bodies[b].grain_mass[p];
      volume += bodies[b].volume[p];
      EXPECT_TRUE(grid.owned().contains(grid.cell_at(bodies[b].position_of(p))));
      EXPECT_EQ(bodies[b].start_volume[p], bodies[b].volume[p]);
    }
    const SoilBody& body = options.bodies[b];
    EXPECT_EQ(sum_over_ranks(grid, static_cast<double>(bodies[b].size())),
              cells * body.points_per_cell);
    EXPECT_NEAR(sum_over_ranks(grid, volume), area, 1e-12);
    EXPECT_NEAR(sum_over_ranks(grid, mass), (1 - body.porosity) * 2650.0 * area, 1e-12 * 1e5);
  }
}

TEST(SeedPoints, FillsEachLayerWithItsPointsAndItsMass) {
  expect_counts_and_masses<2>();
  expect_counts_and_masses<3>();
}

template <int D>
std::map<std::int64_t, Vec<D>> places_by_id(const std::vector<SoilParticles<D>>& bodies) {
  std::map<std::int64_t, Vec<D>> places;
  for (const auto& points : bodies)
    for (std::size_t p = 0; p < points.size(); ++p) {
      EXPECT_EQ(places.count(points.id[p]), 0u) << "id twice";
      places[points.id[p]] = points.position_of(p);
    }
  return places;
}

template <int D>
void expect_ids_of_the_serial_run() {
  const SoilOptions options = make_layers<D>();
  const auto mine = places_by_id<D>(seed<D>(make_grid<D>(MPI_COMM_WORLD), options));
  const auto serial = places_by_id<D>(seed<D>(make_grid<D>(MPI_COMM_SELF), options));
  for (const auto& [id, place] : mine) {
    ASSERT_EQ(serial.count(id), 1u);
    EXPECT_EQ(serial.at(id), place);
  }
  double count = static_cast<double>(mine.size()), all = 0.0;
  MPI_Allreduce(&count, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(all, static_cast<double>(serial.size()));
}

TEST(SeedPoints, NumbersAreUniqueAndDoNotDependOnRanks) {
  expect_ids_of_the_serial_run<2>();
  expect_ids_of_the_serial_run<3>();
}

/// Effective vertical stress and pore pressure by hand.
struct Geostatic {
  double effective, water;
};
Geostatic by_hand(double z) {
  const double dry = 0.6 * 2650.0 * gravity, sand = 0.6 * 1650.0 * gravity,
               clay = 0.5 * 1650.0 * gravity, water = 1000.0 * gravity;
  if (z > 2.0) return {dry * (3.0 - z), 0.0};
  if (z > 1.0) return {dry + sand * (2.0 - z), water * (2.0 - z)};
  return {dry + sand + clay * (1.0 - z), water * (2.0 - z)};
}

template <int D>
void expect_geostatic_layers() {
  const Grid<D> grid = make_grid<D>(MPI_COMM_WORLD);
  const SoilOptions options = make_layers<D>();
  auto bodies = seed<D>(grid, options);
  set_initial_stress(grid, options, 0, bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double k0 = b == 0 ? 0.8 : 0.25 / 0.75;
    for (std::size_t p = 0; p < bodies[b].size(); ++p) {
      const Geostatic exact = by_hand(bodies[b].position[D - 1][p]);
      const SymTensor stress = get_tensor(bodies[b].stress, p);
      EXPECT_NEAR(stress.zz, -exact.effective, 1e-9 * 5e4);
      EXPECT_NEAR(stress.xx, -k0 * exact.effective, 1e-9 * 5e4);
      EXPECT_NEAR(stress.yy, -k0 * exact.effective, 1e-9 * 5e4);
      EXPECT_EQ(stress.zx, 0.0);
      EXPECT_NEAR(bodies[b].pore_pressure[p], exact.water, 1e-9 * 5e4);
    }
  }
}

TEST(InitialStress, IsTheWeightOfTheLayersAboveAndTheWaterBetweenThem) {
  expect_geostatic_layers<2>();
  expect_geostatic_layers<3>();
}

TEST(InitialStress, TakesAGivenTensorAndAddsAGivenPorePressure) {
  const Grid<2> grid = make_grid<2>(MPI_COMM_WORLD);
  SoilOptions options = make_layers<2>();
  options.bodies.resize(1);
  const Varying excess([](const Point3& x, double) { return 100.0 * x[0] + 7.0 * x[2]; }, "excess");
  options.bodies[0].initial_stress = SymTensor{1, 2, 3, 4, 5, 6};
  options.bodies[0].initial_pore_pressure = excess;
  auto given = seed<2>(grid, options);
  set_initial_stress(grid, options, 0, given);
  options.bodies[0].initial_stress = GeostaticStress{};
  auto geostatic = seed<2>(grid, options);
  set_initial_stress(grid, options, 0, geostatic);
  for (std::size_t p = 0; p < given[0].size(); ++p) {
    const double x = given[0].position[0][p], z = given[0].position[1][p];
    EXPECT_EQ(get_tensor(given[0].stress, p), (SymTensor{1, 2, 3, 4, 5, 6}));
    EXPECT_NEAR(given[0].pore_pressure[p], 100.0 * x + 7.0 * z, 1e-9);
    EXPECT_NEAR(geostatic[0].pore_pressure[p], 9810.0 * (1.0 - z) + 100.0 * x + 7.0 * z, 1e-7);
  }
}

TEST(InitialStress, TakesAStressThatVariesInSpace) {
  const Grid<2> grid = make_grid<2>(MPI_COMM_WORLD);
  SoilOptions options = make_layers<2>();
  StressField field;
  field.component[2] = Varying([](const Point3& x, double) { return -1e3 * (3.0 - x[2]); }, "zz");
  field.component[5] = Varying([](const Point3& x, double) { return 50.0 * x[0]; }, "zx");
  options.bodies[1].initial_stress = field;
  auto bodies = seed<2>(grid, options);
  set_initial_stress(grid, options, 0, bodies);
  for (std::size_t p = 0; p < bodies[1].size(); ++p) {
    const SymTensor stress = get_tensor(bodies[1].stress, p);
    EXPECT_NEAR(stress.zz, -1e3 * (3.0 - bodies[1].position[1][p]), 1e-9);
    EXPECT_NEAR(stress.zx, 50.0 * bodies[1].position[0][p], 1e-9);
    EXPECT_EQ(stress.xx, 0.0);
  }
}

TEST(SeedPoints, TakesTheVelocityOfThePlaceForGrainsAndWater) {
  const Grid<2> grid = make_grid<2>(MPI_COMM_WORLD);
  SoilBody body = make_layer("layer", 0.0, 2.0, 0.4, true, 4);
  body.initial_velocity[0] = Varying([](const Point3& x, double) { return x[2]; }, "z");
  body.initial_velocity[2] = Varying(-3.0);
  const auto points = seed_points(grid, body, 0, Transfer::flip);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_EQ(points.velocity[0][p], points.position[1][p]);
    EXPECT_EQ(points.velocity[1][p], -3.0);
    EXPECT_EQ(points.water_velocity[0][p], points.position[1][p]);
    EXPECT_EQ(points.water_velocity[1][p], -3.0);
  }
}

TEST(SeedPoints, RefusesANumberOfPointsThatIsNoPower) {
  SoilBody body = make_layer("layer", 0.0, 2.0, 0.4, true, 5);
  EXPECT_THROW(seed_points(make_grid<2>(MPI_COMM_WORLD), body, 0, Transfer::flip), InputError);
  body.points_per_cell = 4;
  EXPECT_THROW(seed_points(make_grid<3>(MPI_COMM_WORLD), body, 0, Transfer::flip), InputError);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
// Implicit quasi-static steps: consolidation, rest under weight, laws that yield.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

/// Runs to `end` with the steps that the solver recommends; returns how many.
template <int D>
int run_to(SoilSolver<D>& soil, double end, double longest) {
  double time = 0.0;
  int count = 0;
  while (time < end) {
    const double dt = std::min({soil.outer_step(), longest, end - time});
    soil.begin_step(time, dt, nullptr);
    soil.advance(dt);
    time += dt;
    ++count;
  }
  return count;
}

/// Mean of a value over the points of a thin layer around a start height, over all ranks.
template <int D, class F>
double layer_mean(const SoilParticles<D>& points, double height, double half, F&& value) {
  std::array<double, 2> mine{}, all{};
  for (std::size_t p = 0; p < points.size(); ++p)
    if (std::abs(points.start[D - 1][p] - height) < half) mine[0] += value(p), mine[1] += 1.0;
  MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all[0] / all[1];
}

template <int D>
Grid<D> column_grid(int cells, double gravity) {
  return soil_runs::make_grid<D>({3, D == 2 ? cells + 4 : 3, cells + 4}, 1.0 / cells,
                                 D == 2 ? "ssso" : "ssssso", gravity, MPI_COMM_WORLD);
}

template <int D>
SoilOptions column(double conductivity, double load, StrainMeasure strain) {
  SoilOptions soil = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 1.0}, true);
  SoilBody& body = soil.bodies[0];
  body.intrinsic_permeability = conductivity * 1.002e-3 / 9810.0;
  body.strain = strain;
  soil.water_bulk_modulus = 2.15e7;
  soil.method = TimeMethod::implicit_steps;
  if (load > 0.0) soil.loads.push_back({"q", Varying(load)});
  return soil;
}

// Terzaghi (1923): c_v = k / (gamma_w (1/M + n/K_w)), p0 = 0.97557 q; at T = 0.2 half of the
// settlement is done (U = 0.504), and the pressure at the base is 0.772 p0.
template <int D>
void expect_terzaghi(int cells, double step_tolerance) {
  const double conductivity = 1e-7, load = 1000.0;
  const double modulus = soil_runs::constrained_modulus(1e6, 0.3);
  const double diffusivity = conductivity / 9810.0 / (1.0 / modulus + 0.4 / 2.15e7);
  const Grid<D> grid = column_grid<D>(cells, 0.0);
  SoilOptions options = column<D>(conductivity, load, StrainMeasure::small);
  options.step_tolerance = step_tolerance;
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  const int steps = run_to(soil, 0.2 / diffusivity, 1e9);
  const auto& points = soil.points(0);
  const double base = layer_mean(points, 0.5 / cells, 0.4 / cells,
                                 [&](std::size_t p) { return points.pore_pressure[p]; });
  const double top = layer_mean(points, 1.0 - 0.25 / cells, 0.2 / cells, [&](std::size_t p) {
    return points.start[D - 1][p] - points.position[D - 1][p];
  });
  const double undrained = 0.97557;
  const double settlement =
      load / modulus * (1.0 - undrained + undrained * 0.5041 - 0.25 / cells);  // drained there
  std::printf("%d steps to T = 0.2: base %.1f Pa (exact %.1f), settlement %.4e m (exact %.4e)\n",
              steps, base, 0.7722 * undrained * load, top, settlement);
  EXPECT_LT(steps, 200);
  EXPECT_NEAR(base, 0.7722 * undrained * load, 0.01 * load);
  EXPECT_NEAR(top, settlement, (D == 2 ? 0.01 : 0.02) * load / modulus);
}

TEST(Implicit, FollowsTerzaghiOverMonths) {
  expect_terzaghi<2>(20, 1e-3);
  expect_terzaghi<3>(6, 5e-3);
}

// Soil without stress is given its weight: in the end the grains carry their buoyant weight, the
// water stands.
TEST(Implicit, ReachesGeostaticStressByItself) {
  const int cells = 20;
  const Grid<2> grid = column_grid<2>(cells, 9.81);
  SoilOptions options = column<2>(1e-4, 0.0, StrainMeasure::hencky);
  options.step_tolerance = 3e-3;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  run_to(soil, 3000.0, 1e9);
  const auto& points = soil.points(0);
  for (const double height : {0.125, 0.475, 0.825}) {
    const auto mean = [&](auto&& value) { return layer_mean(points, height, 0.3 / cells, value); };
    const double above = mean([&](std::size_t p) { return points.position[1][p]; });
    const double surface = layer_mean(points, 1.0 - 0.25 / cells, 0.2 / cells,
                                      [&](std::size_t p) { return points.position[1][p]; }) +
                           0.25 / cells;
    const double weight = 0.6 * 1650.0 * 9.81 * (1.0 - height);
    EXPECT_NEAR(mean([&](std::size_t p) { return -points.stress[2][p]; }), weight, 100.0);
    EXPECT_NEAR(mean([&](std::size_t p) { return points.pore_pressure[p]; }),
                9810.0 * (surface - above), 100.0);
  }
  EXPECT_LT(soil.totals().kinetic_energy, 1e-12);
}

// A dry fill on wet ground: it feels nothing of the pore water next to it, and the ground settles
// under the fill and its own weight under water.
TEST(Implicit, CarriesADryFillOnWetGround) {
  const Grid<2> grid = soil_runs::make_grid<2>({2, 16, 1}, 0.25, "ssno", 9.81);
  SoilOptions soil = soil_runs::make_soil(2, {-1, -1, -1}, {9, 9, 2.0}, true);
  soil.bodies.push_back(soil_runs::make_soil(2, {-1, -1, 2.0}, {9, 9, 3.0}, false).bodies[0]);
  soil.bodies[1].name = "fill";
  for (SoilBody& body : soil.bodies) {
    body.strain = StrainMeasure::small;
    body.law = LinearElasticOptions{2e7, 0.3};
  }
  soil.method = TimeMethod::implicit_steps;
  soil.step_tolerance = 1.0;
  SoilSolver<2> solver(grid, soil);
  solver.initialise();
  for (int step = 0; step < 6; ++step) {
    solver.begin_step(step * 1e5, 1e5, nullptr);
    solver.advance(1e5);
  }
  EXPECT_EQ(solver.implicit_effort().repeated, 0);
  const auto& ground = solver.points(0);
  double settlement = 0.0, height = 0.0;  // of the uppermost points
  for (std::size_t p = 0; p < ground.size(); ++p) {
    settlement = std::max(settlement, ground.start[1][p] - ground.position[1][p]);
    height = std::max(height, ground.start[1][p]);
  }
  const SoilBody& body = soil.bodies[0];
  const double dry = (1 - body.porosity) * body.grain_density * 9.81;
  const double under_water = (1 - body.porosity) * (body.grain_density - 1000.0) * 9.81;
  const double exact = (dry * 1.0 * height + under_water * (2.0 * height - 0.5 * height * height)) /
                       soil_runs::constrained_modulus(2e7, 0.3);
  std::printf("fill: settlement %.5g m, exact %.5g\n", settlement, exact);
  EXPECT_NEAR(settlement, exact, 1e-3 * exact);
  const auto& fill = solver.points(1);
  for (std::size_t p = 0; p < fill.size(); ++p) EXPECT_EQ(fill.pore_pressure[p], 0.0);
}

// A dry block of Mohr-Coulomb soil without dilatancy is pressed between smooth walls until it
// yields: plane strain, sigma_1 = sigma_3 tan^2(45 + phi/2) + 2 c tan(45 + phi/2).
TEST(Implicit, PressesMohrCoulombSoilToItsStrength) {
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {9, 9, 1.0}, false);
  MohrCoulombOptions law;
  law.young_modulus = 1e7;
  law.poisson_ratio = 0.3;
  law.cohesion = 1e4;
  law.friction_angle = 25.0 * std::numbers::pi / 180.0;
  options.bodies[0].law = law;
  options.bodies[0].strain = StrainMeasure::jaumann;
  options.method = TimeMethod::implicit_steps;
  options.loads.push_back(
      {"q", Varying([](const Point3&, double t) { return 2e5 * t; }, "growing load")});
  const Grid<2> grid = column_grid<2>(10, 0.0);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  run_to(soil, 1.0, 0.05);
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.stress[2][p], -2e5, 200.0);
    const double largest = -points.stress[2][p], smallest = -points.stress[0][p];
    const double ratio = std::tan((45.0 + 12.5) * std::numbers::pi / 180.0);
    EXPECT_LE(largest, smallest * ratio * ratio + 2.0 * law.cohesion * ratio + 1.0);
  }
}

// A strip load that takes half an hour to come: in the first steps, of 1e-3 s, ground of 200 MPa
// carries hundredths of a pascal, and the digits of 1 + strain are all that its stress has.
TEST(Implicit, StiffGroundTakesALoadThatGrowsSlowlyFromNothing) {
  const Grid<2> grid = soil_runs::make_grid<2>({20, 20}, 0.5, "ssno", 0.0, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {11, 11, 9.0}, false);
  options.bodies[0].law = LinearElasticOptions{2e8, 0.3};
  options.method = TimeMethod::implicit_steps;
  options.loads.push_back(
      {"strip", Varying([](const Point3& x,
                           double t) { return x[0] < 1.0 ? 2e4 * std::min(1.0, t / 1800.0) : 0.0; },
                        "ramp")});
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const int steps = run_to(soil, 1800.0, 1e9);
  EXPECT_LT(steps, 100);
  // All of the load arrives at the foot.
  double foot = 0.0, all = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    if (points.start[1][p] < 0.5) foot -= 0.5 * points.stress[2][p] * 0.25;
  MPI_Allreduce(&foot, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_NEAR(all, 2e4, 0.02 * 2e4);
}

}  // namespace
}  // namespace mudlark

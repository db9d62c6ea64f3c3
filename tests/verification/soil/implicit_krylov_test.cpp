// ranks: 1 3
// Implicit steps by Krylov iterations: the direct solver's answer, in a number of iterations that
// neither the grid, nor permeability, nor the stiffness of water moves much.
#include <gtest/gtest.h>

#include <cstdio>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

/// Wet soil under a strip load, level or with a slope.
template <int D>
SoilOptions strip(double conductivity, double water_modulus, bool slope, LinearSolver solver) {
  SoilOptions soil = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, D == 2 ? 9.0 : 1.0}, true);
  if (slope)
    soil.bodies[0].shape.form = BelowShape{{{{0.0, 1.0}}, {{0.35, 1.0}}, {{1.0, 0.45}}}};
  else
    soil.bodies[0].shape.form = BoxShape{{-1, -1, -1}, {9, 9, 1.0}};
  soil.bodies[0].intrinsic_permeability = conductivity * 1.002e-3 / 9810.0;
  soil.water_bulk_modulus = water_modulus;
  soil.method = TimeMethod::implicit_steps;
  soil.step_tolerance = 1.0;
  soil.linear_solver = solver;
  soil.loads.push_back(
      {"q", Varying([](const Point3& x, double) { return x[0] < 0.3 ? 1000.0 : 0.0; }, "strip")});
  return soil;
}

template <int D>
Grid<D> box(int cells) {
  const int high = std::max(cells + cells / 4, 9);  // three ranks share it
  return soil_runs::make_grid<D>({cells, D == 2 ? high : cells, high}, 1.0 / cells,
                                 D == 2 ? "ssno" : "ssssno", 9.81, MPI_COMM_WORLD);
}

/// Sums of settlement and of pore pressure over all points.
template <int D>
std::array<double, 2> sums(const SoilSolver<D>& soil) {
  std::array<double, 2> mine{}, all{};
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    mine[0] += points.start[D - 1][p] - points.position[D - 1][p];
    mine[1] += points.pore_pressure[p];
  }
  MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

template <int D>
void expect_same_as_direct(int cells, bool slope) {
  const Grid<D> grid = box<D>(cells);
  std::array<std::array<double, 2>, 2> all;
  for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative}) {
    SoilSolver<D> soil(grid, strip<D>(1e-6, 2e9, slope, solver));
    soil.initialise();
    for (int step = 0; step < 2; ++step) {
      soil.begin_step(10.0 * step, 10.0, nullptr);
      soil.advance(10.0);
    }
    all[solver == LinearSolver::direct ? 0 : 1] = sums(soil);
  }
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(all[1][i], all[0][i], 1e-6 * std::abs(all[0][i])) << D << "D, sum " << i;
}

TEST(ImplicitKrylov, GivesTheAnswerOfTheDirectSolver) {
  expect_same_as_direct<2>(13, true);
  expect_same_as_direct<3>(6, false);
}

template <int D>
double iterations_per_solve(int cells, double conductivity, double water_modulus, bool slope) {
  const Grid<D> grid = box<D>(cells);
  SoilSolver<D> soil(grid, strip<D>(conductivity, water_modulus, slope, LinearSolver::iterative));
  soil.initialise();
  soil.begin_step(0.0, 10.0, nullptr);
  soil.advance(10.0);
  const auto& effort = soil.implicit_effort();
  EXPECT_EQ(effort.steps, 1);
  EXPECT_EQ(effort.repeated, 0);
  EXPECT_GT(effort.linear_iterations, 2 * effort.newton_iterations) << "a direct solver's count";
  return static_cast<double>(effort.linear_iterations) /
         static_cast<double>(effort.newton_iterations);
}

TEST(ImplicitKrylov, NeedsNoMoreIterationsOnFinerGrids) {
  for (const bool slope : {false, true}) {
    const double coarse = iterations_per_solve<2>(12, 1e-6, 2e9, slope);
    const double fine = iterations_per_solve<2>(48, 1e-6, 2e9, slope);
    std::printf("iterations per linear system, %s: %.1f and %.1f with a quarter of the cell size\n",
                slope ? "slope" : "block", coarse, fine);
    EXPECT_LT(fine, 1.3 * coarse + 3.0);
    EXPECT_LT(fine, 40.0);
  }
  EXPECT_LT(iterations_per_solve<3>(7, 1e-6, 2e9, true), 40.0);
}

TEST(ImplicitKrylov, HoldsForAnyPermeabilityAndAnyWater) {
  for (const double conductivity : {1e-2, 1e-5, 1e-7, 1e-10})
    for (const double modulus : {1e7, 1e15}) {
      const double count = iterations_per_solve<2>(20, conductivity, modulus, true);
      std::printf("k = %.0e m/s, K_w = %.0e Pa: %.1f iterations\n", conductivity, modulus, count);
      EXPECT_LT(count, 40.0) << conductivity << ' ' << modulus;
    }
}

}  // namespace
}  // namespace mudlark

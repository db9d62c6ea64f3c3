// ranks: 1 3
// A layer under a load that varies along it, in the plane and in space: water flows sideways too,
// and pressure rises before it falls (Mandel 1953, Cryer 1963).
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "verification/soil/layer_consolidation.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

constexpr double young = 1e6, poisson = 0.2, conductivity = 1e-7, load = 1000.0;
constexpr double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
constexpr double shear = young / (2 * (1 + poisson));
constexpr double consolidation = conductivity * (lambda + 2 * shear) / 9810.0;

/// q/2 (1 + cos(pi x) cos(pi y)) on a layer of 1 m x 1 m x 1 m (in the plane without y).
template <int D>
SoilOptions layer(LinearSolver solver) {
  SoilOptions soil = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 1.0}, true);
  SoilBody& body = soil.bodies[0];
  body.law = LinearElasticOptions{young, poisson};
  body.strain = StrainMeasure::small;
  body.intrinsic_permeability = conductivity * 1.002e-3 / 9810.0;
  soil.water_bulk_modulus = 1e12;
  soil.method = TimeMethod::implicit_steps;
  soil.step_tolerance = 1.0;  // the steps are given
  soil.linear_solver = solver;
  soil.loads.push_back(
      {"q", Varying(
                [](const Point3& x, double) {
                  const double across = D == 2 ? 1.0 : std::cos(std::numbers::pi * x[1]);
                  return 0.5 * load * (1.0 + std::cos(std::numbers::pi * x[0]) * across);
                },
                "wavy load")});
  return soil;
}

struct Errors {
  double pressure = 0.0, way = 0.0;  ///< root mean square over the points, of q and of the mean way
};

/// Runs to time factor T = c t / H^2 in steps that grow by a fifth.
template <int D>
Errors run_layer(int cells, double time_factor, LinearSolver solver) {
  const Grid<D> grid =
      soil_runs::make_grid<D>({cells, D == 2 ? cells + 5 : cells, cells + 5}, 1.0 / cells,
                              D == 2 ? "ssso" : "ssssso", 0.0, MPI_COMM_WORLD);
  SoilSolver<D> soil(grid, layer<D>(solver));
  soil.initialise();
  const double end = time_factor / consolidation;
  double time = 0.0;
  for (double dt = 1e-4 * end; time < end * (1 - 1e-12); dt *= 1.2) {
    const double step = std::min(dt, end - time);
    soil.begin_step(time, step, nullptr);
    soil.advance(step);
    time += step;
  }
  const LayerConsolidation exact(lambda, shear, consolidation, 1.0);
  const double wave_number = std::numbers::pi * (D == 2 ? 1.0 : std::sqrt(2.0));
  const auto& points = soil.points(0);
  std::array<double, 4> mine{}, all{};
  for (std::size_t p = 0; p < points.size(); ++p) {
    double form = std::cos(std::numbers::pi * points.start[0][p]);
    if (D == 3) form *= std::cos(std::numbers::pi * points.start[1][p]);
    const double z = points.start[D - 1][p];
    const auto even = exact(0.0, z, end), wavy = exact(wave_number, z, end);
    const double pressure = 0.5 * load * (even.pressure + form * wavy.pressure);
    const double way = 0.5 * load * (even.way + form * wavy.way);
    mine[0] += std::pow(points.pore_pressure[p] - pressure, 2);
    mine[1] += std::pow(points.position[D - 1][p] - z - way, 2);
    mine[2] += way * way;
    mine[3] += 1.0;
  }
  MPI_Allreduce(mine.data(), all.data(), 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return {std::sqrt(all[0] / all[3]) / load, std::sqrt(all[1] / all[2])};
}

// A long wave leaves the layer free to spread: undrained plane strain with half the load in the
// water, at the end w = q H (1 - nu^2)/E.
TEST(Layer, ExactSolutionHasItsLimits) {
  const LayerConsolidation exact(lambda, shear, consolidation, 1.0);
  // Terzaghi: p at the base is 0.7723 q at T = 0.2.
  EXPECT_NEAR(exact(0.0, 0.0, 0.2 / consolidation).pressure, 0.7723, 1e-3);
  EXPECT_NEAR(exact(1e-2, 0.0, 1e-3 / consolidation).pressure, 0.5, 1e-2);
  EXPECT_NEAR(exact(1e-2, 1.0, 1e3 / consolidation).way, -(1 - poisson * poisson) / young,
              2e-3 / young);
}

template <int D>
void expect_exact(const std::vector<int>& sizes, double pressure_bound, double way_bound) {
  Errors last;
  for (const int size : sizes) {
    const Errors errors = run_layer<D>(size, 0.1, LinearSolver::iterative);
    std::printf("%dD, %d cells, T = 0.1: pressure %.2e q, settlement %.2e\n", D, size,
                errors.pressure, errors.way);
    if (size > sizes.front()) {  // a grid of half the cell size
      EXPECT_LT(errors.way, 0.6 * last.way);
      EXPECT_LT(errors.pressure, 0.6 * last.pressure);
    }
    last = errors;
  }
  EXPECT_LT(last.pressure, pressure_bound);
  EXPECT_LT(last.way, way_bound);
}

TEST(Layer, ConsolidatesUnderAWavyLoadInThePlane) { expect_exact<2>({9, 18}, 0.008, 0.015); }
TEST(Layer, ConsolidatesUnderAWavyLoadInSpace) { expect_exact<3>({4}, 0.03, 0.12); }

}  // namespace
}  // namespace mudlark

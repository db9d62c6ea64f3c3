// ranks: 1 3
// Pore water at the sides of the domain, explicit steps: pressures, seepage faces, inflow.
#include <gtest/gtest.h>

#include <cstdio>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

constexpr double viscosity = 1.002e-3;

SoilBoundary water_side(int axis, int side, WaterSide kind, Varying value) {
  SoilBoundary boundary;
  boundary.name = std::to_string(axis) + std::to_string(side);
  boundary.axis = axis, boundary.side = side;
  boundary.for_water = true;
  boundary.water = kind;
  boundary.value = std::move(value);
  return boundary;
}

/// Stiff, permeable soil that fills the domain.
SoilOptions filled(int dimension, double conductivity) {
  SoilOptions options = make_soil(dimension, {-9, -9, -9}, {9, 9, 9}, true);
  options.bodies[0].intrinsic_permeability = conductivity * viscosity / 9810.0;
  options.bodies[0].law = LinearElasticOptions{2e7, 0.2};
  return options;
}

template <int D>
double worst_pressure(const SoilSolver<D>& soil, int axis, double at_zero, double slope) {
  double worst = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    worst = std::max(
        worst, std::abs(points.pore_pressure[p] - at_zero - slope * points.position[axis][p]));
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return worst;
}

// Darcy: q = k (p_1 - p_2) / (rho g L), the pressure linear from side to side.
template <int D>
void expect_darcy(int axis, Kernel kernel, Transfer transfer) {
  const double h = 0.1, conductivity = 0.01;
  std::array<int, 3> cells{3, 3, 3};
  cells[static_cast<std::size_t>(axis)] = 10;
  const Grid<D> grid = make_grid<D>(cells, h, D == 2 ? "ssss" : "ssssss", 0.0, MPI_COMM_WORLD);
  SoilOptions options = filled(D, conductivity);
  options.kernel = kernel, options.transfer = transfer;
  options.boundaries.push_back(water_side(axis, 0, WaterSide::pressure, Varying(2000.0)));
  options.boundaries.push_back(water_side(axis, 1, WaterSide::pressure, Varying(500.0)));
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  const double dt = soil.stable_step();
  run(soil, time, static_cast<int>(0.15 / dt), dt);
  if (grid.ranks() == 1 && D == 2 && axis == 0 && kernel == Kernel::composite) {
    const auto& q = soil.points(0);
    for (std::size_t p = 0; p < q.size(); ++p)
      if (std::abs(q.start[1][p] - 0.125) < 0.01)
        std::printf("%.4f %.4f %.3f %.3f v %.3e w %.3e\n", q.start[0][p], q.position[0][p],
                    q.pore_pressure[p], 2000 - 1500 * q.position[0][p], q.velocity[0][p],
                    q.water_velocity[0][p]);
  }
  const double area = D == 2 ? 3 * h : 9 * h * h;
  const double exact = conductivity * 1500.0 / 9810.0 * area;
  const double in = soil.discharge(options.boundaries[0].name),
               out = soil.discharge(options.boundaries[1].name);
  const double worst = worst_pressure(soil, axis, 2000.0, -1500.0);
  std::printf("%dD axis %d kernel %d: in %.4e, out %.4e, exact %.4e; pressure off by %.2e Pa\n", D,
              axis, static_cast<int>(kernel), -in, out, exact, worst);
  EXPECT_NEAR(-in, exact, 1e-3 * exact);
  EXPECT_NEAR(out, exact, 1e-3 * exact);
  EXPECT_LT(worst, 1e-3 * 1500.0);
}

TEST(SideWater, BetweenTwoPressuresFlowsByDarcysLaw) {
  expect_darcy<2>(0, Kernel::composite, Transfer::flip);
  expect_darcy<2>(1, Kernel::composite, Transfer::apic);
  expect_darcy<2>(0, Kernel::quadratic, Transfer::flip);
  expect_darcy<3>(1, Kernel::composite, Transfer::flip);
}

}  // namespace
}  // namespace mudlark

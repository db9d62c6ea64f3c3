// ranks: 1 3
// Sides of the domain in implicit steps: given displacements, pressures, inflow, seepage faces.
#include <gtest/gtest.h>

#include <cstdio>

#include "verification/soil/side_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

/// Soil that fills the domain, in implicit steps.
SoilOptions slowly_filled(int dimension, double conductivity) {
  SoilOptions options = filled(dimension, conductivity);
  options.method = TimeMethod::implicit_steps;
  options.step_tolerance = 1e-2;
  return options;
}

template <int D>
void run_to(SoilSolver<D>& soil, double end) {
  double time = 0.0;
  while (time < end) {
    const double dt = std::min(soil.outer_step(), end - time);
    soil.begin_step(time, dt, nullptr);
    soil.advance(dt);
    time += dt;
  }
}

// Darcy: q = k (p_1 - p_2) / (rho g L), the pressure linear from side to side.
template <int D>
void expect_darcy(int axis, Kernel kernel) {
  const double h = 0.1, conductivity = 1e-5;
  std::array<int, 3> cells{3, 3, 3};
  cells[static_cast<std::size_t>(axis)] = 9;
  const Grid<D> grid = make_grid<D>(cells, h, D == 2 ? "ssss" : "ssssss", 0.0, MPI_COMM_WORLD);
  SoilOptions options = slowly_filled(D, conductivity);
  options.kernel = kernel;
  options.boundaries.push_back(water_side(axis, 0, WaterSide::pressure, Varying(2000.0)));
  options.boundaries.push_back(water_side(axis, 1, WaterSide::pressure, Varying(500.0)));
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  run_to(soil, 400.0);  // ten times L^2 over the coefficient of consolidation
  const double area = D == 2 ? 3 * h : 9 * h * h;
  const double exact = conductivity * 1500.0 / (0.9 * 9810.0) * area;
  const double in = soil.discharge(options.boundaries[0].name),
               out = soil.discharge(options.boundaries[1].name);
  const double worst = worst_pressure(soil, axis, 2000.0, -1500.0 / 0.9);
  std::printf("%dD axis %d kernel %d: in %.5e, out %.5e, exact %.5e; pressure off by %.2e Pa\n", D,
              axis, static_cast<int>(kernel), -in, out, exact, worst);
  EXPECT_NEAR(-in, exact, 1e-3 * exact);
  EXPECT_NEAR(out, exact, 1e-3 * exact);
  EXPECT_LT(worst, 1e-3 * 1500.0);
}
TEST(ImplicitSides, LetWaterFlowByDarcysLaw) {
  expect_darcy<2>(0, Kernel::composite);
  expect_darcy<2>(1, Kernel::quadratic);
  expect_darcy<3>(1, Kernel::composite);
}

// Water that stands does not flow, whichever sides hold its level.
template <int D>
void expect_standing(const std::vector<std::array<int, 2>>& sides) {
  const double level = 2.0;
  const Grid<D> grid =
      make_grid<D>({6, D == 2 ? 9 : 3, 9}, 0.1, D == 2 ? "ssss" : "ssssss", 9.81, MPI_COMM_WORLD);
  SoilOptions options = slowly_filled(D, 1e-3);
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].initial_pore_pressure =
      Varying([=](const Point3&, double) { return 9810.0 * (level - 0.9); }, "level");
  for (const auto& [axis, side] : sides) {
    options.boundaries.push_back(water_side(axis, side, WaterSide::pressure, Varying(level)));
    options.boundaries.back().is_head = true;
  }
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  run_to(soil, 10.0);
  EXPECT_LT(worst_pressure(soil, D - 1, 9810.0 * level, -9810.0),
            0.1 * 981.0);  // of a cell's weight: closed sides have images without weight
  for (const SoilBoundary& boundary : options.boundaries)
    // Of the flow under a gradient of one: the level of the points nearest to a side is not quite
    // that of its cells.
    EXPECT_NEAR(soil.discharge(boundary.name), 0.0, 1e-2 * 1e-3 * (D == 2 ? 0.6 : 0.18));
}
TEST(ImplicitSides, LetWaterRestThatStandsAtOneLevel) {
  expect_standing<2>({{1, 0}});
  expect_standing<2>({{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  expect_standing<3>({{0, 0}, {1, 1}, {2, 0}});
}

TEST(ImplicitSides, TakeAnInflowAndLetItOutThroughASeepageFace) {
  const double conductivity = 1e-4;
  for (const double inflow : {1e-5, -1e-5}) {
    const Grid<2> grid = make_grid<2>({10, 3, 1}, 0.1, "ssss", 0.0, MPI_COMM_WORLD);
    SoilOptions options = slowly_filled(2, conductivity);
    options.boundaries.push_back(water_side(0, 1, WaterSide::inflow, Varying(inflow)));
    options.boundaries.push_back(water_side(0, 0, WaterSide::seepage_face, Varying(0.0)));
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    run_to(soil, inflow > 0.0 ? 1000.0 : 10.0);
    EXPECT_NEAR(soil.discharge("01"), -inflow * 0.3, 1e-12);
    EXPECT_NEAR(soil.discharge("00"), inflow > 0.0 ? inflow * 0.3 : 0.0, 1e-9);
    if (inflow < 0.0) continue;  // what is drawn out does not come in again
    const double slope = inflow * 9810.0 / conductivity;
    EXPECT_LT(worst_pressure(soil, 0, 0.0, slope), 0.15 * slope * 0.1);
  }
}

// Terzaghi with drainage through the base as well: at T = 0.2 of half the height U = 0.504, and the
// pressure in the middle is 0.7723 of the undrained one.
TEST(ImplicitSides, DrainAColumnFromItsBase) {
  const int cells = 20;
  const double conductivity = 1e-7, load = 100.0;
  const Grid<2> grid = make_grid<2>({3, cells + 2, 1}, 1.0 / cells, "ssso", 0.0, MPI_COMM_WORLD);
  SoilOptions options = slowly_filled(2, conductivity);
  options.step_tolerance = 3e-4;
  options.bodies[0].shape.form = BoxShape{{-9, -9, -9}, {9, 9, 1.0}};
  options.bodies[0].law = LinearElasticOptions{1e6, 0.3};
  options.bodies[0].strain = StrainMeasure::small;
  options.loads.push_back({"q", Varying(load)});
  options.boundaries.push_back(water_side(1, 0, WaterSide::pressure, Varying(0.0)));
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double modulus = constrained_modulus(1e6, 0.3), storage = 1.0 / modulus + 0.4 / 2e7;
  run_to(soil, 0.2 * 0.25 * 9810.0 * storage / conductivity);
  const double undrained = load / modulus / storage;
  std::array<double, 4> mine{}, all{};
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (std::abs(points.start[1][p] - 0.5) < 0.03) mine[0] += points.pore_pressure[p], mine[1] += 1;
    if (points.start[1][p] > 1.0 - 0.5 / cells)
      mine[2] += points.start[1][p] - points.position[1][p], mine[3] += 1.0;
  }
  MPI_Allreduce(mine.data(), all.data(), 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  // Of the uppermost points, a quarter of a cell below the surface; all has drained there.
  const double settlement =
      load / modulus * (1.0 - undrained / load * (1.0 - 0.5041) - 0.25 / cells);
  std::printf("middle %.4f of the undrained pressure (0.7723), settlement %.4e m (%.4e)\n",
              all[0] / all[1] / undrained, all[2] / all[3], settlement);
  EXPECT_NEAR(all[0] / all[1], 0.7723 * undrained, 0.01 * undrained);
  EXPECT_NEAR(all[2] / all[3], settlement, 0.015 * load / modulus);
}

// A side is moved in by a thousandth of a cell (its wall stays): the strain is uniform, the
// reaction that of Hooke's law.
template <int D>
void expect_uniform_strain() {
  const Grid<D> grid =
      make_grid<D>({12, 3, 3}, 0.1, D == 2 ? "sspp" : "sspppp", 0.0, MPI_COMM_WORLD);
  SoilOptions options = make_soil(D, {-9, -9, -9}, {9, 9, 9}, false);
  options.bodies[0].law = LinearElasticOptions{1e7, 0.0};
  options.bodies[0].strain = StrainMeasure::small;
  options.method = TimeMethod::implicit_steps;
  SoilBoundary side = side_of(0, 1);
  side.for_grains = true;
  side.grains = GrainSide::moving;
  side.motion_is_displacement = true;
  side.motion[0] = Varying([](const Point3&, double t) { return -1e-4 * t; }, "pushed");
  side.motion[2] = Varying([](const Point3&, double t) { return 2e-4 * t; }, "sheared");
  SoilBoundary base = side_of(0, 0);
  base.for_grains = true;
  base.grains = GrainSide::fixed;
  options.boundaries = {side, base};
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  run_to(soil, 1.0);
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.stress[0][p], -1e7 * 1e-4 / 1.2, 3e-3 * 1e7 * 1e-4 / 1.2);
    EXPECT_NEAR(points.stress[5][p], 0.5e7 * 2e-4 / 1.2, 3e-3 * 0.5e7 * 2e-4 / 1.2);
  }
}
TEST(ImplicitSides, MoveSoilAsGiven) {
  expect_uniform_strain<2>();
  expect_uniform_strain<3>();
}

}  // namespace
}  // namespace mudlark

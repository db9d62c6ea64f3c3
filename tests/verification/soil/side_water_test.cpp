// ranks: 1 3
// Pore water at the sides of the domain, explicit steps: pressures, seepage faces, inflow.
#include <gtest/gtest.h>

#include <cstdio>

#include "verification/soil/side_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

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

/// A domain full of soil under its weight whose water stands to a level.
SoilOptions standing(int dimension, double level) {
  SoilOptions options = filled(dimension, 1e-3);
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].initial_pore_pressure =
      Varying([=](const Point3&, double) { return 9810.0 * (level - 0.8); }, "level");
  return options;
}

// Water that stands does not flow, whichever sides hold its level.
template <int D>
void expect_standing(const std::vector<std::array<int, 2>>& sides) {
  const double level = 2.0;
  const Grid<D> grid =
      make_grid<D>({9, D == 2 ? 8 : 3, 8}, 0.1, D == 2 ? "ssss" : "ssssss", 9.81, MPI_COMM_WORLD);
  SoilOptions options = standing(D, level);
  for (const auto& [axis, side] : sides) {
    options.boundaries.push_back(water_side(axis, side, WaterSide::pressure, Varying(level)));
    options.boundaries.back().is_head = true;
  }
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  run(soil, time, 200, soil.stable_step());
  // Closed sides have images without weight: that alone is 30 Pa, 3 % of a cell's weight of water.
  EXPECT_LT(worst_pressure(soil, D - 1, 9810.0 * level, -9810.0), 60.0);
  for (const SoilBoundary& boundary : options.boundaries)
    EXPECT_NEAR(soil.discharge(boundary.name), 0.0, 1e-3 * 1e-3 * (D == 2 ? 0.9 : 0.27));
}
TEST(SideWater, ThatStandsAtOneLevelRests) {
  expect_standing<2>({{1, 0}});
  expect_standing<2>({{0, 0}, {1, 1}});
  expect_standing<2>({{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  expect_standing<3>({{0, 0}, {1, 1}, {2, 0}});
}

// A given inflow on one side, a pressure on the other: p(0) = q rho g L / k.
TEST(SideWater, FlowsInAsGiven) {
  const double conductivity = 0.01, inflow = 1e-4;
  const Grid<2> grid = make_grid<2>({10, 3, 1}, 0.1, "ssss", 0.0, MPI_COMM_WORLD);
  SoilOptions options = filled(2, conductivity);
  options.boundaries.push_back(water_side(
      0, 1, WaterSide::inflow,
      Varying([=](const Point3&, double t) { return inflow * std::min(1.0, t / 0.1); }, "rain")));
  options.boundaries.push_back(water_side(0, 0, WaterSide::pressure, Varying(0.0)));
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  const double dt = soil.stable_step();
  run(soil, time, static_cast<int>(0.5 / dt), dt);
  const double slope = inflow * 9810.0 / conductivity;
  EXPECT_LT(worst_pressure(soil, 0, 0.0, slope), 0.15 * slope * 0.1);  // a part of a cell
  EXPECT_NEAR(soil.discharge("01"), -inflow * 0.3, 1e-12);
  EXPECT_NEAR(soil.discharge("00"), inflow * 0.3, 1e-3 * inflow * 0.3);
}

// Water leaves through a seepage face as through a drain; where it would come in, nothing flows.
TEST(SideWater, LeavesThroughASeepageFaceAndDoesNotComeBack) {
  const double conductivity = 0.01;
  for (const double pressure : {1000.0, -1000.0}) {
    const Grid<2> grid = make_grid<2>({10, 3, 1}, 0.1, "ssss", 0.0, MPI_COMM_WORLD);
    SoilOptions options = filled(2, conductivity);
    options.boundaries.push_back(water_side(0, 0, WaterSide::pressure, Varying(pressure)));
    options.boundaries.push_back(water_side(0, 1, WaterSide::seepage_face, Varying(0.0)));
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    double time = 0.0;
    const double dt = soil.stable_step();
    run(soil, time, static_cast<int>(0.8 / dt), dt);
    const double exact = pressure > 0.0 ? conductivity * pressure / 9810.0 * 0.3 : 0.0;
    EXPECT_NEAR(soil.discharge("01"), exact, 1e-3 * conductivity * 0.03);
    EXPECT_LT(worst_pressure(soil, 0, pressure, pressure > 0.0 ? -pressure : 0.0), 2.0);
  }
}

// A slope of water behind a seepage face: it leaves below the level and not above.
TEST(SideWater, FindsTheExitPointOfASeepageFace) {
  const Grid<2> grid = make_grid<2>({10, 10, 1}, 0.1, "ssss", 9.81, MPI_COMM_WORLD);
  SoilOptions options = filled(2, 0.01);
  SoilBoundary head = water_side(0, 0, WaterSide::pressure, Varying(0.65));
  head.is_head = true;
  head.to[2] = 0.6;
  options.boundaries.push_back(head);
  for (const double height : {0.0, 0.4, 0.6}) {
    SoilBoundary face = water_side(0, 1, WaterSide::seepage_face, Varying(0.0));
    face.name = "from " + std::to_string(height);
    face.from[2] = height;
    if (!options.boundaries.back().name.starts_with("00")) options.boundaries.back().to[2] = height;
    options.boundaries.push_back(face);
  }
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].initial_pore_pressure =
      Varying([](const Point3&, double) { return 9810.0 * (0.65 - 1.0); }, "level");
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  const double dt = soil.stable_step();
  run(soil, time, static_cast<int>(0.8 / dt), dt);
  std::array<double, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = soil.discharge(options.boundaries[k + 1].name);
  const double in = -soil.discharge("00");
  std::printf("in %.4e, out %.4e below 0.4 m, %.4e below 0.6 m, %.4e above\n", in, out[0], out[1],
              out[2]);
  EXPECT_GT(out[0], 0.9 * in);
  EXPECT_EQ(out[2], 0.0);
  EXPECT_NEAR(out[0] + out[1], in, 0.01 * in);
}

// Terzaghi with drainage at both ends: at T = 0.2 of half the height U = 0.504.
TEST(SideWater, DrainsAColumnFromItsBase) {
  const int cells = 20;
  const double conductivity = 1e-3, load = 100.0;
  const Grid<2> grid = make_grid<2>({3, cells + 2, 1}, 1.0 / cells, "ssso", 0.0, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {-9, -9, -9}, {9, 9, 1.0}, true);
  options.bodies[0].intrinsic_permeability = conductivity * viscosity / 9810.0;
  options.bodies[0].strain = StrainMeasure::small;
  options.loads.push_back(
      {"q", Varying([=](const Point3&, double t) { return load * std::min(1.0, t / 0.04); }, "q")});
  options.boundaries.push_back(water_side(1, 0, WaterSide::pressure, Varying(0.0)));
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double modulus = constrained_modulus(1e6, 0.3), storage = 1.0 / modulus + 0.4 / 2e7;
  const double end = 0.2 * 0.25 * 9810.0 * storage / conductivity + 0.02;
  const int steps = static_cast<int>(std::ceil(end / soil.stable_step()));
  double time = 0.0;
  run(soil, time, steps, end / steps);
  // Middle: 0.772 of the undrained pressure; symmetric.
  const double undrained = load / modulus / storage;
  std::array<double, 3> sum{}, count{}, all{}, counts{};
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double z = points.start[1][p];
    const std::size_t k = std::abs(z - 0.25) < 0.03 ? 0 : std::abs(z - 0.5) < 0.03 ? 1 : 2;
    if (k == 2 && std::abs(z - 0.75) > 0.03) continue;
    sum[k] += points.pore_pressure[p], count[k] += 1.0;
  }
  MPI_Allreduce(sum.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(count.data(), counts.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  std::printf("pressure %.4f %.4f %.4f of the undrained one (0.5509, 0.7723)\n",
              all[0] / counts[0] / undrained, all[1] / counts[1] / undrained,
              all[2] / counts[2] / undrained);
  EXPECT_NEAR(all[1] / counts[1], 0.7723 * undrained, 0.015 * undrained);
  EXPECT_NEAR(all[0] / counts[0], all[2] / counts[2], 0.02 * undrained);
}

}  // namespace
}  // namespace mudlark

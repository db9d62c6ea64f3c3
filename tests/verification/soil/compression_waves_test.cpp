// ranks: 1 3
// Table 2 of the paper: waves in a saturated column. Figures of the exact modal solution of Biot's
// (1956) equations by python/mudlark/reference/compression_waves.py.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

constexpr double height = 0.1, load = 1000.0, slow_period = 2.744724387e-3;

SoilOptions column(double conductivity, LoadedPhase on) {
  SoilOptions soil = soil_runs::make_soil(2, {-1, -1, -1}, {1, 1, height}, true);
  SoilBody& body = soil.bodies[0];
  body.intrinsic_permeability = conductivity * 1.002e-3 / 9810.0;
  body.law = LinearElasticOptions{1e9, 0.35};
  body.strain = StrainMeasure::small;
  soil.water_bulk_modulus = 2.15e7;
  soil.flip_fraction = 1.0;
  const double ramp = 0.5 * slow_period;
  soil.loads.push_back(
      {"q",
       Varying(
           [ramp](const Point3&, double t) {
             return t < ramp ? 0.5 * load * (1.0 - std::cos(std::numbers::pi * t / ramp)) : load;
           },
           "half cosine"),
       on});
  return soil;
}

/// Pore pressure [Pa] at mid-height, linear between the rows of points around it.
double pressure_at_middle(const SoilSolver<2>& soil) {
  const auto& points = soil.points(0);
  double sum = 0.0, count = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (std::abs(points.start[1][p] - 0.5 * height) < 0.26 * height / 40)
      sum += points.pore_pressure[p], count += 1.0;
  std::array<double, 2> mine{sum, count}, all{};
  MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all[0] / all[1];
}

void expect_pressures(double conductivity, LoadedPhase on, const std::array<double, 3>& exact) {
  const double h = height / 40;
  const Grid<2> grid = soil_runs::make_grid<2>({2, 44, 1}, h, "ssso", 0.0, MPI_COMM_WORLD);
  SoilSolver<2> soil(grid, column(conductivity, on));
  soil.initialise();
  double time = 0.0;
  const std::array<double, 3> at{0.4, 0.8, 1.3};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double left = at[i] * slow_period - time;
    const int steps = static_cast<int>(std::ceil(left / soil.stable_step()));
    soil_runs::run(soil, time, steps, left / steps);
    const double pressure = pressure_at_middle(soil);
    std::printf("k = %g: p = %.2f Pa, exact %.2f Pa\n", conductivity, pressure, exact[i]);
    EXPECT_NEAR(pressure, exact[i], 0.01 * load);
  }
}

TEST(CompressionWaves, SwingInHighlyPermeableSoilUnderWater) {
  expect_pressures(1e-1, LoadedPhase::water, {584.62, 1647.60, 369.85});
}
TEST(CompressionWaves, HardlySwingInLessPermeableSoilUnderWater) {
  expect_pressures(1e-3, LoadedPhase::water, {350.64, 910.85, 1002.28});
}
TEST(CompressionWaves, LeaveLittlePressureUnderALoadOnTheGrains) {
  expect_pressures(1e-1, LoadedPhase::skeleton, {6.89, -13.36, 12.99});
}
TEST(CompressionWaves, CreepIntoDenseSoilUnderWater) {
  expect_pressures(1e-5, LoadedPhase::water, {29.22, 33.15, 37.25});
}

/// The block wave of Verruijt (2010), An Introduction to Soil Dynamics, and of the Anura3D
/// verification manual (2021), 2.2: 2 kPa of water pressure at once. After 40 ms the undrained wave
/// (13.8 m/s) has come back from the base, and the damped one (3.24 m/s) is between the places
/// asked. sigma' [Pa] of the exact modal solution; the manual prints -733.52 at x = 0.40025.
TEST(CompressionWaves, OfABlockOfWaterPressureTravelAtTwoSpeeds) {
  constexpr double tall = 0.5, h = tall / 320;
  const Grid<2> grid = soil_runs::make_grid<2>({2, 324, 1}, h, "ssso", 0.0, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {1, 1, tall}, true);
  SoilBody& body = options.bodies[0];
  body.porosity = 0.1, body.grain_density = 2222.0, body.intrinsic_permeability = 1e-9;
  body.law = LinearElasticOptions{180e3, 0.2};
  body.strain = StrainMeasure::small;
  options.water_bulk_modulus = 20e3, options.water_viscosity = 1e-3;
  constexpr double less = 1e-3;  // a thousandth of the load: the solution is that of small strains
  options.loads.push_back({"block", Varying(less * 2000.0), LoadedPhase::water});
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  const int steps = static_cast<int>(std::ceil(0.04 / soil.stable_step()));
  soil_runs::run(soil, time, steps, 0.04 / steps);
  constexpr std::array<double, 5> height_of{0.2, 0.3, 0.40025, 0.42, 0.45},
      exact{-999.98, -1000.0, -733.4, -614.35, -403.00};
  const auto& points = soil.points(0);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    std::array<double, 2> mine{}, all{};  // linear between the rows of points around the place
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double weight = 1.0 - std::abs(points.start[1][p] - height_of[i]) / (0.5 * h);
      if (weight > 0.0) mine[0] += weight * points.stress[2][p], mine[1] += weight;
    }
    MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const double stress = all[0] / all[1] / less;
    std::printf("x = %g m: %.1f Pa, exact %.1f Pa\n", height_of[i], stress, exact[i]);
    EXPECT_NEAR(stress, exact[i], 0.03 * std::abs(exact[i]));
  }
}

}  // namespace
}  // namespace mudlark

// The step that the solver calls stable is, and soil at rest rests.
#include <gtest/gtest.h>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

/// Elastic energy [J] of skeleton (linear) and pore water (one-dimensional, small strain).
double potential_energy(const SoilSolver<2>& soil) {
  const auto& points = soil.points(0);
  double sum = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SymTensor stress = get_tensor(points.stress, p);
    const SymTensor strain = soil.law(0).elastic_strain(stress);
    const double work = stress.xx * strain.xx + stress.yy * strain.yy + stress.zz * strain.zz +
                        2.0 * stress.zx * strain.zx;
    sum += 0.5 * points.volume[p] * work;
    const double pressure = points.pore_pressure[p], porosity = 0.4;
    sum +=
        0.5 * points.volume[p] * porosity * pressure * pressure / soil.options().water_bulk_modulus;
  }
  return sum;
}

/// Largest energy of a column set in noisy motion, over the energy at its start.
double energy_growth(Kernel kernel, bool wet, double courant, double permeability, int steps) {
  const int cells = 20;
  const Grid<2> grid = make_grid<2>({2, cells + 4, 1}, 1.0 / cells, "ssso");
  SoilOptions options = make_soil(2, {-1, -1, -1}, {9, 9, 1.0}, wet);
  options.kernel = kernel;
  options.courant = courant;
  options.flip_fraction = 1.0;
  options.bodies[0].intrinsic_permeability = permeability;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  set_velocity(soil, [](int axis, const Vec<2>&, std::int64_t id) {
    return axis == 1 ? 1e-6 * noise(id, axis) : 0.0;
  });
  const double start = soil.totals().kinetic_energy, dt = soil.stable_step();
  double time = 0.0, largest = 0.0;
  for (int block = 0; block < steps / 50; ++block) {
    run(soil, time, 50, dt);
    largest = std::max(largest, (soil.totals().kinetic_energy + potential_energy(soil)) / start);
    if (!(largest < 1e6)) break;
  }
  return largest;
}

/// Largest share of the nominal step at which the kernel is stable, measured: composite splines
/// reach 1, the others less, since their narrower stencils see shorter waves.
double share_of(Kernel kernel) {
  return kernel == Kernel::composite ? 0.95 : kernel == Kernel::quadratic ? 0.8 : 0.65;
}

TEST(StableStep, KeepsTheEnergyOfANoisyColumnForEveryKernel) {
  for (const Kernel kernel : every_kernel)
    for (const bool wet : {false, true})
      EXPECT_LT(energy_growth(kernel, wet, share_of(kernel), 1e-10, 2000), 1.1)
          << "kernel " << static_cast<int>(kernel) << (wet ? " saturated" : " dry");
}

TEST(StableStep, HoldsWhereDragIsNearlyAbsent) {
  for (const Kernel kernel : every_kernel)
    EXPECT_LT(energy_growth(kernel, true, share_of(kernel), 1e-4, 2000), 1.1)
        << static_cast<int>(kernel);
}

/// Noise of a block that flies through the grid, over the noise at its start. (Linear splines fail
/// here: a node that the block's edge barely touches has a stiffness but hardly a mass.)
double noise_in_flight(Kernel kernel, Transfer transfer, bool wet) {
  const Grid<2> grid = make_grid<2>({12, 12, 1}, 0.1, "pppp");
  SoilOptions options = make_soil(2, {0.3, -1, 0.3}, {0.7, 1, 0.7}, wet);
  options.kernel = kernel;
  options.transfer = transfer;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double size = 1e-9;
  set_velocity(soil, [&](int axis, const Vec<2>&, std::int64_t id) {
    return (axis == 0 ? 1.4 : -2.0) + size * noise(id, axis);
  });
  double time = 0.0, largest = 0.0;
  for (int i = 0; i < 16; ++i) {
    run(soil, time, 50, soil.stable_step());
    for (const double v : soil.points(0).velocity[0])
      largest = std::max(largest, std::abs(v - 1.4) / size);
  }
  return largest;
}

TEST(StableStep, LetsTheEdgesOfABlockPassFacesAtTheDefaultCourantNumber) {
  for (const Kernel kernel : {Kernel::quadratic, Kernel::composite})
    for (const Transfer transfer : {Transfer::flip, Transfer::apic})
      for (const bool wet : {false, true})
        EXPECT_LT(noise_in_flight(kernel, transfer, wet), 30.0)
            << static_cast<int>(kernel) << static_cast<int>(transfer) << wet;
}

TEST(StableStep, OfMinuteLengthIsNotNeededForAnyPermeability) {
  for (const double permeability : {1e-9, 1e-13, 1e-16})
    EXPECT_LT(energy_growth(Kernel::composite, true, 0.9, permeability, 2000), 1.1);
}

TEST(StableStep, IsTheTravelTimeOfTheFastestWaveThroughACell) {
  const Grid<2> grid = make_grid<2>({6, 6, 1}, 0.1, "ssso");
  SoilOptions dry = make_soil(2, {-1, -1, -1}, {9, 9, 0.4}, false);
  dry.courant = 1.0;
  SoilSolver<2> soil(grid, dry);
  soil.initialise();
  const double speed = std::sqrt(constrained_modulus(1e6, 0.3) / (0.6 * 2650.0));
  EXPECT_NEAR(soil.stable_step() / (0.1 / speed), 1.0, 1e-12);
  set_velocity(soil, [](int axis, const Vec<2>&, std::int64_t) { return axis == 0 ? 3.0 : 4.0; });
  EXPECT_NEAR(soil.stable_step() / (0.1 / (speed + 5.0)), 1.0, 1e-12);
  SoilOptions bounded = dry;
  bounded.max_step = 1e-6;
  SoilSolver<2> slow(grid, bounded);
  slow.initialise();
  EXPECT_EQ(slow.stable_step(), 1e-6);
  // Saturated without drag: at least the undrained wave.
  SoilOptions wet = make_soil(2, {-1, -1, -1}, {9, 9, 0.4}, true);
  wet.courant = 1.0;
  SoilSolver<2> saturated(grid, wet);
  saturated.initialise();
  const double undrained =
      std::sqrt((constrained_modulus(1e6, 0.3) + 2e7 / 0.4) / (0.6 * 2650.0 + 0.4 * 1000.0));
  EXPECT_LE(saturated.stable_step(), 0.1 / undrained);
}

/// Settlement over that of the submerged weight, gamma' H^2 / (2 E_c).
double settlement_at_rest(Kernel kernel, Transfer transfer, bool wet, double* pressure_error) {
  const int cells = 20;
  const Grid<2> grid = make_grid<2>({3, cells + 4, 1}, 1.0 / cells, "ssso", 9.81);
  SoilOptions options = make_soil(2, {-1, -1, -1}, {9, 9, 1.0}, wet);
  options.kernel = kernel;
  options.transfer = transfer;
  options.bodies[0].initial_stress = GeostaticStress{};
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  run(soil, time, 5000, soil.stable_step());
  const double weight = 0.6 * (wet ? 1650.0 : 2650.0) * 9.81;
  const double elastic = weight / (2.0 * constrained_modulus(1e6, 0.3));
  double worst = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    worst = std::max(worst, std::abs(points.position[1][p] - points.start[1][p]));
    const double exact = 9810.0 * (1.0 - points.position[1][p]);
    if (!wet) continue;
    *pressure_error = std::max(*pressure_error, std::abs(points.pore_pressure[p] - exact) / 9810);
  }
  return worst / elastic;
}

TEST(GeostaticColumn, StaysAtRest) {
  for (const Kernel kernel : every_kernel)
    for (const bool wet : {false, true}) {
      double pressure_error = 0.0;
      const double settled = settlement_at_rest(kernel, Transfer::flip, wet, &pressure_error);
      RecordProperty("settlement_" + std::to_string(static_cast<int>(kernel)) + (wet ? "w" : "d"),
                     std::to_string(settled) + " " + std::to_string(pressure_error));
      EXPECT_LT(settled, 1e-3) << "kernel " << static_cast<int>(kernel) << (wet ? " wet" : " dry");
    }
  double unused = 0.0;
  EXPECT_LT(settlement_at_rest(Kernel::composite, Transfer::apic, true, &unused), 1e-3);
}

TEST(NeutralBed, OfJitteredPointsRestsUnderWaterToRoundOff) {
  const double water_surface = 2.0;
  const Grid<2> grid = make_grid<2>({8, 12, 1}, 0.1, "ssso", 9.81);
  SoilOptions options = make_soil(2, {-1, -1, -1}, {9, 9, 0.7}, true);
  options.bodies[0].grain_density = options.water_density;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  FluidLoad<2> water(grid);
  for (auto* field : {&water.pressure_begin, &water.pressure_end})
    for_each(grid.local(), [&](const Index<2>& cell) {
      (*field)[cell] = 9810.0 * (water_surface - grid.cell_centre(cell)[1]);
    });
  auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int a = 0; a < 2; ++a) points.position[a][p] += 0.02 * noise(points.id[p], a);
  soil.set_pore_pressure(water.pressure_begin);
  double time = 0.0;
  run(soil, time, 1000, soil.stable_step(), &water);
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(points.velocity[a][p], 0.0, 1e-10);
}

}  // namespace
}  // namespace mudlark

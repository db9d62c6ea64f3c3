// Laws of flow in the engine: decay of a shear wave in a liquid of points, the step of viscosity,
// and a column of grains that collapses.
#include <gtest/gtest.h>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

SoilOptions make_liquid(double bulk_modulus, double viscosity) {
  SoilOptions options = make_soil(2, {-9, -9, -9}, {9, 9, 9}, false);
  options.bodies[0].grain_density = 1000.0;
  options.bodies[0].porosity = 0.0;
  options.bodies[0].law = NewtonianOptions{bulk_modulus, viscosity, 1e3};
  options.bodies[0].strain = StrainMeasure::jaumann;
  options.flip_fraction = 1.0;
  return options;
}

TEST(NewtonianPoints, AShearWaveDecaysByItsViscosity) {
  const double pi = std::acos(-1.0), viscosity = 50.0, kinematic = viscosity / 1000.0;
  const Grid<2> grid = make_grid<2>({4, 32, 1}, 1.0 / 32, "ppss");
  SoilOptions options = make_liquid(1e5, viscosity);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  set_velocity(soil, [&](int axis, const Vec<2>& x, std::int64_t) {
    return axis == 0 ? 0.01 * std::cos(pi * x[1]) : 0.0;
  });
  const double start = soil.totals().kinetic_energy, dt = soil.stable_step();
  double time = 0.0;
  run(soil, time, static_cast<int>(1.0 / dt), dt);
  const double exact = std::exp(-2.0 * kinematic * pi * pi * time);
  EXPECT_NEAR(soil.totals().kinetic_energy / start, exact, 0.01 * exact);
}

/// Kinetic energy of noise after 400 steps, over that at the start.
double noise_left(Kernel kernel, double courant, double viscosity) {
  const Grid<2> grid = make_grid<2>({8, 8, 1}, 0.1, "ssss");
  SoilOptions options = make_liquid(1e4, viscosity);
  options.kernel = kernel;
  options.courant = courant;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  set_velocity(soil,
               [](int axis, const Vec<2>&, std::int64_t id) { return 1e-6 * noise(id, axis); });
  const double start = soil.totals().kinetic_energy, dt = soil.stable_step();
  double time = 0.0;
  run(soil, time, 400, dt);
  return soil.totals().kinetic_energy / start;
}

TEST(NewtonianPoints, AreStableAtTheStepThatTheirViscosityAllowsAndNotFarBeyond) {
  for (const double viscosity : {1.0, 300.0, 3e4})  // nu/(c h) = 0.004, 1.3, 130
    for (const Kernel kernel : every_kernel)
      EXPECT_LT(noise_left(kernel, 0.9, viscosity), 1.0) << viscosity;
  EXPECT_GT(noise_left(Kernel::linear, 2.0, 3e4), 1e3);
}

TEST(GranularCollapse, OfAColumnComesToRestAndKeepsMassAndVolume) {
  const Grid<2> grid = make_grid<2>({32, 12, 1}, 0.01, "sono", 9.81);
  SoilOptions options = make_soil(2, {-1, -1, -1}, {0.1, 9, 0.1}, false);
  options.transfer = Transfer::apic;
  for (const bool rounded : {false, true}) {
    MohrCoulombOptions sharp;
    sharp.young_modulus = 5e5, sharp.poisson_ratio = 0.3, sharp.friction_angle = 0.54;
    DruckerPragerOptions cone;
    cone.young_modulus = 5e5, cone.poisson_ratio = 0.3, cone.friction_angle = 0.54;
    options.bodies[0].law = rounded ? SoilLawOptions(cone) : SoilLawOptions(sharp);
    options.bodies[0].strain = StrainMeasure::jaumann;
    options.bodies[0].initial_stress = GeostaticStress{};
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    const double mass = soil.totals().grain_mass, fallen = mass * 9.81 * 0.05;
    const double dt = soil.stable_step();
    double time = 0.0;
    run(soil, time, static_cast<int>(0.8 / dt), dt);
    const auto& points = soil.points(0);
    double front = 0.0, volume = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      front = std::max(front, points.position[0][p]);
      volume += points.volume[p];
    }
    // Aspect ratio 1: (d - d0)/d0 about 1.2 (Lube et al. 2005), less on so coarse a grid.
    EXPECT_GT(front, 0.17);
    EXPECT_LT(front, 0.24);
    EXPECT_NEAR(volume, 0.01, 2e-4);
    EXPECT_EQ(soil.totals().grain_mass, mass);
    EXPECT_LT(soil.totals().kinetic_energy, 1e-4 * fallen);
  }
}

}  // namespace
}  // namespace mudlark

// Motion of blocks and columns with exact answers: free fall, drift, elastic vibration, drag.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;
constexpr double pi = 3.14159265358979323846;

template <int D>
void expect_free_fall(Kernel kernel, Transfer transfer, bool wet) {
  SCOPED_TRACE(static_cast<int>(kernel) * 10 + static_cast<int>(transfer));
  const Grid<D> grid = make_grid<D>({10, D == 2 ? 24 : 10, 24}, 0.1, "oooooo", 9.81);
  const double up = D == 2 ? 1.0 : 0.6;
  SoilOptions options = make_soil(D, {0.3, D == 2 ? -1 : 0.3, 1.6}, {0.6, up, 1.9}, wet);
  options.kernel = kernel;
  options.transfer = transfer;
  options.water_bulk_modulus = 2e5;
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  const double dt = 1e-3;
  double time = 0.0;
  const int steps = 200;
  run(soil, time, steps, dt);
  const auto& points = soil.points(0);
  ASSERT_EQ(points.size(), static_cast<std::size_t>(D == 2 ? 36 : 216));
  // To round-off, which the lightest nodes at the rim of the soil amplify some thousand times.
  // Symplectic Euler: v = -g n dt, z = -g dt^2 n (n + 1) / 2.
  const double v = -9.81 * steps * dt, fall = -9.81 * dt * dt * steps * (steps + 1) / 2;
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.velocity[D - 1][p], v, 1e-9);
    EXPECT_NEAR(points.velocity[0][p], 0.0, 1e-9);
    EXPECT_NEAR(points.position[D - 1][p] - points.start[D - 1][p], fall, 1e-9);
    EXPECT_NEAR(points.volume[p] / points.start_volume[p], 1.0, 1e-9);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(points.stress[c][p], 0.0, 1e-3);
    EXPECT_NEAR(points.water_velocity[D - 1][p], wet ? v : 0.0, 1e-9);
  }
}

TEST(FreeFall, IsExactForEveryKernelAndTransfer) {
  for (const Kernel kernel : every_kernel)
    for (const bool wet : {false, true}) {
      expect_free_fall<2>(kernel, Transfer::flip, wet);
      if (kernel == Kernel::linear) continue;
      expect_free_fall<2>(kernel, Transfer::apic, wet);
    }
  expect_free_fall<3>(Kernel::composite, Transfer::flip, true);
  expect_free_fall<3>(Kernel::composite, Transfer::apic, false);
}

/// A block that drifts through a periodic box and over its seam.
template <int D>
void expect_drift(Transfer transfer, bool shaken) {
  const Grid<D> grid = make_grid<D>({10, 9, 8}, 0.1, "pppppp");
  SoilOptions options = make_soil(D, {0.5, D == 2 ? -1.0 : 0.5, 0.4}, {0.9, 0.8, 0.7}, true);
  options.transfer = transfer;
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  set_velocity(soil, [&](int axis, const Vec<D>&, std::int64_t id) {
    return 2.0 - 0.7 * axis + (shaken ? 0.02 * noise(id, axis) : 0.0);
  });
  const auto before = soil.totals();
  double time = 0.0;
  run(soil, time, 600, 0.5 * soil.stable_step());
  const auto after = soil.totals();
  double leftmost = 1.0;
  for (const double x : soil.points(0).position[0]) leftmost = std::min(leftmost, x);
  EXPECT_LT(leftmost, 0.1) << "must cross the seam";
  EXPECT_EQ(after.points, before.points);
  EXPECT_NEAR(after.grain_mass / before.grain_mass, 1.0, 1e-14);
  const double scale = (before.grain_mass + before.water_mass) * 2.0;
  for (int a = 0; a < D; ++a) {
    // Pore water keeps to the volume of the soil, so its mass moves a little while the block
    // breathes; without that, momentum is exact.
    const double tolerance = shaken ? 1e-5 : 1e-12;
    EXPECT_NEAR(after.momentum[a] / scale, before.momentum[a] / scale, tolerance) << "axis " << a;
  }
  if (shaken) {
    EXPECT_LT(after.kinetic_energy, before.kinetic_energy);
  } else {
    EXPECT_NEAR(after.kinetic_energy / before.kinetic_energy, 1.0, 1e-12);
  }
}

TEST(Drift, KeepsMomentumAndEnergyThroughThePeriodicSeam) {
  for (const Transfer transfer : {Transfer::flip, Transfer::apic}) {
    expect_drift<2>(transfer, false);
    expect_drift<2>(transfer, true);
    expect_drift<3>(transfer, false);
  }
}

TEST(Drift, OfADryBlockThatRingsKeepsItsMomentumToRoundOff) {
  const Grid<2> grid = make_grid<2>({10, 9, 1}, 0.1, "pppp");
  SoilSolver<2> soil(grid, make_soil(2, {0.2, -1.0, 0.2}, {0.6, 1.0, 0.6}, false));
  soil.initialise();
  set_velocity(soil, [&](int axis, const Vec<2>&, std::int64_t id) {
    return 2.0 - 0.7 * axis + 0.2 * noise(id, axis);
  });
  const auto before = soil.totals();
  double time = 0.0;
  run(soil, time, 600, 0.5 * soil.stable_step());
  const auto after = soil.totals();
  for (int a = 0; a < 2; ++a)
    EXPECT_NEAR(after.momentum[a] / (2.0 * before.grain_mass),
                before.momentum[a] / (2.0 * before.grain_mass), 1e-12);
}

/// Period of a bar fixed at one end, free at the other, from the zero crossings of its free end.
double measured_frequency(int cells, Kernel kernel, double poisson) {
  const double h = 1.0 / cells;
  const Grid<2> grid = make_grid<2>({2, cells + 4, 1}, h, "ssso");
  SoilOptions options = make_soil(2, {-1, -1, -1}, {9, 9, 1.0}, false);
  options.bodies[0].law = LinearElasticOptions{1e6, poisson};
  options.bodies[0].strain = StrainMeasure::small;
  options.flip_fraction = 1.0;
  options.kernel = kernel;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  set_velocity(soil, [](int axis, const Vec<2>& x, std::int64_t) {
    return axis == 1 ? 1e-4 * std::sin(0.5 * pi * x[1]) : 0.0;
  });
  const double dt = 0.4 * soil.stable_step();
  double time = 0.0, last = 1.0;
  std::vector<double> crossings;
  while (crossings.size() < 9) {
    soil.begin_step(time, dt, nullptr);
    soil.advance(dt);
    time += dt;
    const double now = soil.points(0).velocity[1].back();
    if (now * last < 0.0) crossings.push_back(time - dt * now / (now - last));
    last = now;
    if (time > 10.0) return 0.0;
  }
  return 4.0 / (crossings.back() - crossings.front());
}

TEST(Bar, VibratesAtItsNaturalFrequency) {
  const double poisson = 0.2;
  const double speed = std::sqrt(constrained_modulus(1e6, poisson) / (0.6 * 2650.0));
  for (const Kernel kernel : every_kernel) {
    const double exact = speed / 4.0, measured = measured_frequency(40, kernel, poisson);
    RecordProperty("frequency_error_" + std::to_string(static_cast<int>(kernel)),
                   std::to_string(measured / exact - 1.0));
    EXPECT_NEAR(measured / exact, 1.0, 0.01) << "kernel " << static_cast<int>(kernel);
  }
}

/// Grains and water of a uniform mixture in a periodic box slow each other down.
double relative_velocity_after(double permeability, int steps, double dt, double start) {
  const Grid<2> grid = make_grid<2>({6, 6, 1}, 0.1, "pppp");
  SoilOptions options = make_soil(2, {-1, -1, -1}, {9, 9, 9}, true);
  options.bodies[0].intrinsic_permeability = permeability;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  auto& points = soil.points(0);
  for (double& v : points.water_velocity[0]) v = start;
  double time = 0.0;
  run(soil, time, steps, dt);
  const auto& now = soil.points(0);
  const auto totals = soil.totals();
  EXPECT_NEAR(totals.momentum[0], 0.4 * 1000.0 * 0.36 * start, 1e-10);
  for (std::size_t p = 0; p < now.size(); ++p) {
    EXPECT_NEAR(now.water_velocity[0][p] - now.velocity[0][p],
                now.water_velocity[0][0] - now.velocity[0][0], 1e-10 * start);
    EXPECT_NEAR(now.volume[p] / now.start_volume[p], 1.0, 1e-10);
  }
  return now.water_velocity[0][0] - now.velocity[0][0];
}

TEST(Drag, RelaxesTheRelativeVelocityAsTheImplicitSchemeSays) {
  const double n = 0.4, start = 1e-3;
  for (const double permeability : {1e-7, 1e-9, 1e-12, 1e-16}) {
    const double drag = n * n * 1.002e-3 / permeability;
    const double rate = drag * (1.0 / (0.6 * 2650.0) + 1.0 / (n * 1000.0)), dt = 1e-4;
    const int steps = 20;
    const double exact = start * std::pow(1.0 + rate * dt, -steps);
    EXPECT_NEAR(relative_velocity_after(permeability, steps, dt, start), exact, 1e-12 * start);
  }
  // And the scheme's own limit: the exponential of physics.
  const double drag = n * n * 1.002e-3 / 1e-7;
  const double rate = drag * (1.0 / (0.6 * 2650.0) + 1.0 / (n * 1000.0)), dt = 1e-3 / rate;
  EXPECT_NEAR(relative_velocity_after(1e-7, 1000, dt, start) / start, std::exp(-1.0), 1e-3);
}

TEST(Drag, DoesNotShortenTheStep) {
  const Grid<2> grid = make_grid<2>({6, 6, 1}, 0.1, "pppp");
  std::vector<double> steps;
  for (const double permeability : {1e-7, 1e-16}) {
    SoilOptions options = make_soil(2, {-1, -1, -1}, {9, 9, 9}, true);
    options.bodies[0].intrinsic_permeability = permeability;
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    steps.push_back(soil.stable_step());
  }
  EXPECT_EQ(steps[0], steps[1]);
}

TEST(Damping, TakesACundallShareOfTheUnbalancedForce) {
  const Grid<2> grid = make_grid<2>({10, 24, 1}, 0.1, "oooo", 9.81);
  SoilOptions options = make_soil(2, {0.3, -1, 1.6}, {0.6, 1, 1.9}, false);
  options.damping = 0.2;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  set_velocity(soil, [](int axis, const Vec<2>&, std::int64_t) { return axis == 1 ? -1.0 : 0.0; });
  double time = 0.0;
  run(soil, time, 100, 1e-3);
  for (const double v : soil.points(0).velocity[1]) EXPECT_NEAR(v, -1.0 - 0.8 * 9.81 * 0.1, 1e-10);
}

// Behind walls, too: there the mirrored weight is part of what the floor carries.
TEST(BodyAcceleration, OfGravityActsAsGravity) {
  std::array<std::vector<double>, 2> height, start;
  for (const bool given : {false, true}) {
    const Grid<2> grid = make_grid<2>({3, 10, 1}, 0.1, "ssso", given ? 0.0 : 10.0);
    SoilOptions options = make_soil(2, {0, -1, 0}, {0.3, 1, 0.7}, true);
    if (given)
      options.body_acceleration = std::array<Varying, 3>{
          Varying(0.0), Varying(0.0), Varying([](const Point3&, double) { return -10.0; }, "-10")};
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    double time = 0.0;
    run(soil, time, 300, 2e-4);
    height[given ? 1 : 0] = soil.points(0).position[1];
    start[given ? 1 : 0] = soil.points(0).start[1];
  }
  double settled = 0.0;
  for (std::size_t p = 0; p < height[0].size(); ++p) {
    EXPECT_NEAR(height[1][p], height[0][p], 1e-13);
    settled = std::max(settled, start[0][p] - height[0][p]);
  }
  EXPECT_GT(settled, 1e-4);
}

}  // namespace
}  // namespace mudlark

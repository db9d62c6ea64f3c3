// A drop of liquid that is drawn out: its points lose touch unless they are split.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

/// A circle of incompressible liquid with the velocity (s x, -s z) becomes an ellipse of half axes
/// a and 1/a: a' = s a, s' = s^2 (a^-2 - a^2)/(a^-2 + a^2) (the pressure is zero on the ellipse,
/// Euler's equations give the rest; Monaghan 1994 has it for the same test of SPH).
struct Ellipse {
  double a = 1.0, s = 1.0;
  void advance(double time) {
    constexpr int steps = 20000;
    const auto slope = [](double rate, double axis) {
      return rate * rate * (1.0 - std::pow(axis, 4)) / (1.0 + std::pow(axis, 4));
    };
    const double dt = time / steps;
    for (int i = 0; i < steps; ++i) {
      const double s_mid = s + 0.5 * dt * slope(s, a), a_mid = a + 0.5 * dt * s * a;
      s += dt * slope(s_mid, a_mid);
      a += dt * s_mid * a_mid;
    }
  }
};

struct Drawn {
  double length, height;  ///< of the half axes, from moments, over the exact ones
  int columns = 0, empty = 0;
  std::size_t points = 0;
};

/// A quarter of the drop on cells of a tenth of its radius, drawn to 6.5 times its width.
Drawn draw(Transfer transfer, std::optional<double> split) {
  constexpr double h = 0.1, end = 4.0;
  SoilOptions soil = soil_runs::make_soil(2, {0, -1, 0}, {1, 1, 1}, false);
  SoilBody& body = soil.bodies[0];
  body.shape.form = SphereShape{{0, 0, 0}, 1.0, true};
  body.law = NewtonianOptions{1e5, 1e-3, 0.0};
  body.strain = StrainMeasure::jaumann;
  body.porosity = 0.0, body.grain_density = 1000.0;
  body.initial_velocity[0] = Varying([](const Point3& x, double) { return x[0]; }, "x");
  body.initial_velocity[2] = Varying([](const Point3& x, double) { return -x[2]; }, "-z");
  soil.transfer = transfer;
  soil.split_stretched = split;
  const Grid<2> grid = soil_runs::make_grid<2>({80, 13, 1}, h, "soso");
  SoilSolver<2> solver(grid, soil);
  solver.initialise();
  for (double time = 0.0; time < end - 1e-9;) {
    const double dt = std::min(20.0 * solver.stable_step(), end - time);
    const int steps = static_cast<int>(std::ceil(dt / solver.stable_step()));
    solver.begin_step(time, dt, nullptr);
    for (int i = 0; i < steps; ++i) solver.advance(dt / steps);
    time += dt;
  }
  Ellipse exact;
  exact.advance(end);
  const auto& points = solver.points(0);
  double mass = 0.0, xx = 0.0, zz = 0.0;
  std::map<int, int> column;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double m = points.grain_mass[p], x = points.position[0][p], z = points.position[1][p];
    mass += m, xx += m * x * x, zz += m * z * z;
    ++column[static_cast<int>(x / h)];
  }
  // The second moment of an ellipse is a quarter of its half axis squared.
  Drawn drawn{2.0 * std::sqrt(xx / mass) / exact.a, 2.0 * std::sqrt(zz / mass) * exact.a};
  drawn.columns = static_cast<int>(0.8 * exact.a / h);
  for (int i = 0; i < drawn.columns; ++i) drawn.empty += column.contains(i) ? 0 : 1;
  drawn.points = points.size();
  std::printf(
      "%s, %s: %zu points, half axes %.3f and %.3f of the exact ones, %d of %d columns "
      "empty\n",
      transfer == Transfer::apic ? "apic" : "flip", split ? "split" : "not split", drawn.points,
      drawn.length, drawn.height, drawn.empty, drawn.columns);
  return drawn;
}

TEST(DrawnDrop, TearsWherePointsAreNotSplit) {
  const Drawn drawn = draw(Transfer::flip, {});
  EXPECT_GT(drawn.empty, 8);
  EXPECT_GT(drawn.height, 1.3);
}

TEST(DrawnDrop, StaysInOnePieceWherePointsAreSplit) {
  for (const Transfer transfer : {Transfer::flip, Transfer::apic}) {
    const Drawn drawn = draw(transfer, 1.0);
    EXPECT_EQ(drawn.empty, 0);
    EXPECT_NEAR(drawn.length, 1.0, 0.03);
    EXPECT_NEAR(drawn.height, 1.0, transfer == Transfer::apic ? 0.02 : 0.15);
  }
}

}  // namespace
}  // namespace mudlark

#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include <map>
#include "verification/soil/manufactured.hpp"
#include "verification/soil/soil_runs.hpp"
namespace mudlark {
namespace {
double env(const char* n, double d) { const char* s = std::getenv(n); return s ? std::atof(s) : d; }
TEST(Scratch, Vortex) {
  const Vortex motion;
  const int cpm = (int)env("CPM", 16);
  const double last = env("END", 1.0), split = env("SPLIT", 0), ppc = env("PPC", 9);
  const bool apic = env("APIC", 0) > 0;
  SoilOptions soil = soil_runs::make_soil(2, {0, -1, 0}, {3, 1, 3}, false);
  SoilBody& body = soil.bodies[0];
  body.law = LinearElasticOptions{motion.solid.young, motion.solid.poisson};
  body.porosity = 0.5; body.grain_density = 2.0 * motion.solid.density;
  body.points_per_cell = (int)ppc;
  soil.transfer = apic ? Transfer::apic : Transfer::flip;
  soil.flip_fraction = env("FLIP", 1.0);
  if (split > 0) soil.split_stretched = split;
  std::array<Varying, 3> given;
  for (const int axis : {0, 1})
    given[axis == 0 ? 0u : 2u] = Varying([motion, axis](const Point3& x, double t) {
          return motion.body_acceleration(Vec<2>{{x[0], x[2]}}, t)[axis]; }, "manufactured");
  soil.body_acceleration = given;
  const int cells = 3 * cpm;
  const Grid<2> grid = soil_runs::make_grid<2>({cells, cells, 1}, 1.0 / cpm, "ssss");
  SoilSolver<2> solver(grid, soil);
  solver.initialise();
  const double dt = 0.25 / cpm;
  auto& points = solver.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec<2> v = motion.velocity(points.position_of(p), -0.5 * dt);
    for (int a = 0; a < 2; ++a) points.velocity[a][p] = v[a];
  }
  double time = 0.0;
  while (time < last - 1e-9) {
    const int n = std::max(1, (int)std::lround(0.125 / dt) / 4);
    for (int k = 0; k < 4; ++k) { // redistribute every few steps
      solver.begin_step(time, n * dt, nullptr);
      for (int i = 0; i < n; ++i) solver.advance(dt);
      time += n * dt;
    }
    std::map<std::pair<double,double>, std::pair<Vec<2>,double>> mean;
    double ve = 0, m = 0, re = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      auto& e = mean[{points.start[0][p], points.start[1][p]}];
      const double w = points.grain_mass[p];
      e.first += w * points.position_of(p); e.second += w;
      const Vec<2> v = motion.velocity(points.position_of(p), time - 0.5 * dt);
      for (int a = 0; a < 2; ++a) ve += w * std::pow(points.velocity[a][p] - v[a], 2);
      Vec<2> X{{points.start[0][p], points.start[1][p]}};
      re += w * std::pow(norm(points.position_of(p) - motion.centre) - norm(X - motion.centre), 2);
      m += w;
    }
    double pe = 0;
    for (auto& [k, e] : mean) { Vec<2> d = (1 / e.second) * e.first - motion.position(Vec<2>{{k.first, k.second}}, time); pe += dot(d, d); }
    std::printf("t %.4f points %zu position %.3e radius %.3e velocity %.3e\n", time, points.size(), std::sqrt(pe / mean.size()), std::sqrt(re/m), std::sqrt(ve / m));
  }
}
}  // namespace
}  // namespace mudlark

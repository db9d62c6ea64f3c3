#pragma once
/// Small boxes of water for the tests of the flow.
#include "flow/flow_solver.hpp"

namespace mudlark {

inline DomainOptions flow_domain(std::array<int, 3> cells, std::array<double, 3> upper,
                                 std::array<double, 3> gravity, Wall wall = Wall::slip) {
  DomainOptions options;
  options.cells = cells;
  options.upper = upper;
  options.gravity = gravity;
  for (auto& axis : options.walls) axis = {wall, wall};
  return options;
}

inline WaterBody water_box(Point3 lower, Point3 upper) {
  WaterBody body;
  body.shape.form = BoxShape{lower, upper};
  return body;
}

inline constexpr double far_away = 1e9;

/// A solver in its medium at the start of a run.
template <int D>
struct FlowRun {
  Grid<D> grid;
  PorousMedium<D> medium;
  FlowSolver<D> flow;
  double time = 0.0;

  FlowRun(const DomainOptions& domain, const FlowOptions& options, MPI_Comm comm = MPI_COMM_WORLD)
      : grid(domain, comm), medium(grid), flow(grid, options) {
    fill_fixed_ground(grid, options, medium);
    flow.initialise(medium);
  }
  void step(double dt) {
    flow.advance(medium, dt);
    time += dt;
  }
};

}  // namespace mudlark

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

/// A column of water about to fall on a rubble mound, in a tank of 0.6 m x 0.5 m (3D: 0.2 m wide).
template <int D>
FlowOptions column_and_mound() {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {0.2, D == 3 ? 0.11 : 1.0, 0.4})};
  PorousGround mound;
  mound.shape.form = BoxShape{{0.3, -1.0, -1.0}, {0.45, 1.0, 0.15}};
  mound.drag = DragLaw::van_gent;
  mound.grain_size = 0.02;
  mound.porosity = 0.45;
  options.porous = {mound};
  return options;
}

template <int D>
DomainOptions tank(int cells_per_length) {
  const int n = cells_per_length;
  return D == 2 ? flow_domain({6 * n, 5 * n, 1}, {0.6, 0.5, 1.0}, {0.0, -9.81, 0.0})
                : flow_domain({6 * n, 2 * n, 5 * n}, {0.6, 0.2, 0.5}, {0.0, 0.0, -9.81});
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
    flow.place_solids(medium);
    flow.initialise(medium);
  }
  void step(double dt) {
    flow.move_solids(medium, dt);
    flow.advance(medium, dt);
    flow.drive_solids(dt);
    time += dt;
  }
};

}  // namespace mudlark

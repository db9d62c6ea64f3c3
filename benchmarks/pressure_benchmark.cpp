/// Cost of a pressure solve, per cell: half-full box with a free surface, residual brought down by
/// `reduction`.
#include <benchmark/benchmark.h>
#include <mpi.h>

#include <cmath>

#include "numerics/loops.hpp"
#include "numerics/pressure_solver.hpp"
#include "stream.hpp"

namespace mudlark {
namespace {

template <int D>
void pressure_solve(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  DomainOptions options;
  options.cells = {cells, cells, cells};
  options.upper = {1.0, 1.0, 1.0};
  const Grid<D> grid(options, MPI_COMM_SELF);
  PressureSystem<D> system(grid);
  // Water below a wavy surface; its uppermost cells see the air at xi = 0.3 of a cell.
  const auto wet = [&](const Index<D>& cell) {
    return grid.global().contains(cell) &&
           cell[D - 1] < (0.6 + 0.1 * std::sin(9.0 * grid.cell_centre(cell)[0])) * cells;
  };
  for (int axis = 0; axis < D; ++axis)
    for_each(bounding_faces(grid, axis), [&](const Index<D>& face) {
      const Index<D> below = face.shifted(axis, -1);
      const bool here = wet(face), there = wet(below);
      system.coupling[axis][face] = here && there ? 1.0 : 0.0;
      for (const Index<D>& cell : {face, below}) {
        if (!grid.owned().contains(cell) || !wet(cell)) continue;
        const bool wall = face[axis] == 0 || face[axis] == cells;
        system.diagonal[cell] += wall ? 0.0 : here && there ? 1.0 : 1.0 / 0.3;
      }
    });
  for_each(grid.owned(), [&](const Index<D>& cell) {
    system.right_side[cell] = wet(cell) ? std::sin(7.0 * cell[0] + 3.0 * cell[D - 1]) : 0.0;
  });
  find_spans(
      grid, grid.owned(), [&](std::ptrdiff_t at) { return system.diagonal.data()[at] > 0.0; },
      system.unknowns);
  const double reduction = 1e-6;
  PressureSolver<D> solver(grid);
  CellField<D> p(grid, "p", "Pa");
  double iterations = 0.0;
  for (auto _ : state) {
    p.fill(0.0);
    iterations += solver.solve(system, p, reduction).iterations;
  }
  const double cells_total = std::pow(cells, D), solves = static_cast<double>(state.iterations());
  state.counters["iterations"] = iterations / solves;
  // Our part of an iteration: matrix (D+1), p, direction, image, residual read and written, two dot
  // products.
  set_counters(state, cells_total, iterations / solves * (D + 1 + 12) * sizeof(double));
}
BENCHMARK(pressure_solve<2>)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(pressure_solve<3>)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mudlark

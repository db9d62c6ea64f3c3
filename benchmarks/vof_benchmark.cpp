/// Cost of moving the interface, per cell and sweep: a dam-break-like half-full box in a swirling
/// flow.
#include <benchmark/benchmark.h>
#include <mpi.h>

#include <cmath>

#include "grid/shape.hpp"
#include "numerics/interface_advection.hpp"
#include "numerics/loops.hpp"
#include "stream.hpp"

namespace mudlark {
namespace {

template <int D>
Grid<D> box(int cells) {
  DomainOptions options;
  options.cells = {cells, cells, cells};
  options.upper = {1.0, 1.0, 1.0};
  return Grid<D>(options, MPI_COMM_SELF);
}

template <int D>
void vof_sweep(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const Grid<D> grid = box<D>(cells);
  CellField<D> water(grid, "water", "1"), porosity(grid, "porosity", "1", 1.0);
  FaceVector<D> flux(grid, "flux", "m/s");
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const double height = (0.5 + 0.1 * std::sin(6.0 * grid.cell_centre(cell)[0])) * cells;
    water[cell] = std::clamp(height - cell[D - 1], 0.0, 1.0);
  });
  // U = (d psi/dz, -d psi/dx) with psi = sin^2 sin^2: closed walls, no divergence.
  const double h = grid.spacing()[0];
  const auto psi = [](double x, double z) {
    return std::pow(std::sin(M_PI * x) * std::sin(M_PI * z), 2) / M_PI;
  };
  for (const int axis : {0, D - 1})
    for_each(bounding_faces(grid, axis), [&](const Index<D>& face) {
      const double x = face[0] * h, z = face[D - 1] * h;
      flux[axis][face] =
          axis == 0 ? (psi(x, z + h) - psi(x, z)) / h : -(psi(x + h, z) - psi(x, z)) / h;
    });
  const CellRuns<D> everywhere(grid);
  InterfaceAdvection<D> advection(grid, everywhere);
  std::int64_t step = 0;
  for (auto _ : state) advection.sweep(water, porosity, flux, 0.2 * h, step++);
  const double cells_total = std::pow(cells, D);
  // Per cell and sweep at least: W read and written twice, theta, U, c, F, alpha written and read.
  set_counters(state, cells_total * D, 10 * sizeof(double));
}
BENCHMARK(vof_sweep<2>)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(vof_sweep<3>)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mudlark

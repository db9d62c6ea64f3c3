/// Cost of the soil engine per point: transfers, stress update, whole step; two-phase elastic soil.
#include <mpi.h>

#include <cmath>

#include "materials/linear_elastic.hpp"
#include "soil/kinematics.hpp"
#include "soil/soil_solver.hpp"
#include "stream.hpp"

namespace mudlark {
namespace {

/// A block of soil that fills the lower three quarters of a box, 2^D points per cell, slightly
/// sheared.
template <int D>
struct Block {
  Grid<D> grid;
  SoilSolver<D> solver;

  static DomainOptions domain(int cells) {
    DomainOptions options;
    options.cells = {cells, cells, cells};
    options.upper = {1.0, 1.0, 1.0};
    options.gravity[D - 1] = -9.81;
    return options;
  }
  static SoilOptions soil(Kernel kernel, Transfer transfer) {
    SoilBody body;
    body.name = "block";
    body.shape.form = BoxShape{{-1, -1, -1}, {2, 2, 0.75}};
    body.points_per_cell = D == 2 ? 4 : 8;
    body.intrinsic_permeability = 1e-11;
    body.law = LinearElasticOptions{1e7, 0.3};
    body.strain = StrainMeasure::hencky;
    body.initial_stress = GeostaticStress{};
    body.initial_velocity[0] = Varying([](const Point3& x, double) { return 0.1 * x[2]; }, "shear");
    SoilOptions options;
    options.bodies.push_back(body);
    options.kernel = kernel;
    options.transfer = transfer;
    return options;
  }
  Block(int cells, Kernel kernel, Transfer transfer)
      : grid(domain(cells), MPI_COMM_SELF), solver(grid, soil(kernel, transfer)) {
    solver.initialise();
  }
  double points() const { return static_cast<double>(solver.points(0).size()); }
  /// Doubles that a point carries.
  double arrays() {
    double count = 1.0;
    solver.points(0).for_each_array([&](std::vector<double>&) { count += 1.0; });
    return count;
  }
};

template <class T, int D, std::size_t... A>
NodeField<T, D> node_field(const Grid<D>& grid, std::index_sequence<A...>) {
  return {((void)A, Field<T, AtFace, D>(grid, "nodes", ""))...};
}

template <int D, Kernel kernel, Transfer transfer>
void p2g(benchmark::State& state) {
  Block<D> block(static_cast<int>(state.range(0)), kernel, transfer);
  auto sums = node_field<NodeSums, D>(block.grid, std::make_index_sequence<D>{});
  for (auto _ : state)
    points_to_grid(block.grid, block.solver.points(0), block.solver.constants(0), kernel, transfer,
                   {}, sums);
  // Reads position, velocities, stress, pressure, mass, volume once; node sums stay in cache and
  // count per cell.
  const double nodes = D * 2.0 * sizeof(NodeSums) / (D == 2 ? 4 : 8);
  const double affine = transfer == Transfer::apic ? 2.0 * D * D : 0.0;
  set_counters(state, block.points(), (3.0 * D + 6 + 3 + affine) * sizeof(double) + nodes);
}

template <int D, Kernel kernel, Transfer transfer>
void g2p(benchmark::State& state) {
  Block<D> block(static_cast<int>(state.range(0)), kernel, transfer);
  auto motion = node_field<NodeMotion, D>(block.grid, std::make_index_sequence<D>{});
  PointMotion result;
  for (auto _ : state)
    grid_to_points(block.grid, motion, kernel, transfer, 0.99, 1e-6, true, block.solver.points(0),
                   result);
  const double nodes = D * 1.0 * sizeof(NodeMotion) / (D == 2 ? 4 : 8);
  const double affine = transfer == Transfer::apic ? 2.0 * D * D : 0.0;
  set_counters(state, block.points(), (6.0 * D + D * D + 1 + affine) * sizeof(double) + nodes);
}

template <int D, StrainMeasure measure>
void stress_update(benchmark::State& state) {
  Block<D> block(static_cast<int>(state.range(0)), Kernel::composite, Transfer::flip);
  auto& points = block.solver.points(0);
  points.carries_deformation = measure == StrainMeasure::small;
  points.resize(points.size());
  const LinearElastic law({1e7, 0.3});
  initialise_material_state(points, law, measure, 0.4);
  const std::vector<double> gradient(points.size() * D * D, 1e-9);
  for (auto _ : state)
    benchmark::DoNotOptimize(update_stress(points, gradient, law, measure, {1e-6, 0.0, 1.0}));
  set_counters(state, block.points(), (2.0 * 12 + D * D + 2) * sizeof(double));
}

template <int D, Kernel kernel, Transfer transfer>
void whole_step(benchmark::State& state) {
  Block<D> block(static_cast<int>(state.range(0)), kernel, transfer);
  const double dt = block.solver.stable_step();
  int step = 0;
  for (auto _ : state) {
    if (step++ % 50 == 0) block.solver.begin_step(step * dt, 50 * dt, nullptr);
    block.solver.advance(dt);
  }
  set_counters(state, block.points(), 2.0 * block.arrays() * sizeof(double));
}

BENCHMARK((p2g<2, Kernel::composite, Transfer::flip>))->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK((p2g<2, Kernel::quadratic, Transfer::flip>))->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK((p2g<3, Kernel::composite, Transfer::flip>))->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK((p2g<3, Kernel::composite, Transfer::apic>))->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK((g2p<2, Kernel::composite, Transfer::flip>))->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK((g2p<2, Kernel::quadratic, Transfer::flip>))->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK((g2p<3, Kernel::composite, Transfer::flip>))->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK((g2p<3, Kernel::composite, Transfer::apic>))->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK((stress_update<2, StrainMeasure::hencky>))->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK((stress_update<2, StrainMeasure::small>))->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK((stress_update<3, StrainMeasure::hencky>))->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK((whole_step<2, Kernel::composite, Transfer::flip>))
    ->Arg(128)
    ->Unit(benchmark::kMillisecond);
BENCHMARK((whole_step<2, Kernel::quadratic, Transfer::flip>))
    ->Arg(128)
    ->Unit(benchmark::kMillisecond);
BENCHMARK((whole_step<3, Kernel::composite, Transfer::flip>))
    ->Arg(32)
    ->Unit(benchmark::kMillisecond);
BENCHMARK((whole_step<3, Kernel::quadratic, Transfer::apic>))
    ->Arg(32)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mudlark

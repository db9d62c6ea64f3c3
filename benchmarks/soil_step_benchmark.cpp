/// Whole steps of the soil engine at the sizes and with the laws that users compare codes by: time
/// and bytes per point, and the share of what the memory would allow if each array were read and
/// written once. Argument: cells along an edge; 2^D points per cell in three quarters of the box.
#include <mpi.h>

#include <cmath>

#include "soil/soil_solver.hpp"
#include "stream.hpp"

namespace mudlark {
namespace {

/// saturated: formulation u-w; projected: u-w-p in incompressible water, its pressure solve
/// included.
enum class Ground { elastic, mohr_coulomb, saturated, projected };

template <int D>
DomainOptions box(int cells) {
  DomainOptions options;
  options.cells = {cells, cells, cells};
  options.upper = {1.0, 1.0, 1.0};
  options.gravity[D - 1] = -9.81;
  return options;
}

/// A block under its weight that is sheared at 0.1 1/s, which makes some of it yield where it can.
template <int D, Ground ground>
SoilOptions block(Kernel kernel) {
  SoilBody body;
  body.name = "block";
  body.shape.form = BoxShape{{-1, -1, -1}, {2, 2, 0.75}};
  body.points_per_cell = D == 2 ? 4 : 8;
  constexpr bool wet = ground == Ground::saturated || ground == Ground::projected;
  body.pore_water = wet ? PoreWater::two_phase : PoreWater::none;
  body.intrinsic_permeability = 1e-11;
  if (ground == Ground::mohr_coulomb) {
    body.law = MohrCoulombOptions{.young_modulus = 1e7,
                                  .poisson_ratio = 0.3,
                                  .cohesion = 1e3,
                                  .friction_angle = 0.5236,
                                  .dilatancy_angle = 0.0};
    body.strain = StrainMeasure::jaumann;
  } else {
    body.law = LinearElasticOptions{1e7, 0.3};
    body.strain = StrainMeasure::hencky;
  }
  body.initial_stress = GeostaticStress{};
  body.initial_velocity[0] = Varying([](const Point3& x, double) { return 0.1 * x[2]; }, "shear");
  SoilOptions options;
  options.bodies.push_back(body);
  options.kernel = kernel;
  if (ground == Ground::projected) {
    options.formulation = Formulation::u_w_p;
    options.water_bulk_modulus = HUGE_VAL;
  }
  return options;
}

template <int D, Ground ground, Kernel kernel>
void step(benchmark::State& state) {
  const Grid<D> grid(box<D>(static_cast<int>(state.range(0))), MPI_COMM_SELF);
  SoilSolver<D> solver(grid, block<D, ground>(kernel));
  solver.initialise();
  const double dt = solver.stable_step();
  constexpr int steps_per_outer_step = 50;
  int count = 0;
  for (auto _ : state) {
    if (count % steps_per_outer_step == 0)
      solver.begin_step(count * dt, steps_per_outer_step * dt, nullptr);
    solver.advance(dt);
    ++count;
  }
  double doubles = 1.0;  // the number of a point
  solver.points(0).for_each_array([&](std::vector<double>&) { doubles += 1.0; });
  const auto points = static_cast<double>(solver.points(0).size());
  set_counters(state, points, 2.0 * doubles * sizeof(double));
  state.counters["points"] = points;
  state.counters["stored_bytes"] = doubles * sizeof(double);
}

// Small enough for a cache of 16 MB, and not.
constexpr auto milliseconds = benchmark::kMillisecond;
BENCHMARK((step<3, Ground::elastic, Kernel::quadratic>))->Arg(16)->Arg(40)->Unit(milliseconds);
BENCHMARK((step<3, Ground::mohr_coulomb, Kernel::composite>))->Arg(16)->Arg(40)->Unit(milliseconds);
BENCHMARK((step<3, Ground::saturated, Kernel::composite>))->Arg(16)->Arg(40)->Unit(milliseconds);
BENCHMARK((step<2, Ground::mohr_coulomb, Kernel::composite>))
    ->Arg(80)
    ->Arg(256)
    ->Unit(milliseconds);
BENCHMARK((step<2, Ground::saturated, Kernel::composite>))->Arg(80)->Arg(256)->Unit(milliseconds);
BENCHMARK((step<3, Ground::projected, Kernel::composite>))->Arg(16)->Arg(40)->Unit(milliseconds);
BENCHMARK((step<2, Ground::projected, Kernel::composite>))->Arg(80)->Arg(256)->Unit(milliseconds);
// From 1e4 to 1e7 points.
BENCHMARK((step<2, Ground::mohr_coulomb, Kernel::composite>))
    ->Name("size")
    ->Arg(60)
    ->Arg(180)
    ->Arg(560)
    ->Arg(1800)
    ->Unit(milliseconds);

}  // namespace
}  // namespace mudlark

#pragma once
/// Small blocks and columns of soil that the verification tests run.
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include "soil/soil_solver.hpp"

namespace mudlark::soil_runs {

inline constexpr std::array<Kernel, 3> every_kernel{Kernel::linear, Kernel::quadratic,
                                                    Kernel::composite};
inline constexpr std::array<Transfer, 2> every_transfer{Transfer::flip, Transfer::apic};

/// Cubic cells of edge h from the origin; walls: 's' slip, 'n' no slip, 'o' open, 'p' periodic, per
/// axis (x, z or x, y, z) lower and upper.
template <int D>
Grid<D> make_grid(std::array<int, 3> cells, double h, const char* walls, double gravity = 0.0,
                  MPI_Comm comm = MPI_COMM_SELF) {
  DomainOptions domain;
  domain.dimension = D;
  domain.cells = cells;
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a) {
    domain.upper[a] = cells[a] * h;
    for (std::size_t side = 0; side < 2; ++side) {
      const char c = walls[2 * a + side];
      domain.walls[a][side] = c == 's'   ? Wall::slip
                              : c == 'n' ? Wall::no_slip
                              : c == 'o' ? Wall::open
                                         : Wall::periodic;
    }
  }
  domain.gravity[static_cast<std::size_t>(D - 1)] = -gravity;
  return Grid<D>(domain, comm);
}

/// One body of soil in a box; plain defaults that tests change.
inline SoilOptions make_soil(int dimension, const Point3& lower, const Point3& upper, bool wet) {
  SoilBody body;
  body.name = "block";
  body.shape.form = BoxShape{lower, upper};
  body.pore_water = wet ? PoreWater::two_phase : PoreWater::none;
  body.intrinsic_permeability = 1e-10;
  body.points_per_cell = dimension == 2 ? 4 : 8;
  body.law = LinearElasticOptions{1e6, 0.3};
  body.strain = StrainMeasure::hencky;
  SoilOptions soil;
  soil.water_bulk_modulus = 2e7;
  soil.bodies.push_back(body);
  return soil;
}

inline double constrained_modulus(double young, double poisson) {
  return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
}

/// Runs `steps` steps of dt in outer steps of at most 50.
template <int D>
void run(SoilSolver<D>& soil, double& time, int steps, double dt,
         const FluidLoad<D>* water = nullptr) {
  while (steps > 0) {
    const int k = std::min(steps, 50);
    soil.begin_step(time, k * dt, water);
    for (int i = 0; i < k; ++i) soil.advance(dt);
    time += k * dt;
    steps -= k;
  }
}

/// Gives every point a velocity from a function of its position and number.
template <int D, class F>
void set_velocity(SoilSolver<D>& soil, F&& velocity) {
  auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int a = 0; a < D; ++a)
      points.velocity[a][p] = points.water_velocity[a][p] =
          velocity(a, points.position_of(p), points.id[p]);
}

/// A number in [-1, 1] that belongs to a point and an axis, the same on any number of ranks.
inline double noise(std::int64_t id, int axis) {
  std::mt19937_64 generator(static_cast<std::uint64_t>(id) * 3 + static_cast<std::uint64_t>(axis));
  return std::uniform_real_distribution<double>(-1.0, 1.0)(generator);
}

}  // namespace mudlark::soil_runs

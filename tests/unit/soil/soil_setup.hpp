#pragma once
/// Small grids and clouds of material points that the tests of the soil share.
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "soil/nodes.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/transfer.hpp"

namespace mudlark::soil_test {

inline constexpr std::array<Kernel, 3> every_kernel{Kernel::linear, Kernel::quadratic,
                                                    Kernel::composite};
inline constexpr std::array<Transfer, 2> every_transfer{Transfer::flip, Transfer::apic};
inline const char* name_of(Kernel kernel) {
  return kernel == Kernel::linear      ? "linear"
         : kernel == Kernel::quadratic ? "quadratic"
                                       : "composite";
}

/// Cells of unequal edges from (-1, 2, -3) on, so that nothing passes by a lucky spacing or origin.
template <int D>
Grid<D> make_grid(const std::array<int, 3>& cells, Wall wall, MPI_Comm comm = MPI_COMM_SELF) {
  DomainOptions options;
  options.dimension = D;
  options.cells = cells;
  options.lower = {-1.0, 2.0, -3.0};
  const std::array<double, 3> edge{0.5, 0.4, 0.3};
  for (std::size_t a = 0; a < 3; ++a) {
    options.upper[a] = options.lower[a] + cells[a] * edge[a];
    options.walls[a] = {wall, wall};
  }
  return Grid<D>(options, comm);
}

template <class T, int D, std::size_t... A>
NodeField<T, D> make_nodes(const Grid<D>& grid, std::index_sequence<A...>) {
  return {((void)A, Field<T, AtFace, D>(grid, "nodes", ""))...};
}
template <class T, int D>
NodeField<T, D> make_nodes(const Grid<D>& grid) {
  return make_nodes<T, D>(grid, std::make_index_sequence<static_cast<std::size_t>(D)>{});
}

inline BodyConstants saturated_sand() {
  return {2650.0, 0.4, 1000.0, 1e-3, 1e-10, PermeabilityLaw::kozeny_carman};
}

/// Points at jittered lattice places in the given cells, m per axis and cell, with random masses,
/// velocities, stresses and pore pressures.
template <int D>
SoilParticles<D> make_cloud(const Grid<D>& grid, const IndexBox<D>& cells, int m, double jitter,
                            unsigned seed = 7) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  SoilParticles<D> points;
  points.carries_affine = true;
  IndexBox<D> lattice = cells;
  for (int a = 0; a < D; ++a) lattice.lower[a] *= m, lattice.upper[a] *= m;
  const double volume = grid.cell_volume() / std::pow(m, D);
  for_each(lattice, [&](const Index<D>& site) {
    const std::size_t p = points.size();
    points.resize(p + 1);
    points.id[p] = static_cast<std::int64_t>(p);
    for (int a = 0; a < D; ++a)
      points.position[a][p] = points.start[a][p] =
          grid.lower()[a] +
          (site[a] + 0.5 + 0.5 * jitter * unit(generator)) / m * grid.spacing()[a];
    points.start_volume[p] = volume;
    points.volume[p] = volume * (1.0 + 0.1 * unit(generator));
    points.grain_mass[p] = 0.6 * 2650.0 * volume;
    points.pore_pressure[p] = 1e4 * unit(generator);
    for (int a = 0; a < D; ++a) {
      points.velocity[a][p] = unit(generator);
      points.water_velocity[a][p] = unit(generator);
    }
    for (int c = 0; c < D * D; ++c) {
      points.affine[c][p] = unit(generator);
      points.water_affine[c][p] = unit(generator);
    }
    for (int c = 0; c < 6; ++c) points.stress[c][p] = 1e4 * unit(generator);
  });
  return points;
}

/// Box of cells from `lower` to `upper` on every axis.
template <int D>
IndexBox<D> cube(int lower, int upper) {
  IndexBox<D> box;
  for (int a = 0; a < D; ++a) box.lower[a] = lower, box.upper[a] = upper;
  return box;
}

inline double water_mass_of(double grain_mass, double volume, const BodyConstants& body) {
  return (volume - grain_mass / body.grain_density) * body.water_density;
}

}  // namespace mudlark::soil_test

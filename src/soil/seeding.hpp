#pragma once
/// Material points and their initial state from the bodies of a case.
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"

namespace mudlark {

/// Points of one body on this rank: a regular lattice of points_per_cell points in every cell, kept
/// where the point lies in the body's shape and in no rigid body. Each carries an equal share of
/// the cell's volume. Sets position, masses, volumes and initial velocity, and their extent if
/// asked for; ids are unique in the case and do not depend on ranks.
template <int D>
SoilParticles<D> seed_points(const Grid<D>& grid, const SoilBody& body, std::size_t body_number,
                             Transfer transfer, bool with_extent = false,
                             std::span<const SolidOptions> solids = {});

/// Initial stress and pore pressure of the points of all bodies of a stage.
/// Geostatic: along each vertical line of the lattice the submerged weight of what lies above is
/// summed up, sigma'_zz(z) = -integral_z^top (1-n)(rho_s - rho_w) g dz (dry: (1-n) rho_s), sigma'_h
/// = K0 sigma'_zz, and p = rho_w g (depth below the top of the soil). Bodies of other stages weigh
/// nothing here.
template <int D>
void set_initial_stress(const Grid<D>& grid, const SoilOptions& options, std::size_t stage,
                        std::vector<SoilParticles<D>>& bodies);

}  // namespace mudlark

#pragma once
/// Points to their owners and into the order of the cells.
#include "grid/grid.hpp"
#include "soil/particles.hpp"
#include "soil/sides.hpp"

namespace mudlark {

/// Collective. Sends each point to the rank that owns its cell (axis after axis, as often as
/// needed), wraps points around periodic sides, and removes points that left through an open side.
/// Returns the grain mass [kg] removed on this rank. A point behind a closed side is an error of
/// the computation: DivergenceError. Sides that move or absorb take points along, up to half a cell
/// out of the domain.
template <int D>
double migrate(const SoilSides<D>& sides, SoilParticles<D>& points);
template <int D>
double migrate(const Grid<D>& grid, SoilParticles<D>& points) {
  return migrate(SoilSides<D>(grid), points);
}

/// Removes the points whose flag is set, keeping the order of the others.
template <int D>
void remove_points(SoilParticles<D>& points, const std::vector<char>& flagged);

/// Sorts points by cell (stable counting sort), first axis fastest.
template <int D>
void sort_by_cell(const Grid<D>& grid, SoilParticles<D>& points);

}  // namespace mudlark

#pragma once
/// What faces and cells are told of the volume of soil and of what it lets through.
#include "soil/transfer.hpp"

namespace mudlark {

/// The volume that faces are told of [m^D]: of the soil, or of its grains where only they are the
/// soil's. Of a double or of lanes.
template <class Value>
Value held_volume(const BodyConstants& body, const Value& grain_mass, const Value& volume) {
  if (!body.in_grid_water) return volume;
  return grain_mass / body.grain_density;
}

/// Adds to the cells around the points, with the across-axis spline, mu/kappa of the soil at each
/// point's own porosity, times the share of the cell that the point's soil takes [Pa s/m2].
template <int D>
void add_resistance(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                    Kernel kernel, CellField<D>& resistance);

}  // namespace mudlark

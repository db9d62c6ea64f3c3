#pragma once
/// Between points and the cells that pore pressure is found on.
#include "soil/transfer.hpp"

namespace mudlark {

/// Adds the shares of a cell's volume that wet points fill, sum V N_c / V_c, and that their pores
/// fill, sum n V N_c / V_c [-], to the cells around them, with the across-axis spline N.
template <int D>
void add_filling(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                 Kernel kernel, CellField<D>& filling, CellField<D>& pores);

/// Values of a cell field (ghosts valid) at the points of `range`; `values` starts with the first.
template <int D>
void sample_range(const Grid<D>& grid, const SoilParticles<D>& points, PointRange range,
                  Kernel kernel, const CellField<D>& field, std::vector<double>& values);

}  // namespace mudlark

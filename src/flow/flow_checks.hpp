#pragma once
/// What is read off the water's fields: gauges, sums, and places for messages. All but the texts
/// are collective.
#include <string>

#include "grid/field.hpp"
#include "grid/halo.hpp"

namespace mudlark {

/// The faces of one side of the domain (for ranks that touch it).
template <int D>
IndexBox<D> wall_faces(const Grid<D>& grid, int axis, int side);
template <int D>
void zero_wall(const Grid<D>& grid, int axis, int side, FaceField<D>& field);

/// Cell centre of a position in the local arrays, and its text "(x, z) = (.., ..) m".
template <int D>
Vec<D> place_of(const Grid<D>& grid, std::ptrdiff_t at);
template <int D>
std::string place_text(const Vec<D>& position);
/// Centre of the cell whose value is largest in size, or not finite, over all ranks. Collective.
template <int D>
Vec<D> place_of_largest(const Grid<D>& grid, const CellField<D>& field);
/// Empty, or a sentence that names the first place where a value is not finite.
template <int D>
std::string not_finite(const Grid<D>& grid, const IndexBox<D>& box, const double* values,
                       const char* quantity);

/// 1/2 rho sum over faces of M_f v^2 [J], J/m in 2D.
template <int D>
double kinetic_energy(const Grid<D>& grid, const CellField<D>& water, const FaceVector<D>& velocity,
                      double density);
/// rho sum over faces of M_f v [kg m/s], per metre in 2D.
template <int D>
Vec<D> momentum(const Grid<D>& grid, const CellField<D>& water, const FaceVector<D>& velocity,
                double density);
/// Largest face velocity beside a cell with water (more than a millionth of it), and its cell's
/// centre.
template <int D>
double fastest_water(const Grid<D>& grid, const CellField<D>& water, const FaceVector<D>& velocity,
                     Vec<D>& position);
/// This rank's cells of the column that holds a position; the position on the domain's upper end
/// belongs to the last column.
template <int D>
IndexBox<D> own_column(const Grid<D>& grid, const Vec<D>& position);
/// Top of the uppermost cell with alpha >= 1/2 in the column, corrected by what that cell lacks and
/// the cell above holds.
template <int D>
double surface_height(const Grid<D>& grid, const CellField<D>& saturation, const Vec<D>& position);
/// The same towards larger x, the farthest of all rows.
template <int D>
double water_front(const Grid<D>& grid, const CellField<D>& saturation);
/// Linear interpolation of a cell field (axis = -1) or of the faces of an axis.
template <int D>
double interpolate(const Grid<D>& grid, const double* values, int axis, const Vec<D>& position);

}  // namespace mudlark

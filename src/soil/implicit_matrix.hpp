#pragma once
/// The assembled matrix of a Newton iteration, for the direct solver.
#include <vector>

#include "soil/implicit_tangent.hpp"
#include "soil/implicit_unknowns.hpp"
#include "soil/petsc_handle.hpp"

namespace mudlark {

/// A matrix with room for what `add_jacobian` writes. Collective.
template <int D>
void make_matrix(const Grid<D>& grid, Kernel kernel, const ImplicitUnknowns<D>& unknowns,
                 MatHandle& matrix);

/// Adds what the points contribute in a step of length `dt` [s]; rows of the cells are multiplied
/// by `water_scale` [Pa/m].
template <int D>
void add_jacobian(const Grid<D>& grid, Kernel kernel, const ImplicitUnknowns<D>& unknowns,
                  const std::vector<LinearPoint<D>>& points, double dt, double water_scale,
                  ::Mat matrix);

}  // namespace mudlark

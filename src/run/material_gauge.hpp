#pragma once
/// Values of the soil at a material place: where a point of the continuum that started at `at` is
/// now.
#include <array>
#include <vector>

#include "soil/soil_solver.hpp"

namespace mudlark {

/// What a material gauge can read, per component, in this order.
enum class MaterialQuantity { displacement, pore_pressure, effective_stress, porosity };

/// Reads a quantity at the material place `at` (its position at time zero) by a weighted
/// least-squares fit, linear in the initial position, to the points that started within 1.5 cells:
/// exact for linear fields, so a gauge on the surface reads the surface and not the nearest point.
/// Collective; empty when no soil started there.
template <int D>
std::vector<double> read_material(const Grid<D>& grid, const SoilSolver<D>& soil,
                                  MaterialQuantity quantity, const Vec<D>& at);

}  // namespace mudlark

#pragma once
/// Particle-to-grid and grid-to-particle transfers on the staggered grid.
#include <vector>

#include "grid/field.hpp"
#include "soil/nodes.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"

namespace mudlark {

/// Pressure on the soil's surface, extended smoothly into the soil, at cell centres [Pa].
template <int D>
struct SurfacePressure {
  const CellField<D>* traction = nullptr;  ///< on the mixture: loads and water; null: none
  const CellField<D>* drained = nullptr;   ///< pressure that pore water drains against; null: zero
};

/// Constants of the body whose points are transferred.
struct BodyConstants {
  double grain_density;           ///< [kg/m3]
  double start_porosity;          ///< [-]
  double water_density;           ///< [kg/m3]; 0: no pore water
  double water_viscosity;         ///< [Pa s]
  double intrinsic_permeability;  ///< at the start [m2]
  PermeabilityLaw permeability_law;
  bool in_grid_water = false;  ///< the pores hold water of the flow
};

/// kappa [m2] at porosity n: constant, or Kozeny-Carman kappa_0 (n/n_0)^3 ((1-n_0)/(1-n))^2.
double permeability(const BodyConstants& body, double porosity);

/// Adds mass, momentum, volume, drag and forces of the points to the faces around them.
/// Internal forces: -sum V sigma grad W. Surface pressure as a virtual stress (NUMERICS A5):
/// f = -sum V (grad W p_e + W grad p_e), which needs no surface and leaves sigma = -p_e I at rest
/// exactly. `quadratic` and `composite` kernels take points a cell at a time (cell_scatter.cpp).
template <int D>
void points_to_grid(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                    Kernel kernel, Transfer transfer, const SurfacePressure<D>& surface,
                    NodeField<NodeSums, D>& nodes);

/// What the stress update needs of the grid's motion, per point.
struct PointMotion {
  std::vector<double>
      gradient;  ///< dt * dv_i/dx_j [-], component (i, j) of all points, then the next
  std::vector<double> flux_divergence;  ///< div(v_s + n (v_f - v_s)) [1/s]; only with pore water
  /// Rise of pore pressure where a projection found it [Pa]; empty: it follows from the divergence.
  std::vector<double> pressure_rise;
  double largest_speed = 0.0;  ///< of the grains [m/s]; infinite when not a number
  std::size_t strays = 0;      ///< points met outside the cell that they were sorted into
};

/// How points follow the grid.
struct PointUpdate {
  double flip_fraction, dt;  ///< [-], [s]
  bool pore_water;
};

/// Moves the points with the grid and updates their velocities:
/// FLIP/PIC  v_p <- f (v_p + dv) + (1 - f) v  (Brackbill & Ruppel 1986), or APIC (Jiang et al.
/// 2015). Only the points of `range`; `motion` then starts with the first of them.
template <int D>
void grid_to_points(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes, Kernel kernel,
                    Transfer transfer, const PointUpdate& update, PointRange range,
                    SoilParticles<D>& points, PointMotion& motion);
/// The same for all points.
template <int D>
void grid_to_points(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes, Kernel kernel,
                    Transfer transfer, double flip_fraction, double dt, bool pore_water,
                    SoilParticles<D>& points, PointMotion& motion) {
  grid_to_points(grid, nodes, kernel, transfer, PointUpdate{flip_fraction, dt, pore_water},
                 PointRange{0, points.size()}, points, motion);
}

/// Both transfers one point after the other, for any kernel: the reference that the faster paths
/// are tested against, and the path of `linear`.
template <int D>
void points_to_grid_one_by_one(const Grid<D>& grid, const SoilParticles<D>& points,
                               const BodyConstants& body, Kernel kernel, Transfer transfer,
                               const SurfacePressure<D>& surface, NodeField<NodeSums, D>& nodes);
template <int D>
void grid_to_points_one_by_one(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes,
                               Kernel kernel, Transfer transfer, const PointUpdate& update,
                               PointRange range, SoilParticles<D>& points, PointMotion& motion);

/// Adds `weight` times V_grains / V_cell of the points to the cells around them, with the
/// across-axis spline: weight 1 gives the solid fraction [-].
template <int D>
void add_solid_fraction(const Grid<D>& grid, const SoilParticles<D>& points, double grain_density,
                        Kernel kernel, double weight, CellField<D>& solid_fraction);

}  // namespace mudlark

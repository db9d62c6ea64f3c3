#pragma once
/// Friction of closed walls whose boundary layer is thinner than a cell.
#include "flow/options.hpp"
#include "grid/field.hpp"

namespace mudlark {

/// Shear stress [Pa] of a smooth wall on water that passes with the mean tangential speed [m/s] of
/// a layer of the given thickness [m]: the law of Werner & Wengle (1991, Eqs. 8-9), integrated over
/// the layer: u+ = y+ below y+ = 11.81, u+ = 8.3 y+^(1/7) above. Viscosity is kinematic [m2/s].
double werner_wengle_stress(double speed, double thickness, double density, double viscosity);

inline constexpr double von_karman = 0.41;
/// y+ = u+ where the viscous sublayer meets the logarithmic law.
inline constexpr double sublayer_thickness = 11.53;
/// Shear stress [Pa] of a smooth wall on water with a tangential speed [m/s] at a distance [m]:
/// u+ = y+ in the viscous sublayer, u+ = ln(9.8 y+) / kappa beyond. Viscosity is kinematic [m2/s].
double log_law_stress(double speed, double distance, double density, double viscosity);

/// Sets the resistance [Pa s/m2] per volume of water, -resistance * v [N/m3], that no-slip walls
/// give to the first row of faces along them beyond the linear profile that the viscous term
/// resolves; zero elsewhere. Where the water is a film thinner than a cell, the film carries the
/// stress. `water` is the water volume per cell volume [-]; ghosts of the inputs valid.
template <int D>
void find_wall_friction(const Grid<D>& grid, const FlowOptions& options,
                        const CellField<D>& saturation, const FaceVector<D>& velocity,
                        FaceVector<D>& resistance);

}  // namespace mudlark

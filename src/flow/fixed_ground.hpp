#pragma once
/// Rigid porous ground of the case file as the flow's porous medium.
#include "flow/drag_laws.hpp"
#include "flow/options.hpp"
#include "flow/porous_medium.hpp"

namespace mudlark {

/// Coefficients of one ground's drag law at its porosity.
DragCoefficients drag_of(const PorousGround& ground, const FlowOptions& water);

/// Adds the fixed ground, with its added mass as drag: porosity by the share of each cell inside
/// the shapes, drag by the share of each face's own cell-sized box inside (half where a mound's
/// edge runs along the face: resistances in series). Where grounds overlap the later one counts.
/// Values hold in the ghost layers too; grains stand still.
template <int D>
void fill_fixed_ground(const Grid<D>& grid, const FlowOptions& options, PorousMedium<D>& medium);

/// The ground that fills at least half of each face's box, counted from 1; 0: none. Owned faces.
template <int D>
void number_grounds(const Grid<D>& grid, const FlowOptions& options, FaceVector<D>& number);

extern template void number_grounds(const Grid<2>&, const FlowOptions&, FaceVector<2>&);
extern template void number_grounds(const Grid<3>&, const FlowOptions&, FaceVector<3>&);
extern template void fill_fixed_ground(const Grid<2>&, const FlowOptions&, PorousMedium<2>&);
extern template void fill_fixed_ground(const Grid<3>&, const FlowOptions&, PorousMedium<3>&);

}  // namespace mudlark

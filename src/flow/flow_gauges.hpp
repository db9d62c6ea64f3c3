#pragma once
/// What instruments of a laboratory read off the water: flow through a section, surfaces over a
/// place, run-up, energy. All are collective and the same on all ranks.
#include <vector>

#include "flow/porous_medium.hpp"
#include "grid/field.hpp"
#include "grid/halo.hpp"

namespace mudlark {

/// A plane across an axis, or a part of it. Water is counted on the plane of faces nearest to
/// `place`; faces at the edges of the part count by the share of them inside.
template <int D>
struct FlowSection {
  int axis = 0;
  double place = 0.0;  ///< [m]
  Vec<D> from, to;     ///< [m]; the entries of `axis` mean nothing
};

/// Sum over the section of `through`, the water that passed each face as a share of a cell's
/// volume, towards larger coordinates [m^D]. This rank's part only: many sections share one
/// reduction.
template <int D>
double own_water_through(const Grid<D>& grid, const FaceVector<D>& through,
                         const FlowSection<D>& section);

/// Heights at which the column of cells through a position turns from water to none or back, from
/// the top down [m]. One column with waves that do not break has one; an overturning wave has
/// three. Empty without water.
template <int D>
std::vector<double> surfaces_over(const Grid<D>& grid, const CellField<D>& saturation,
                                  const Vec<D>& position);

/// Where run-up is looked for.
template <int D>
struct RunUpRange {
  Vec<D> from, to;  ///< [m], columns whose centres lie between; vertical entries mean nothing
  double thickness = 0.0;  ///< of the water on the ground that counts as wet [m]
};

/// Highest water surface among the columns in which water stands at least `thickness` deep on the
/// ground: on its topmost cell with grains, on the mean surface of a body in the column, or on the
/// domain's bottom. Water above a gap (spray, an overturning crest) does not count. NaN where all
/// is dry [m].
template <int D>
double run_up(const Grid<D>& grid, const CellField<D>& saturation, const PorousMedium<D>& medium,
              const RunUpRange<D>& range);

/// rho |g| integral of the height over the domain's lower end, over the water [J], J/m in 2D; in
/// the surface's cells over the part below its plane.
template <int D>
double potential_energy(const Grid<D>& grid, const CellField<D>& water,
                        const CellField<D>& saturation, double density);

}  // namespace mudlark

#pragma once
/// Planar interface in a cell (PLIC): plane constant from volume, volume from plane, in cell units.
///
/// The cell is the unit square or cube; water fills the part m.x <= c. The normal m points out of
/// the water.
#include "base/vec.hpp"

namespace mudlark {

template <int D>
struct Plane {
  Vec<D> normal;          ///< out of the water, any length, cell units
  double constant = 0.0;  ///< water where normal.x <= constant, x in 0..1
};

/// Share of the unit cell below the plane, for any sign and length of the normal.
/// Scardovelli & Zaleski (2000), J. Comput. Phys. 164, eqs. 3-6, arranged so that no small
/// component of the normal is divided by.
template <int D>
double volume_below(const Plane<D>& plane);

/// Plane with the given normal that cuts off `fraction` (0..1) of the unit cell.
/// Scardovelli & Zaleski (2000), sec. 3; the cubic root is polished by one Newton step.
template <int D>
Plane<D> plane_of_volume(const Vec<D>& normal, double fraction);

/// Water in the slab from..from+width of the cell along an axis, as a share of the cell.
template <int D>
double water_in_slab(const Plane<D>& plane, int axis, double from, double width);

/// Interface normal -grad(alpha) by the mixed Youngs-centred method (Aulisa, Manservisi,
/// Scardovelli & Zaleski 2007, J. Comput. Phys. 225, sec. 2.2) from the 3^D saturations around
/// `alpha[0]`; stride[a] steps along axis a. Sum of |components| is 1.
template <int D>
Vec<D> interface_normal(const double* alpha, const std::ptrdiff_t* stride);

}  // namespace mudlark

#pragma once
/// All that the flow knows of the ground: a fixed mound fills this from the case file, moving soil
/// from coupling/. (Architecture, "the central idea".)
#include "grid/space.hpp"

namespace mudlark {

template <int D>
struct PorousMedium {
  explicit PorousMedium(const Grid<D>& grid);

  bool moves = false;     ///< do grains come and go from step to step?
  Space<D> space;         ///< what rigid bodies leave free *now*
  CellField<D> porosity;  ///< n [-], 1 in open water; what the medium's grains leave of that *now*
  FaceVector<D> grain_flux;  ///< (1-theta_f) v_s [m/s], volume flux of grains and bodies through
                             ///< faces; 0 if fixed
  FaceVector<D> grain_velocity;  ///< v_s [m/s]
  FaceVector<D> linear_drag;     ///< A of the pressure loss (A + B|w|) w, w = n(v - v_s) [Pa s/m2]
  FaceVector<D> quadratic_drag;  ///< B [Pa s2/m3]
  FaceVector<D> added_mass;  ///< C_A rho (1-n)/n [kg/m3]: what fixed grains add to the inertia of
                             ///< the water between them, per volume of it
  CellField<D> suction;   ///< of the water's surface between grains, less where they are fewer [Pa]
  CellField<D> residual;  ///< n S_r, water per volume that stays with the grains [-]
  CellField<D> at_start;  ///< n S, the same that is there where no body of water is [-]
  CellField<D> drains;    ///< 1 where water in partly filled pores goes by a relative permeability
  CellField<D> give_way;  ///< volume rate per volume and pressure rise over the step [1/(Pa s)]:
                          ///< how easily the ground gives way; 0 for rigid ground
};

}  // namespace mudlark

#pragma once
/// Grains that share one pressure with the water around and between them (NUMERICS C2).
#include "base/pore_filling.hpp"
#include "flow/residual_water.hpp"
#include "grid/field.hpp"

namespace mudlark {

/// What the grains bring to a step, on faces, and what they take from it. Where there are none all
/// is zero.
template <int D>
struct MovingGrains {
  explicit MovingGrains(const Grid<D>& grid)
      : inertia(grid, "grain inertia", "kg/m3"),
        share(grid, "grain share", "1"),
        force(grid, "grain force", "N/m3"),
        resistance(grid, "resistance", "Pa s/m2"),
        velocity(grid, "grain velocity", "m/s"),
        room(grid, "room", "1", 1.0) {}

  FaceVector<D> inertia;     ///< M_s, mass of grains per volume [kg/m3]
  FaceVector<D> share;       ///< phi_f, volume of grains per volume [-]
  FaceVector<D> force;       ///< on the grains, pressure and drag apart: stress and weight [N/m3]
  FaceVector<D> resistance;  ///< A of the drag theta^2 A (v_f - v_s) on them: mu/kappa [Pa s/m2]
  FaceVector<D> velocity;    ///< v_s [m/s]: before the step, then after it
  PoreFilling filling;       ///< how the pores let water pass where they are not full
  bool hold_water = false;   ///< is there suction between them?
  FaceVector<D> room;  ///< what bodies and fixed ground leave of a face to grains and water [-]
  bool fill_faces = false;  ///< do the shares of both add up to that room? Else each has its own
};

/// Momentum of water and grains on the faces of a step, drag implicit, and how both answer to a
/// pressure gradient:
///   [M_s + dt b, -dt b; -dt b, M_l + dt b] [v_s; v_f] = [M_s v_s + dt f; M_l v_f] - dt [phi;
///   theta] grad p,   b = theta^2 A.
/// The drag stands inside the operator of the pressure, so no permeability bounds the step.
template <int D>
class GrainsInWater {
 public:
  explicit GrainsInWater(const Grid<D>& grid);

  /// `velocity` is that of the water under all but pressure and grains, `mobility` its answer
  /// alone, dt / (rho + ...) [m2 s/kg]; both become those of the two together, as does
  /// grains.velocity. `water`, free in the room `porosity`, and `unknown` (cells with a pressure)
  /// need ghosts, as does grains.share; `reach` is that of the pressure at a face [cells]: only
  /// grains under the surface feel it (flow/grains_at_surface.hpp). `residual` (or null) hangs on
  /// the grains. Closed walls hold both. Owned and bounding faces.
  void couple(const FaceVector<D>& capacity, const CellField<D>& water,
              const CellField<D>& porosity, const CellField<D>& unknown, const FaceVector<D>& reach,
              const ResidualWater<D>* residual, double dt, FaceVector<D>& velocity,
              FaceVector<D>& mobility, MovingGrains<D>& grains);

  /// theta v_f + phi v_s from both velocities, which walls may have been given since.
  void find_flux(const FaceVector<D>& velocity, const MovingGrains<D>& grains);
  /// That flux [m/s], and what a unit pressure gradient takes from it and from v_s.
  FaceVector<D>& flux() { return flux_; }
  FaceVector<D>& flux_mobility() { return flux_mobility_; }
  FaceVector<D>& grain_mobility() { return grain_mobility_; }
  FaceVector<D>& water_share() { return water_share_; }  ///< of a face, in that flux [-]
  /// Room for the force of menisci on the grains [N/m3], until couple() finds the rims.
  FaceVector<D>& menisci() { return scratch_; }
  /// Of the ground at the surface (find_rims()), after couple(), without ghosts.
  FaceVector<D>& rims() { return scratch_; }
  const FaceVector<D>& whole() const { return whole_; }  ///< 1 everywhere: the flux is whole

 private:
  void find_shares(const FaceVector<D>& capacity, FaceVector<D>& mobility, MovingGrains<D>& grains);

  const Grid<D>* grid_;
  FaceVector<D> flux_, flux_mobility_, grain_mobility_;
  FaceVector<D> water_share_;  ///< that the water answers to pressure with: theta_f as a rule [-]
  FaceVector<D> scratch_, whole_;
};

extern template class GrainsInWater<2>;
extern template class GrainsInWater<3>;

}  // namespace mudlark

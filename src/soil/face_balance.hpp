#pragma once
/// Momentum of grains and pore water on one face.
#include <algorithm>
#include <cmath>

#include "soil/nodes.hpp"
#include "soil/options.hpp"

namespace mudlark {

/// Does the face carry motion of its own? Lighter ones than this share of a full one do not.
inline bool carries_motion(const NodeSums& sums, double face_volume) {
  return sums.volume >= 1e-12 * face_volume;
}
/// Where the surface of the soil is sealed, water and grains move together at the soil's rim:
/// faces with less than this share of a cell's volume.
inline bool tied(bool sealed, const NodeSums& sums, double face_volume) {
  return sealed && sums.volume < 0.9 * face_volume;
}

/// What holds a face beside its own inertia.
struct FaceHold {
  double grains = 0.0, water = 0.0;  ///< dashpots [kg/s], springs times the step included
  bool locked = false;               ///< do grains and water move together?
};

/// Velocities of both phases along the face's axis [m/s].
struct PhaseVelocity {
  double grains = 0.0, water = 0.0;
};

/// Share of the rise of pore pressure that moves the mixture in the formulation u-p, against the
/// rise of the step before: p + 1/4 (rise - last rise) is centred in the step, neither damps waves
/// nor lets them grow, and holds at any step (docs/decisions/0016).
inline constexpr double centred_rise = 0.25;

/// The balance of momentum over a step dt. u-w and u-w-p, drag implicit (NUMERICS A1, C2):
///   [M_s + dt b, -dt b; -dt b, M_l + dt b] [v_s; v_f]' = [M_s v_s + dt F_s; M_l v_f + dt F_f];
/// u-p, relative acceleration dropped (NUMERICS A2):
///   (M_s + M_l) a_s = F_s + F_f,  b (v_f - v_s) = F_f - i M_l a_s,
/// i = 1 with the inertia of the mixture in Darcy's law, otherwise 0. Where the phases are `tied`
/// they move as one.
class FaceBalance {
 public:
  FaceBalance(const NodeSums& sums, const SoilOptions& options, double dt, bool tied,
              const FaceHold& hold = {})
      : sums_(sums),
        options_(options),
        dt_(dt),
        porosity_(sums.water_mass > 0.0
                      ? std::min(1.0, sums.water_mass / (options.water_density * sums.volume))
                      : 0.0),
        grain_mass_(options.mass_scaling * sums.grain_mass + dt * hold.grains),
        water_mass_(options.mass_scaling * sums.water_mass + dt * hold.water),
        drag_(dt * sums.drag),
        dry_(!(sums.water_mass > 0.0)),
        tied_(tied || hold.locked) {}

  double porosity() const { return porosity_; }
  PhaseVelocity old() const {
    const double grains = sums_.grain_momentum / sums_.grain_mass;
    return {grains, dry_ ? grains : sums_.water_momentum / sums_.water_mass};
  }
  /// Under the forces in the sums, without damping.
  PhaseVelocity moved() const {
    const double water_force = porosity_ * sums_.water_force;
    const double grain_force = sums_.mixture_force - water_force;
    if (quasi_static_water()) {
      const double change = dt_ * sums_.mixture_force / (grain_mass_ + water_mass_);
      const double grains = old().grains + change;
      return {grains, grains + slip(dt_ * water_force, change)};
    }
    return solve(options_.mass_scaling * sums_.grain_momentum + dt_ * grain_force,
                 options_.mass_scaling * sums_.water_momentum + dt_ * water_force);
  }
  /// Less local damping (Cundall 1987): a share of the unbalanced force against the motion, each
  /// phase by itself; in u-p water goes with the grains.
  PhaseVelocity damped(const PhaseVelocity& now, const PhaseVelocity& before) const {
    PhaseVelocity left = now;
    left.grains = damped(options_.damping, now.grains, before.grains);
    if (dry_)
      left.water = left.grains;
    else if (quasi_static_water())
      left.water += left.grains - now.grains;
    else
      left.water =
          damped(options_.water_damping.value_or(options_.damping), now.water, before.water);
    return left;
  }
  /// Change of velocity per impulse of pore pressure on the whole face [m/s per N s].
  PhaseVelocity answer() const {
    if (!quasi_static_water()) return solve(1.0 - porosity_, porosity_);
    const double grains = centred_rise / (grain_mass_ + water_mass_);
    return {grains, grains + slip(porosity_, grains)};
  }
  /// Grains and water through a unit of area [m/s]: v_s + n (v_f - v_s).
  double flux(const PhaseVelocity& v) const { return v.grains + porosity_ * (v.water - v.grains); }

 private:
  bool quasi_static_water() const { return options_.formulation == Formulation::u_p; }
  PhaseVelocity solve(double grains, double water) const {
    if (dry_) return {grains / grain_mass_, grains / grain_mass_};
    if (tied_) {
      const double both = (grains + water) / (grain_mass_ + water_mass_);
      return {both, both};
    }
    const double determinant = grain_mass_ * water_mass_ + drag_ * (grain_mass_ + water_mass_);
    return {(grains * (water_mass_ + drag_) + drag_ * water) / determinant,
            (water * (grain_mass_ + drag_) + drag_ * grains) / determinant};
  }
  /// v_f - v_s by Darcy's law, from impulses on the water and the change of v_s.
  double slip(double water_impulse, double change) const {
    if (dry_ || tied_) return 0.0;
    const double inertia = options_.inertia_in_darcy ? water_mass_ * change : 0.0;
    return (water_impulse - inertia) / drag_;
  }
  static double damped(double coefficient, double now, double old) {
    if (coefficient == 0.0) return now;
    return now - coefficient * std::copysign(std::abs(now - old), old);
  }

  const NodeSums& sums_;
  const SoilOptions& options_;
  double dt_, porosity_, grain_mass_, water_mass_, drag_;
  bool dry_, tied_;
};

}  // namespace mudlark

#pragma once
/// Waves made and absorbed in zones where water and velocity relax towards a known motion.
#include <memory>
#include <string>
#include <vector>

#include "flow/wave_theory.hpp"
#include "grid/field.hpp"

namespace mudlark {

/// What is relaxed in a zone. water_and_velocity: makes waves, or absorbs them towards a level;
/// velocity: a sponge, which takes motion away and leaves the level alone.
enum class ZoneAction { water_and_velocity, velocity };

/// A part of the domain between two positions along a horizontal axis. At `outer` water is what the
/// wave says, at `inner` it is free. The wave goes from outer to inner; still water absorbs.
struct WaveZoneOptions {
  std::string name;
  WaveKind wave;
  int axis = 0;                     ///< 0: x, 1: y (3D)
  double outer = 0.0, inner = 0.0;  ///< [m] along the axis
  double still_level = 0.0;         ///< height of still water [m]
  double depth = 0.0;               ///< of still water [m]
  double ramp = 0.0;                ///< over which the wave grows, half a cosine [s]
  double direction = 0.0;  ///< of the wave against the way inwards, towards the other axis [rad]
  double current = 0.0;    ///< uniform, along the axis (not: inwards) [m/s]
  ZoneAction action = ZoneAction::water_and_velocity;
  double damping = 0.0;  ///< of a sponge at its outer end [1/s]
};

/// Share of the wave that is there while it grows.
double ramp_share(double ramp, double time);

/// The motion that a zone relaxes towards, in its own frame.
std::unique_ptr<const WaveMotion> make_wave(const WaveZoneOptions& zone, double gravity);

/// Relaxation zones of Jacobsen, Fuhrman & Fredsoe (2012), Int. J. Numer. Meth. Fluids 70, eqs.
/// 6-7: q <- chi q + (1 - chi) q_target, chi = 1 - (exp(s^3.5) - 1) / (e - 1), s = 1 at the outer
/// end. chi is raised to dt / tau, tau = 0.02 sqrt(d/g), so that the zone does not depend on the
/// step. A sponge damps by dv/dt = -D (v - v_target), D growing from 0 to `damping` with s^2.
template <int D>
class WaveZones {
 public:
  WaveZones(const Grid<D>& grid, const std::vector<WaveZoneOptions>& options);

  bool empty() const { return zones_.empty(); }
  /// Blends W of the owned cells towards the wave at `time` [s] over a step dt [s]. Returns the
  /// volume that this rank added [m^D].
  double blend_water(const CellField<D>& porosity, double time, double dt,
                     CellField<D>& water) const;
  /// Blends the velocity of bounding faces that have water, now or in the wave.
  void blend_velocity(const CellField<D>& water, double time, double dt, FaceVector<D>& velocity);

 private:
  struct Zone {
    WaveZoneOptions options;
    std::unique_ptr<const WaveMotion> motion;
    double relaxation_time;  ///< tau [s]
  };
  double share(const Zone& zone, double position, double dt) const;
  WavePlace place_in(const Zone& zone, const Vec<D>& position) const;
  double level(const Zone& zone, const WavePlace& place, double time) const;
  void blend_column(const Zone& zone, int component, const Index<D>& lowest, int count,
                    const CellField<D>& water, double time, double taken, FaceField<D>& velocity);

  const Grid<D>* grid_;
  std::vector<Zone> zones_;
  std::vector<double> heights_;        ///< of the faces of one column above still water [m]
  std::vector<WaveVelocity> motions_;  ///< there
};

extern template class WaveZones<2>;
extern template class WaveZones<3>;

}  // namespace mudlark

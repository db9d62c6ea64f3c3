#pragma once
/// Waves made and absorbed in zones where water and velocity relax towards a known motion.
#include <string>
#include <vector>

#include "flow/wave_theory.hpp"
#include "grid/field.hpp"

namespace mudlark {

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
};

/// Relaxation zones of Jacobsen, Fuhrman & Fredsoe (2012), Int. J. Numer. Meth. Fluids 70, eqs.
/// 6-7: q <- chi q + (1 - chi) q_target, chi = 1 - (exp(s^3.5) - 1) / (e - 1), s = 1 at the outer
/// end. chi is raised to dt / tau, tau = 0.02 sqrt(d/g), so that the zone does not depend on the
/// step.
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
  void blend_velocity(const CellField<D>& water, double time, double dt,
                      FaceVector<D>& velocity) const;

 private:
  struct Zone {
    WaveZoneOptions options;
    WaveMotion motion;
    double relaxation_time;  ///< tau [s]
  };
  double share(const Zone& zone, double position, double dt) const;
  double way(const Zone& zone, double position) const;
  double level(const Zone& zone, double position, double time) const;

  const Grid<D>* grid_;
  std::vector<Zone> zones_;
};

extern template class WaveZones<2>;
extern template class WaveZones<3>;

}  // namespace mudlark

#pragma once
/// Where the energy of the soil goes.
#include <algorithm>

#include "soil/nodes.hpp"
#include "soil/particles.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// Work since the start [J] (J/m in the plane), over all ranks. Balance: external = internal + drag
/// + damping + change of kinetic energy + what the scheme itself takes (transfers, time step).
struct SoilEnergy {
  double start_kinetic = 0.0;
  double external = 0.0;  ///< of gravity, loads and given accelerations on grains and pore water
  double internal = 0.0;  ///< of effective stress and pore pressure: stored, or lost in yielding
  double drag = 0.0;      ///< lost between grains and pore water
  double damping = 0.0;   ///< lost to local damping

  SoilEnergy& operator+=(const SoilEnergy& other) {
    external += other.external, internal += other.internal;
    drag += other.drag, damping += other.damping;
    return *this;
  }
  template <class Archive>
  void archive(Archive& a) {
    a.number("soil/energy/start kinetic", start_kinetic);
    a.number("soil/energy/external", external);
    a.number("soil/energy/internal", internal);
    a.number("soil/energy/drag", drag);
    a.number("soil/energy/damping", damping);
  }
};

/// Adds what one face does in a step dt [s]: force times new velocity is the work of all forces on
/// grains and water, internal ones included (`external` takes it; internal work is added to it
/// later); momentum that the forces gave and the face did not get went into drag and damping.
/// `water_density` [kg/m3] gives the face its porosity, `inertia` [-] scales its mass,
/// `water_change` is the change of velocity [m/s] that the water's inertia answers to.
inline void add_face_work(const NodeSums& sums, const NodeMotion& motion, double water_density,
                          double inertia, double water_change, double dt, SoilEnergy& energy) {
  const double porosity =
      sums.water_mass > 0.0 ? std::min(1.0, sums.water_mass / (water_density * sums.volume)) : 0.0;
  const double water_force = porosity * sums.water_force;
  const double grain_force = sums.mixture_force - water_force;
  const double work =
      dt * (grain_force * motion.grain_velocity + water_force * motion.water_velocity);
  const double gained = inertia * (sums.grain_mass * motion.grain_change * motion.grain_velocity +
                                   sums.water_mass * water_change * motion.water_velocity);
  const double slip = motion.water_velocity - motion.grain_velocity;
  const double drag = dt * sums.drag * slip * slip;
  energy.external += work;
  energy.drag += drag;
  energy.damping += work - gained - drag;
}

/// Work of the present stresses on the motion of a step [J]: sum V (sigma' : grad v - p div (v_s +
/// n (v_f - v_s))) dt. With the stresses before the step it is what the faces' forces did; the mean
/// of before and after is the work of second order in the step.
template <int D>
double internal_work(const SoilParticles<D>& points, PointRange range, const PointMotion& motion,
                     double dt, bool pore_water);

}  // namespace mudlark

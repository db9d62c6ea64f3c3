#pragma once
/// Volumes and pore pressures that follow the motion of a step.
#include "soil/transfer.hpp"

namespace mudlark {

/// V <- det(I + dt grad v) V, and with pore water p <- p - dt K_w/n div(v_s + n (v_f - v_s)), n
/// the new porosity (mass balance of the water, NUMERICS A1), or p <- p + `motion.pressure_rise`.
/// `motion` starts with the first point of `range`. Returns how many points have no pores left.
template <int D>
std::size_t update_volumes(const PointMotion& motion, const BodyConstants& body,
                           double water_bulk_modulus, double dt, PointRange range,
                           SoilParticles<D>& points);

}  // namespace mudlark

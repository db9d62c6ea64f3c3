#include "coupling/grain_drag.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/around_face.hpp"

namespace mudlark {
namespace {

/// Gravity that exponents of hindered settling go with, whatever the case's own [m/s2].
constexpr double standard_gravity = 9.81;

/// 0 up to `lower`, 1 from `upper` on, with a continuous slope.
double smooth_step(double x, double lower, double upper) {
  const double t = std::clamp((x - lower) / (upper - lower), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

/// Soulsby's velocity is the root of 1.049 (s-1) g d^3/nu^2 = r^2 + 20.72 r, r = v d/nu: a grain's
/// weight under water equals a drag that is linear and quadratic in v, phi (rho_s - rho) g = phi (a
/// v + b v^2).
GrainDragLaw::GrainDragLaw(double viscosity, double water_density, double grain_density,
                           double diameter)
    : packed_{viscosity, water_density, diameter} {
  constexpr double linear = 10.36, cubic = 1.049;
  const double nu = viscosity / water_density;
  const double excess = std::abs(grain_density / water_density - 1.0);
  const double size = excess * standard_gravity * diameter * diameter * diameter / (nu * nu);
  settling_velocity_ = nu / diameter * (std::sqrt(linear * linear + cubic * size) - linear);
  const double reynolds = std::pow(settling_velocity_ * diameter / nu, 0.75);
  exponent_ = (4.7 + 0.41 * reynolds) / (1.0 + 0.175 * reynolds);
  single_ = {2.0 * linear / cubic * viscosity / (diameter * diameter),
             water_density / (cubic * diameter)};
}

/// In a cloud that settles, grains and water move against each other by v_0 n^(N-1), and the drag
/// phi n (rho_s - rho) g carries the weight in the mixture. So w = v_0 n^N, and each power of w
/// goes with its own power of n.
DragCoefficients GrainDragLaw::operator()(double porosity) const {
  const double grains = 1.0 - porosity;
  const double hindered = std::pow(porosity, -exponent_);
  const DragCoefficients sparse{grains * single_.linear * hindered,
                                grains * single_.quadratic * hindered * hindered};
  const double share = smooth_step(grains, cloud, bed);
  if (share == 0.0) return sparse;
  const DragCoefficients dense = packed_(porosity);
  return {sparse.linear + share * (dense.linear - sparse.linear),
          sparse.quadratic + share * (dense.quadratic - sparse.quadratic)};
}

template <int D>
GrainDrag<D>::GrainDrag(const Grid<D>& grid, const SoilOptions& options) : grid_(&grid) {
  const SoilBody& body = options.bodies.front();
  if (body.grain_diameter > 0.0)
    law_.emplace(options.water_viscosity, options.water_density, body.grain_density,
                 body.grain_diameter);
}

/// The law counts with the grains of the cells, the face has its own share of them: lone points are
/// dragged by what they are.
template <int D>
void GrainDrag<D>::find(const SoilInWater<D>& room, const Space<D>& space,
                        const FaceVector<D>& water, MovingGrains<D>& grains) const {
  constexpr double sparsest = 1e-9;
  for (int axis = 0; axis < D; ++axis)
    for_each(grid_->owned_faces(axis), [&](const Index<D>& face) {
      // Beside bodies a face's grains stand in its open part, and water resists only there.
      const double open = space.aperture[axis][face], share = grains.share[axis][face];
      grains.resistance[axis][face] = 0.0;
      if (share == 0.0 || open == 0.0) return;
      const double fraction =
          std::clamp(room.fraction_at(axis, face), sparsest, 1.0 - room.least_porosity);
      const Vec<D> slip =
          velocity_around(axis, face, water) - velocity_around(axis, face, grains.velocity);
      const DragCoefficients drag = (*law_)(1.0 - fraction);
      grains.resistance[axis][face] =
          share / (fraction * open * open) *
          (drag.linear + drag.quadratic * (1.0 - fraction) * norm(slip));
    });
}

template class GrainDrag<2>;
template class GrainDrag<3>;

}  // namespace mudlark

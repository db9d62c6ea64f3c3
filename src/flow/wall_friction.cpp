#include "flow/wall_friction.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

constexpr double power_factor = 8.3, power = 1.0 / 7.0;
/// Thinner films count as this share of a cell: their stress would stop them within a step.
constexpr double thinnest_film = 0.05;

/// Friction of one wall on one component along it.
template <int D>
void add_friction(const Grid<D>& grid, const FlowOptions& options, int axis, int side,
                  int component, const CellField<D>& saturation, const FaceVector<D>& velocity,
                  FaceVector<D>& resistance) {
  const double h = grid.width(axis, side == 0 ? 0 : grid.cells()[axis] - 1),
               nu = options.viscosity / options.density;
  const std::ptrdiff_t inwards = side == 0 ? grid.stride(axis) : -grid.stride(axis);
  const std::ptrdiff_t sc = grid.stride(component);
  IndexBox<D> row = bounding_faces(grid, component);
  row.lower[axis] = side == 0 ? 0 : grid.cells()[axis] - 1;
  row.upper[axis] = row.lower[axis] + 1;
  const double* w = saturation.data();
  const double* v = velocity[component].data();
  double* out = resistance[component].data();
  for_each_offset(grid, row, [&](std::ptrdiff_t at) {
    double speed2 = v[at] * v[at];
    for (int other = 0; other < D; ++other) {
      if (other == axis || other == component) continue;
      const double* u = velocity[other].data();
      const std::ptrdiff_t so = grid.stride(other);
      const double mean = 0.25 * (u[at] + u[at + so] + u[at - sc] + u[at + so - sc]);
      speed2 += mean * mean;
    }
    // Two rows of cells tell a film on the wall from a surface that meets the wall.
    const double first = 0.5 * (w[at] + w[at - sc]);
    const double second = 0.5 * (w[at + inwards] + w[at + inwards - sc]);
    const double film = h * std::clamp(first + second, thinnest_film, 1.0);
    const double speed = std::sqrt(speed2);
    const double resolved = 2.0 * options.viscosity * speed / film;
    const double stress = options.wall_law == WallLaw::logarithmic
                              ? log_law_stress(speed, 0.5 * film, options.density, nu)
                              : werner_wengle_stress(speed, film, options.density, nu);
    double beyond = stress > resolved ? (stress - resolved) / (speed * film) : 0.0;
    if (options.gas) beyond *= std::min((first + second) / thinnest_film, 1.0);  // none on gas
    out[at] += beyond;
  });
}

}  // namespace

double werner_wengle_stress(double speed, double thickness, double density, double viscosity) {
  constexpr double a = power_factor, b = power;
  const double per_thickness = viscosity / thickness;
  if (speed <= 0.5 * per_thickness * std::pow(a, 2.0 / (1.0 - b)))
    return 2.0 * density * per_thickness * speed;
  const double friction =
      0.5 * (1.0 - b) * std::pow(a, (1.0 + b) / (1.0 - b)) * std::pow(per_thickness, 1.0 + b) +
      (1.0 + b) / a * std::pow(per_thickness, b) * speed;
  return density * std::pow(friction, 2.0 / (1.0 + b));
}

/// Newton's method for x = u / u_tau, x = ln(E Re / x) / kappa with Re = u y / nu.
double log_law_stress(double speed, double distance, double density, double viscosity) {
  constexpr double roughness = 9.8;  // E of a smooth wall
  const double reynolds = speed * distance / viscosity;
  if (reynolds <= sublayer_thickness * sublayer_thickness)
    return density * viscosity * speed / distance;
  double x = sublayer_thickness;
  for (int k = 0; k < 20; ++k) {
    const double miss = x - std::log(roughness * reynolds / x) / von_karman;
    const double step = miss / (1.0 + 1.0 / (von_karman * x));
    x -= step;
    if (std::abs(step) < 1e-12 * x) break;
  }
  const double u_tau = speed / x;
  return density * u_tau * u_tau;
}

template <int D>
void find_wall_friction(const Grid<D>& grid, const FlowOptions& options,
                        const CellField<D>& saturation, const FaceVector<D>& velocity,
                        FaceVector<D>& resistance) {
  resistance.fill(0.0);
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(axis, side) || grid.wall(axis, side) != Wall::no_slip) continue;
      for (int component = 0; component < D; ++component)
        if (component != axis)
          add_friction(grid, options, axis, side, component, saturation, velocity, resistance);
    }
}

template void find_wall_friction(const Grid<2>&, const FlowOptions&, const CellField<2>&,
                                 const FaceVector<2>&, FaceVector<2>&);
template void find_wall_friction(const Grid<3>&, const FlowOptions&, const CellField<3>&,
                                 const FaceVector<3>&, FaceVector<3>&);

}  // namespace mudlark

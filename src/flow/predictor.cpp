#include "flow/predictor.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {

template <int D>
Predictor<D>::Predictor(const Grid<D>& grid, const CellRuns<D>& beside, const FlowOptions& options)
    : grid_(&grid),
      beside_(&beside),
      density_(options.density),
      viscosity_(options.viscosity),
      gas_density_(options.gas ? options.gas->density : 0.0),
      gas_viscosity_(options.gas ? options.gas->viscosity : 0.0),
      viscous_(grid),
      body_(grid, options),
      water_viscosity_(grid, "viscosity", "Pa s", options.viscosity),
      acceleration_(grid, "viscous acceleration", "m/s2") {
  const auto inverse_square = [](double length) { return 1.0 / (length * length); };
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    for (int i = grid.local().lower[a]; i < grid.local().upper[a]; ++i) {
      across_cell_[u].push_back(inverse_square(grid.width(a, i)));
      // No stencil reaches across the lowest face of the ghost layers.
      across_face_[u].push_back(inverse_square(grid.gap(a, std::max(i, -ghost_layers + 1))));
    }
  }
}

/// (1/theta_f) div(theta nu grad v) of one component: the Brinkman term of the porous flow
/// (NUMERICS B1) without the transposed gradient, which vanishes for constant theta and viscosity.
/// On stretched axes it is the Laplacian in the grid's own coordinates: d is the distance over
/// which the velocity changes, and the capacities hold the areas and volumes.
template <int D>
void Predictor<D>::find_viscous_acceleration(int component, const double* porosity,
                                             const double* velocity, double* out) const {
  const Grid<D>& grid = *grid_;
  const double nu = viscosity_ / density_;
  const std::ptrdiff_t sa = grid.stride(component);
  for_each_place(
      *beside_, bounding_faces(grid, component),
      [&](std::ptrdiff_t at, const Index<D>& face) {
        double sum = 0.0;
        for (int axis = 0; axis < D; ++axis) {
          const std::ptrdiff_t s = grid.stride(axis);
          double below, above;  // capacity where the momentum passes
          if (axis == component) {
            below = porosity[at - s];
            above = porosity[at];
          } else {
            const double middle = porosity[at] + porosity[at - sa];
            below = 0.25 * (middle + porosity[at - s] + porosity[at - s - sa]);
            above = 0.25 * (middle + porosity[at + s] + porosity[at + s - sa]);
          }
          const auto u = static_cast<std::size_t>(axis);
          const auto i = static_cast<std::size_t>(face[axis] - grid.local().lower[axis]);
          const bool along = axis == component;
          above *= along ? across_cell_[u][i] : across_face_[u][i + 1];
          below *= along ? across_cell_[u][i - 1] : across_face_[u][i];
          sum +=
              above * (velocity[at + s] - velocity[at]) - below * (velocity[at] - velocity[at - s]);
        }
        const double held = 0.5 * (porosity[at] + porosity[at - sa]);
        out[at] = held > 0.0 ? nu * sum / held : 0.0;
      },
      velocity + grid.stride(D - 1), porosity + grid.stride(D - 1), out);
}

namespace {

/// Square of the seepage velocity w = n (v - v_s) at a face; other components from their four
/// neighbours.
template <int D>
double seepage_squared(const Grid<D>& grid, int component, const FaceVector<D>& velocity,
                       const FaceVector<D>& grains, double porosity, std::ptrdiff_t at) {
  double square = 0.0;
  const std::ptrdiff_t sa = grid.stride(component);
  for (int axis = 0; axis < D; ++axis) {
    const double* v = velocity[axis].data();
    const double* g = grains[axis].data();
    double slip = v[at] - g[at];
    if (axis != component) {
      const std::ptrdiff_t s = grid.stride(axis);
      slip += v[at - sa] - g[at - sa] + v[at + s] - g[at + s] + v[at + s - sa] - g[at + s - sa];
      slip *= 0.25;
    }
    square += slip * slip;
  }
  return square * porosity * porosity;
}

/// Water alone: the same density and weight on all faces. `share` scales the water's added mass.
struct WaterAlone {
  double mass, gravity;
  double density(std::ptrdiff_t) const { return mass; }
  double weight(std::ptrdiff_t) const { return gravity; }
  double share(std::ptrdiff_t) const { return 1.0; }
};

/// Water and gas: density and weight face by face.
struct WaterAndGas {
  const double *mass, *acceleration;
  double water;
  double density(std::ptrdiff_t at) const { return mass[at]; }
  double weight(std::ptrdiff_t at) const { return acceleration[at]; }
  /// Added mass is that of the fluid that is pushed aside.
  double share(std::ptrdiff_t at) const { return mass[at] / water; }
};

}  // namespace

/// Viscous acceleration of all components, and in `mobility` the resistance R for a while: both
/// need the old velocity of all components.
template <int D>
void Predictor<D>::find_forces(const PorousMedium<D>& medium, const CellField<D>& porosity,
                               const FaceVector<D>& capacity, const Mixture<D>* mixture,
                               const CellField<D>* eddy, const FaceVector<D>& velocity,
                               FaceVector<D>& resistance) {
  const Grid<D>& grid = *grid_;
  for (int a = 0; a < D; ++a) {
    double* viscous = acceleration_[a].data();
    const double* rho = mixture ? mixture->density[a].data() : nullptr;
    if (mixture || eddy) {
      viscous_.find(a, mixture ? mixture->viscosity : water_viscosity_, eddy,
                    mixture ? Mean::harmonic : Mean::arithmetic, porosity, velocity,
                    acceleration_[a]);
      for_each_apart(*beside_, bounding_faces(grid, a),
                     [&](std::ptrdiff_t at) { viscous[at] /= mixture ? rho[at] : density_; });
    } else {
      find_viscous_acceleration(a, porosity.data(), velocity[a].data(), viscous);
    }
    const double* theta = capacity[a].data();
    const double* aperture = medium.space.aperture[a].data();
    const double* linear = medium.linear_drag[a].data();
    const double* quadratic = medium.quadratic_drag[a].data();
    double* r = resistance[a].data();
    for_each_apart(
        *beside_, bounding_faces(grid, a),
        [&](std::ptrdiff_t at) {
          const double open = aperture[at] > 0.0 ? theta[at] / aperture[at] : 1.0;  // n_f
          const double wet = mixture ? water_share(rho[at]) : 1.0;
          double loss = linear[at];
          if (wet < 1.0 && loss > 0.0) loss *= wet + (1.0 - wet) * gas_viscosity_ / viscosity_;
          if (quadratic[at] > 0.0) {
            const double inertia = wet < 1.0 ? quadratic[at] * rho[at] / density_ : quadratic[at];
            loss += inertia *
                    std::sqrt(seepage_squared(grid, a, velocity, medium.grain_velocity, open, at));
          }
          r[at] = open * loss;
        },
        theta, aperture, linear, quadratic, r);
  }
}

template <int D>
double Predictor<D>::water_share(double density) const {
  return density_ > gas_density_
             ? std::clamp((density - gas_density_) / (density_ - gas_density_), 0.0, 1.0)
             : 1.0;
}

template <int D>
void Predictor<D>::advance(const PorousMedium<D>& medium, const CellField<D>& porosity,
                           const FaceVector<D>& capacity, const FaceVector<D>& wall_friction,
                           double time, double dt, const Mixture<D>* mixture,
                           const CellField<D>* eddy, FaceVector<D>& velocity,
                           FaceVector<D>& mobility) {
  const Grid<D>& grid = *grid_;
  find_forces(medium, porosity, capacity, mixture, eddy, velocity, mobility);
  for (int a = 0; a < D; ++a) {
    body_.add(a, time + 0.5 * dt, acceleration_[a]);
    const double* viscous = acceleration_[a].data();
    const double* grains = medium.grain_velocity[a].data();
    const double* friction = wall_friction[a].data();
    const double* added = medium.added_mass[a].data();
    const double* theta = capacity[a].data();
    double* v = velocity[a].data();
    double* m = mobility[a].data();
    const auto push = [&](const auto& fluid) {
      for_each_apart(
          *beside_, bounding_faces(grid, a),
          [&](std::ptrdiff_t at) {
            const double resistance = m[at], rho = fluid.density(at);
            const double inertia = added[at] * fluid.share(at);
            m[at] = dt / (rho + inertia + dt * (resistance + friction[at]));
            v[at] = (rho * (v[at] + dt * (fluid.weight(at) + viscous[at])) + inertia * v[at] +
                     dt * resistance * grains[at]) *
                    (m[at] / dt);
            if (theta[at] == 0.0) v[at] = 0.0;
          },
          viscous, grains, friction, added, theta, v, m);
    };
    if (mixture)
      push(WaterAndGas{mixture->density[a].data(), mixture->acceleration[a].data(), density_});
    else
      push(WaterAlone{density_, grid.gravity()[a]});
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(a, side) || grid.wall(a, side) == Wall::open) continue;
      IndexBox<D> wall = grid.owned();
      wall.lower[a] = side == 0 ? wall.lower[a] : wall.upper[a];
      wall.upper[a] = wall.lower[a] + 1;
      for_each_offset(grid, wall, [&](std::ptrdiff_t at) { v[at] = 0.0; });
    }
  }
}

template class Predictor<2>;
template class Predictor<3>;

}  // namespace mudlark

#include "flow/turbulence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/flow_checks.hpp"
#include "flow/wall_friction.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Smallest k [m2/s2] and epsilon [m2/s3]: they are divided by.
constexpr double least_k = 1e-12, least_epsilon = 1e-14;
constexpr double lambda_2 = 0.05;
/// The eddies of a filtered flow end in ground: full above this porosity, none below the other.
constexpr double open_ground = 1.0, closed_ground = 0.8;

double squared(double x) { return x * x; }

}  // namespace

KEpsilon produce_and_decay(KEpsilon state, double production, double production_of_epsilon,
                           double dt) {
  using C = KEpsilonConstants;
  const auto produce = [&] {
    state.k = std::max(state.k + 0.5 * dt * production, least_k);
    state.epsilon = std::max(state.epsilon + 0.5 * dt * production_of_epsilon, least_epsilon);
  };
  produce();
  const double turns = 1.0 + (C::c2 - 1.0) * dt * state.epsilon / state.k;
  const double factor = std::pow(turns, -1.0 / (C::c2 - 1.0));
  state.k *= factor;
  state.epsilon *= factor / turns;
  produce();
  return state;
}

double limited_eddy_viscosity(KEpsilon state, double strain2, double rotation2) {
  using C = KEpsilonConstants;
  const double plain = C::c_mu * state.k * state.k / state.epsilon;
  // epsilon times the larger of 1 and lambda_2 C2/C1 strain2 / rotation2.
  const double strained = lambda_2 * C::c2 / C::c1 * strain2;
  return strained > rotation2 ? plain * rotation2 / strained : plain;
}

template <int D>
Turbulence<D>::Turbulence(const Grid<D>& grid, const FlowOptions& options)
    : grid_(&grid),
      options_(options.turbulence),
      density_(options.density),
      gas_density_(options.gas ? options.gas->density : options.density),
      viscosity_(options.viscosity / options.density),
      everywhere_(options.gas.has_value()),
      ghosts_(grid),
      eddy_(grid, "eddy viscosity", "m2/s"),
      dynamic_(grid, "dynamic eddy viscosity", "Pa s"),
      k_(grid, "turbulent energy", "m2/s2", options_.initial_k),
      epsilon_(grid, "dissipation", "m2/s3"),
      strain2_(grid, "strain", "1/s2"),
      rotation2_(grid, "rotation", "1/s2"),
      old_(grid, "old", "1"),
      wall_production_(grid, "production at walls", "m2/s3", -1.0),
      wall_distance_(grid, "distance to walls", "m", std::numeric_limits<double>::infinity()),
      grain_size_(grid, "grain size", "m") {
  epsilon_.fill(KEpsilonConstants::c_mu * squared(options_.initial_k) /
                (options_.initial_viscosity_ratio * viscosity_));
  find_grain_size(options);
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (grid.wall(axis, side) != Wall::no_slip) continue;
      const double wall = side == 0 ? grid.lower()[axis] : grid.upper()[axis];
      for_each(grid.owned(), [&](const Index<D>& cell) {
        const double distance = std::abs(grid.cell_centre(cell)[axis] - wall);
        wall_distance_[cell] = std::min(wall_distance_[cell], distance);
      });
    }
}

template <int D>
void Turbulence<D>::find_grain_size(const FlowOptions& options) {
  for (const PorousGround& ground : options.porous)
    for_each(grid_->owned(), [&](const Index<D>& cell) {
      const Vec<D> centre = grid_->cell_centre(cell);
      Vec<D> half;
      for (int a = 0; a < D; ++a) half[a] = 0.5 * grid_->width(a, cell[a]);
      if (fraction_inside(ground.shape, to_point3(centre - half), to_point3(centre + half), D) >
          0.0)
        grain_size_[cell] = ground.grain_size;
    });
}

/// Each cell takes the mean of what it held and what came in: upwind of first order, which keeps k
/// and epsilon within their neighbours' range.
template <int D>
void Turbulence<D>::move(const CellField<D>& mass, const FaceVector<D>& mass_flux) {
  if (options_.model != TurbulenceModel::k_epsilon) return;
  const Grid<D>& grid = *grid_;
  const double* now = mass.data();
  for (CellField<D>* field : {&k_, &epsilon_}) {
    old_.copy_values_from(*field);
    const double* old = old_.data();
    double* value = field->data();
    for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {
      double came_in = 0.0, gained = 0.0;
      for (int axis = 0; axis < D; ++axis) {
        const double* flux = mass_flux[axis].data();
        const std::ptrdiff_t s = grid.stride(axis);
        const double lower = std::max(flux[at], 0.0), upper = std::max(-flux[at + s], 0.0);
        came_in += lower + upper;
        gained += lower * (old[at - s] - old[at]) + upper * (old[at + s] - old[at]);
      }
      if (came_in > 0.0) value[at] += gained / std::max(now[at], came_in);
    });
    ghosts_.update(*field);
  }
}

/// Between wet cells, explicit: div((nu + nu_t / sigma) grad) with the mean nu_t of two cells.
template <int D>
void Turbulence<D>::diffuse(const CellField<D>& alpha, double share, double dt,
                            CellField<D>& field) {
  const Grid<D>& grid = *grid_;
  old_.copy_values_from(field);
  const double *old = old_.data(), *nu_t = eddy_.data(), *wetness = alpha.data();
  double* value = field.data();
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    for_each_place(grid, grid.owned(), [&](std::ptrdiff_t at, const Index<D>& cell) {
      if (!wet(wetness[at])) return;
      const auto through = [&](std::ptrdiff_t other, int face, int side) {
        const bool wall = (face == 0 || face == grid.cells()[axis]) && grid.touches(axis, side) &&
                          !grid.periodic(axis);
        if (wall || !wet(wetness[other])) return 0.0;
        const double diffusivity = viscosity_ + share * 0.5 * (nu_t[at] + nu_t[other]);
        return diffusivity * (old[other] - old[at]) / grid.gap(axis, face);
      };
      value[at] += dt / grid.width(axis, cell[axis]) *
                   (through(at - s, cell[axis], 0) + through(at + s, cell[axis] + 1, 1));
    });
  }
}

/// Square of the speed at a cell's centre, without the component along an axis (-1: with all).
template <int D>
double Turbulence<D>::speed2(const FaceVector<D>& velocity, std::ptrdiff_t at, int without) const {
  double sum = 0.0;
  for (int a = 0; a < D; ++a)
    if (a != without)
      sum += squared(0.5 * (velocity[a].data()[at] + velocity[a].data()[at + grid_->stride(a)]));
  return sum;
}

/// Cells along a no-slip wall are in equilibrium in the logarithmic layer: production u_tau^3 /
/// (kappa y), epsilon = C_mu^(3/4) k^(3/2) / (kappa y), y the distance of the centre from the wall.
template <int D>
void Turbulence<D>::find_wall_row(int axis, int side, const CellField<D>& alpha,
                                  const FaceVector<D>& velocity) {
  const Grid<D>& grid = *grid_;
  if (!grid.touches(axis, side) || grid.wall(axis, side) != Wall::no_slip) return;
  IndexBox<D> row = grid.owned();
  row.lower[axis] = side == 0 ? 0 : grid.cells()[axis] - 1;
  row.upper[axis] = row.lower[axis] + 1;
  for_each_place(grid, row, [&](std::ptrdiff_t at, const Index<D>& cell) {
    if (!wet(alpha.data()[at])) return;
    const double y = 0.5 * grid.width(axis, cell[axis]);
    const double u = std::sqrt(speed2(velocity, at, axis));
    const double u_tau = std::sqrt(log_law_stress(u, y, 1.0, viscosity_));
    const bool logarithmic = y * u_tau > sublayer_thickness * viscosity_;
    const double production = logarithmic ? u_tau * u_tau * u_tau / (von_karman * y) : 0.0;
    wall_production_.data()[at] = std::max(wall_production_.data()[at], production);
  });
}

template <int D>
void Turbulence<D>::advance(const PorousMedium<D>& medium, const CellField<D>& alpha,
                            const FaceVector<D>& velocity, double dt) {
  if (options_.model == TurbulenceModel::k_epsilon) react(medium, alpha, velocity, dt);
  const double *share = alpha.data(), *nu_t = eddy_.data();
  double* mu_t = dynamic_.data();
  for_each_offset(*grid_, grid_->local(), [&](std::ptrdiff_t at) {
    mu_t[at] = (gas_density_ + share[at] * (density_ - gas_density_)) * nu_t[at];
  });
}

template <int D>
void Turbulence<D>::react(const PorousMedium<D>& medium, const CellField<D>& alpha,
                          const FaceVector<D>& velocity, double dt) {
  using C = KEpsilonConstants;
  const Grid<D>& grid = *grid_;
  diffuse(alpha, 1.0 / C::sigma_k, dt, k_);
  diffuse(alpha, 1.0 / C::sigma_epsilon, dt, epsilon_);
  wall_production_.fill(-1.0);
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) find_wall_row(axis, side, alpha, velocity);
  const double *n = medium.porosity.data(), *grain = grain_size_.data(), *nu_t = eddy_.data();
  for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {
    double &k = k_.data()[at], &epsilon = epsilon_.data()[at];
    k = std::max(k, least_k);
    epsilon = std::max(epsilon, least_epsilon);
    if (!wet(alpha.data()[at])) return;
    const double at_wall = wall_production_.data()[at];
    double production = at_wall >= 0.0 ? at_wall : nu_t[at] * strain2_.data()[at];
    double of_epsilon = C::c1 * production * epsilon / k;
    if (n[at] < 1.0 && grain[at] > 0.0) {  // Nakayama & Kuwahara (1999), v between the grains
      const double u2 = speed2(velocity, at, -1);
      const double k_in_pores = 3.7 * (1.0 - n[at]) * std::pow(n[at], 1.5) * u2;
      const double epsilon_in_pores =
          39.0 * std::pow(1.0 - n[at], 2.5) * squared(n[at]) * u2 * std::sqrt(u2) / grain[at];
      production += epsilon_in_pores;
      of_epsilon += C::c2 * squared(epsilon_in_pores) / std::max(k_in_pores, least_k);
    }
    const KEpsilon next = produce_and_decay({k, epsilon}, production, of_epsilon, dt);
    k = next.k;
    epsilon = next.epsilon;
    if (at_wall >= 0.0)
      epsilon = std::max(
          std::pow(C::c_mu, 0.75) * std::pow(k, 1.5) / (von_karman * wall_distance_.data()[at]),
          least_epsilon);
  });
}

/// 2 S_ij S_ij and 2 Omega_ij Omega_ij at cell centres; derivatives across are means over the two
/// faces of the cell.
template <int D>
void Turbulence<D>::find_rates(const FaceVector<D>& velocity) {
  const Grid<D>& grid = *grid_;
  for_each_place(grid, grid.owned(), [&](std::ptrdiff_t at, const Index<D>& cell) {
    const auto derivative = [&](int component, int axis) {
      const double* v = velocity[component].data();
      const std::ptrdiff_t sc = grid.stride(component), s = grid.stride(axis);
      if (component == axis) return (v[at + s] - v[at]) / grid.width(axis, cell[axis]);
      return 0.5 * (v[at + s] - v[at - s] + v[at + sc + s] - v[at + sc - s]) /
             (grid.gap(axis, cell[axis]) + grid.gap(axis, cell[axis] + 1));
    };
    double strain = 0.0, rotation = 0.0;
    for (int a = 0; a < D; ++a) {
      strain += 2.0 * squared(derivative(a, a));
      for (int b = 0; b < a; ++b) {
        const double ab = derivative(a, b), ba = derivative(b, a);
        strain += squared(ab + ba);
        rotation += squared(ab - ba);
      }
    }
    strain2_.data()[at] = strain;
    rotation2_.data()[at] = rotation;
  });
}

template <int D>
void Turbulence<D>::find(const PorousMedium<D>& medium, const CellField<D>& alpha,
                         const FaceVector<D>& velocity) {
  const Grid<D>& grid = *grid_;
  find_rates(velocity);
  const double* n = medium.porosity.data();
  const bool filtered = options_.model == TurbulenceModel::smagorinsky;
  for_each_place(grid, grid.owned(), [&](std::ptrdiff_t at, const Index<D>& cell) {
    double& nu_t = eddy_.data()[at];
    nu_t = 0.0;
    if (!wet(alpha.data()[at])) return;
    if (filtered) {
      double volume = 1.0;
      for (int a = 0; a < D; ++a) volume *= grid.width(a, cell[a]);
      const double length = std::min(options_.constant * std::pow(volume, 1.0 / D),
                                     von_karman * wall_distance_.data()[at]);
      const double open = (n[at] - closed_ground) / (open_ground - closed_ground);
      nu_t = length * length * std::sqrt(strain2_.data()[at]) * std::clamp(open, 0.0, 1.0);
    } else {
      nu_t = limited_eddy_viscosity({k_.data()[at], epsilon_.data()[at]}, strain2_.data()[at],
                                    rotation2_.data()[at]);
    }
  });
  update_ghosts();
}

template <int D>
void Turbulence<D>::update_ghosts() {
  const Grid<D>& grid = *grid_;
  ghosts_.update(eddy_);
  if (options_.model == TurbulenceModel::k_epsilon) {
    ghosts_.update(k_);
    ghosts_.update(epsilon_);
  }
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(axis, side) || grid.wall(axis, side) != Wall::no_slip) continue;
      IndexBox<D> behind = grid.local();
      if (side == 0)
        behind.upper[axis] = grid.owned().lower[axis];
      else
        behind.lower[axis] = grid.owned().upper[axis];
      double* nu_t = eddy_.data();
      for_each_offset(grid, behind, [&](std::ptrdiff_t at) { nu_t[at] = -nu_t[at]; });
    }
}

template <int D>
double Turbulence<D>::largest() const {
  double largest = 0.0;
  const double* nu_t = eddy_.data();
  for_each_offset(*grid_, grid_->owned(),
                  [&](std::ptrdiff_t at) { largest = std::max(largest, nu_t[at]); });
  return max_over_ranks(*grid_, largest);
}

template <int D>
std::vector<const CellField<D>*> Turbulence<D>::fields() const {
  if (options_.model == TurbulenceModel::k_epsilon) return {&eddy_, &k_, &epsilon_};
  return {&eddy_};
}

template class Turbulence<2>;
template class Turbulence<3>;

}  // namespace mudlark

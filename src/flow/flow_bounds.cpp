/// The flow's step: how long it may be, and what must hold after it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "flow/flow_checks.hpp"
#include "flow/flow_solver.hpp"
#include "numerics/loops.hpp"
#include "parallel/collective_error.hpp"

namespace mudlark {
namespace {

/// W may leave 0..theta by no more than this: round-off of the sweeps.
constexpr double bound_tolerance = 1e-12;
/// Less water than this does not limit the step: what it could overshoot by is far within the
/// tolerance.
constexpr double nothing = 1e-13;

/// Rates of volume into and out of a cell, per volume of a cell [1/s].
struct InAndOut {
  double in = 0.0, out = 0.0;
};

}  // namespace

/// Largest of sum of inflow and sum of outflow per pore volume of a cell [1/s]; only fluxes that
/// can carry something count: all of them in cells with a pressure, else those whose donor holds
/// water.
template <int D>
double FlowSolver<D>::courant_rate() const {
  const Grid<D>& grid = *grid_;
  const double* w = free_water().data();
  const double* theta = free_room().data();
  double fastest = 0.0;
  const auto sums = [&](std::ptrdiff_t at) {
    const bool all = gas_ || InterfaceAdvection<D>::dilates(w[at], theta[at]);
    const bool wet = gas_ || w[at] > nothing;
    InAndOut sum;
    for (int axis = 0; axis < D; ++axis) {
      const std::ptrdiff_t s = grid.stride(axis);
      const double inverse = 1.0 / grid.spacing()[axis];
      const double* v = velocity_[axis].data();
      const double* capacity = capacity_[axis].data();
      const double lower = capacity[at] * v[at] * inverse;
      const double upper = capacity[at + s] * v[at + s] * inverse;
      if (lower > 0.0 && (all || w[at - s] > nothing)) sum.in += lower;
      if (upper < 0.0 && (all || w[at + s] > nothing)) sum.in -= upper;
      if (wet) sum.out += std::max(-lower, 0.0) + std::max(upper, 0.0);
    }
    return sum;
  };
  const std::vector<SmallCell>& small = solids_.walls().small();
  auto pair = small.begin();  // both loops go from place to place upwards
  for_each_offset(
      near_.cells(), grid.owned(),
      [&](std::ptrdiff_t at) {
        InAndOut sum = sums(at);
        double room = theta[at];
        // A small cell and its host move as one.
        while (pair != small.end() && pair->at < at) ++pair;
        if (pair != small.end() && pair->at == at) {
          const InAndOut hosts = sums(pair->host);
          sum.in += hosts.in, sum.out += hosts.out, room += theta[pair->host];
        }
        if (room > 0.0) fastest = std::max(fastest, std::max(sum.in, sum.out) / room);
      },
      w + grid.stride(D - 1), theta, velocity_.data(), capacity_.data());
  return max_over_ranks(grid, fastest);
}

template <int D>
double FlowSolver<D>::stable_step(const PorousMedium<D>&) const {
  const Grid<D>& grid = *grid_;
  const double h = grid.smallest_spacing();
  double step = options_.courant / std::max(courant_rate(), 1e-300);
  const double gravity = norm(grid.gravity()) + predictor_.largest_body_acceleration(time_);
  if (gravity > 0.0)
    step = std::min(step, 2.0 * options_.courant * std::sqrt(h / (std::numbers::pi * gravity)));
  if (options_.viscosity > 0.0)
    step = std::min(step, h * h * options_.density / (6.0 * options_.viscosity));
  // At the surface a face may be lighter than the edges beside it are viscous: up to four times.
  if (gas_ && options_.gas->viscosity > 0.0)
    step = std::min(step, h * h * options_.gas->density / (24.0 * options_.gas->viscosity));
  if (turbulence_)  // a little below 1/6: the viscosity varies, and its stress is symmetric
    step = std::min(
        step, h * h / (8.0 * (options_.viscosity / options_.density + turbulence_->largest())));
  return solids_.moving() ? solids_.limited_step(time_, step) : step;
}

template <int D>
void FlowSolver<D>::check_step(double dt) const {
  const double rate = courant_rate();
  if (rate * dt > 0.5 + 1e-9) {
    const FastestPlace<D> fastest = max_speed();
    throw DivergenceError(
        fmt::format("The water's step of {:.4g} s is too large: at most {:.4g} s keep the surface "
                    "bounded (fastest water {:.4g} m/s at {}). Use a smaller step.",
                    dt, 0.5 / rate, fastest.speed, place_text(fastest.position)));
  }
}

template <int D>
void FlowSolver<D>::check_bounds(const CellRuns<D>& where) const {
  const Grid<D>& grid = *grid_;
  const double* w = water_.data();
  const double* theta = porosity_.data();
  double worst = bound_tolerance;
  std::ptrdiff_t place = -1;
  for_each_offset(where, grid.owned(), [&](std::ptrdiff_t at) {
    const double beyond = std::max(-w[at], w[at] - theta[at]);
    if (beyond > worst || std::isnan(beyond)) worst = beyond, place = at;
  });
  std::string problem;
  if (place >= 0) {
    const Vec<D> position = place_of(grid, place);
    problem =
        fmt::format("The water fraction left its bounds at {}: {:.17g} in a porosity of {:.17g}.",
                    place_text(position), w[place], theta[place]);
  }
  throw_divergence_if_any(grid.comm(), problem);
}

template <int D>
void FlowSolver<D>::check_finite() const {
  std::string problem =
      not_finite(*grid_, grid_->owned(), pressure_.data(), "pressure of the water");
  for (int axis = 0; axis < D && problem.empty(); ++axis)
    problem = not_finite(*grid_, grid_->owned(), velocity_[axis].data(), "velocity of the water");
  throw_divergence_if_any(grid_->comm(), problem);
}

template double FlowSolver<2>::courant_rate() const;
template double FlowSolver<3>::courant_rate() const;
template double FlowSolver<2>::stable_step(const PorousMedium<2>&) const;
template double FlowSolver<3>::stable_step(const PorousMedium<3>&) const;
template void FlowSolver<2>::check_step(double) const;
template void FlowSolver<3>::check_step(double) const;
template void FlowSolver<2>::check_bounds(const CellRuns<2>&) const;
template void FlowSolver<3>::check_bounds(const CellRuns<3>&) const;
template void FlowSolver<2>::check_finite() const;
template void FlowSolver<3>::check_finite() const;

}  // namespace mudlark

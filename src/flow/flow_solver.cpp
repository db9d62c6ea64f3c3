#include "flow/flow_solver.hpp"

#include <algorithm>
#include <cmath>

#include "flow/flow_checks.hpp"
#include "flow/percolation.hpp"
#include "flow/wall_friction.hpp"
#include "numerics/loops.hpp"
#include "parallel/stopwatch.hpp"

namespace mudlark {
namespace {

/// Share of the drift between transported and given porosity that one step takes back (NUMERICS C2
/// step 6).
constexpr double drift_feedback = 0.1;
/// With grains that give way to pressure it is taken back no faster than waves of one cell take:
/// what the points' places scatter would otherwise be pressure, and the more the shorter the steps
/// are (docs/decisions/0070). The same beside bodies that move: their cells close and open by what
/// the shares of a finite step say, and in a short step that would be a blow (0087).
template <int D>
double slow_feedback(const Grid<D>& grid) {
  const double gravity = norm(grid.gravity());
  return gravity > 0.0 ? std::sqrt(gravity / grid.smallest_spacing()) : HUGE_VAL;
}

}  // namespace

template <int D>
FlowSolver<D>::FlowSolver(const Grid<D>& grid, const FlowOptions& options)
    : grid_(&grid),
      options_(options),
      ghosts_(grid),
      near_(grid),
      everywhere_(grid),
      interface_(grid, near_.cells()),
      momentum_(grid, near_.cells()),
      predictor_(grid, near_.beside(), options),
      drained_(grid, options),
      projection_(grid, near_, options),
      extension_(grid, near_.cells()),
      waves_(grid, options.waves),
      sides_(grid, options.sides, options.density),
      sources_(grid, options.wave_sources),
      rain_(grid, options.rains),
      solids_(grid, options.solids, options.density),
      water_(grid, "water fraction", "1"),
      porosity_(grid, "porosity", "1", 1.0),
      pressure_(grid, "pressure", "Pa"),
      saturation_(grid, "saturation", "1"),
      velocity_(grid, "velocity", "m/s"),
      old_water_(grid, "old water fraction", "1"),
      new_porosity_(grid, "new porosity", "1", 1.0),
      target_(grid, "target divergence", "1/s"),
      no_storage_(grid, "storage", "1/(Pa s)"),
      seen_(grid, "saturation", "1"),
      loose_(grid, "loose", "1"),
      capacity_(grid, "capacity", "1", 1.0),
      flux_(grid, "flux", "m/s"),
      carried_(grid, "carried water", "1"),
      mobility_(grid, "mobility", "m2 s/kg"),
      wall_friction_(grid, "wall friction", "Pa s/m2"),
      body_friction_(grid, "body friction", "Pa s/m2") {
  if (options.gas) gas_.emplace(grid, options);
  if (options.turbulence.model != TurbulenceModel::none) turbulence_.emplace(grid, options);
  if (!options.ground_sides.empty())
    ground_sides_.emplace(grid, options.ground_sides, options.density);
  for (const PorousGround& ground : options.porous)
    if (ground.filling.residual > 0.0) keep_residual_water();
}

/// May anything but the flow's own steps change cells that are not near the water?
template <int D>
bool FlowSolver<D>::far_changes(const PorousMedium<D>& medium) const {
  return medium.moves || solids_.moving() || gas_ || residual_ || ground_sides_ ||
         !waves_.empty() || !sides_.empty() || !sources_.empty() || !rain_.empty();
}

/// Ghosts and what follows from W, theta and v; without a medium what grains hold stays as it is.
template <int D>
void FlowSolver<D>::update_derived(const CellRuns<D>& where, const PorousMedium<D>* medium) {
  ghosts_.update(water_, where);
  ghosts_.update(porosity_, where);
  ghosts_.update(pressure_, where);
  ghosts_.update_velocity(velocity_, where);
  if (residual_ && medium)
    residual_->hold(water_, porosity_, *medium);
  else if (residual_)
    residual_->release(water_, porosity_);
  const double* w = free_water().data();
  const double* theta = free_room().data();
  double* alpha = saturation_.data();
  for_each_apart(where, grid_->local(),
                 [&](std::ptrdiff_t at) { alpha[at] = theta[at] > 0.0 ? w[at] / theta[at] : 0.0; });
}

/// theta_f = aperture times the mean porosity of the room beside the face, on owned and bounding
/// faces, with bodies on ghost faces too. All that passes a face is this times its velocity, so
/// water, porosity and pressure agree.
template <int D>
void FlowSolver<D>::find_capacity(const PorousMedium<D>& medium) {
  const double* theta = porosity_.data();
  const double* volume = medium.space.volume.data();
  const auto porosity = [&](std::ptrdiff_t at) {
    return volume[at] > 0.0 ? theta[at] / volume[at] : 1.0;
  };
  for (int a = 0; a < D; ++a) {
    const std::ptrdiff_t s = grid_->stride(a);
    const double* aperture = medium.space.aperture[a].data();
    double* capacity = capacity_[a].data();
    const auto mean = [&](std::ptrdiff_t at) {
      capacity[at] = aperture[at] * (0.5 * (porosity(at) + porosity(at - s)));
    };
    if (solids_.empty()) {
      for_each_apart(near_.cells(), bounding_faces(*grid_, a), mean, theta, volume, aperture,
                     capacity);
      continue;
    }
    IndexBox<D> box = grid_->local();
    box.lower[a] += 1;
    for_each_offset(*grid_, box, mean);
  }
}

template <int D>
void FlowSolver<D>::fill_with_bodies(const PorousMedium<D>& medium) {
  const Grid<D>& grid = *grid_;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const Vec<D> centre = grid.cell_centre(cell);
    Vec<D> half;
    for (int a = 0; a < D; ++a) half[a] = 0.5 * grid.width(a, cell[a]);
    double share = 0.0;
    for (const WaterBody& body : options_.bodies)
      share += fraction_inside(body.shape, to_point3(centre - half), to_point3(centre + half), D);
    share = std::min(share, 1.0);
    const double elsewhere =
        std::min(medium.space.volume[cell] * medium.at_start[cell], porosity_[cell]);
    water_[cell] = share * porosity_[cell] + (1.0 - share) * elsewhere;
  });
  for (int axis = 0; axis < D; ++axis)
    for_each(grid.owned_faces(axis), [&](const Index<D>& face) {
      const Vec<D> centre = grid.face_centre(axis, face);
      Vec<D> half;
      for (int a = 0; a < D; ++a)
        half[a] = 0.5 * (a == axis ? grid.gap(a, face[a]) : grid.width(a, face[a]));
      const auto component = static_cast<std::size_t>(D == 2 && axis == 1 ? 2 : axis);
      if (gas_) velocity_[axis][face] = options_.gas->velocity[component](to_point3(centre), 0.0);
      for (const WaterBody& body : options_.bodies) {
        // A face belongs to a body that reaches into one of its cells.
        const double touched =
            fraction_inside(body.shape, to_point3(centre - half), to_point3(centre + half), D);
        if (touched > 0.0 && capacity_[axis][face] > 0.0)
          velocity_[axis][face] = body.velocity[component](to_point3(centre), 0.0);
      }
    });
}

template <int D>
void FlowSolver<D>::initialise(const PorousMedium<D>& medium) {
  const double* volume = medium.space.volume.data();
  const double* given = medium.porosity.data();
  double* theta = porosity_.data();
  for_each_offset(*grid_, grid_->local(),
                  [&](std::ptrdiff_t at) { theta[at] = volume[at] * given[at]; });
  if (ground_sides_) ghosts_.update(porosity_);  // what is behind sides says how they let through
  find_capacity(medium);
  fill_with_bodies(medium);
  update_derived(everywhere_, &medium);
  find_sides(0.0, &medium);
  find_near();
  initial_volume_ = ledger().present;
  outflow_ = time_ = 0.0;
  step_ = 0;
  find_unknowns();
  project_start(medium);
  hold_sides();
  if (turbulence_) turbulence_->find(medium, saturation_, velocity_);
}

template <int D>
void FlowSolver<D>::find_near(const PorousMedium<D>* medium) {
  if (gas_) return;  // nothing is far
  near_.find(water_, porosity_, velocity_, with_ground_, !medium || far_changes(*medium));
}

/// Where pressure acts, for the present water: in the water up to its surface, or everywhere.
template <int D>
void FlowSolver<D>::find_unknowns() {
  if (gas_) {
    gas_->find_mixture(water_, porosity_, saturation_);
    projection_.cover_all(porosity_, gas_->find_reference(saturation_));
    return;
  }
  const CellField<D>* seen = &saturation_;
  if (!solids_.walls().empty()) {
    seen_.copy_values_from(saturation_);
    solids_.walls().extend_saturation(porosity_, seen_);
    seen = &seen_;
  }
  projection_.find_surface(free_water(), free_room(), capacity_, *seen, interface_,
                           ground_sides_ ? &ground_sides_->passes() : nullptr);
  if (residual_) residual_->hang(projection_.unknown(), projection_.reach(), time_);
}

/// First the given velocity is made free of divergence (its pressure is an impulse and is thrown
/// away), then the pressure at rest follows from the velocity that gravity alone would give in one
/// second.
template <int D>
void FlowSolver<D>::project_start(const PorousMedium<D>& medium) {
  const Grid<D>& grid = *grid_;
  find_target(medium, 0.0, HUGE_VAL);
  for (int a = 0; a < D; ++a) {
    mobility_[a].fill(1.0 / options_.density);
    if (!gas_) continue;
    const double* rho = gas_->mixture().density[a].data();
    double* m = mobility_[a].data();
    for_each_offset(grid, bounding_faces(grid, a),
                    [&](std::ptrdiff_t at) { m[at] = 1.0 / rho[at]; });
  }
  if (gas_ || max_speed().speed > 0.0) {
    last_solve_ = projection_.project(capacity_, mobility_, target_, no_storage_, pressure_,
                                      velocity_, options_.pressure_tolerance);
    pressure_.fill(0.0);
  }
  if (gas_)
    ghosts_.update_velocity(velocity_);
  else
    extension_.extend(projection_.unknown(), free_water(), free_room(), capacity_, medium.drains,
                      velocity_);
  double round_off = 1e-300;  // what cancellation leaves of the divergence under the deepest water
  for (int a = 0; a < D; ++a) {
    round_off = std::max(
        round_off, 4e-15 * grid.cells()[a] * std::abs(grid.gravity()[a]) / grid.smallest_spacing());
    flux_[a].fill(grid.gravity()[a]);
    if (gas_) flux_[a].copy_values_from(gas_->mixture().acceleration[a]);
  }
  for (int a = 0; a < D; ++a) {  // no flow through closed walls
    for (int side = 0; side < 2; ++side)
      if (grid.touches(a, side) && grid.wall(a, side) != Wall::open)
        zero_wall(grid, a, side, flux_[a]);
  }
  sides_.push(mobility_, projection_.unknown(), flux_);
  if (ground_sides_) {
    ground_sides_->weigh(flux_);
    ground_sides_->push(mobility_, projection_.unknown(), flux_);
  }
  projection_.pull(mobility_, medium.suction, flux_);
  target_.fill(0.0);
  last_solve_ =
      projection_.project(capacity_, mobility_, target_, no_storage_, pressure_, flux_, round_off);
  flux_.fill(0.0);
}

/// Divergence that the water's flux must have: minus that of the grains, plus the share of the
/// drift between the transported porosity and the medium's that is taken back.
template <int D>
void FlowSolver<D>::find_target(const PorousMedium<D>& medium, double dt, double most) {
  const Grid<D>& grid = *grid_;
  const double* theta = porosity_.data();
  const double* porosity = medium.porosity.data();
  const double* volume = medium.space.volume.data();
  const double* stored = storage_ ? storage_->stored().data() : nullptr;
  double* target = target_.data();
  const double beside_bodies = solids_.moving() ? slow_feedback(grid) : HUGE_VAL;
  for_each_apart(
      near_.beside(), grid.owned(),
      [&](std::ptrdiff_t at) {
        const double given = volume[at] * porosity[at] + (stored ? stored[at] : 0.0);
        // Cells that close faster than that keep some room: without any they would dictate the
        // step.
        const double slowest = theta[at] < 0.5 * given ? HUGE_VAL : most;
        // Beside bodies the same, but little by little.
        const double narrow = given > 0.0 ? std::max(0.0, 1.0 - 2.0 * theta[at] / given) : 0.0;
        const double rate = porosity[at] < 1.0
                                ? std::min(drift_feedback / dt, slowest)
                                : std::min(1.0 / dt, beside_bodies + narrow * drift_feedback / dt);
        target[at] = dt > 0.0 ? rate * (theta[at] - given) : 0.0;
      },
      theta, porosity, volume, target);
  for (int a = 0; a < D; ++a) {
    const std::ptrdiff_t s = grid.stride(a);
    const double inverse = 1.0 / grid.spacing()[a];
    const double* grains = medium.grain_flux[a].data();
    for_each_apart(
        near_.beside(), grid.owned(),
        [&](std::ptrdiff_t at) { target[at] -= (grains[at + s] - grains[at]) * inverse; }, grains,
        target);
  }
}

/// With the water that has just moved.
template <int D>
void FlowSolver<D>::move_momentum(double dt) {
  const Stopwatch watch(effort_.momentum);
  solids_.walls().extend_velocity(velocity_);
  hold_sides();
  if (!options_.advection) return;
  if (gas_)
    gas_->move_momentum(water_, porosity_, flux_, carried_, dt, momentum_, velocity_);
  else
    momentum_.advance(Inertia::water, {&old_water_, &water_, &porosity_, &carried_}, velocity_);
  if (ground_sides_) ground_sides_->carry_momentum(water_, porosity_, velocity_);
  if (turbulence_)
    turbulence_->move(gas_ ? gas_->mass() : water_, gas_ ? gas_->mass_flux() : carried_);
}

/// What else gives or takes water, and what follows from where it is now.
template <int D>
void FlowSolver<D>::settle_water(const PorousMedium<D>& medium, double dt,
                                 const MovingGrains<D>* grains) {
  const Stopwatch watch(effort_.interface);
  if (!waves_.empty()) make_waves(dt);
  if (grains)
    fall_to_surface(*grid_, medium, porosity_,
                    {dt, -options_.density * grid_->gravity()[D - 1], grains->filling,
                     grains->resistance, carried_},
                    water_);
  if (!rain_.empty())
    outflow_ -= sum_over_ranks(*grid_, rain_.fall(medium.drains, porosity_, time_, dt, water_));
  update_derived(changing(medium), &medium);
  find_sides(time_ + dt, &medium);
  find_near(&medium);
  find_unknowns();
}

template <int D>
void FlowSolver<D>::apply_forces(const PorousMedium<D>& medium, double dt, bool with_grains) {
  const Stopwatch watch(effort_.forces);
  make_friction();
  solids_.walls().extend_velocity(velocity_);
  hold_sides();
  if (turbulence_) turbulence_->advance(medium, saturation_, velocity_, dt);
  predictor_.advance(medium, porosity_, capacity_, wall_friction_, time_, dt,
                     gas_ ? &gas_->mixture() : nullptr,
                     turbulence_ ? &turbulence_->viscosity() : nullptr, velocity_, mobility_);
  drained_.slow(free_water(), free_room(), projection_.unknown(), medium.added_mass, dt, velocity_,
                mobility_);
  hold_sides();
  if (!with_grains) push_given(medium);
}

template <int D>
void FlowSolver<D>::make_free_of_divergence(const PorousMedium<D>& medium, double dt,
                                            MovingGrains<D>* grains) {
  const Stopwatch watch(effort_.pressure);
  find_target(medium, dt, grains ? slow_feedback(*grid_) : HUGE_VAL);
  sources_.add(time_ + dt, target_);
  const bool gas_gives_way = gas_ && gas_->compressible();
  const CellField<D>& give_way =
      gas_gives_way ? gas_->with_gas_storage(medium.give_way, water_, porosity_, dt)
                    : medium.give_way;
  if (grains)
    project_with_grains(medium, give_way, dt, *grains);
  else
    last_solve_ = projection_.project(capacity_, mobility_, target_, give_way, pressure_, velocity_,
                                      options_.pressure_tolerance / dt);
  effort_.cycles += last_solve_.iterations;
}

template <int D>
void FlowSolver<D>::extend_velocity(const PorousMedium<D>& medium) {
  const Stopwatch watch(effort_.extension);
  ghosts_.update_velocity(velocity_, near_.cells());
  if (!gas_)
    extension_.extend(projection_.unknown(), free_water(), free_room(), capacity_, medium.drains,
                      velocity_);
  if (ground_sides_) ground_sides_->follow_surface(projection_.unknown(), velocity_);
  hold_sides();
}

template <int D>
void FlowSolver<D>::advance(const PorousMedium<D>& medium, double dt, MovingGrains<D>* grains) {
  check_step(dt);
  if (grains && !with_ground_) {
    with_ground_ = true;
    near_.take_all();
  }
  move_water(medium, dt, grains ? &grains->velocity : nullptr);
  move_momentum(dt);
  settle_water(medium, dt, grains);
  apply_forces(medium, dt, grains != nullptr);
  make_free_of_divergence(medium, dt, grains);
  extend_velocity(medium);
  check_finite();
  if (turbulence_) turbulence_->find(medium, saturation_, velocity_);
  step_ += 1;
  time_ += dt;
}

/// The water is at the end of the step. The velocity has just carried it there from the start:
/// in this scheme (symplectic Euler) it belongs to the middle. Gravity and pressure come later.
template <int D>
void FlowSolver<D>::make_waves(double dt) {
  outflow_ -= sum_over_ranks(*grid_, waves_.blend_water(porosity_, time_ + dt, dt, water_));
  ghosts_.update(water_);
  waves_.blend_velocity(water_, time_ + 0.5 * dt, dt, velocity_);
}

/// Sides that water flows through as given: from the present water and a time [s].
template <int D>
void FlowSolver<D>::find_sides(double time, const PorousMedium<D>* medium) {
  if (sides_.empty() && !ground_sides_) return;
  if (!sides_.empty()) sides_.find(water_, porosity_, capacity_, time);
  if (ground_sides_ && medium) ground_sides_->find(medium->drains, pressure_, capacity_, time);
  hold_sides();
}

/// What the ghosts and the predictor make of walls is at rest.
template <int D>
void FlowSolver<D>::hold_sides() {
  sides_.apply(porosity_, water_, velocity_);
  if (ground_sides_) ground_sides_->apply(porosity_, water_, velocity_);
}

template class FlowSolver<2>;
template class FlowSolver<3>;

}  // namespace mudlark

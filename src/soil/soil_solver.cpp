#include "soil/soil_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "materials/registry.hpp"
#include "soil/body_force.hpp"
#include "soil/face_balance.hpp"
#include "soil/grains_in_cells.hpp"
#include "soil/kinematics.hpp"
#include "soil/point_volume.hpp"
#include "soil/pore_cells.hpp"
#include "soil/redistribute.hpp"
#include "soil/seeding.hpp"
#include "soil/splitting.hpp"
#include "soil/stable_step.hpp"
#include "soil/walls.hpp"

namespace mudlark {
namespace {

/// Points may go this far between visits to their owners, in cells: the ghost layers hold no more.
constexpr double longest_travel = 0.9;
/// The same where contacts lie up to half a cell beside the points.
constexpr double longest_travel_with_solids = 0.45;
/// A body moves at most so far in a step of courant 1, in cells.
constexpr double most_of_a_cell = 0.2;
/// Points whose state is updated together; their arrays fit into the second-level cache.
constexpr std::size_t points_per_block = 1024;
/// No point is split in a cell that holds so many times the points of a full one.
constexpr int most_points = 4;
/// Points are sorted again when this share of them has left the cell that they were sorted into.
constexpr double most_strays = 0.2;
template <class T, int D, std::size_t... A>
NodeField<T, D> make_node_field(const Grid<D>& grid, const char* name, std::index_sequence<A...>) {
  return {((void)A, Field<T, AtFace, D>(grid, name, ""))...};
}
template <class T, int D>
NodeField<T, D> make_node_field(const Grid<D>& grid, const char* name) {
  return make_node_field<T, D>(grid, name, std::make_index_sequence<static_cast<std::size_t>(D)>{});
}

}  // namespace

template <int D>
SoilSolver<D>::SoilSolver(const Grid<D>& grid, const SoilOptions& options)
    : grid_(&grid),
      options_(options),
      halo_(grid),
      surface_(grid, options.loads),
      sides_(grid, options.boundaries, options.water_density, options.mass_scaling),
      side_water_(sides_),
      absorbing_(sides_),
      wall_contact_(sides_),
      sums_(make_node_field<NodeSums, D>(grid, "soil sums")),
      motion_(make_node_field<NodeMotion, D>(grid, "soil motion")),
      occupied_(grid, "cells with soil", "1"),
      mean_velocity_(grid, "mean grain velocity", "m/s") {
  if (options.transfer == Transfer::apic && options.kernel == Kernel::linear)
    throw InputError(
        "transfer = \"apic\" needs kernel = \"quadratic\" or \"composite\" (the inertia of a "
        "linear "
        "stencil vanishes at its nodes); or use transfer = \"flip\".");
  defaults_.damping = options.damping, defaults_.water_damping = options.water_damping;
  defaults_.mass_scaling = options.mass_scaling, defaults_.method = options.method;
  defaults_.stop_when_static = options.stop_when_static;
  for (const SoilBody& body : options.bodies) {
    const bool wet = body.pore_water == PoreWater::two_phase;
    constants_.push_back({body.grain_density, body.porosity, wet ? options.water_density : 0.0,
                          options.water_viscosity, body.intrinsic_permeability,
                          body.permeability_law, body.pore_water == PoreWater::unified});
    laws_.push_back(make_soil_model(body.law));
    if (!laws_.back()->supports(body.strain))
      throw InputError(fmt::format("soil {}: law {} cannot be used with this strain measure",
                                   body.name, laws_.back()->name()));
  }
  if (options.formulation != Formulation::u_w && two_phase()) projection_.emplace(sides_, options_);
  if (options.solids.empty()) return;
  if (projection_)
    throw InputError(
        "[[solid]] needs formulation = \"u-w\": the pore pressure of u-w-p and u-p does not know "
        "that bodies are impermeable.");
  for (const SolidOptions& solid : options.solids)
    solids_.emplace_back(solid, D, to_point3(grid.gravity()), options.mass_scaling);
  solid_contact_.emplace(sides_, options);
  watch_collisions(false);
}

template <int D>
void SoilSolver<D>::watch_collisions(bool in_water) {
  if (std::none_of(solids_.begin(), solids_.end(), [](const Solid& one) { return one.free(); }))
    return;
  std::vector<RigidPose> start;
  for (const Solid& solid : solids_) start.push_back(solid.pose());
  collisions_.emplace(*grid_, in_water, start);
}

template <int D>
void SoilSolver<D>::initialise() {
  points_.clear();
  for (std::size_t b = 0; b < options_.bodies.size(); ++b)
    points_.push_back(seed_points(*grid_, options_.bodies[b], b, options_.transfer,
                                  options_.split_stretched || !options_.solids.empty(),
                                  options_.solids));
  for (std::size_t b = 0; b < options_.bodies.size(); ++b)
    if (options_.bodies[b].stage > 0) points_[b].resize(0);
  set_initial_stress(*grid_, options_, 0, points_);
  for (std::size_t b = 0; b < points_.size(); ++b)
    initialise_material_state(points_[b], *laws_[b], options_.bodies[b].strain,
                              options_.bodies[b].porosity);
  energy_ = SoilEnergy{};
  energy_.start_kinetic = totals().kinetic_energy;
  apply_stage(0);
  redistribute();
}

template <int D>
bool SoilSolver<D>::two_phase() const {
  return std::any_of(constants_.begin(), constants_.end(),
                     [](const BodyConstants& body) { return body.water_density > 0.0; });
}

template <int D>
void SoilSolver<D>::redistribute() {
  for (std::size_t b = 0; b < points_.size(); ++b) try {
      recently_removed_mass_ += migrate(sides_, points_[b]);
      if (options_.split_stretched)
        recently_removed_mass_ += split_stretched(
            sides_, {*options_.split_stretched, most_points * options_.bodies[b].points_per_cell},
            points_[b]);
      sort_by_cell(*grid_, points_[b]);
    } catch (const DivergenceError& error) {  // on all ranks at once
      throw DivergenceError(
          fmt::format("soil {}: {}, t = {:.6g} s", options_.bodies[b].name, error.what(), time_));
    }
  // The box of all soil, so that faces loaded from a neighbouring rank are inside too.
  std::array<int, 2 * D> extreme{}, widest{};
  extreme.fill(std::numeric_limits<int>::min() / 2);
  for (const auto& points : points_)
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Index<D> cell = grid_->cell_at(points.position_of(p));
      for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a) {
        extreme[a] = std::max(extreme[a], -cell.component[a]);
        extreme[a + D] = std::max(extreme[a + D], cell.component[a]);
      }
    }
  MPI_Allreduce(extreme.data(), widest.data(), 2 * D, MPI_INT, MPI_MAX, grid_->comm());
  for (int a = 0; a < D; ++a) {  // one cell of travel and two of the kernel
    active_.lower[a] = -widest[static_cast<std::size_t>(a)] - ghost_layers;
    active_.upper[a] = widest[static_cast<std::size_t>(a + D)] + ghost_layers + 1;
    if (grid_->periodic(a))
      active_.lower[a] = grid_->local().lower[a], active_.upper[a] = grid_->local().upper[a];
  }
  active_ = active_.intersected(grid_->local());
  if (projection_) projection_->cover(active_);
  travelled_ = 0.0;
}

template <int D>
double SoilSolver<D>::stable_step() const {
  double step = mudlark::stable_step(*grid_, options_, points_, constants_, laws_);
  const BoxShape domain{to_point3(grid_->lower()), to_point3(grid_->upper())};
  for (const Solid& solid : solids_)
    if (const double speed = solid.largest_speed(domain); speed > 0.0)
      step = std::min(step, options_.courant * most_of_a_cell * grid_->smallest_spacing() / speed);
  return step;
}

template <int D>
void SoilSolver<D>::begin_step(double time, double length, const FluidLoad<D>* water) {
  settle_sums();
  redistribute();
  time_ = time;
  length_ = length;
  mean_velocity_.fill(0.0);
  surface_.begin_step(time, length, water, active_);
  for (Solid& solid : solids_) solid.begin_outer_step();
  side_water_.begin_outer_step(length);
}

template <int D>
void SoilSolver<D>::advance(double dt) {
  if (is_implicit()) return advance_implicitly(dt, 0);
  if (travelled_ > (solid_contact_ ? longest_travel_with_solids : longest_travel)) {
    redistribute();
    surface_.resample(active_);
  }
  sort_strays();
  step_ = dt;
  sides_.update(time_, dt);
  gather_nodes();
  for (Solid& solid : solids_) solid.begin_step(time_, dt, solids_wait_);
  solve_nodes(dt);
  update_points(dt);
  if (collisions_) collisions_->settle(solids_, dt);
  for (Solid& solid : solids_) solid.book(dt), solid.move(dt);
  time_ += dt;
}

/// Puts points of one cell side by side again when too many have moved on; no rank waits for
/// another.
template <int D>
void SoilSolver<D>::sort_strays() {
  std::size_t count = 0;
  for (const auto& points : points_) count += points.size();
  if (static_cast<double>(point_motion_.strays) <= most_strays * static_cast<double>(count)) return;
  for (auto& points : points_) sort_by_cell(*grid_, points);
  point_motion_.strays = 0;
}

/// Points to faces: sums on owned faces, mirrored walls included.
template <int D>
void SoilSolver<D>::gather_nodes(double body_force_time) {
  for (auto& field : sums_)
    for_each(active_, [&](const Index<D>& face) { field[face] = NodeSums{}; });
  SurfacePressure<D> surface = surface_.at(time_);
  const bool facets = options_.load_form == LoadForm::facets && surface.traction;
  for (std::size_t b = 0; b < points_.size(); ++b)
    points_to_grid(*grid_, points_[b], constants_[b], options_.kernel, options_.transfer,
                   facets ? SurfacePressure<D>{} : surface, sums_);
  if (projection_) projection_->measure(points_, constants_);
  if (exchanges_halos(*grid_)) halo_.add_to_owners(as_doubles<NodeSums, D>(sums_), node_sums);
  add_body_force(*grid_, options_, body_force_time, active_, sums_);
  gather_sides();
  if (facets) {
    for_each(active_, [&](const Index<D>& cell) { occupied_[cell] = 0.0; });
    for (const auto& points : points_) mark_occupied(*grid_, points, occupied_);
    // Points that wandered into a neighbour's cell since redistribute() count there.
    const std::array<double*, 1> counts{occupied_.data()};
    if (exchanges_halos(*grid_)) halo_.add_to_owners(counts);
    for_each(active_,
             [&](const Index<D>& cell) { occupied_[cell] = occupied_[cell] > 0.0 ? 1.0 : 0.0; });
    halo_.exchange(occupied_);
    add_facet_forces(*grid_, occupied_, surface, active_, sums_);
  }
}

/// What images and the sides themselves give to the sums.
template <int D>
void SoilSolver<D>::gather_sides() {
  if (side_water_.drains()) side_water_.measure(sides_, halo_, options_.kernel, points_);
  fold_into_domain(sides_, active_, step_, side_water_.pushes(), sums_);
  if (absorbing_.empty()) return;
  absorbing_.measure(sides_, halo_, options_.kernel, points_);
  if (absorbing_.started()) absorbing_.add_forces(sums_);
}

/// Motion of a face under the forces of its points.
template <int D>
void SoilSolver<D>::solve_face(const NodeSums& sums, double dt, double face_volume,
                               const FaceHold& hold, NodeMotion& motion) const {
  motion = NodeMotion{};
  if (!carries_motion(sums, face_volume)) return;
  const FaceBalance balance(sums, options_, dt, tied(surface_.sealed(), sums, face_volume), hold);
  const PhaseVelocity old = balance.old(), now = balance.moved();
  motion = {now.grains, now.grains - old.grains, now.water, now.water - old.water,
            balance.flux(now)};
}

/// Local damping after all else that a face feels: what bodies press with is a part of the
/// unbalanced force.
template <int D>
void SoilSolver<D>::damp_face(const NodeSums& sums, double dt, NodeMotion& motion) const {
  if (!carries_motion(sums, grid_->cell_volume())) return;
  const FaceBalance balance(sums, options_, dt, false);
  const PhaseVelocity now{motion.grain_velocity, motion.water_velocity};
  const PhaseVelocity damped =
      balance.damped(now, {now.grains - motion.grain_change, now.water - motion.water_change});
  motion.grain_velocity = damped.grains, motion.water_velocity = damped.water;
  motion.grain_change += damped.grains - now.grains;
  motion.water_change += damped.water - now.water;
  motion.total_flux = balance.flux(damped);
}

template <int D>
void SoilSolver<D>::solve_nodes(double dt) {
  if (projection_) projection_->add_last_rise(dt, sums_);
  const bool damps_at_once = !solid_contact_ && damps();
  for (int d = 0; d < D; ++d) {
    const auto u = static_cast<std::size_t>(d);
    const double volume = grid_->cell_volume();
    const NodeSums* sums = sums_[u].data();
    NodeMotion* motion = motion_[u].data();
    for_each(solved_faces(sides_, d).intersected(active_), [&](const Index<D>& face) {
      const std::ptrdiff_t at = grid_->offset(face);
      solve_face(sums[at], dt, volume, {}, motion[at]);
      if (damps_at_once) damp_face(sums[at], dt, motion[at]);
    });
  }
  if (solid_contact_) {
    solid_contact_->apply(dt, constants_, active_, solids_, points_, sums_, motion_);
    for (int d = 0; d < D; ++d) {
      const auto u = static_cast<std::size_t>(d);
      for_each(solved_faces(sides_, d).intersected(active_),
               [&](const Index<D>& face) { damp_face(sums_[u][face], dt, motion_[u][face]); });
    }
  }
  solve_sides(dt);
  account_nodes(dt);
  if (exchanges_halos(*grid_)) halo_.exchange(as_doubles<NodeMotion, D>(motion_), node_motions);
}

/// What the sides make of the motion.
template <int D>
void SoilSolver<D>::solve_sides(double dt) {
  if (!absorbing_.empty() && !sides_.holds_still()) {
    if (!absorbing_.started()) {
      absorbing_.start(sides_, halo_, points_, constants_, laws_, options_.water_bulk_modulus,
                       sums_);
      absorbing_.add_forces(sums_);
    }
    absorbing_.solve(dt, motion_, [&](int d, std::ptrdiff_t at, const FaceHold& hold) {
      const auto u = static_cast<std::size_t>(d);
      solve_face(sums_[u].data()[at], dt, grid_->cell_volume(), hold, motion_[u].data()[at]);
      if (damps()) damp_face(sums_[u].data()[at], dt, motion_[u].data()[at]);
    });
  }
  if (!wall_contact_.empty())
    wall_contact_.apply(sides_,
                        {dt, options_.transfer == Transfer::apic ? 0.0 : options_.flip_fraction,
                         options_.mass_scaling},
                        sums_, motion_);
  if (projection_)
    projection_->project(dt, time_, surface_.sealed(), sums_, motion_, recent_energy_);
  if (side_water_.drains()) {
    std::array<IndexBox<D>, D> faces;
    for (int d = 0; d < D; ++d)
      faces[static_cast<std::size_t>(d)] = solved_faces(sides_, d).intersected(active_);
    side_water_.solve(sides_, halo_, dt, faces, sums_, motion_);
  }
  mirror_motion(sides_, active_, sums_, motion_);
  forget_images(sides_, active_, sums_);
  if (!side_water_.drains()) return;
  if (exchanges_halos(*grid_)) halo_.exchange(as_doubles<NodeMotion, D>(motion_), node_motions);
  side_water_.mirror_fluxes(sides_, dt, options_.water_bulk_modulus, points_, sums_, motion_);
}

/// Mean motion and work of the step, after the sides had their say.
template <int D>
void SoilSolver<D>::account_nodes(double dt) {
  const bool moves_with_grains = options_.formulation == Formulation::u_p;
  for (int d = 0; d < D; ++d) {
    const NodeSums* sums = sums_[static_cast<std::size_t>(d)].data();
    const NodeMotion* motion = motion_[static_cast<std::size_t>(d)].data();
    double* mean = mean_velocity_[d].data();
    for_each(solved_faces(sides_, d).intersected(active_), [&](const Index<D>& face) {
      const std::ptrdiff_t at = grid_->offset(face);
      mean[at] += dt / length_ * motion[at].grain_velocity;
      const double water_change =
          moves_with_grains ? motion[at].grain_change : motion[at].water_change;
      add_face_work(sums[at], motion[at], options_.water_density, options_.mass_scaling,
                    water_change, dt, recent_energy_);
    });
  }
  side_water_.account(
      sides_, dt,
      [&](int axis, const Index<D>& face) {
        const NodeMotion& motion = motion_[static_cast<std::size_t>(axis)][face];
        return motion.total_flux - motion.grain_velocity;
      },
      [&](int axis, const Index<D>& face) {
        return sums_[static_cast<std::size_t>(axis)][face].volume;
      });
}

/// Grid to points, and their new state, for points few enough to stay in the cache. Returns how
/// many failed.
template <int D>
std::size_t SoilSolver<D>::update_block(std::size_t b, PointRange block, double dt) {
  auto& points = points_[b];
  const bool wet = constants_[b].water_density > 0.0;
  if (wet && projection_)
    sample_range(*grid_, points, block, options_.kernel, projection_->rise(),
                 point_motion_.pressure_rise);
  grid_to_points(*grid_, motion_, options_.kernel, options_.transfer,
                 {options_.flip_fraction, dt, wet}, block, points, point_motion_);
  const double work = internal_work(points, block, point_motion_, dt, wet);
  recent_energy_.external += work;  // what the faces' work had taken off
  const std::size_t without_pores =
      update_volumes(point_motion_, constants_[b], options_.water_bulk_modulus, dt, block, points);
  const StressResult result =
      update_stress(points, block, point_motion_.gradient, *laws_[b], options_.bodies[b].strain,
                    {dt, time_, grid_->smallest_spacing()});
  recent_energy_.internal += 0.5 * (work + internal_work(points, block, point_motion_, dt, wet));
  if (points.carries_extent) follow_extent(point_motion_.gradient, block, points);
  if (result.failed > 0 && failed_stress_.empty()) note_failed_stress(b, result);
  return without_pores + result.failed;
}

template <int D>
void SoilSolver<D>::update_points(double dt) {
  point_motion_.largest_speed = 0.0;
  point_motion_.strays = 0;
  std::size_t failed = 0;
  for (std::size_t b = 0; b < points_.size(); ++b)
    for (PointRange block; block.last < points_[b].size();) {
      block = points_[b].block(block.last, points_per_block);
      failed += update_block(b, block, dt);
    }
  std::array<double, 2> mine{point_motion_.largest_speed, static_cast<double>(failed)},
      worst = mine;
  if (grid_->ranks() > 1)
    MPI_Allreduce(mine.data(), worst.data(), 2, MPI_DOUBLE, MPI_MAX, grid_->comm());
  travelled_ += worst[0] * dt / grid_->smallest_spacing();
  const double too_fast = 10.0 * grid_->smallest_spacing() / dt;
  if (worst[1] > 0.0 || !(worst[0] < too_fast)) report_bad_point(worst[0], failed);
}

template <int D>
void SoilSolver<D>::solid_fraction(CellField<D>& fraction, CellField<D>& resistance) {
  if (travelled_ > longest_travel) redistribute();
  fraction.fill(0.0);
  resistance.fill(0.0);
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const BodyConstants& body = constants_[b];
    add_solid_fraction(*grid_, points_[b], body.grain_density, options_.kernel, 1.0, fraction);
    if (body.water_density > 0.0 || body.in_grid_water)
      add_resistance(*grid_, points_[b], body, options_.kernel, resistance);
  }
  const std::array<double*, 2> both{fraction.data(), resistance.data()};
  halo_.add_to_owners(both);
  fold_cells(sides_, active_, fraction);
  fold_cells(sides_, active_, resistance);
  halo_.exchange(both);
}

template <int D>
void SoilSolver<D>::set_pore_pressure(const CellField<D>& pressure) {
  for (std::size_t b = 0; b < points_.size(); ++b) {
    if (constants_[b].water_density == 0.0 && !constants_[b].in_grid_water) continue;
    auto& points = points_[b];
    sample_range(*grid_, points, {0, points.size()}, options_.kernel, pressure,
                 points.pore_pressure);
    if (const auto& excess = options_.bodies[b].initial_pore_pressure)
      for (std::size_t p = 0; p < points.size(); ++p)
        points.pore_pressure[p] += (*excess)(to_point3(points.position_of(p)), 0.0);
  }
}

template class SoilSolver<2>;
template class SoilSolver<3>;

}  // namespace mudlark

#include "soil/implicit_krylov.hpp"

#include <algorithm>

namespace mudlark {
namespace {

template <int D>
UnknownPlaces face_places(::Vec x, const std::array<std::vector<PetscInt>, D>& numbers,
                          const std::array<std::vector<double>, D>& signs) {
  std::array<UnknownPlaces::Places, D> fields;
  for (std::size_t d = 0; d < D; ++d) fields[d] = {numbers[d], signs[d]};
  return UnknownPlaces(x, fields);
}
UnknownPlaces cell_places(::Vec x, const std::vector<PetscInt>& numbers,
                          const std::vector<double>& signs) {
  const std::array<UnknownPlaces::Places, 1> fields{{{numbers, signs}}};
  return UnknownPlaces(x, fields);
}

/// All faces of the local box that have a cell of it on both sides.
template <int D, class F>
void for_each_inner_face(const Grid<D>& grid, int axis, F&& f) {
  IndexBox<D> box = grid.local();
  ++box.lower[axis];
  const auto below = static_cast<std::size_t>(grid.stride(axis));
  for_each(box, [&](const Index<D>& face) {
    const auto upper = static_cast<std::size_t>(grid.offset(face));
    f(upper, upper - below);
  });
}

}  // namespace

template <int D>
ImplicitKrylov<D>::ImplicitKrylov(const Grid<D>& grid, const ImplicitUnknowns<D>& unknowns,
                                  ImplicitContact<D>& contact, ::Vec x, double dt,
                                  double water_scale)
    : grid_(&grid),
      unknowns_(&unknowns),
      contact_(&contact),
      dt_(dt),
      water_scale_(water_scale),
      grains_(face_places<D>(x, unknowns.grains, unknowns.grain_sign)),
      water_(face_places<D>(x, unknowns.water, unknowns.water_sign)),
      pressure_(cell_places(x, unknowns.pressure, unknowns.pressure_sign)),
      ways_(grid, "way", "m"),
      forces_(grid, "force", "N"),
      seals_(grid, "force of sealed surfaces", "N"),
      cell_pressure_(grid, "pressure", "Pa"),
      flow_(grid, "divergence of the water's way", "1"),
      storage_(grid, "volume", "m^D"),
      pore_push_(grid, "force times way", "J") {
  for (VecHandle* vector : {&u_, &f_u_}) grains_.make_vector(*vector);
  for (VecHandle* vector : {&w_, &f_w_, &drag_, &resistance_}) water_.make_vector(*vector);
  for (VecHandle* vector : {&p_, &f_p_}) pressure_.make_vector(*vector);
}

template <int D>
void ImplicitKrylov<D>::linearise(const std::vector<LinearPoint<D>>& points) {
  points_ = std::make_unique<PointOperator<D>>(*grid_, points);
  if (!prepared()) make_drag();  // of the step's start
}

template <int D>
void ImplicitKrylov<D>::make_drag() {
  forces_.fill(0.0);
  points_->add_drag(pointers(forces_));
  seals_.fill(0.0);
  contact_->add_seal_diagonal(seals_);
  for (int d = 0; d < D; ++d) {  // weights add up behind walls
    const auto& sign = unknowns_->water_sign[static_cast<std::size_t>(d)];
    for (std::size_t at = 0; at < sign.size(); ++at)
      forces_[d].data()[at] *= sign[at], seals_[d].data()[at] *= sign[at];
  }
  water_.to_unknowns(pointers(std::as_const(forces_)), drag_);
  water_.to_unknowns(pointers(std::as_const(seals_)), resistance_);
  VecAYPX(resistance_, dt_, drag_);
}

template <int D>
void ImplicitKrylov<D>::prepare() {
  frozen_ = points_->points();
  if (unknowns_->body_freedoms > 0) holding_.compute(contact_->holding());
  frozen_points_ = std::make_unique<PointOperator<D>>(*grid_, frozen_);
  displacement_ = std::make_unique<DisplacementMultigrid<D>>(*grid_, *unknowns_, grains_, frozen_,
                                                             contact_->stiffness());
  PetscInt cells = 0;
  VecGetSize(p_, &cells);
  if (cells == 0) return;  // dry
  pore_pressure_ = std::make_unique<PressurePreconditioner<D>>(
      *grid_, *frozen_points_, pressure_, unknowns_->pressure_sign, water_, resistance_, dt_);
}

/// Divergence in cells of the water's way in w_.
template <int D>
void ImplicitKrylov<D>::find_flow() {
  water_.to_places(w_, pointers(ways_));
  flow_.fill(0.0);
  for (int d = 0; d < D; ++d) {
    const double per_spacing = 1.0 / grid_->spacing()[d];
    const double* way = ways_[d].data();
    double* flow = flow_.data();
    for_each_inner_face(*grid_, d, [&](std::size_t upper, std::size_t lower) {
      flow[lower] += way[upper] * per_spacing;
      flow[upper] -= way[upper] * per_spacing;
    });
  }
}

/// What pressure does to the water: its sums in cells, differenced across faces.
template <int D>
void ImplicitKrylov<D>::difference_push() {
  forces_.fill(0.0);
  for (int d = 0; d < D; ++d) {
    const double per_spacing = 1.0 / grid_->spacing()[d];
    const double* push = pore_push_.data();
    double* force = forces_[d].data();
    for_each_inner_face(*grid_, d, [&](std::size_t upper, std::size_t lower) {
      force[upper] = (push[lower] - push[upper]) * per_spacing;
    });
  }
}

template <int D>
void ImplicitKrylov<D>::multiply(::Vec x, ::Vec y) {
  grains_.take_from_all(x, u_);
  water_.take_from_all(x, w_);
  pressure_.take_from_all(x, p_);
  find_flow();
  if (contact_->any()) {
    seals_.fill(0.0);
    contact_->apply_seals(ways_, seals_);
  }
  grains_.to_places(u_, pointers(ways_));
  const std::array<double*, 1> pressure{cell_pressure_.data()};
  pressure_.to_places(p_, pressure);
  forces_.fill(0.0), storage_.fill(0.0), pore_push_.fill(0.0);
  points_->apply(pointers(ways_), cell_pressure_.data(), flow_.data(),
                 {pointers(forces_), storage_.data(), pore_push_.data()});
  contact_->stiffness().apply(ways_, forces_);
  load_bodies(*grid_, *unknowns_, x, bodies_);
  rests_.assign(bodies_.size(), 0.0);
  contact_->apply_bodies(ways_, bodies_, forces_, rests_);
  store_bodies(*grid_, *unknowns_, rests_, y);
  grains_.to_unknowns(pointers(std::as_const(forces_)), f_u_);
  const std::array<const double*, 1> storage{storage_.data()};
  pressure_.to_unknowns(storage, f_p_);
  VecScale(f_p_, water_scale_);
  difference_push();
  for (int d = 0; d < D && contact_->any(); ++d)
    for (std::size_t at = 0; at < forces_[d].size(); ++at)
      forces_[d].data()[at] -= seals_[d].data()[at];
  water_.to_unknowns(pointers(std::as_const(forces_)), f_w_);
  VecPointwiseMult(w_, drag_, w_);
  VecScale(w_, 1.0 / dt_);
  VecAYPX(f_w_, -1.0, w_);
  grains_.give_to_all(f_u_, y);
  water_.give_to_all(f_w_, y);
  pressure_.give_to_all(f_p_, y);
}

/// Bodies go where the forces on them, and what the way of the grains in u_ pushes them with, are
/// in balance.
template <int D>
void ImplicitKrylov<D>::move_bodies(::Vec r, ::Vec x) {
  if (unknowns_->body_freedoms == 0) return;
  grains_.to_places(u_, pointers(ways_));
  rests_.assign(static_cast<std::size_t>(unknowns_->body_freedoms), 0.0);
  contact_->push_bodies(ways_, rests_);
  MPI_Allreduce(MPI_IN_PLACE, rests_.data(), unknowns_->body_freedoms, MPI_DOUBLE, MPI_SUM,
                grid_->comm());
  load_bodies(*grid_, *unknowns_, r, bodies_);
  Eigen::VectorXd force(unknowns_->body_freedoms);
  for (std::size_t k = 0; k < rests_.size(); ++k)
    force[static_cast<Eigen::Index>(k)] = bodies_[k] - rests_[k];
  const Eigen::VectorXd way = holding_.solve(force);
  rests_.assign(rests_.size(), 0.0);
  if (grid_->rank() == 0) std::copy(way.begin(), way.end(), rests_.begin());
  store_bodies(*grid_, *unknowns_, rests_, x);
}

template <int D>
void ImplicitKrylov<D>::precondition(::Vec r, ::Vec x) {
  grains_.take_from_all(r, f_u_);
  water_.take_from_all(r, f_w_);
  pressure_.take_from_all(r, f_p_);
  displacement_->apply(f_u_, u_);
  grains_.give_to_all(u_, x);
  move_bodies(r, x);
  if (!pore_pressure_) return;
  VecPointwiseDivide(w_, f_w_, resistance_);
  VecScale(w_, dt_);
  find_flow();
  grains_.to_places(u_, pointers(ways_));
  storage_.fill(0.0);
  frozen_points_->apply_volume(pointers(ways_), flow_.data(), storage_.data());
  const std::array<const double*, 1> storage{storage_.data()};
  pressure_.to_unknowns(storage, p_);
  VecScale(f_p_, 1.0 / water_scale_);
  VecAXPY(f_p_, -1.0, p_);
  pore_pressure_->apply(f_p_, p_);
  // w = dt R^-1 (f_w + B p)
  const std::array<double*, 1> pressure{cell_pressure_.data()};
  pressure_.to_places(p_, pressure);
  pore_push_.fill(0.0);
  frozen_points_->apply_mass(cell_pressure_.data(), pore_push_.data());
  difference_push();
  water_.to_unknowns(pointers(std::as_const(forces_)), w_);
  VecAXPY(w_, 1.0, f_w_);
  VecPointwiseDivide(w_, w_, resistance_);
  VecScale(w_, dt_);
  water_.give_to_all(w_, x);
  pressure_.give_to_all(p_, x);
}

template class ImplicitKrylov<2>;
template class ImplicitKrylov<3>;

}  // namespace mudlark

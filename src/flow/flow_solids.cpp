/// The part of the flow solver that knows of bodies.
#include <algorithm>
#include <cmath>

#include "flow/flow_checks.hpp"
#include "flow/flow_solver.hpp"
#include "flow/wall_friction.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// How many steps late a free body answers to a slow change of force. With m the mass, m_a the
/// added mass on both sides of Newton's law and mu the water's true one, the acceleration s of a
/// step is (G + (m_a - mu) s_last)/(m + m_a): it follows G/(m + mu) late by (m_a - mu)/(m + mu)
/// steps. mu is not known; half of m_a is that of a body that floats.
double steps_late(const Solid& body) {
  if (body.mobility() == 0.0) return 0.0;
  const double added = std::max(0.0, 1.0 / body.mobility() - body.mass());
  return 0.5 * added / (body.mass() + 0.5 * added);
}

}  // namespace

template <int D>
void FlowSolver<D>::restore(PorousMedium<D>& medium) {
  if (ground_sides_) find_sides(time_, &medium);
  if (solids_.empty()) return;
  find_capacity(medium);
  find_unknowns();
}

/// In a state just loaded, small cells hold just their room where they stand alone.
template <int D>
void FlowSolver<D>::place_solids(PorousMedium<D>& medium) {
  if (solids_.empty()) return;
  const CellField<D>& volume = solids_.open_volume();
  solids_.fill(medium, [&](const Index<D>& cell, const Index<D>&) {
    return std::abs(porosity_[cell] - volume[cell]) < 1e-9;
  });
  solids_.begin();
}

template <int D>
void FlowSolver<D>::move_solids(PorousMedium<D>& medium, double dt) {
  if (!solids_.moving()) return;
  solids_.walls().extend_velocity(velocity_);  // what faces that open now begin with
  hold_sides();
  solids_.move(time_, dt);
  // In soil and beside gas small cells are joined to others, as beside bodies at rest.
  const bool may = !with_ground_ && !gas_;
  solids_.fill(medium, [&](const Index<D>&, const Index<D>& host) {
    return may && InterfaceAdvection<D>::dilates(water_[host], porosity_[host]);
  });
}

template <int D>
void FlowSolver<D>::push_solids(std::vector<Solid>& leaders, double dt) const {
  for (Solid& leader : leaders) {
    if (!leader.free()) continue;
    // Where the body will be when it answers: else what drives a floating body back comes late, and
    // its heave and roll would grow (Euler's explicit method).
    const SolidLoad load =
        solid_load_ahead(*solids_.find(leader.options().name), (1.0 + steps_late(leader)) * dt);
    leader.feel_water(load.force, load.moment, dt);
  }
}

template <int D>
void FlowSolver<D>::drive_solids(double dt) {
  for (Solid& solid : solids_.free()) solid.begin_outer_step(), solid.begin_step(time_, dt, false);
  push_solids(solids_.free(), dt);
  solids_.collide(time_, dt);
  for (Solid& solid : solids_.free()) solid.book(dt);
  solids_.follow(solids_.free());
}

/// Cells that bodies make or take change hands; those without a pressure unknown take the room that
/// is there, or what their water needs until the pressure can push it out.
template <int D>
void FlowSolver<D>::follow_solids(const PorousMedium<D>& medium) {
  ghosts_.update(water_);
  ghosts_.update(porosity_);
  solids_.regroup(medium.space, porosity_, water_);
  const double* w = water_.data();
  const double* given = medium.porosity.data();
  const double* volume = medium.space.volume.data();
  const double* loose = loose_.data();
  double* theta = porosity_.data();
  for_each_offset(*grid_, grid_->owned(), [&](std::ptrdiff_t at) {
    if (loose[at] > 0.0 && volume[at] > 0.0) theta[at] = std::max(volume[at] * given[at], w[at]);
  });
}

template <int D>
WallPressure<D> FlowSolver<D>::wall_pressure() const {
  return {*grid_, pressure_, projection_.unknown(), porosity_, saturation_, options_.density};
}
template <int D>
double FlowSolver<D>::pressure_at(const Vec<D>& position) const {
  // Beside bodies by the gradient from the next cell with a pressure.
  double beside = 0.0, value = 0.0;
  const Index<D> cell = grid_->cell_at(position);
  if (!solids_.walls().empty() && grid_->owned().contains(cell)) {
    IndexBox<D> around{cell, cell};
    for (int a = 0; a < D; ++a) around.lower[a] -= 1, around.upper[a] += 2;
    for_each(around, [&](const Index<D>& other) {
      if (porosity_[other] == 0.0) beside = 1.0;
    });
    value = wall_pressure().mean(cell, position, 0.0);
  }
  if (sum_over_ranks(*grid_, beside) > 0.0) return sum_over_ranks(*grid_, value);
  return interpolate(*grid_, pressure_.data(), -1, position);
}
template <int D>
SolidLoad FlowSolver<D>::solid_load(std::size_t body, const std::optional<BoxShape>& part) const {
  return load_on(*grid_, solids_, body, part, wall_pressure(), velocity_, options_.viscosity);
}

template <int D>
SolidLoad FlowSolver<D>::solid_load_ahead(std::size_t body, double time) const {
  return load_on(*grid_, solids_, body, {}, wall_pressure(), velocity_, options_.viscosity, time);
}

/// Of walls and of the surfaces of bodies.
template <int D>
void FlowSolver<D>::make_friction() {
  if (options_.wall_law != WallLaw::resolved)
    find_wall_friction(*grid_, options_, saturation_, velocity_, wall_friction_);
  if (!solids_.no_slip()) return;
  if (options_.wall_law == WallLaw::resolved) wall_friction_.fill(0.0);
  find_body_friction(*grid_, solids_, porosity_, options_.viscosity, body_friction_);
  ghosts_.add_to_owners(body_friction_);
  for (int a = 0; a < D; ++a)
    for_each_offset(*grid_, bounding_faces(*grid_, a), [&](std::ptrdiff_t at) {
      wall_friction_[a].data()[at] += body_friction_[a].data()[at];
    });
}

template WallPressure<2> FlowSolver<2>::wall_pressure() const;
template void FlowSolver<2>::make_friction();
template void FlowSolver<2>::restore(PorousMedium<2>&);
template void FlowSolver<2>::place_solids(PorousMedium<2>&);
template void FlowSolver<2>::move_solids(PorousMedium<2>&, double);
template void FlowSolver<2>::follow_solids(const PorousMedium<2>&);
template void FlowSolver<2>::push_solids(std::vector<Solid>&, double) const;
template void FlowSolver<2>::drive_solids(double);
template double FlowSolver<2>::pressure_at(const Vec<2>&) const;
template SolidLoad FlowSolver<2>::solid_load(std::size_t, const std::optional<BoxShape>&) const;
template SolidLoad FlowSolver<2>::solid_load_ahead(std::size_t, double) const;
template WallPressure<3> FlowSolver<3>::wall_pressure() const;
template void FlowSolver<3>::make_friction();
template void FlowSolver<3>::restore(PorousMedium<3>&);
template void FlowSolver<3>::place_solids(PorousMedium<3>&);
template void FlowSolver<3>::move_solids(PorousMedium<3>&, double);
template void FlowSolver<3>::follow_solids(const PorousMedium<3>&);
template void FlowSolver<3>::push_solids(std::vector<Solid>&, double) const;
template void FlowSolver<3>::drive_solids(double);
template double FlowSolver<3>::pressure_at(const Vec<3>&) const;
template SolidLoad FlowSolver<3>::solid_load(std::size_t, const std::optional<BoxShape>&) const;
template SolidLoad FlowSolver<3>::solid_load_ahead(std::size_t, double) const;

}  // namespace mudlark

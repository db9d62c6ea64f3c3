/// The state of rest from which a case may start.
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {
namespace {

/// Steps between looks at how far the soil is from rest.
constexpr int steps_between = 50;

template <int N>
void set_zero(PointQuantity<N>& quantity) {
  for (int c = 0; c < N; ++c) std::fill(quantity[c].begin(), quantity[c].end(), 0.0);
}

}  // namespace

template <int D>
void SoilSolver<D>::find_equilibrium() {
  if (!options_.start_in_equilibrium) return;
  if (is_implicit()) {
    solids_wait_ = true;
    sides_.hold_still(true);
    find_equilibrium_implicitly();
    start_bodies_and_sides();
    return start_from_rest();
  }
  const EquilibriumStart& start = *options_.start_in_equilibrium;
  const Dampings given = seek_rest();
  Statics statics;
  double elapsed = 0.0;
  do {
    check_search(elapsed, statics);
    const double dt = stable_step();
    begin_step(0.0, steps_between * dt, nullptr);
    for (int i = 0; i < steps_between; ++i) {
      advance(dt);
      time_ = 0.0;  // loads and accelerations stay those of the start
    }
    elapsed += steps_between * dt;
    statics = *this->statics();
  } while (!statics.at_rest(start.rest));
  begin_at_rest(given);
}

/// Sides, bodies and time stand still while rest is sought.
template <int D>
auto SoilSolver<D>::seek_rest() -> Dampings {
  const Dampings given{options_.damping, options_.water_damping};
  options_.damping = options_.start_in_equilibrium->damping, options_.water_damping.reset();
  solids_wait_ = true;
  for (Solid& solid : solids_) solid.stop();
  sides_.hold_still(true);
  return given;
}

template <int D>
void SoilSolver<D>::begin_at_rest(const Dampings& given) {
  options_.damping = given.both, options_.water_damping = given.water;
  start_bodies_and_sides();
  time_ = 0.0;
  start_from_rest();
}

template <int D>
void SoilSolver<D>::start_bodies_and_sides() {
  solids_wait_ = false;
  for (Solid& solid : solids_) solid.start(options_.start_in_equilibrium->reset_displacements);
  sides_.hold_still(false);
}

template <int D>
void SoilSolver<D>::check_search(double elapsed, const Statics& statics) const {
  const double longest = options_.start_in_equilibrium->longest;
  if (elapsed <= longest) return;
  throw InputError(fmt::format(
      "soil_solver.start_in_equilibrium: no rest within {:g} s (unbalanced force {:.2g}, "
      "kinetic energy {:.2g}). Either the soil does not stand, or it needs a larger `longest`.",
      longest, statics.unbalanced_force, statics.kinetic_energy));
}

/// Forgets how the points came to rest.
template <int D>
void SoilSolver<D>::start_from_rest() {
  for (auto& points : points_) {
    set_zero(points.velocity), set_zero(points.water_velocity);
    set_zero(points.affine), set_zero(points.water_affine);
    if (options_.start_in_equilibrium->reset_displacements) points.start = points.position;
  }
  energy_ = recent_energy_ = SoilEnergy{};
  mean_velocity_.fill(0.0);
  length_ = 0.0;
}

template void SoilSolver<2>::find_equilibrium();
template void SoilSolver<3>::find_equilibrium();
template SoilSolver<2>::Dampings SoilSolver<2>::seek_rest();
template SoilSolver<3>::Dampings SoilSolver<3>::seek_rest();
template void SoilSolver<2>::begin_at_rest(const Dampings&);
template void SoilSolver<3>::begin_at_rest(const Dampings&);
template void SoilSolver<2>::start_bodies_and_sides();
template void SoilSolver<3>::start_bodies_and_sides();
template void SoilSolver<2>::check_search(double, const Statics&) const;
template void SoilSolver<3>::check_search(double, const Statics&) const;
template void SoilSolver<2>::start_from_rest();
template void SoilSolver<3>::start_from_rest();

}  // namespace mudlark

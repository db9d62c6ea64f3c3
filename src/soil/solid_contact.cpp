#include "soil/solid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "soil/mirror.hpp"
#include "soil/point_stencil.hpp"
#include "soil/walls.hpp"

namespace mudlark {
namespace {

/// Sweeps per step; what they leave is taken up by those of the next steps.
constexpr int sweeps = 4;
/// Faces with less than this share of a cell's volume have no soil.
constexpr double lightest_face = 1e-12;
/// Gap up to which a point is watched, in point spacings.
constexpr double watched_gap = 0.1;

}  // namespace

template <int D>
SolidContact<D>::SolidContact(const SoilSides<D>& sides, const SoilOptions& options)
    : sides_(&sides),
      grid_(&sides.grid()),
      inertia_(options.mass_scaling),
      exchanges_(exchanges_halos(*grid_)),
      wet_(std::any_of(
          options.bodies.begin(), options.bodies.end(),
          [](const SoilBody& body) { return body.pore_water == PoreWater::two_phase; })),
      halo_(*grid_),
      list_(*grid_, options.kernel),
      velocity_(*grid_, "contact velocity", "m/s"),
      slip_(*grid_, "contact slip of water", "m/s"),
      mobility_(*grid_, "contact mobility", "1/kg"),
      cross_mobility_(*grid_, "contact mobility between phases", "1/kg"),
      slip_mobility_(*grid_, "contact mobility of slip", "1/kg"),
      impulse_(*grid_, "contact impulse", "N s"),
      seal_(*grid_, "sealing impulse", "N s"),
      total_impulse_(*grid_, "contact impulse of all sweeps", "N s"),
      total_seal_(*grid_, "sealing impulse of all sweeps", "N s"),
      force_(*grid_, "contact force", "N") {}

/// Faces that contacts may reach: the bodies' boxes and a kernel around them. Ranks that exchange
/// ghosts may find a neighbour's impulses anywhere in theirs.
template <int D>
void SolidContact<D>::set_box(const std::vector<Solid>& solids, const IndexBox<D>& active) {
  box_ = active;
  if (exchanges_) return;
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(axis_in_space<D>(a));
    double lower = std::numeric_limits<double>::infinity(), upper = -lower;
    for (const Solid& solid : solids) {
      lower = std::min(lower, solid.box().lower[u]);
      upper = std::max(upper, solid.box().upper[u]);
    }
    const double first = (lower - grid_->lower()[a]) / grid_->spacing()[a] - 2 * ghost_layers;
    const double last = (upper - grid_->lower()[a]) / grid_->spacing()[a] + 2 * ghost_layers;
    box_.lower[a] = static_cast<int>(std::clamp<double>(first, box_.lower[a], box_.upper[a]));
    box_.upper[a] = static_cast<int>(std::clamp<double>(last, box_.lower[a], box_.upper[a]));
  }
}

template <int D>
template <class F>
void SolidContact<D>::for_each_face(int axis, F&& f) const {
  for_each(solved_faces(*sides_, axis).intersected(box_),
           [&](const Index<D>& face) { f(grid_->offset(face)); });
}

template <int D>
void SolidContact<D>::clear(FaceVector<D>& field) {
  for (int d = 0; d < D; ++d) {
    double* values = field[d].data();
    for_each(box_, [&](const Index<D>& face) { values[grid_->offset(face)] = 0.0; });
  }
}

/// Sums that lie in ghosts and behind closed walls go to the faces that they belong to.
template <int D>
void SolidContact<D>::gather_sums(FaceVector<D>& field, bool signs) {
  if (exchanges_) {
    std::array<double*, D> all{};
    for (int d = 0; d < D; ++d) all[static_cast<std::size_t>(d)] = field[d].data();
    halo_.add_to_owners(all);
  }
  for (int axis = 0; axis < D; ++axis)
    for (int d = 0; d < D; ++d)
      for_each_image(*sides_, box_, axis, d,
                     [&](const SideNode& node, const Index<D>& behind, const Index<D>& before) {
                       field[d][before] += (signs ? node.grain_sign : 1.0) * field[d][behind];
                     });
}

/// Gives ghosts and places behind closed walls their values.
template <int D>
void SolidContact<D>::complete(FaceVector<D>& field, bool signs) {
  for (int axis = 0; axis < D; ++axis)
    for (int d = 0; d < D; ++d)
      for_each_image(*sides_, box_, axis, d,
                     [&](const SideNode& node, const Index<D>& behind, const Index<D>& before) {
                       field[d][behind] = (signs ? node.grain_sign : 1.0) * field[d][before];
                     });
  if (exchanges_) halo_.exchange(field);
}

/// Mobilities are from the inverse of [M_s + dt b, -dt b; -dt b, M_l + dt b] of
/// SoilSolver::solve_face. The faces of closed walls take any impulse and stay where they are.
template <int D>
void SolidContact<D>::read_mobilities(double dt, const NodeField<NodeSums, D>& sums) {
  const double lightest = lightest_face * grid_->cell_volume();
  for (int d = 0; d < D; ++d) {
    const auto u = static_cast<std::size_t>(d);
    for_each_face(d, [&](std::ptrdiff_t at) {
      const NodeSums& node = sums[u].data()[at];
      double& mobility = mobility_[d].data()[at];
      double &cross = cross_mobility_[d].data()[at], &slip = slip_mobility_[d].data()[at];
      mobility = -1.0, cross = slip = 0.0;
      if (node.volume < lightest) return;
      const double ms = inertia_ * node.grain_mass, ml = inertia_ * node.water_mass;
      if (ml <= 0.0) {
        mobility = 1.0 / ms;
        return;
      }
      const double drag = dt * node.drag, determinant = ms * ml + drag * (ms + ml);
      mobility = (ml + drag) / determinant;
      cross = ml / determinant;
      slip = (ms + ml) / determinant;
    });
  }
  for_each_wall_face([&](int axis, const Index<D>& face) {
    cross_mobility_[axis][face] = slip_mobility_[axis][face] = 0.0;
    mobility_[axis][face] = std::min(0.0, mobility_[axis][face]);
  });
  complete(mobility_, false);
}

template <int D>
template <class F>
void SolidContact<D>::for_each_wall_face(F&& f) const {
  for (int axis = 0; axis < D; ++axis)
    for_each_face_on_sides(*sides_, box_, axis,
                           [&](int, const SideNode&, const Index<D>& face) { f(axis, face); });
}

/// Puts an impulse on the faces around a contact, and its opposite on the body; the sealing one
/// stays between water and grains.
template <int D>
void SolidContact<D>::give(const Contact<D>& contact, const Vec<D>& impulse, double seal,
                           const Solid& solid) {
  for (int d = 0; d < D; ++d) {
    double *faces = impulse_[d].data(), *seals = seal_[d].data();
    list_.for_each_node(d, contact, [&](std::ptrdiff_t at, double w) {
      faces[at] += w * impulse[d];
      if (contact.wet) seals[at] += w * seal * contact.normal[d];
    });
  }
  loads_[contact.solid].add_answer(contact, impulse, solid);
}

/// An impulse that every contact may give at once without any of them giving too much: the inverse
/// of the sum of sizes over a row of the matrix that makes velocities of impulses. Rows so scaled
/// make Jacobi's iteration converge.
template <int D>
void SolidContact<D>::set_stiffness(const std::vector<Solid>& solids) {
  reduced_.assign(2 * solids.size(), 0.0);
  for (const Contact<D>& contact : list_.contacts()) {
    for (int d = 0; d < D; ++d) {
      double* faces = impulse_[d].data();
      list_.for_each_node(d, contact,
                          [&](std::ptrdiff_t at, double w) { faces[at] += std::abs(w); });
    }
    reduced_[2 * contact.solid] += 1.0;
    reduced_[2 * contact.solid + 1] +=
        (to_space(contact.place) - solids[contact.solid].centre()).norm();
  }
  gather_sums(impulse_, false);
  for (int d = 0; d < D; ++d)
    for_each_face(d, [&](std::ptrdiff_t at) {
      const double all = impulse_[d].data()[at], cross = cross_mobility_[d].data()[at];
      total_impulse_[d].data()[at] = all * (std::max(0.0, mobility_[d].data()[at]) + cross);
      total_seal_[d].data()[at] = all * (slip_mobility_[d].data()[at] + cross);
    });
  complete(total_impulse_, false);
  if (wet_) complete(total_seal_, false);
  MPI_Allreduce(MPI_IN_PLACE, reduced_.data(), static_cast<int>(reduced_.size()), MPI_DOUBLE,
                MPI_SUM, grid_->comm());
  const auto inverse_of = [](double sum) { return sum > 0.0 ? 1.0 / sum : 0.0; };
  for (Contact<D>& contact : list_.contacts()) {
    const Solid& solid = solids[contact.solid];
    const double arm = (to_space(contact.place) - solid.centre()).norm();
    const double body = solid.mobility() * reduced_[2 * contact.solid] +
                        solid.turning_mobility() * arm * reduced_[2 * contact.solid + 1];
    contact.stiffness = inverse_of(largest_sum(total_impulse_, contact) + body);
    contact.seal_stiffness = contact.wet ? inverse_of(largest_sum(total_seal_, contact)) : 0.0;
  }
  for (FaceVector<D>* field : {&impulse_, &total_impulse_, &total_seal_}) clear(*field);
}

/// Largest component of a positive field around a contact, weighted by the size of its weights.
template <int D>
double SolidContact<D>::largest_sum(const FaceVector<D>& field, const Contact<D>& contact) const {
  double largest = 0.0;
  for (int d = 0; d < D; ++d) {
    const double* faces = field[d].data();
    double sum = 0.0;
    list_.for_each_node(d, contact,
                        [&](std::ptrdiff_t at, double w) { sum += std::abs(w) * faces[at]; });
    largest = std::max(largest, sum);
  }
  return largest;
}

/// One sweep of Jacobi's iteration over all contacts, with the velocities that the last one left.
template <int D>
void SolidContact<D>::sweep(const std::vector<Solid>& solids) {
  for (Contact<D>& contact : list_.contacts()) {
    const Solid& solid = solids[contact.solid];
    const Vec<D> miss = list_.at_contact(velocity_, contact) -
                        ContactList<D>::velocity_of(solid, contact) +
                        contact.approach * contact.normal;
    const Vec<D> impulse = contact.bounded(contact.impulse - contact.stiffness * miss);
    const double leak = contact.wet ? dot(list_.at_contact(slip_, contact), contact.normal) : 0.0;
    const double seal = contact.seal - contact.seal_stiffness * leak;
    give(contact, impulse - contact.impulse, seal - contact.seal, solid);
    contact.impulse = impulse, contact.seal = seal;
  }
}

/// Turns the impulses of a sweep into velocities of faces and bodies.
template <int D>
void SolidContact<D>::spread(std::vector<Solid>& solids) {
  gather_sums(impulse_, true);
  if (wet_) gather_sums(seal_, true);
  for (int d = 0; d < D; ++d)
    for_each_face(d, [&](std::ptrdiff_t at) {
      const double impulse = impulse_[d].data()[at], seal = seal_[d].data()[at];
      const double cross = cross_mobility_[d].data()[at];
      velocity_[d].data()[at] += std::max(0.0, mobility_[d].data()[at]) * impulse - cross * seal;
      slip_[d].data()[at] += slip_mobility_[d].data()[at] * seal - cross * impulse;
      total_impulse_[d].data()[at] += impulse;
      total_seal_[d].data()[at] += seal;
    });
  clear(impulse_);
  complete(velocity_, true);
  if (wet_) clear(seal_), complete(slip_, true);
  all_loads_ = loads_;
  add_over_ranks(grid_->comm(), all_loads_);
  for (std::size_t s = 0; s < solids.size(); ++s)
    solids[s].set_impulse(all_loads_[s].impulse, all_loads_[s].moment);
}

/// Contacts of the step with the impulses that they start with; false when there are none.
template <int D>
bool SolidContact<D>::prepare(double dt, const std::vector<BodyConstants>& constants,
                              const IndexBox<D>& active, std::vector<Solid>& solids,
                              std::vector<SoilParticles<D>>& bodies,
                              const NodeField<NodeSums, D>& sums) {
  set_box(solids, active);
  list_.find(dt, watched_gap, constants, solids, bodies);
  for (FaceVector<D>* field : {&force_, &impulse_, &seal_}) clear(*field);
  any_ = max_over_ranks(*grid_, list_.contacts().empty() ? 0.0 : 1.0) > 0.0;
  if (!any_) {
    list_.note_forces(dt, bodies);
    return false;
  }
  read_mobilities(dt, sums);
  list_.keep_faces_with_soil(mobility_);
  set_stiffness(solids);
  loads_.assign(solids.size(), ContactLoad{});
  for (Contact<D>& contact : list_.contacts()) {
    contact.impulse = contact.bounded(contact.impulse);
    give(contact, contact.impulse, contact.seal, solids[contact.solid]);
  }
  return true;
}

template <int D>
void SolidContact<D>::sweep_and_spread(std::vector<Solid>& solids) {
  for (int i = 0; i < sweeps; ++i) {
    sweep(solids);
    spread(solids);
  }
}

template <int D>
void SolidContact<D>::apply(double dt, const std::vector<BodyConstants>& constants,
                            const IndexBox<D>& active, std::vector<Solid>& solids,
                            std::vector<SoilParticles<D>>& bodies, NodeField<NodeSums, D>& sums,
                            NodeField<NodeMotion, D>& motion) {
  if (!prepare(dt, constants, active, solids, bodies, sums)) return;
  for (int d = 0; d < D; ++d)
    for_each_face(d, [&](std::ptrdiff_t at) {
      const NodeMotion& face = motion[static_cast<std::size_t>(d)].data()[at];
      velocity_[d].data()[at] = face.grain_velocity;
      slip_[d].data()[at] = face.water_velocity - face.grain_velocity;
    });
  for_each_wall_face(
      [&](int axis, const Index<D>& face) { velocity_[axis][face] = slip_[axis][face] = 0.0; });
  spread(solids);
  sweep_and_spread(solids);
  write_back(dt, sums, motion);
  list_.note_forces(dt, bodies);
}

template <int D>
void SolidContact<D>::lean(double dt, const std::vector<BodyConstants>& constants,
                           const IndexBox<D>& active, std::vector<Solid>& solids,
                           std::vector<SoilParticles<D>>& bodies, NodeField<NodeSums, D>& sums) {
  if (!prepare(dt, constants, active, solids, bodies, sums)) return;
  spread(solids);
  for (int d = 0; d < D; ++d)
    for_each_face(d, [&](std::ptrdiff_t at) {
      const double impulse = total_impulse_[d].data()[at];
      sums[static_cast<std::size_t>(d)].data()[at].mixture_force += impulse / dt;
      force_[d].data()[at] = impulse;  // what the velocity of `settle` has already
    });
}

template <int D>
void SolidContact<D>::settle(double dt, std::vector<Solid>& solids,
                             std::vector<SoilParticles<D>>& bodies, FaceVector<D>& velocity) {
  if (!any_) return;
  for (int d = 0; d < D; ++d)
    for_each_face(d, [&](std::ptrdiff_t at) {
      velocity_[d].data()[at] = velocity[d].data()[at];
      slip_[d].data()[at] = 0.0;
    });
  for_each_wall_face([&](int axis, const Index<D>& face) { velocity_[axis][face] = 0.0; });
  complete(velocity_, true);
  sweep_and_spread(solids);
  for (int d = 0; d < D; ++d)
    for_each_face(d, [&](std::ptrdiff_t at) {
      double& force = force_[d].data()[at];
      const double impulse = total_impulse_[d].data()[at], rest = impulse - force;
      velocity[d].data()[at] += std::max(0.0, mobility_[d].data()[at]) * rest;
      force = impulse / dt;
    });
  list_.note_forces(dt, bodies);
}

template <int D>
void SolidContact<D>::write_back(double dt, NodeField<NodeSums, D>& sums,
                                 NodeField<NodeMotion, D>& motion) {
  for (int d = 0; d < D; ++d)
    for_each_face(d, [&](std::ptrdiff_t at) {
      const double impulse = total_impulse_[d].data()[at], seal = total_seal_[d].data()[at];
      if (impulse == 0.0 && seal == 0.0) return;
      NodeMotion& node = motion[static_cast<std::size_t>(d)].data()[at];
      const double cross = cross_mobility_[d].data()[at];
      const double grains = std::max(0.0, mobility_[d].data()[at]) * impulse - cross * seal;
      const double water = grains + slip_mobility_[d].data()[at] * seal - cross * impulse;
      node.grain_velocity += grains, node.grain_change += grains;
      node.water_velocity += water, node.water_change += water;
      sums[static_cast<std::size_t>(d)].data()[at].mixture_force += impulse / dt;
      force_[d].data()[at] = impulse / dt;
    });
}

template class SolidContact<2>;
template class SolidContact<3>;

}  // namespace mudlark

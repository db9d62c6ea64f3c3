#include "soil/implicit_contact.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "soil/stable_step.hpp"

namespace mudlark {
namespace {

/// Points are watched up to this gap, in their thicknesses: a step is longer than an explicit one.
constexpr double watched_gap = 0.6;
/// Stiffness of trial forces over that of the soil. Much stiffer ones would need fewer passes, but
/// with them Newton's method goes to and fro between contacts that stick and slip, open and close.
constexpr double stiffness_factor = 3.0;
/// What a pass may leave, as a share of the largest way at a contact.
constexpr double left_over = 3e-4;
/// A body that hardly any contact holds in one of its ways is held by this share of the stiffness
/// of all its contacts in Newton's matrix, so that it finds them.
constexpr double hardly_held = 1e-3, least_holding = 1e-2;
/// A body is to blame for a step that fails where it makes this share of what is out of balance.
constexpr double most_of_it = 0.5;
/// Rotations are multiplied by so many cells.
constexpr double arm_in_cells = 10.0;

/// Bends of the laws of contact: about zero pressure, as a share of the mean force of a body's
/// contacts, and about the limit of friction, as a share of it. Newton's method does not get past
/// corners.
constexpr double soft_share = 0.02, soft_slip = 0.1;
/// The least of the former is the force of a gap that is none, as a share of a point's thickness.
constexpr double touching = 1e-7;

/// A force and its slope over the trial force.
struct Bent {
  double value, slope;
};
/// max(0, x), within `soft` of zero a parabola.
Bent pressed(double x, double soft) {
  if (x >= soft) return {x, 1.0};
  if (x <= -soft) return {0.0, 0.0};
  return {(x + soft) * (x + soft) / (4.0 * soft), (x + soft) / (2.0 * soft)};
}
/// min(x, limit), near the limit a parabola.
Bent rubbed(double x, double limit) {
  const double soft = soft_slip * limit;
  if (x >= limit + soft) return {limit, 0.0};
  if (x <= limit - soft || std::isinf(limit)) return {x, 1.0};
  const double over = x - limit + soft;
  return {x - over * over / (4.0 * soft), 1.0 - over / (2.0 * soft)};
}

/// Marks of faces: no soil, a face that a side holds, soil.
constexpr double no_soil = -1.0, held = 0.0, soil = 1.0;

}  // namespace

template <int D>
auto ImplicitContact<D>::list_freedoms(const ImplicitProblem<D>& problem) -> std::vector<Freedom> {
  std::vector<Freedom> all;
  if (!problem.solids) return all;
  for (std::size_t s = 0; s < problem.solids->size(); ++s) {
    const Solid& solid = (*problem.solids)[s];
    if (!solid.free()) continue;
    for (int axis = 0; axis < 6; ++axis)
      if ((axis < 3 ? solid.free_axes()[axis] : solid.free_turns()[axis - 3]) != 0.0)
        all.push_back({s, axis});
  }
  return all;
}

template <int D>
int ImplicitContact<D>::freedoms(const ImplicitProblem<D>& problem) {
  return static_cast<int>(list_freedoms(problem).size());
}

template <int D>
ImplicitContact<D>::ImplicitContact(const ImplicitProblem<D>& problem,
                                    const ImplicitUnknowns<D>& unknowns)
    : problem_(&problem),
      list_(problem.grid, problem.options.kernel),
      arm_(arm_in_cells * problem.grid.smallest_spacing()),
      freedoms_(list_freedoms(problem)) {
  if (!problem.solids || problem.solids->empty()) return;
  // Without inertia there are forces instead of impulses, and ways instead of speeds.
  list_.find(1.0, watched_gap, problem.constants, *problem.solids, problem.bodies);
  keep_soil(unknowns);
  any_ = max_over_ranks(problem.grid, list_.contacts().empty() ? 0.0 : 1.0) > 0.0;
  set_stiffness();
  start_bodies();
  const std::size_t count = list_.contacts().size();
  ways_.resize(count), forces_.resize(count), leaks_.resize(count), seals_.resize(count);
  if (any_) stiffness_.list = &list_;
  stiffness_.of.resize(count);
  bounds_.resize(count), soft_.resize(count);
  set_bounds(true);
}

/// Contacts act on faces that soil moves, or that a side holds.
template <int D>
void ImplicitContact<D>::keep_soil(const ImplicitUnknowns<D>& unknowns) {
  const Grid<D>& grid = problem_->grid;
  FaceVector<D> marks(grid, "soil", "1");
  for (int d = 0; d < D; ++d) {
    const auto& numbers = unknowns.grains[static_cast<std::size_t>(d)];
    for (std::size_t at = 0; at < numbers.size(); ++at)
      marks[d].data()[at] = numbers[at] >= 0 ? soil : no_soil;
    for_each_face_on_sides(
        problem_->sides.sides(), grid.local(), d,
        [&](int, const SideNode&, const Index<D>& face) { marks[d][face] = held; });
  }
  list_.keep_faces_with_soil(marks);
}

template <int D>
void ImplicitContact<D>::set_stiffness() {
  const double h = problem_->grid.smallest_spacing();
  std::vector<double> modulus;
  for (std::size_t b = 0; b < problem_->bodies.size(); ++b)
    modulus.push_back(max_over_ranks(
        problem_->grid, largest_wave_modulus(problem_->bodies[b], *problem_->laws[b])));
  for (Contact<D>& contact : list_.contacts()) {
    const auto& points = problem_->bodies[contact.body];
    const BodyConstants& constants = problem_->constants[contact.body];
    const double volume = points.volume[contact.point], area = volume / contact.thickness;
    const double stiffness = std::max(1.0, modulus[contact.body]);
    const double per_stiffness = stiffness_factor * area / h;
    contact.stiffness = per_stiffness * stiffness;
    if (!contact.wet) continue;
    const double porosity =
        1.0 - points.grain_mass[contact.point] / (constants.grain_density * volume);
    const double drag = constants.water_viscosity / permeability(constants, porosity);
    contact.seal_stiffness = per_stiffness * (drag * h * h / problem_->dt + stiffness);
  }
}

/// Given motion; free bodies start where they are.
template <int D>
void ImplicitContact<D>::start_bodies() {
  for (const Solid& solid : *problem_->solids) {
    body_ways_.emplace_back(Vector6::Zero());
    if (!solid.free())
      body_ways_.back() << problem_->dt * solid.velocity(), problem_->dt * arm_ * solid.spin();
  }
}

/// Component by component, the way of the body at a contact per unit of its own.
template <int D>
typename ImplicitContact<D>::Arms ImplicitContact<D>::arms_of(const Contact<D>& contact) const {
  const Eigen::Vector3d centre = (*problem_->solids)[contact.solid].centre();
  Arms arms;
  for (int d = 0; d < D; ++d) {
    Vec<D> unit{};
    unit[d] = 1.0;
    const Eigen::Vector3d along = to_space(unit);
    const Eigen::Vector3d arm = to_space(contact.places[static_cast<std::size_t>(d)]) - centre;
    arms.row(d) << along.transpose(), arm.cross(along).transpose() / arm_;
  }
  return arms;
}

/// Forces on the soil for the present ways of soil and bodies.
template <int D>
void ImplicitContact<D>::press(bool tangents) {
  for (std::size_t c = 0; c < list_.contacts().size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    const Vec<D>& n = contact.normal;
    const Eigen::Matrix<double, D, 1> body = arms_of(contact) * body_ways_[contact.solid];
    Vec<D> miss = contact.approach * n;
    for (int d = 0; d < D; ++d) miss[d] += ways_[c][d] - body[d];
    const double miss_along = dot(miss, n), along_before = dot(contact.impulse, n);
    const double along = along_before - contact.stiffness * miss_along;
    const Bent pressure = pressed(along + contact.suction, soft_[c]);
    Vec<D> slip = contact.impulse - along_before * n - contact.stiffness * (miss - miss_along * n);
    const double size = norm(slip);
    if (size > 0.0) slip *= 1.0 / size;
    const Bent friction = rubbed(size, bounds_[c]);
    forces_[c] = (pressure.value - contact.suction) * n + friction.value * slip;
    seals_[c] = contact.wet ? contact.seal - contact.seal_stiffness * leaks_[c] : 0.0;
    if (!tangents) continue;
    const double turned = size > 0.0 ? friction.value / size : friction.slope;
    for (int d = 0; d < D; ++d)
      for (int e = 0; e < D; ++e) {
        const double normal = n[d] * n[e], along_slip = slip[d] * slip[e];
        const double across = (d == e ? 1.0 : 0.0) - normal - along_slip;
        stiffness_.of[c](d, e) =
            contact.stiffness *
            (pressure.slope * normal + friction.slope * along_slip + turned * across);
      }
  }
}

template <int D>
void ImplicitContact<D>::evaluate(const ImplicitFields<D>& state, bool tangents) {
  for (std::size_t c = 0; c < list_.contacts().size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    ways_[c] = list_.at_contact(state.grains, contact);
    leaks_[c] = contact.wet ? dot(list_.at_contact(state.water, contact), contact.normal) : 0.0;
  }
  for (std::size_t k = 0; k < freedoms_.size(); ++k)
    body_ways_[freedoms_[k].solid][freedoms_[k].axis] = state.bodies[k];
  press(tangents);
  if (tangents) sum_holding();
}

template <int D>
void ImplicitContact<D>::subtract(const std::vector<Vec<D>>& forces,
                                  const std::vector<double>& seals, ImplicitFields<D>& sums) const {
  for (std::size_t c = 0; c < forces.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    for (int d = 0; d < D; ++d) {
      double *grains = sums.grains[d].data(), *water = sums.water[d].data();
      const double force = forces[c][d], seal = seals[c] * contact.normal[d];
      list_.for_each_node(d, contact, [&](std::ptrdiff_t at, double w) {
        grains[at] -= w * force;
        if (contact.wet) water[at] -= w * seal;
      });
    }
    if (freedoms_.empty()) continue;
    const Arms arms = arms_of(contact);
    for_each_freedom(contact, [&](std::size_t k, int axis) {
      for (int d = 0; d < D; ++d) sums.bodies[k] += arms(d, axis) * forces[c][d];
    });
  }
}

template <int D>
void ImplicitContact<D>::add_residual(ImplicitFields<D>& sums) const {
  sums.bodies.resize(freedoms_.size());
  subtract(forces_, seals_, sums);
  if (problem_->grid.rank() != 0) return;
  for (std::size_t k = 0; k < freedoms_.size(); ++k) sums.bodies[k] -= given_load(freedoms_[k]);
}

/// Weight and given force, or moment over the arm, at the end of the step [N].
template <int D>
double ImplicitContact<D>::given_load(const Freedom& freedom) const {
  const Solid& solid = (*problem_->solids)[freedom.solid];
  const double end = problem_->time + problem_->dt;
  return freedom.axis < 3 ? solid.given_force(end)[freedom.axis]
                          : solid.given_moment(end)[freedom.axis - 3] / arm_;
}

template <int D>
void ImplicitContact<D>::add_change(ImplicitFields<D>& sums) const {
  std::vector<Vec<D>> forces = forces_;
  std::vector<double> seals = seals_;
  sums.bodies.resize(freedoms_.size());
  for (std::size_t c = 0; c < forces.size(); ++c)
    forces[c] += -1.0 * list_.contacts()[c].impulse, seals[c] -= list_.contacts()[c].seal;
  subtract(forces, seals, sums);
}

template <int D>
void ImplicitContact<D>::push_bodies(const FaceVector<D>& ways, std::vector<double>& rests) const {
  if (freedoms_.empty()) return;
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    if (!(*problem_->solids)[contact.solid].free()) continue;
    const Vec<D> way = list_.at_contact(ways, contact);
    const Arms arms = arms_of(contact);
    for (int d = 0; d < D; ++d)
      for (int e = 0; e < D; ++e)
        for_each_freedom(contact, [&](std::size_t k, int axis) {
          rests[k] -= arms(d, axis) * stiffness_.of[c](d, e) * way[e];
        });
  }
}

template <int D>
void ImplicitContact<D>::apply_bodies(const FaceVector<D>& ways, const std::vector<double>& bodies,
                                      FaceVector<D>& forces, std::vector<double>& rests) const {
  if (freedoms_.empty()) return;
  push_bodies(ways, rests);
  if (problem_->grid.rank() == 0)
    Eigen::Map<Eigen::VectorXd>(rests.data(), holding_.rows()) +=
        holding_ * Eigen::Map<const Eigen::VectorXd>(bodies.data(), holding_.cols());
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    if (!(*problem_->solids)[contact.solid].free()) continue;
    const Arms arms = arms_of(contact);
    Vector6 way = Vector6::Zero();
    for_each_freedom(contact, [&](std::size_t k, int axis) { way[axis] = bodies[k]; });
    const Eigen::Matrix<double, D, 1> change = stiffness_.of[c] * (arms * way);
    for (int d = 0; d < D; ++d) {
      double* faces = forces[d].data();
      list_.for_each_node(d, contact,
                          [&](std::ptrdiff_t at, double w) { faces[at] -= w * change[d]; });
    }
  }
}

template <int D>
void ImplicitContact<D>::sum_holding() {
  if (freedoms_.empty()) return;
  const auto count = static_cast<Eigen::Index>(freedoms_.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count, count + 1);  // and the stiffest there may be
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    const Arms arms = arms_of(contact);
    const Eigen::Matrix<double, 6, 6> own = arms.transpose() * stiffness_.of[c] * arms;
    for_each_freedom(contact, [&](std::size_t k, int row) {
      const auto r = static_cast<Eigen::Index>(k);
      all(r, count) += contact.stiffness * arms.col(row).squaredNorm();
      for_each_freedom(contact, [&](std::size_t l, int column) {
        all(r, static_cast<Eigen::Index>(l)) += own(row, column);
      });
    });
  }
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM,
                problem_->grid.comm());
  for (Eigen::Index k = 0; k < count; ++k) {
    const double stiffest = all(k, count) > 0.0 ? all(k, count) : 1.0;
    if (all(k, k) < hardly_held * stiffest) all(k, k) += least_holding * stiffest;
  }
  holding_ = all.leftCols(count);
}

template <int D>
void ImplicitContact<D>::apply_seals(const FaceVector<D>& flows, FaceVector<D>& forces) const {
  for (const Contact<D>& contact : list_.contacts()) {
    if (!contact.wet) continue;
    const double force =
        contact.seal_stiffness * dot(list_.at_contact(flows, contact), contact.normal);
    for (int d = 0; d < D; ++d) {
      double* faces = forces[d].data();
      list_.for_each_node(d, contact, [&](std::ptrdiff_t at, double w) {
        faces[at] += w * force * contact.normal[d];
      });
    }
  }
}

template <int D>
void ImplicitContact<D>::add_seal_diagonal(FaceVector<D>& diagonal) const {
  for (const Contact<D>& contact : list_.contacts()) {
    if (!contact.wet) continue;
    for (int d = 0; d < D; ++d) {
      double* faces = diagonal[d].data();
      const double n2 = contact.normal[d] * contact.normal[d];
      list_.for_each_node(d, contact, [&](std::ptrdiff_t at, double w) {
        faces[at] += w * w * n2 * contact.seal_stiffness;
      });
    }
  }
}

template <int D>
void ImplicitContact<D>::add_to(::Mat matrix, const ImplicitUnknowns<D>& unknowns) const {
  if (!any_) return;
  std::array<const std::vector<PetscInt>*, D> grains, water;
  for (std::size_t d = 0; d < D; ++d)
    grains[d] = &unknowns.grains[d], water[d] = &unknowns.water[d];
  stiffness_.add_to(matrix, grains, unknowns.grain_sign);
  ContactStiffness<D> seals = stiffness_;
  for (std::size_t c = 0; c < seals.of.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    for (int d = 0; d < D; ++d)
      for (int e = 0; e < D; ++e)
        seals.of[c](d, e) =
            contact.wet ? contact.seal_stiffness * contact.normal[d] * contact.normal[e] : 0.0;
  }
  seals.add_to(matrix, water, unknowns.water_sign);
  if (!freedoms_.empty()) add_bodies_to(matrix, unknowns);
}

/// -B C J, its counterpart and J^T C J, with J the arms.
template <int D>
void ImplicitContact<D>::add_bodies_to(::Mat matrix, const ImplicitUnknowns<D>& unknowns) const {
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    const Arms arms = arms_of(contact);
    const Arms left = stiffness_.of[c] * arms, right = stiffness_.of[c].transpose() * arms;
    for_each_freedom(contact, [&](std::size_t k, int axis) {
      const PetscInt body = unknowns.first_body + static_cast<PetscInt>(k);
      for (int d = 0; d < D; ++d) {
        const auto u = static_cast<std::size_t>(d);
        list_.for_each_node(d, contact, [&](std::ptrdiff_t at, double w) {
          const auto place = static_cast<std::size_t>(at);
          const PetscInt face = unknowns.grains[u][place];
          if (face < 0) return;
          const double weight = -w * unknowns.grain_sign[u][place];
          MatSetValue(matrix, face, body, weight * left(d, axis), ADD_VALUES);
          MatSetValue(matrix, body, face, weight * right(d, axis), ADD_VALUES);
        });
      }
    });
  }
  if (problem_->grid.rank() != 0) return;
  for (Eigen::Index k = 0; k < holding_.rows(); ++k)
    for (Eigen::Index l = 0; l < holding_.cols(); ++l)
      MatSetValue(matrix, unknowns.first_body + static_cast<PetscInt>(k),
                  unknowns.first_body + static_cast<PetscInt>(l), holding_(k, l), ADD_VALUES);
}

template <int D>
bool ImplicitContact<D>::misses() const {
  std::array<double, 3> mine{}, all{};  // ways, what is left of them, and leaks
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    mine[0] = std::max(mine[0], norm(ways_[c]));
    mine[1] = std::max(mine[1], norm(forces_[c] - contact.impulse) / contact.stiffness);
    if (contact.wet) mine[2] = std::max(mine[2], std::abs(leaks_[c]));
  }
  MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_MAX, problem_->grid.comm());
  const double least = 1e-9 * problem_->grid.smallest_spacing();
  return std::max(all[1], all[2]) > left_over * std::max(all[0], least);
}

template <int D>
double ImplicitContact<D>::largest_compression() const {
  double mine = 0.0, all = 0.0;
  for (std::size_t c = 0; c < forces_.size(); ++c)
    mine = std::max(mine, norm(forces_[c]) / list_.contacts()[c].stiffness);
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, problem_->grid.comm());
  return all;
}

template <int D>
void ImplicitContact<D>::begin_pass() {
  for (std::size_t c = 0; c < forces_.size(); ++c)
    list_.contacts()[c].impulse = forces_[c], list_.contacts()[c].seal = seals_[c];
  set_bounds(false);
}

/// Friction and adhesion of a pass are those of the pressure that it starts with: its balance is
/// then that of a convex energy, which Newton's method finds. In the step's first pass a contact
/// counts at least the mean pressure of its body, and without any it sticks: otherwise what begins
/// to press would slip.
template <int D>
void ImplicitContact<D>::set_bounds(bool first) {
  std::vector<double> sums(2 * body_ways_.size(), 0.0);  // of the pressures and their squares
  for (const Contact<D>& contact : list_.contacts()) {
    const double pressure = std::max(0.0, dot(contact.impulse, contact.normal));
    sums[2 * contact.solid] += pressure, sums[2 * contact.solid + 1] += pressure * pressure;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                problem_->grid.comm());
  for (std::size_t c = 0; c < bounds_.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    const double* sum = &sums[2 * contact.solid];
    const double mean = sum[0] > 0.0 ? sum[1] / sum[0] : 0.0;  // those that press count most
    const double pressure = std::max(first ? mean : 0.0, dot(contact.impulse, contact.normal));
    const bool sticks = contact.friction > 0.0 && first && mean == 0.0;
    bounds_[c] = sticks || std::isinf(contact.friction)
                     ? std::numeric_limits<double>::infinity()
                     : contact.adhesion + contact.friction * pressure;
    soft_[c] = std::max(soft_share * mean, touching * contact.stiffness * contact.thickness);
  }
}

template <int D>
std::string ImplicitContact<D>::unheld(const std::vector<double>& rests, double all) const {
  constexpr std::array<const char*, 6> ways{"along x", "along y", "along z",
                                            "about x", "about y", "about z"};
  for (std::size_t k = 0; k < freedoms_.size(); ++k)
    if (std::abs(rests[k]) > most_of_it * all)
      return fmt::format("; nothing holds solid {} {} ({:.3g} N{})",
                         (*problem_->solids)[freedoms_[k].solid].options().name,
                         ways[static_cast<std::size_t>(freedoms_[k].axis)],
                         freedoms_[k].axis < 3 ? rests[k] : rests[k] * arm_,
                         freedoms_[k].axis < 3 ? "" : " m");
  return {};
}

template <int D>
void ImplicitContact<D>::finish() {
  if (!problem_->solids || problem_->solids->empty()) return;
  std::vector<ContactLoad> loads(body_ways_.size());
  begin_pass();
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const Contact<D>& contact = list_.contacts()[c];
    loads[contact.solid].add_answer(contact, forces_[c], (*problem_->solids)[contact.solid]);
  }
  list_.note_forces(1.0, problem_->bodies);
  add_over_ranks(problem_->grid.comm(), loads);
  const double dt = problem_->dt;
  for (std::size_t s = 0; s < body_ways_.size(); ++s)
    (*problem_->solids)[s].follow(
        {body_ways_[s].template head<3>() / dt, body_ways_[s].template tail<3>() / (dt * arm_)},
        dt * loads[s].impulse, dt * loads[s].moment);
}

template class ImplicitContact<2>;
template class ImplicitContact<3>;

}  // namespace mudlark

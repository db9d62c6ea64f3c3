#include "soil/contact_search.hpp"

#include <algorithm>
#include <cmath>

#include "soil/point_stencil.hpp"

namespace mudlark {
namespace {

/// Contacts with less than this share of their weights on faces with soil are none.
constexpr double smallest_sum = 0.1;
/// How far beside a contact its faces may lie, on a surface of any direction [cells].
constexpr double widest_reach = 2.5;
/// A contact keeps all its faces where less than this share of their weights is in front of the
/// body: next to a needle.
constexpr double least_covered = 0.05;

/// Share of the grains in the pressure on a surface.
template <int D>
double effective_share(const SoilParticles<D>& points, std::size_t p, const Vec<D>& normal,
                       double pore_pressure) {
  const SymTensor stress = get_tensor(points.stress, p);
  double pressed = 0.0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) pressed -= normal[i] * stress.template between<D>(i, j) * normal[j];
  pressed = std::max(0.0, pressed);
  const double whole = pressed + std::max(0.0, pore_pressure);
  return whole > 0.0 ? pressed / whole : 1.0;
}

/// How far a point reaches along a normal, from its extent (that of the lattice, deformed with the
/// soil) [m]; at most a cell, as ghost layers end there.
template <int D>
double thickness_of(const SoilParticles<D>& points, std::size_t p, const Vec<D>& normal,
                    double cell) {
  SymTensor extent;
  const auto& e = points.extent;
  if constexpr (D == 2)
    extent = {e[0][p], 0.0, e[1][p], 0.0, 0.0, e[2][p]};
  else
    extent = get_tensor(e, p);
  double squared = 0.0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) squared += normal[i] * extent.template between<D>(i, j) * normal[j];
  return std::clamp(std::sqrt(std::max(0.0, squared)), 0.1 * cell, cell);
}

/// Two directions along a surface, in the plane one; in what is the same all along y those of the
/// plane.
template <int D>
std::array<Vec<D>, D - 1> along(const Vec<D>& normal) {
  if constexpr (D == 2) {
    return {Vec<2>{{-normal[1], normal[0]}}};
  } else {
    const int axis = std::abs(normal[1]) < 0.9 ? 1 : 0;
    Vec<3> first = -normal[axis] * normal;
    first[axis] += 1.0;
    first *= 1.0 / norm(first);
    const Vec<3> second{{normal[1] * first[2] - normal[2] * first[1],
                         normal[2] * first[0] - normal[0] * first[2],
                         normal[0] * first[1] - normal[1] * first[0]}};
    return {first, second};
  }
}

/// How far inside the body a place is that lies `beside` a contact along the surface and half a
/// cell under it [cells]. Behind the sides of the domain, and up to half a cell before them, the
/// body is as it is there: one that ends at a side has no edge.
template <int D>
double depth_at(const Solid& solid, const Grid<D>& grid, const Vec<D>& contact,
                const Vec<D>& normal, const Vec<D>& beside) {
  const double cell = grid.smallest_spacing();
  const Vec<D> lower = grid.lower(), upper = grid.upper();
  Vec<D> place = contact + beside - 0.5 * cell * normal;
  for (int a = 0; a < D; ++a)
    place[a] = std::clamp(place[a], lower[a] + 0.5 * cell, upper[a] - 0.5 * cell);
  return -solid.distance(to_point3(place)).distance / cell;
}

}  // namespace

/// Does a point touch the body, or may it in this step? Sets all that depends on their places. For
/// adhesion a point covers its volume over its thickness of the surface, fading from half a
/// thickness away to one and a half, so that rows and random points alike cover it once.
template <int D>
bool ContactList<D>::touch(double dt, double watched_gap, const Solid& solid,
                           const SoilParticles<D>& points, Contact<D>& contact) const {
  const std::size_t p = contact.point;
  const double volume = points.volume[p];
  const Vec<D> position = points.position_of(p);
  const SurfaceDistance surface = solid.distance(to_point3(position));
  contact.normal = to_axes<D>(to_vector(surface.normal));
  const double thickness = thickness_of(points, p, contact.normal, grid_->smallest_spacing());
  const double gap = surface.distance - 0.5 * thickness;
  const double adhesion = solid.options().adhesion;
  if (gap > (adhesion > 0.0 ? 1.0 : watched_gap) * thickness) return false;
  contact.place = position - 0.5 * thickness * contact.normal;
  contact.places.fill(contact.place);
  contact.thickness = thickness;
  contact.approach = std::max(0.0, gap) / dt;
  const double area = volume / thickness;
  contact.adhesion = dt * adhesion * area * std::clamp(1.0 - gap / thickness, 0.0, 1.0);
  contact.friction = solid.options().friction;
  if (!contact.wet) return true;
  const double pressure = points.pore_pressure[p];
  contact.suction = dt * area * std::max(0.0, -pressure);
  const double share = effective_share(points, p, contact.normal, pressure);
  contact.friction = share > 0.0 ? share * contact.friction : 0.0;  // which may be infinite
  return true;
}

/// Does the surface go on around a contact as far as its faces lie, hardly bent?
template <int D>
bool ContactList<D>::far_from_edges(const Solid& solid, const Contact<D>& contact) const {
  const double cell = grid_->smallest_spacing();
  const auto tangents = along(contact.normal);
  for (int corner = 0; corner < (1 << (D - 1)); ++corner) {
    Vec<D> beside{};
    for (int a = 0; a < D - 1; ++a)
      beside += ((corner >> a & 1) ? 1.0 : -1.0) * widest_reach * cell *
                tangents[static_cast<std::size_t>(a)];
    if (depth_at(solid, *grid_, contact.place, contact.normal, beside) < 0.25) return false;
  }
  return true;
}

/// Takes faces that are not in front of the body out of the weights from `first` on. A node beyond
/// the body's edge, seen along the normal, does not count; one half a cell within it counts in
/// full. The points along the edge hold all faces that they reach, and with those beyond it the
/// body was a cell wider all round (decision 0089). The impulse acts at the centre of what is left.
template <int D>
void ContactList<D>::keep_covered(int component, std::size_t first, const Solid& solid,
                                  Contact<D>& contact) {
  double sum = 0.0;
  Vec<D> centre{};
  for (std::size_t i = first; i < nodes_.size(); ++i) {
    const Vec<D> away = node_places_[i - first] - contact.place;
    const Vec<D> beside = away - dot(away, contact.normal) * contact.normal;
    const double depth = depth_at(solid, *grid_, contact.place, contact.normal, beside);
    covered_[i - first] = nodes_[i].weight * std::clamp(2.0 * depth, 0.0, 1.0);
    sum += covered_[i - first];
    centre += covered_[i - first] * node_places_[i - first];
  }
  if (sum < least_covered) return;
  for (std::size_t i = first; i < nodes_.size(); ++i) nodes_[i].weight = covered_[i - first] / sum;
  contact.places[static_cast<std::size_t>(component)] = 1.0 / sum * centre;
}

/// The faces that hear of a contact, and how much: the edge of a point moves as the place half a
/// thickness into the soil does, less what the point itself stretches,
/// W(x_p + d/2 n) - d n . grad W(x_p).
/// Forces shared out by these weights meet the stress of the points where the points have it: a
/// uniform stress stays uniform up to the body. Weights at the edge itself would not, as points sum
/// up the divergence of stress and do not integrate it; faces that the outermost points hardly
/// reach would need stresses there that oscillate (decision 0050).
template <int D>
void ContactList<D>::list_nodes(const Vec<D>& position, const Solid& solid, Contact<D>& contact) {
  const Vec<D> per_spacing = inverse(grid_->spacing());
  const Vec<D> deeper = position + 0.5 * contact.thickness * contact.normal;
  const bool whole = !solid.options().sharp_edges || far_from_edges(solid, contact);
  const auto add = [&](std::size_t first, std::ptrdiff_t at, double weight, const Vec<D>& place) {
    if (weight == 0.0) return;
    for (std::size_t i = first; i < nodes_.size(); ++i)
      if (nodes_[i].at == at) {
        nodes_[i].weight += weight;
        return;
      }
    node_places_[nodes_.size() - first] = place;
    nodes_.push_back({at, weight});
  };
  with_kernel(kernel_, [&]<class K>(K) {
    using Splines = PointSplines<D, K>;
    const Vec<D> own_cells = in_cells(*grid_, per_spacing, position);
    const Vec<D> deep_cells = in_cells(*grid_, per_spacing, deeper);
    const Splines own(own_cells), deep(deep_cells);
    Splines::template static_for<D>([&]<int Component>() {
      const std::size_t first = nodes_.size();
      contact.nodes[Component] = first;
      const auto place_of = [&](const Vec<D>& from, const Vec<D>& to_first, const Vec<D>& count) {
        Vec<D> place = from;
        for (int a = 0; a < D; ++a) place[a] += (to_first[a] + count[a]) * grid_->spacing()[a];
        return place;
      };
      const Vec<D> deep_first = deep.template first_from_point<Component>(deep_cells);
      deep.template for_each_node<Component>(
          *grid_, per_spacing,
          [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>& count) {
            add(first, at, w, place_of(deeper, deep_first, count));
          });
      const Vec<D> own_first = own.template first_from_point<Component>(own_cells);
      own.template for_each_node<Component>(
          *grid_, per_spacing,
          [&](std::ptrdiff_t at, double, const Vec<D>& g, const Vec<D>& count) {
            add(first, at, -contact.thickness * dot(g, contact.normal),
                place_of(position, own_first, count));
          });
      if (!whole) keep_covered(Component, first, solid, contact);
    });
  });
  contact.nodes[D] = nodes_.size();
}

template <int D>
void ContactList<D>::find(double dt, double watched_gap,
                          const std::vector<BodyConstants>& constants,
                          const std::vector<Solid>& solids,
                          const std::vector<SoilParticles<D>>& bodies) {
  contacts_.clear(), nodes_.clear();
  const double reach = 2.0 * grid_->smallest_spacing();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const SoilParticles<D>& points = bodies[b];
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Point3 place = to_point3(points.position_of(p));
      bool known = false;  // the last step's impulse belongs to one contact
      for (std::size_t s = 0; s < solids.size(); ++s) {
        if (!solids[s].near(place, reach)) continue;
        Contact<D> contact;
        contact.body = b, contact.point = p, contact.solid = s;
        contact.wet = constants[b].water_density > 0.0;
        if (!touch(dt, watched_gap, solids[s], points, contact)) continue;
        for (int a = 0; a < D && !known; ++a) contact.impulse[a] = dt * points.contact_force[a][p];
        if (!known) contact.seal = dt * points.contact_force[D][p];
        known = true;
        list_nodes(points.position_of(p), solids[s], contact);
        contacts_.push_back(contact);
      }
    }
  }
}

template <int D>
void ContactList<D>::keep_faces_with_soil(const FaceVector<D>& soil) {
  std::size_t kept = 0, kept_nodes = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    Contact<D> contact = contacts_[c];
    const std::size_t start = kept_nodes;
    bool alone = false;
    for (int d = 0; d < D; ++d) {
      const auto u = static_cast<std::size_t>(d);
      const double* marks = soil[d].data();
      const std::size_t first = kept_nodes;
      double sum = 0.0;
      for (std::size_t i = contacts_[c].nodes[u]; i < contacts_[c].nodes[u + 1]; ++i) {
        if (marks[nodes_[i].at] < 0.0) continue;
        sum += nodes_[i].weight;
        nodes_[kept_nodes++] = nodes_[i];
      }
      alone = alone || sum < smallest_sum;
      for (std::size_t i = first; i < kept_nodes; ++i) nodes_[i].weight /= sum;
      contact.nodes[u] = first, contact.nodes[u + 1] = kept_nodes;
    }
    if (alone)
      kept_nodes = start;
    else
      contacts_[kept++] = contact;
  }
  contacts_.resize(kept), nodes_.resize(kept_nodes);
}

template <int D>
void ContactList<D>::note_forces(double dt, std::vector<SoilParticles<D>>& bodies) const {
  for (auto& points : bodies)
    for (int a = 0; a <= D; ++a)
      std::fill(points.contact_force[a].begin(), points.contact_force[a].end(), 0.0);
  for (const Contact<D>& contact : contacts_) {
    auto& force = bodies[contact.body].contact_force;
    for (int a = 0; a < D; ++a) force[a][contact.point] += contact.impulse[a] / dt;
    force[D][contact.point] += contact.seal / dt;
  }
}

template <int D>
Vec<D> ContactList<D>::at_contact(const FaceVector<D>& field, const Contact<D>& contact) const {
  Vec<D> sum;
  for (int d = 0; d < D; ++d) {
    const double* faces = field[d].data();
    for_each_node(d, contact, [&](std::ptrdiff_t at, double w) { sum[d] += w * faces[at]; });
  }
  return sum;
}

template <int D>
Vec<D> ContactList<D>::velocity_of(const Solid& solid, const Contact<D>& contact) {
  Vec<D> velocity;
  for (int d = 0; d < D; ++d)
    velocity[d] =
        to_axes<D>(solid.velocity_at(to_space(contact.places[static_cast<std::size_t>(d)])))[d];
  return velocity;
}

template <int D>
Vec<D> Contact<D>::bounded(const Vec<D>& trial) const {
  const double along = dot(trial, normal), pressed = std::max(-suction, along);
  const double largest = adhesion + (pressed > 0.0 ? friction * pressed : 0.0);
  Vec<D> tangent = trial - along * normal;
  const double size = norm(tangent);
  if (size > largest) tangent *= largest / size;
  return pressed * normal + tangent;
}

template <int D>
void ContactLoad::add_answer(const Contact<D>& contact, const Vec<D>& impulse_on_soil,
                             const Solid& solid) {
  impulse -= to_space(impulse_on_soil);
  for (int d = 0; d < D; ++d) {
    Vec<D> part{};
    part[d] = -impulse_on_soil[d];
    moment += (to_space(contact.places[static_cast<std::size_t>(d)]) - solid.centre())
                  .cross(to_space(part));
  }
}

void add_over_ranks(MPI_Comm comm, std::vector<ContactLoad>& loads) {
  static_assert(sizeof(ContactLoad) == 6 * sizeof(double));
  if (loads.empty()) return;
  MPI_Allreduce(MPI_IN_PLACE, loads.front().impulse.data(), 6 * static_cast<int>(loads.size()),
                MPI_DOUBLE, MPI_SUM, comm);
}

template struct Contact<2>;
template struct Contact<3>;
template class ContactList<2>;
template class ContactList<3>;
template void ContactLoad::add_answer(const Contact<2>&, const Vec<2>&, const Solid&);
template void ContactLoad::add_answer(const Contact<3>&, const Vec<3>&, const Solid&);

}  // namespace mudlark

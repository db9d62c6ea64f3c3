#pragma once
/// Which material points touch rigid bodies, and which faces hear of it.
#include <array>
#include <vector>

#include "grid/solid.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// One material point at one body. Impulses are over the length of a step; in implicit steps, which
/// have none, they are forces and speeds are ways.
template <int D>
struct Contact {
  std::size_t body = 0, point = 0, solid = 0;
  bool wet = false;
  Vec<D> place{}, normal{};  ///< edge of the point, and out of the body
  /// Where the components of its impulse act: `place`, or beside it at an edge of the body.
  std::array<Vec<D>, D> places{};
  double thickness = 0.0;       ///< of the point [m]
  double approach = 0.0;        ///< speed along -normal that closes the gap in the step [m/s]
  double adhesion = 0.0;        ///< largest impulse along the surface without pressure [N s]
  double friction = 0.0;        ///< on the whole pressure, that of pore water included [-]
  double suction = 0.0;         ///< largest pull, by pore water below zero pressure [N s]
  double stiffness = 0.0;       ///< impulse per velocity that all contacts may give at once [kg]
  double seal_stiffness = 0.0;  ///< the same of water against grains [kg]
  Vec<D> impulse{};             ///< on the soil [N s]
  double seal = 0.0;            ///< along the normal on the water, and its opposite on the grains
  std::array<std::size_t, D + 1> nodes{};  ///< first of the list's nodes per component, and the end

  /// The part of a trial impulse that is allowed: pressure, or as much pull as there is suction,
  /// and along the surface at most friction times pressure and the adhesion (Coulomb).
  Vec<D> bounded(const Vec<D>& trial) const;
};

/// The contacts of this rank's points and the faces that they act on. Soil touches a body where the
/// edge of a material point reaches the body's surface (decision 0050).
template <int D>
class ContactList {
 public:
  struct Node {
    std::ptrdiff_t at;
    double weight;
  };

  ContactList(const Grid<D>& grid, Kernel kernel) : grid_(&grid), kernel_(kernel) {}

  /// Lists the contacts of all points in a step of dt [s], each with its impulse of the last step
  /// for a start: points whose gap is at most `watched_gap` of their thickness.
  void find(double dt, double watched_gap, const std::vector<BodyConstants>& constants,
            const std::vector<Solid>& solids, const std::vector<SoilParticles<D>>& bodies);
  /// Keeps the faces where `soil` is not negative, makes their weights add up to one, and drops
  /// contacts without any.
  void keep_faces_with_soil(const FaceVector<D>& soil);
  /// The impulses of a step of dt [s] wait with the points for the next one.
  void note_forces(double dt, std::vector<SoilParticles<D>>& bodies) const;

  /// Calls f(offset, weight) for the faces of one component around a contact.
  template <class F>
  void for_each_node(int component, const Contact<D>& contact, F&& f) const {
    const auto u = static_cast<std::size_t>(component);
    for (std::size_t i = contact.nodes[u]; i < contact.nodes[u + 1]; ++i)
      f(nodes_[i].at, nodes_[i].weight);
  }
  /// Value of a field at a contact.
  Vec<D> at_contact(const FaceVector<D>& field, const Contact<D>& contact) const;
  /// Velocity of a body at a contact, component by component where it acts [m/s].
  static Vec<D> velocity_of(const Solid& solid, const Contact<D>& contact);

  std::vector<Contact<D>>& contacts() { return contacts_; }
  const std::vector<Contact<D>>& contacts() const { return contacts_; }

 private:
  bool touch(double dt, double watched_gap, const Solid& solid, const SoilParticles<D>& points,
             Contact<D>& contact) const;
  bool far_from_edges(const Solid& solid, const Contact<D>& contact) const;
  void keep_covered(int component, std::size_t first, const Solid& solid, Contact<D>& contact);
  void list_nodes(const Vec<D>& position, const Solid& solid, Contact<D>& contact);

  const Grid<D>* grid_;
  Kernel kernel_;
  std::vector<Contact<D>> contacts_;
  std::vector<Node> nodes_;
  /// Of one component of one contact: nodes of two stencils and a half, and their new weights.
  std::array<Vec<D>, 128> node_places_{};
  std::array<double, 128> covered_{};
};

/// Force and moment on a body, or their impulses.
struct ContactLoad {
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();

  /// Adds the opposite of an impulse on the soil.
  template <int D>
  void add_answer(const Contact<D>& contact, const Vec<D>& impulse_on_soil, const Solid& solid);
};
/// Sums of all ranks. Collective.
void add_over_ranks(MPI_Comm comm, std::vector<ContactLoad>& loads);

extern template struct Contact<2>;
extern template struct Contact<3>;
extern template class ContactList<2>;
extern template class ContactList<3>;

}  // namespace mudlark

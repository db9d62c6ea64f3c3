#pragma once
/// Contact of material points with rigid bodies.
#include <vector>

#include "grid/halo.hpp"
#include "grid/solid.hpp"
#include "soil/nodes.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/sides.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// Soil touches a body where the edge of a material point reaches the body's surface. There, on the
/// surface, the velocity that the faces around give must not point into the body faster than the
/// gap allows; the impulse that sees to this is shared among the faces by their weights and taken
/// from the body. Coulomb's law bounds its part along the surface. Pore water does not pass the
/// surface. Impulses of all contacts are
/// found together by a few sweeps of a projected Jacobi iteration, from those of the last step on.
/// Whatever the sweeps leave undone, momentum and its moment are conserved to round-off (decision
/// 0016).
template <int D>
class SolidContact {
 public:
  SolidContact(const SoilSides<D>& sides, const SoilOptions& options);

  /// Adds what the bodies give in a step of dt [s] to the motion of the faces in `active` and to
  /// the forces in the sums; sets the bodies' impulses. Sums come folded, motion without ghosts and
  /// mirrors. Collective.
  void apply(double dt, const std::vector<BodyConstants>& constants, const IndexBox<D>& active,
             std::vector<Solid>& solids, std::vector<SoilParticles<D>>& bodies,
             NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion);
  /// The same in two parts around a solution of faces that knows more than the soil (NUMERICS C2):
  /// `lean` adds the impulses that the contacts start with to the forces in the sums, `settle` what
  /// they lack to the velocity that came out [m/s]; soil without pore water of its own. Collective.
  void lean(double dt, const std::vector<BodyConstants>& constants, const IndexBox<D>& active,
            std::vector<Solid>& solids, std::vector<SoilParticles<D>>& bodies,
            NodeField<NodeSums, D>& sums);
  void settle(double dt, std::vector<Solid>& solids, std::vector<SoilParticles<D>>& bodies,
              FaceVector<D>& velocity);
  /// Mean force of the bodies on a face in the last step [N].
  double force(int axis, std::ptrdiff_t at) const { return force_[axis].data()[at]; }

 private:
  struct Node {
    std::ptrdiff_t at;
    double weight;
  };
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
    std::array<std::size_t, D + 1> nodes{};  ///< first of its nodes_ per component, and the end
  };
  struct Load {
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  };

  void set_box(const std::vector<Solid>& solids, const IndexBox<D>& active);
  void find(double dt, const std::vector<BodyConstants>& constants,
            const std::vector<Solid>& solids, std::vector<SoilParticles<D>>& bodies);
  bool touch(double dt, const Solid& solid, const SoilParticles<D>& points, Contact& contact) const;
  bool far_from_edges(const Solid& solid, const Contact& contact) const;
  void keep_covered(int component, std::size_t first, const Solid& solid, Contact& contact);
  void list_nodes(const Vec<D>& position, const Solid& solid, Contact& contact);
  bool prepare(double dt, const std::vector<BodyConstants>& constants, const IndexBox<D>& active,
               std::vector<Solid>& solids, std::vector<SoilParticles<D>>& bodies,
               const NodeField<NodeSums, D>& sums);
  void read_mobilities(double dt, const NodeField<NodeSums, D>& sums);
  void sweep_and_spread(std::vector<Solid>& solids);
  template <class F>
  void for_each_wall_face(F&& f) const;
  void keep_faces_with_soil();
  void set_stiffness(const std::vector<Solid>& solids);
  double largest_sum(const FaceVector<D>& field, const Contact& contact) const;
  void sweep(const std::vector<Solid>& solids);
  Vec<D> at_contact(const FaceVector<D>& field, const Contact& contact) const;
  void give(const Contact& contact, const Vec<D>& impulse, double seal, const Solid& solid);
  void spread(std::vector<Solid>& solids);
  void write_back(double dt, NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion);
  void note_forces(double dt, std::vector<SoilParticles<D>>& bodies) const;
  void clear(FaceVector<D>& field);
  void gather_sums(FaceVector<D>& field, bool signs);
  void complete(FaceVector<D>& field, bool signs);
  template <class F>
  void for_each_face(int axis, F&& f) const;
  template <class F>
  void for_each_node(int axis, const Contact& contact, F&& f) const;

  const SoilSides<D>* sides_;
  const Grid<D>* grid_;
  Kernel kernel_;
  double inertia_;
  bool exchanges_, wet_;  ///< ghosts; pore water
  Halo<D> halo_;
  IndexBox<D> box_{};  ///< faces that contacts may reach
  bool any_ = false;   ///< contacts on any rank
  std::vector<Contact> contacts_;
  std::vector<Node> nodes_;
  /// Of one component of one contact: nodes of two stencils and a half, and their new weights.
  std::array<Vec<D>, 128> node_places_{};
  std::array<double, 128> covered_{};
  std::vector<Load> loads_;  ///< on the bodies by this rank's contacts
  std::vector<double> reduced_;
  /// With u the velocity of the grains, r that of the water past them, P an impulse on the grains
  /// and Q one on the water with its opposite on the grains:
  /// du = a P - c Q, dr = e Q - c P, with drag in a (negative where there is no soil), c and e.
  FaceVector<D> velocity_, slip_, mobility_, cross_mobility_, slip_mobility_;
  FaceVector<D> impulse_, seal_;              ///< P and Q of a sweep [N s]
  FaceVector<D> total_impulse_, total_seal_;  ///< of all sweeps of a step [N s]
  FaceVector<D> force_;                       ///< of the last step [N]
};

extern template class SolidContact<2>;
extern template class SolidContact<3>;

}  // namespace mudlark

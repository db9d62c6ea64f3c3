#pragma once
/// Contact of material points with rigid bodies.
#include <vector>

#include "grid/halo.hpp"
#include "grid/solid.hpp"
#include "soil/contact_search.hpp"
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
  void set_box(const std::vector<Solid>& solids, const IndexBox<D>& active);
  bool prepare(double dt, const std::vector<BodyConstants>& constants, const IndexBox<D>& active,
               std::vector<Solid>& solids, std::vector<SoilParticles<D>>& bodies,
               const NodeField<NodeSums, D>& sums);
  void read_mobilities(double dt, const NodeField<NodeSums, D>& sums);
  void sweep_and_spread(std::vector<Solid>& solids);
  template <class F>
  void for_each_wall_face(F&& f) const;
  void set_stiffness(const std::vector<Solid>& solids);
  double largest_sum(const FaceVector<D>& field, const Contact<D>& contact) const;
  void sweep(const std::vector<Solid>& solids);
  void give(const Contact<D>& contact, const Vec<D>& impulse, double seal, const Solid& solid);
  void spread(std::vector<Solid>& solids);
  void write_back(double dt, NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion);
  void clear(FaceVector<D>& field);
  void gather_sums(FaceVector<D>& field, bool signs);
  void complete(FaceVector<D>& field, bool signs);
  template <class F>
  void for_each_face(int axis, F&& f) const;

  const SoilSides<D>* sides_;
  const Grid<D>* grid_;
  double inertia_;
  bool exchanges_, wet_;  ///< ghosts; pore water
  Halo<D> halo_;
  IndexBox<D> box_{};  ///< faces that contacts may reach
  bool any_ = false;   ///< contacts on any rank
  ContactList<D> list_;
  std::vector<ContactLoad> loads_, all_loads_;  ///< on the bodies by contacts of this rank, of all
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

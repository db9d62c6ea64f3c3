#pragma once
/// Contact of soil with rigid bodies in an implicit step.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "soil/contact_stiffness.hpp"
#include "soil/implicit_step.hpp"

namespace mudlark {

/// In the step's end no contact may enter its body, and Coulomb's law bounds the force along the
/// surface. By augmented Lagrangians (Simo & Laursen 1992): the force is that of the last step, or
/// of the last pass, plus a stiffness times what the edge still goes too far, bounded; passes are
/// repeated until nothing is left that matters. Friction is that of the pressure at the pass'
/// start. Pore water does not pass the surface, by the same means. The freedoms of free bodies are
/// unknowns, their equations the balance of forces and moments on them.
template <int D>
class ImplicitContact {
 public:
  /// How many ways all free bodies may move in.
  static int freedoms(const ImplicitProblem<D>& problem);

  /// Bodies are where they are at the start of the step, with the velocity of given motion.
  /// Collective.
  ImplicitContact(const ImplicitProblem<D>& problem, const ImplicitUnknowns<D>& unknowns);

  /// Are there contacts on any rank?
  bool any() const { return any_; }
  /// Forces for these ways of soil and bodies, and with `tangents` their change. Collective.
  void evaluate(const ImplicitFields<D>& state, bool tangents);
  /// Takes the forces of the last evaluation from what is out of balance.
  void add_residual(ImplicitFields<D>& sums) const;

  /// The tangent of the last evaluation with tangents; bodies held.
  const ContactStiffness<D>& stiffness() const { return stiffness_; }
  /// The rest of the tangent: adds to `forces`, and to `rests` of the bodies on this rank, what
  /// changes with the ways of bodies, and of the soil around them.
  void apply_bodies(const FaceVector<D>& ways, const std::vector<double>& bodies,
                    FaceVector<D>& forces, std::vector<double>& rests) const;
  /// Adds to `rests` what `ways` of the soil push bodies with.
  void push_bodies(const FaceVector<D>& ways, std::vector<double>& rests) const;
  /// Change of the bodies' rests with their own ways, all ranks together; what hardly any contact
  /// holds is held a little.
  const Eigen::MatrixXd& holding() const { return holding_; }
  /// The whole tangent, sealed water and bodies included, for the direct solver. Collective.
  void add_to(::Mat matrix, const ImplicitUnknowns<D>& unknowns) const;
  /// Adds what seals answer to `flows` of the water to `forces`.
  void apply_seals(const FaceVector<D>& flows, FaceVector<D>& forces) const;
  void add_seal_diagonal(FaceVector<D>& diagonal) const;

  /// Does the last evaluation leave ways of edges that matter? Collective.
  bool misses() const;
  /// What the largest force of a contact presses its spring together by [m]. Collective.
  double largest_compression() const;
  /// Takes the change of forces since the pass began from what is out of balance.
  void add_change(ImplicitFields<D>& sums) const;
  /// Takes the forces of the last evaluation for those that the next pass starts with. Collective.
  void begin_pass();
  /// The free body that most of what is out of balance, of this size, is left on, in words; empty
  /// when it is on soil.
  std::string unheld(const std::vector<double>& rests, double all) const;
  /// Leaves forces with points and bodies, and free bodies with the velocity of the step's mean.
  void finish();

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Arms = Eigen::Matrix<double, D, 6>;
  /// Translation, and rotation times a length, along and about an axis of space.
  struct Freedom {
    std::size_t solid;
    int axis;
  };
  static std::vector<Freedom> list_freedoms(const ImplicitProblem<D>& problem);
  Arms arms_of(const Contact<D>& contact) const;
  void keep_soil(const ImplicitUnknowns<D>& unknowns);
  void set_stiffness();
  void start_bodies();
  void press(bool tangents);
  void sum_holding();
  void set_bounds(bool first);
  double given_load(const Freedom& freedom) const;
  void subtract(const std::vector<Vec<D>>& forces, const std::vector<double>& seals,
                ImplicitFields<D>& sums) const;
  void add_bodies_to(::Mat matrix, const ImplicitUnknowns<D>& unknowns) const;
  /// Calls f(number of a freedom, its column of the arms) for those of a contact's body.
  template <class F>
  void for_each_freedom(const Contact<D>& contact, F&& f) const {
    for (std::size_t k = 0; k < freedoms_.size(); ++k)
      if (freedoms_[k].solid == contact.solid) f(k, freedoms_[k].axis);
  }

  const ImplicitProblem<D>* problem_;
  ContactList<D> list_;
  bool any_ = false;
  double arm_;  ///< the length that makes ways of rotations [m]
  std::vector<Freedom> freedoms_;
  std::vector<Vector6> body_ways_;     ///< of each body in the step
  std::vector<Vec<D>> ways_, forces_;  ///< of the soil at each contact, on the soil
  std::vector<double> leaks_, seals_;  ///< way of the water out of the soil [m], force on it [N]
  std::vector<double> bounds_;         ///< of forces along the surface [N]
  std::vector<double> soft_;           ///< forces about which a contact opens and closes [N]
  ContactStiffness<D> stiffness_;
  Eigen::MatrixXd holding_;
};

extern template class ImplicitContact<2>;
extern template class ImplicitContact<3>;

}  // namespace mudlark

#pragma once
/// Coulomb friction of soil on sides of the domain, or on parts of them.
#include <memory>
#include <string>
#include <vector>

#include "grid/halo.hpp"
#include "soil/nodes.hpp"
#include "soil/sides.hpp"

namespace mudlark {

/// A wall of friction is a smooth mirror for the motion of the soil; what the mirror presses back
/// with is the normal reaction, and the lowest row of faces along the wall is held back by at most
/// the coefficient times it. Effective stress counts: pore pressure does not press grains on walls.
///
/// The mirror also holds soil that would lift off. Soil that swings presses more than its weight
/// and pulls in turn, and the positive half alone is more than the mean: what a wall pulled is
/// owed, and taken from the pressure after it before that rubs. Debts fade within some swings of a
/// layer, so that soil which hung on a wall for long rubs again soon after it lies on it.
template <int D>
class WallContact {
 public:
  explicit WallContact(const SoilSides<D>& sides);

  bool empty() const { return walls_.empty(); }
  /// How velocities change in a step.
  struct Change {
    double dt;            ///< [s]
    double flip;          ///< share of FLIP in what points get [-]
    double inertia;       ///< factor on the mass [-]
    bool lifted = false;  ///< do grains weigh less by a pressure that is no part of the sums?
  };
  /// Takes the friction of a step from the motion of the faces along the walls. `sums` are folded
  /// into the domain, and behind the walls still as points left them. Collective.
  void apply(const SoilSides<D>& sides, const Change& change, const NodeField<NodeSums, D>& sums,
             NodeField<NodeMotion, D>& motion);

  template <class Archive>
  void archive(Archive& a) {
    for (Side& wall : walls_)
      a.cells("soil/pull of wall " + std::to_string(wall.axis) + " " + std::to_string(wall.side),
              wall.owed);
  }

 private:
  static double unsummed_push(const NodeSums& sum, const NodeMotion& node, const Change& change);

  struct Side {
    int axis, side;
    /// With which it presses, times the coefficient of friction, in the cells along it [kg m/s].
    CellField<D> impulse;
    /// With which it pulled and has not yet pressed since, times the coefficient [kg m/s].
    CellField<D> owed;
  };
  void measure(const SoilSides<D>& sides, const Change& change, const NodeField<NodeSums, D>& sums,
               const NodeField<NodeMotion, D>& motion);

  const Grid<D>* grid_;
  Halo<D> halo_;
  std::vector<Side> walls_;
};

extern template class WallContact<2>;
extern template class WallContact<3>;

}  // namespace mudlark

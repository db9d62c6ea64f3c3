#pragma once
/// Coulomb friction of soil on the sides of the domain.
#include <memory>
#include <vector>

#include "grid/halo.hpp"
#include "soil/nodes.hpp"

namespace mudlark {

/// A wall of friction is a smooth mirror for the motion of the soil; what the mirror presses back
/// with is the normal reaction, and the lowest row of faces along the wall is held back by at most
/// the coefficient times it. Effective stress counts: pore pressure does not press grains on walls.
template <int D>
class WallContact {
 public:
  explicit WallContact(const Grid<D>& grid);

  bool empty() const { return walls_.empty(); }
  /// Reads the reaction off the sums of all points, before they are folded into the domain.
  /// Collective.
  void measure(const NodeField<NodeSums, D>& sums);
  /// Takes the friction of a step dt [s] from the motion of the faces along the walls.
  void apply(double dt, const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion) const;

 private:
  struct Side {
    int axis, side;
    double coefficient;
    CellField<D> force, momentum;  ///< of the reaction, in the cells at the wall [N], [kg m/s]
  };
  const Grid<D>* grid_;
  Halo<D> halo_;
  std::vector<Side> walls_;
};

extern template class WallContact<2>;
extern template class WallContact<3>;

}  // namespace mudlark

#pragma once
/// Sides that swallow waves: dashpots and springs (Kelvin-Voigt; NUMERICS A6).
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "grid/halo.hpp"
#include "materials/soil_model.hpp"
#include "soil/face_balance.hpp"
#include "soil/nodes.hpp"
#include "soil/sides.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// What soil is to a wave, per bulk volume.
template <int D>
struct SoilStiffness {
  explicit SoilStiffness(const Grid<D>& grid)
      : volume(grid, "volume", "m^D"),
        density(grid, "mass", "kg"),
        compression(grid, "modulus", "Pa m^D"),
        shear(grid, "shear modulus", "Pa m^D") {}
  CellField<D> volume, density, compression, shear;  ///< sums over the points of each cell
};

/// Grains may go through such a side; its nodes are held by the traction
///   t = t_0 - a rho c_p v_n n - b rho c_s v_t - (M u_n n + G u_t) / d,
/// rho c_p = sqrt(rho M), M undrained where there is pore water, rho c_s = sqrt(rho G), of the soil
/// at the side when the run starts. t_0 is what holds the soil still then: only what comes later is
/// a wave. Pore water is sealed in. A node's share of the side is that of measure_side_slopes, so
/// that a side in equilibrium is so to round-off.
template <int D>
class AbsorbingSides {
 public:
  explicit AbsorbingSides(const SoilSides<D>& sides);

  bool empty() const { return !any_; }
  bool started() const { return started_; }

  /// How much of the sides belongs to their nodes now. Collective.
  void measure(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
               const std::vector<SoilParticles<D>>& bodies);
  /// Takes the forces of the moment [N] as those that the sides hold, and the stiffness of the soil
  /// at them. Collective.
  void start(const SoilSides<D>& sides, Halo<D>& halo, const std::vector<SoilParticles<D>>& bodies,
             const std::vector<BodyConstants>& constants,
             const std::vector<std::unique_ptr<SoilModel>>& laws, double water_bulk_modulus,
             const NodeField<NodeSums, D>& sums);
  /// Adds what the sides hold, and their springs, to the forces.
  void add_forces(NodeField<NodeSums, D>& sums) const;

  /// Solves the nodes on the sides again: solve(component, offset, hold). Stretches the springs.
  template <class Solve>
  void solve(double dt, NodeField<NodeMotion, D>& motion, Solve&& solve) {
    for (Node& node : nodes_) {
      double dashpot = 0.0;
      for (int a = 0; a < D; ++a)
        dashpot += area(node, a) * (node.dashpot[a] + dt * node.spring[a]);
      auto& field = motion[static_cast<std::size_t>(node.component)];
      solve(node.component, node.at,
            FaceHold{(1.0 - node.water_share) * dashpot, node.water_share * dashpot,
                     node.inner < 0 && node.normal});
      node.stretch += dt * field.data()[node.at].grain_velocity;
    }
    seal(motion);
  }

  /// Numbers per node of a saved state.
  static constexpr int saved = 4 + 2 * D;
  template <class Archive>
  void archive(Archive& a) {
    if (!any_) return;
    std::int64_t started = started_ ? 1 : 0;
    a.integer("soil/absorbing sides started", started);
    started_ = started != 0;
    std::vector<double> values;
    if (!Archive::loading) values = pack();
    a.points("soil/absorbing sides", values, saved);
    if (Archive::loading) unpack(values);
  }

 private:
  struct Node {
    int component;
    Index<D> index;
    std::ptrdiff_t at;           ///< in the fields of the component
    bool normal = false;         ///< is the component that along the normal of its side?
    std::ptrdiff_t inner = -1;   ///< node behind the side that this one inside it mirrors
    double reaction = 0.0;       ///< that holds it from the start on [N]
    double stretch = 0.0;        ///< since the start [m]
    double water_share = 0.0;    ///< of the mass [-]
    Vec<D> dashpot{}, spring{};  ///< of the sides across each axis, per area [Pa s/m], [Pa/m]
    std::array<std::ptrdiff_t, D> share{};  ///< where its slope across each axis stands; -1: none
    Vec<D> sign{};                          ///< that makes an area of it
  };
  double area(const Node& node, int axis) const {
    const std::ptrdiff_t at = node.share[static_cast<std::size_t>(axis)];
    if (at < 0) return 0.0;
    const double a =
        node.sign[axis] * slopes_[static_cast<std::size_t>(axis)][node.component].data()[at];
    return a > 0.0 ? a : 0.0;
  }
  void add_node(const SoilSides<D>& sides, int axis, int side, int component, const Index<D>& index,
                const Index<D>& behind, bool inner, std::map<std::int64_t, std::size_t>& known);
  void set_stiffness(const SoilSides<D>& sides, const SoilStiffness<D>& soil, Node& node,
                     int axis) const;
  void seal(NodeField<NodeMotion, D>& motion) const;
  std::int64_t key_of(int component, const Index<D>& index) const;
  std::vector<double> pack() const;
  void unpack(const std::vector<double>& mine);

  const Grid<D>* grid_;
  bool any_ = false, started_ = false;
  std::array<bool, D> across_{};       ///< has an axis such a side, anywhere?
  std::vector<FaceVector<D>> slopes_;  ///< per axis
  std::vector<Node> nodes_;
};

extern template class AbsorbingSides<2>;
extern template class AbsorbingSides<3>;

}  // namespace mudlark

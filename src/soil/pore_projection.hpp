#pragma once
/// Pore pressure by an implicit projection: formulations u-w-p and u-p
/// (docs/methods/formulations.md).
#include "grid/halo.hpp"
#include "numerics/pressure_solver.hpp"
#include "soil/energy.hpp"
#include "soil/sides.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// Finds the rise of pore pressure over a step with which the volume of grains and water that faces
/// carry into each cell is what the compression of the water takes up:
///   D (dt M G q) - n / (K_w f) q / dt = D U*,   rise of p = q / f,
/// U* the flux of grains and water under the pressure before the step, M the faces' answer to
/// pressure, drag included, and f the share of the cell that soil fills. q pulls at the faces and
/// ends with the soil, so a drained surface is the natural condition, as in u-w.
template <int D>
class PoreProjection {
 public:
  PoreProjection(const SoilSides<D>& sides, const SoilOptions& options);

  /// Restricts the work to cells around the soil, and makes ghosts valid after loading. Collective.
  void cover(const IndexBox<D>& active);
  /// Finds how far wet soil fills the cells. Collective.
  void measure(const std::vector<SoilParticles<D>>& bodies,
               const std::vector<BodyConstants>& constants);
  /// u-p: takes a share of the last step's rise off the forces, see `centred_rise`.
  void add_last_rise(double dt, NodeField<NodeSums, D>& sums) const;
  /// Corrects the motion of the owned faces, and adds the forces of the rise to the sums. Their
  /// work is not external: it is taken out of `energy`. Throws DivergenceError with place and time
  /// on all ranks when there is no solution. Collective.
  void project(double dt, double time, bool sealed, NodeField<NodeSums, D>& sums,
               NodeField<NodeMotion, D>& motion, SoilEnergy& energy);
  /// Rise of pore pressure over the last step [Pa], in all cells around the soil.
  const CellField<D>& rise() const { return rise_; }

  template <class Archive>
  void archive(Archive& a) {
    if (centred_) a.cells("soil/rate of pore pressure", last_rate_);
  }

 private:
  IndexBox<D> faces(int axis) const { return grid_->owned_faces(axis).intersected(active_); }
  bool at_side(int axis, const Index<D>& face) const;
  bool held(int axis, const Index<D>& face) const;
  bool has_unknown(const Index<D>& cell) const;
  double slope(const CellField<D>& field, int axis, const Index<D>& face) const;
  void set_up_faces(double dt, bool sealed, const NodeField<NodeSums, D>& sums,
                    const NodeField<NodeMotion, D>& motion);
  void set_up_cells(double dt);
  bool cut_couplings();
  void solve(double dt, double time);
  void keep_rise(double dt);
  [[noreturn]] void report_failure(double time) const;

  const SoilSides<D>* sides_;
  const Grid<D>* grid_;
  const SoilOptions* options_;
  Halo<D> halo_;
  Ghosts<D> ghosts_;
  IndexBox<D> active_{}, box_{};
  bool centred_, alone_;
  CellField<D> filling_, pores_;  ///< shares of the cell [-]
  CellField<D> pull_;             ///< q [Pa]
  CellField<D> rise_;
  CellField<D> last_rate_;  ///< q of the last step over its length [Pa/s]
  FaceVector<D> flux_;      ///< [m/s]
  PressureSystem<D> system_;
  PressureSolver<D> solver_;
  Hierarchy hierarchy_ = Hierarchy::fresh;
  int usual_iterations_ = 0;  ///< of the solve that the hierarchy was built for
};

extern template class PoreProjection<2>;
extern template class PoreProjection<3>;

}  // namespace mudlark

#pragma once
/// Transport of the water fraction W (water volume per cell volume) through a porous medium that
/// may move.
///
/// Weymouth & Yue (2010), J. Comput. Phys. 229: one sweep per axis with a dilation term frozen at
/// the start of the step, and Mudlark's fourth sweep, which gives back what the porosity theta
/// gained, so that W stays conserved to round-off and 0 <= W <= theta when theta moves
/// (docs/methods/free-surface-flow.md).
#include <vector>

#include "numerics/cell_runs.hpp"
#include "numerics/ghosts.hpp"
#include "numerics/plic.hpp"
#include "numerics/wall_band.hpp"

namespace mudlark {

/// What becomes of water whose face neighbours are all less than half full: it keeps a sharp plane,
/// or it is mixed over its cell. A plane knows nothing of where a droplet is inside its cell: if it
/// happens to lie away from the face, the droplet hangs while its velocity grows for ever. Mixed
/// spray always moves with its velocity. (In thin filaments of a given smooth flow the plane is the
/// better choice.)
enum class Spray { sharp, mixed };

template <int D>
class InterfaceAdvection {
 public:
  InterfaceAdvection(const Grid<D>& grid, const CellRuns<D>& near);

  /// Cells that count as full of water for the dilation term: W >= theta/2 > 0. The pressure solve
  /// must make the flux free of divergence (up to the porosity's change) in exactly these cells.
  static bool dilates(double water, double porosity) {
    return porosity > 0.0 && water >= 0.5 * porosity;
  }

  /// The D sweeps. `flux` is U = theta_f v [m/s], `porosity` the theta that it was made with; both
  /// need valid ghosts and stay fixed. Then `water` lacks the fourth sweep. `order` permutes the
  /// axes: count it up every step. `walls`: bodies behind which interface normals see the water go
  /// on. `inflow`: share of water in what comes in through each face of a wall; without it only air
  /// does. Bound: dt * max(sum of inflow, sum of outflow) <= theta/2 in every cell.
  void sweep(CellField<D>& water, const CellField<D>& porosity, const FaceVector<D>& flux,
             double dt, std::int64_t order, Spray spray = Spray::sharp,
             const WallBand<D>* walls = nullptr, const FaceVector<D>* inflow = nullptr);

  /// Fourth sweep: W += c (theta_new - theta); then theta = theta_new. Owned cells of `where`.
  void follow_porosity(const CellRuns<D>& where, CellField<D>& water, CellField<D>& porosity,
                       const CellField<D>& new_porosity) const;

  /// Water that passed each face during the sweeps, as a share of a cell's volume; on owned and
  /// bounding faces.
  const FaceVector<D>& water_flux() const { return water_flux_; }

  /// Plane of the interface in a cell; `alpha` with valid neighbours, `at` the cell's place.
  Plane<D> plane(const double* alpha, std::ptrdiff_t at) const;

 private:
  void sweep_axis(CellField<D>& water, const CellField<D>& porosity, const FaceField<D>& flux,
                  int axis, double dt, const WallBand<D>* walls);
  void find_planes(int axis);
  void find_spray(const CellField<D>& water, const CellField<D>& porosity);
  double water_through(double shift, std::ptrdiff_t donor, int axis, double porosity) const;

  const Grid<D>* grid_;
  const CellRuns<D>* near_;
  Ghosts<D> ghosts_;
  CellField<D> alpha_;
  CellField<D> dilates_;
  CellField<D> mixed_;  ///< 1 in cells of mixed spray
  std::vector<Plane<D>> planes_;
  FaceVector<D> water_flux_;
  const FaceVector<D>* inflow_ = nullptr;  ///< of the present sweep
  std::array<std::ptrdiff_t, D> strides_{};
};

/// theta - dt div U on owned cells of `where`: the porosity after the flux U has carried the
/// mixture.
template <int D>
void move_porosity(const Grid<D>& grid, const CellRuns<D>& where, const CellField<D>& porosity,
                   const FaceVector<D>& flux, double dt, CellField<D>& moved);

extern template class InterfaceAdvection<2>;
extern template class InterfaceAdvection<3>;

}  // namespace mudlark

#pragma once
/// Pressure on the soil's surface during a step: loads of the case and the free water, in time.
#include <optional>
#include <vector>

#include "soil/fluid_load.hpp"
#include "soil/nodes.hpp"
#include "soil/options.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

template <int D>
class SurfaceLoads {
 public:
  SurfaceLoads(const Grid<D>& grid, std::vector<SurfaceLoad> loads);

  /// Which of the loads act from now on, in their order; nothing: all.
  void set_active(std::optional<std::vector<bool>> active);
  /// For the cells of `box` and times in [begin, begin + length]. Water's pressure is linear
  /// between both; loads are taken as they are at each time, however fast they vary. `water` must
  /// live until the step is over; null: no free water.
  void begin_step(double begin, double length, const FluidLoad<D>* water, const IndexBox<D>& box);
  /// Goes on in the open step with another box of cells, after the soil moved on.
  void resample(const IndexBox<D>& box) { begin_step(begin_, length_, water_, box); }
  /// The pressures at `time` within the step; valid until the next call.
  SurfacePressure<D> at(double time);
  bool sealed() const { return water_ && water_->outlet == PoreOutlet::sealed; }

 private:
  bool loaded() const { return water_ || !loads_.empty(); }
  void fill(double time, bool against_flow);

  const Grid<D>* grid_;
  std::vector<SurfaceLoad> all_loads_, loads_;  ///< and those that act
  const FluidLoad<D>* water_ = nullptr;
  double begin_ = 0.0, length_ = 0.0;
  IndexBox<D> box_{};
  bool steady_ = false, filled_ = false;
  bool on_water_ = false;  ///< does any load press on the pore water?
  CellField<D> traction_, drained_;
};

/// The load by facets, Eqs. 10-15 of the paper, on this grid: between a cell with soil and one
/// without, the facet of area A gets f = -n A p with p the mean over its corners, which is the sum
/// of (A/36) sum_j c_ij p_j over its nodes (c = 4, 2, 1). Adds to mixture_force, and to water_force
/// when pore water drains against that pressure. `solid_fraction` tells cells with soil (> 0 counts
/// by points, see occupied_cells).
template <int D>
void add_facet_forces(const Grid<D>& grid, const CellField<D>& occupied,
                      const SurfacePressure<D>& surface, const IndexBox<D>& box,
                      NodeField<NodeSums, D>& nodes);

/// Marks the cells that hold a point (1, otherwise 0); owned cells and ghosts.
template <int D>
void mark_occupied(const Grid<D>& grid, const SoilParticles<D>& points, CellField<D>& occupied);

}  // namespace mudlark

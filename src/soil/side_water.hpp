#pragma once
/// Pore water at the sides of the domain: pressures, seepage faces, and what flows through.
#include <string>
#include <vector>

#include "grid/halo.hpp"
#include "soil/nodes.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/sides.hpp"
#include "soil/walls.hpp"

namespace mudlark {

template <int D>
class SideWater {
 public:
  explicit SideWater(const SoilSides<D>& sides);

  /// Does any side have a pressure or a seepage face?
  bool drains() const { return !drains_.empty(); }
  /// What the pressures of the sides do to the nodes on them and behind them (see
  /// measure_side_slopes), for fold_into_domain. Collective.
  void measure(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
               const std::vector<SoilParticles<D>>& bodies);
  const SidePushes<D>* pushes() const { return drains() ? &pushes_ : nullptr; }

  /// Motion of the water through faces on sides with a pressure, grains held by the side, from the
  /// folded sums; opens seepage faces where it goes out and closes them where it would come in.
  /// `faces`: those that this rank solves, per axis. Collective.
  void solve(SoilSides<D>& sides, Halo<D>& halo, double dt, const std::array<IndexBox<D>, D>& faces,
             const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion);
  /// Fluxes behind sides with a pressure, such that the pore pressure of points keeps that of the
  /// side: the divergence of the total flux is odd about -n/K_w dp/dt of the side. Ghosts and all
  /// other images of `motion` must be valid. Collective.
  void mirror_fluxes(const SoilSides<D>& sides, double dt, double water_bulk_modulus,
                     const std::vector<SoilParticles<D>>& bodies,
                     const NodeField<NodeSums, D>& sums, NodeField<NodeMotion, D>& motion);

  /// Adds up what flows out through the boundaries of the case in a step [m^D]. `flux(axis, face)`
  /// is that of the water relative to the grains [m/s], `volume(axis, face)` the bulk volume of
  /// soil on the face, no image [m^D].
  template <class Flux, class Volume>
  void account(const SoilSides<D>& sides, double dt, Flux&& flux, Volume&& volume) {
    for (std::size_t b = 0; b < volume_.size(); ++b) {
      const auto [axis, side] = where_[b];
      const double area = grid_->cell_volume() / grid_->spacing()[axis];
      for_each_cell_at(sides, axis, side, [&](Index<D> cell) {
        if (!sides.belongs_to(boundary_[b], cell)) return;
        if (side == 1) ++cell[axis];  // the face behind it
        const double filled = 2.0 * volume(axis, cell) / grid_->cell_volume();
        const double covered = filled > full_face ? 1.0 : filled;
        volume_[b] += (side == 0 ? -1.0 : 1.0) * covered * area * dt * flux(axis, cell);
      });
    }
  }
  /// For implicit steps: what explicit ones do one by one. Collective.
  void begin_implicit_step(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                           const std::vector<SoilParticles<D>>& bodies);
  /// What the pressure of a side rises by in the step [Pa].
  double rise(const SoilSides<D>& sides, int axis, int side, const Index<D>& cell) const;
  /// Do seepage faces that are open let water out with these ways of the water [m], and those that
  /// are closed hold less than zero pressure with this rise of it [Pa]? Those that do not are
  /// switched, and the step is to be solved again. Collective.
  bool review(SoilSides<D>& sides, Halo<D>& halo, const FaceVector<D>& way,
              const CellField<D>& rise);
  /// Takes over the pressure on the sides.
  void end_implicit_step(const SoilSides<D>& sides, const CellField<D>& rise);

  /// What a step that is solved again starts from.
  struct State {
    std::vector<CellField<D>> fields;
    std::vector<double> volume;
  };
  State state() const;
  void restore(const State& state, SoilSides<D>& sides, Halo<D>& halo);

  void begin_outer_step(double length);
  /// Mean over the last outer step, out of the soil, by the name of the boundary [m^D/s].
  /// Collective.
  double discharge(const std::string& boundary) const;

  /// Takes the state of seepage faces from its fields to `sides`, ghosts included. Collective.
  void spread(SoilSides<D>& sides, Halo<D>& halo);

  template <class Archive>
  void archive(Archive& a) {
    for (Drain& drain : drains_) {
      const std::string name = std::to_string(drain.axis) + " " + std::to_string(drain.side);
      a.cells("soil/pressure on side " + name, drain.pressure);
      a.cells("soil/seepage face " + name, drain.open);
    }
    std::int64_t started = started_ ? 1 : 0;
    if (!drains_.empty()) a.integer("soil/pressure on sides known", started);
    started_ = started != 0;
    for (std::size_t b = 0; b < volume_.size(); ++b) {
      double all = Archive::loading ? 0.0 : total(volume_[b]);
      a.number("soil/discharge " + names_[b], all);
      if (Archive::loading) volume_[b] = first_rank_ ? all : 0.0;
    }
    if (!volume_.empty()) a.number("soil/discharge time", length_);
  }

 private:
  /// A side with a pressure or a seepage face somewhere; values in the cells next to it.
  struct Drain {
    int axis, side;
    CellField<D> pressure;  ///< that the points have there now [Pa]
    CellField<D> open;      ///< of seepage faces: 1 or 0
  };
  Drain* drain_on(int axis, int side);
  const Drain* drain_on(int axis, int side) const;
  void start(const SoilSides<D>& sides, const std::vector<SoilParticles<D>>& bodies);
  void mirror_flux(const SoilSides<D>& sides, Drain& drain, const Index<D>& cell, double dt,
                   double water_bulk_modulus, const NodeField<NodeSums, D>& sums,
                   NodeField<NodeMotion, D>& motion);
  /// Above this share of its volume a face counts as covered with soil.
  static constexpr double full_face = 0.9;

  /// Cells of this rank next to a side.
  template <class F>
  void for_each_cell_at(const SoilSides<D>& sides, int axis, int side, F&& f) const {
    const Grid<D>& grid = sides.grid();
    if (!grid.touches(axis, side)) return;
    IndexBox<D> row = grid.owned();
    row.lower[axis] = side == 0 ? 0 : grid.cells()[axis] - 1;
    row.upper[axis] = row.lower[axis] + 1;
    for_each(row, f);
  }
  double total(double mine) const;

  const Grid<D>* grid_;
  bool first_rank_, started_ = false;
  SidePushes<D> pushes_;
  std::vector<Drain> drains_;
  /// Boundaries of the case that say something of the pore water: their names, their numbers in
  /// SoilSides, axis and side.
  std::vector<std::string> names_;
  std::vector<std::size_t> boundary_;
  std::vector<std::array<int, 2>> where_;
  std::vector<double> volume_;  ///< that went out in the outer step, of this rank [m^D]
  double length_ = 0.0;         ///< of the outer step [s]
};

extern template class SideWater<2>;
extern template class SideWater<3>;

}  // namespace mudlark

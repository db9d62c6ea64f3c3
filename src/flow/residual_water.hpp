#pragma once
/// Water that stays behind in drained pores and goes with the grains (decision 0090).
#include "flow/body_acceleration.hpp"
#include "flow/porous_medium.hpp"
#include "numerics/interface_advection.hpp"

namespace mudlark {

/// Splits the water W of a cell in what the grains hold, R = min(W, n S_r), and what is free to
/// move, W - R in the room theta - R. All that is known of a sharp surface holds for the free part:
/// a cell is full when half of its free room is, and what drains leaves R behind. The share of free
/// room that is filled is the effective saturation S_e = (S - S_r)/(1 - S_r).
template <int D>
class ResidualWater {
 public:
  ResidualWater(const Grid<D>& grid, const FlowOptions& options);

  /// R of the present water. All inputs with ghosts, and so the result.
  void hold(const CellField<D>& water, const CellField<D>& porosity, const PorousMedium<D>& medium);
  /// W - R and theta - R, with what is held left as it is.
  void release(const CellField<D>& water, const CellField<D>& porosity);

  const CellField<D>& free() const { return free_; }  ///< W - R [-]
  const CellField<D>& room() const { return room_; }  ///< theta - R [-]

  /// Where R hangs on the faces between cells without pressure, for a surface at `reach` (cells)
  /// from the cells with one. Owned and bounding faces; `time` [s] is that of a given acceleration.
  void hang(const CellField<D>& unknown, const FaceVector<D>& reach, double time);
  const FaceVector<D>& mass() const { return mass_; }      ///< [kg/m3]
  const FaceVector<D>& weight() const { return weight_; }  ///< [N/m3]
  /// Of the pores beside a face, what is free to move [-].
  const FaceVector<D>& free_share() const { return free_share_; }

  /// Moves R with the grains over dt (null: they stand) and takes that from the volume flux U =
  /// `flux`, capacity times velocity: what is left is that of the free room.
  void go_with_grains(const FaceVector<D>* grain_velocity, const FaceVector<D>& capacity, double dt,
                      FaceVector<D>& flux);
  /// The water after the sweeps of the free part.
  void join(CellField<D>& water) const;
  /// Fourth sweep: the free room becomes what R leaves of `moved`, which becomes the porosity.
  void follow_porosity(const CellRuns<D>& where, const InterfaceAdvection<D>& interface,
                       const CellField<D>& moved, CellField<D>& water, CellField<D>& porosity);
  CellField<D>& free() { return free_; }
  /// R that passed each face, as a share of a cell's volume, is added to what else did.
  void add_passed(FaceVector<D>& carried) const;

  template <class Archive>
  void archive(Archive& a) {
    a.cells("held water", held_);
    ghosts_.update(held_);
  }

 private:
  const Grid<D>* grid_;
  Ghosts<D> ghosts_;
  BodyAcceleration<D> acceleration_;
  double density_;
  CellField<D> held_, free_, room_, moved_;
  FaceVector<D> mass_, weight_, free_share_;
  FaceVector<D> passed_;  ///< R through faces in a step, as a share of a cell's volume [-]
};

extern template class ResidualWater<2>;
extern template class ResidualWater<3>;

}  // namespace mudlark

#pragma once
/// Water that flows through sides of the domain as given: inflow, outflow, levels, and waves that
/// are made and absorbed at a side.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/varying.hpp"
#include "flow/part_of_side.hpp"
#include "flow/wave_zone.hpp"

namespace mudlark {

/// velocity, discharge: inwards through the part, below a level; level: pressure of water at rest
/// with that level outside an open wall; wave: a known motion, and long waves that come may leave.
enum class SideFlow { velocity, discharge, level, wave };

/// What flowing water does at a part of a side.
struct FlowSideOptions : PartOfSide {
  SideFlow flow = SideFlow::velocity;
  Varying value;  ///< [m/s]; of a discharge m3/s, in 2D m2/s
  std::optional<Varying>
      level;             ///< of the water that comes in [m]; without: that of the water there
  WaveZoneOptions wave;  ///< of a wave; its outer end is this side
};

/// Velocities that walls have are put into closed walls: the pressure solve sees them as it sees
/// walls at rest, and water passes with the velocity, so the ledger counts what the transport
/// carried. A level pushes on an open wall.
template <int D>
class FlowSides {
 public:
  FlowSides(const Grid<D>& grid, const std::vector<FlowSideOptions>& options, double density);

  bool empty() const { return sides_.empty(); }
  /// Velocities and levels at `time` [s], from the water that is there. Throws DivergenceError when
  /// a discharge finds no water and no level. Collective.
  void find(const CellField<D>& water, const CellField<D>& porosity, const FaceVector<D>& capacity,
            double time);
  /// Puts them into the faces of the walls and behind; the cells behind hold what comes in.
  void apply(const CellField<D>& porosity, CellField<D>& water, FaceVector<D>& velocity) const;
  /// Adds what the pressure of given levels does to the velocity of open walls that touch a cell of
  /// `unknown`; the pressure solve takes it for zero there.
  void push(const FaceVector<D>& mobility, const CellField<D>& unknown,
            FaceVector<D>& velocity) const;
  /// Share of water in what comes in through each face of a wall [-].
  FaceVector<D>& inflow() { return inflow_; }

 private:
  struct Side {
    FlowSideOptions options;
    std::unique_ptr<const WaveMotion> motion;  ///< of a wave
    std::vector<double> levels;                ///< of the water at the side, one per column [m]
  };
  template <class Body>
  void for_each_face(const Side& side, Body&& body) const;
  std::size_t column(const Side& side, const Index<D>& index) const;
  void measure_levels(Side& side, const CellField<D>& water, const CellField<D>& porosity) const;
  void find_flow(const Side& side, const FaceVector<D>& capacity, double time);
  void find_wave(const Side& side, double time);
  double discharge_speed(const Side& side, const FaceVector<D>& capacity, double time) const;
  double level_at(const Side& side, const Index<D>& face, double time) const;
  void bring_motion(const Side& side, FaceVector<D>& velocity) const;

  const Grid<D>* grid_;
  double gravity_, density_;
  std::vector<Side> sides_;
  /// Of the faces of walls, along their axis; in the cells behind also of what comes in [m/s].
  FaceVector<D> speed_;
  FaceVector<D> inflow_;    ///< [-]
  FaceVector<D> pressure_;  ///< of given levels [Pa]
};

extern template class FlowSides<2>;
extern template class FlowSides<3>;

}  // namespace mudlark

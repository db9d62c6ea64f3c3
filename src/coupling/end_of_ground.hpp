#pragma once
/// Where soil ends under or beside open water, which the kernel spreads over two cells on either
/// side.
#include <cstddef>
#include <vector>

#include "coupling/soil_in_water.hpp"
#include "flow/moving_grains.hpp"
#include "grid/halo.hpp"

namespace mudlark {

/// How soil resists flowing water where it ends as sharply as its points do. Water that comes out
/// of the ground passes all of the soil that lies behind one another there; water along its surface
/// passes beside it. Where no water moves along the end it feels the soil as the kernel spreads it,
/// as the grains do: then loads on them are shared best. Only ground ends: lumps that left it, and
/// looser soil in it, are as the kernel has them (docs/decisions/0101).
template <int D>
class EndOfGround {
 public:
  explicit EndOfGround(const Grid<D>& grid);

  /// Share that soil takes of the cells, after room.find(). Collective.
  void find(SoilSolver<D>& soil, const SoilInWater<D>& room, const Space<D>& space);

  /// Makes `grains.resistance`, as the kernel spreads it, end sharply, for `water` of that
  /// velocity [m/s] in cells of that saturation. No water resists the motion of the rim then, the
  /// grains spread beyond the end, which would ring: it takes on half of what its velocity differs
  /// from the ground's. Momentum is kept. All with ghosts. Collective.
  void sharpen(const FaceVector<D>& water, const CellField<D>& saturation, MovingGrains<D>& grains);

 private:
  double share_at(int axis, const Index<D>& face) const;
  double flows(int axis, const Index<D>& face, const Vec<D>& slope, const Vec<D>& grain_velocity,
               const FaceVector<D>& water, const CellField<D>& saturation) const;
  void look_at(int axis, const Index<D>& face, const FaceVector<D>& water,
               const CellField<D>& saturation, MovingGrains<D>& grains);
  void damp_rim(MovingGrains<D>& grains);

  const Grid<D>* grid_;
  Halo<D> halo_;
  Ghosts<D> ghosts_;
  CellField<D> taken_;     ///< share of a cell that soil takes, grains and pores [-]
  FaceVector<D> rim_;      ///< part of the grains of a face that lie beyond the end [-]
  FaceVector<D> towards_;  ///< direction of the ground, +-(axis + 1)
  /// Momentum per volume [kg/(m2 s)] that the ground gives to a face of the rim.
  struct Loan {
    std::ptrdiff_t rim, ground;
    double momentum;
  };
  std::vector<Loan> loans_;  ///< of one axis, kept for its memory
  double slow_;              ///< water along the end is at rest [m/s]
};

extern template class EndOfGround<2>;
extern template class EndOfGround<3>;

}  // namespace mudlark

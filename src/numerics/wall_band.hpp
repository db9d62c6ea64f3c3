#pragma once
/// What stencils beside rigid bodies find in closed cells and on closed faces.
#include <vector>

#include "grid/space.hpp"
#include "numerics/ghosts.hpp"

namespace mudlark {

/// A closed face beside open ones, the body's normal and velocity there.
template <int D>
struct WallFace {
  int axis = 0;
  Index<D> face;
  Vec<D> normal, velocity;  ///< [-], [m/s]
};

/// A small cell and the one that transport takes it for a part of, by their places in the local
/// arrays.
struct SmallCell {
  std::ptrdiff_t at, host;
};

/// Closed cells and faces beside open ones. Interface normals and upwind velocities are formed as
/// if the water went on behind the wall: its level continues there, and its velocity does, without
/// the part that would pass the wall.
template <int D>
class WallBand {
 public:
  explicit WallBand(const Grid<D>& grid);

  /// Collects the closed cells with an open one around them.
  void find_cells(const Space<D>& space);
  /// Takes the closed faces within two faces of an open one from all local ones; `describe(axis,
  /// face, wall)` gives normal and velocity.
  template <class Describe>
  void find_faces(const Space<D>& space, Describe&& describe) {
    mark_faces(space);
    walls_.clear();
    for (int axis = 0; axis < D; ++axis)
      for_each(grid_->owned_faces(axis), [&](const Index<D>& face) {
        if (layer_[axis][face] < 1.0) return;
        WallFace<D> wall{axis, face, {}, {}};
        describe(wall);
        walls_.push_back(wall);
      });
    moved_.resize(walls_.size());
  }
  bool empty() const { return empty_; }

  /// Small cells with faces of their own, and room that is shared anew with their hosts in each
  /// step. In the order of their places.
  std::vector<SmallCell>& small() { return small_; }
  const std::vector<SmallCell>& small() const { return small_; }

  /// Saturation in closed cells; those of open cells need valid ghosts.
  void extend_saturation(const CellField<D>& porosity, CellField<D>& saturation) const;
  /// Velocity of closed faces, ghosts included; those of open faces need valid ghosts.
  void extend_velocity(FaceVector<D>& velocity);

 private:
  enum class From { beside, above, below, around };
  struct Cell {
    std::ptrdiff_t at;
    From from;
  };
  void mark_faces(const Space<D>& space);
  Vec<D> velocity_at(const FaceVector<D>& velocity, const WallFace<D>& wall) const;

  const Grid<D>* grid_;
  Ghosts<D> ghosts_;
  std::vector<SmallCell> small_;
  bool empty_ = true;
  CellField<D> known_;   ///< 1: open; 2, 3, 4: closed and given in that pass; 0: far from water
  FaceVector<D> layer_;  ///< 0: open; 1, 2: closed, that many faces from an open one; -1: far
  std::array<std::vector<Cell>, 3> passes_;
  std::array<std::vector<std::pair<int, std::ptrdiff_t>>, 2> layers_;
  std::vector<WallFace<D>> walls_;
  std::vector<double> moved_;
};

extern template class WallBand<2>;
extern template class WallBand<3>;

}  // namespace mudlark

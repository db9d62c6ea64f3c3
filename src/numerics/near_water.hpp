#pragma once
/// The cells near the water, where alone a flow with a free surface has anything to compute.
#include "numerics/cell_runs.hpp"
#include "numerics/ghosts.hpp"

namespace mudlark {

/// Near is within five cells of water (and of ground, where its grains take part) and two of a
/// velocity; at first all cells. The velocity is extended by three layers of faces beyond the
/// surface, water moves less than a cell in a step, and stencils see one cell more. Farther cells
/// keep what they have from one step to the next: no pressure, no velocity, no flux. Water that
/// vanishes counts for one step more, in which all that it moved comes to rest.
///
/// Beside the water is within one cell of it: all faces that forces and pressure act on, as long as
/// the water stays where it was looked for. What the others have is extended from these.
template <int D>
class NearWater {
 public:
  explicit NearWater(const Grid<D>& grid);

  /// Looks for them, all inputs having valid ghosts; with `ground` cells with less porosity than 1
  /// count as water. Without `anywhere` nothing but the flow itself changes water and velocity:
  /// none is farther than the present near cells. With it all near cells are beside the water.
  /// Collective.
  void find(const CellField<D>& water, const CellField<D>& porosity, const FaceVector<D>& velocity,
            bool ground, bool anywhere = true);
  /// All cells.
  void take_all();

  const CellRuns<D>& cells() const { return cells_; }
  const CellRuns<D>& beside() const { return beside_; }

 private:
  template <class Body>
  void for_each_candidate(bool anywhere, Body&& body) const;
  template <int Cells>
  void dilate();

  const Grid<D>* grid_;
  Ghosts<D> ghosts_;
  Field<std::uint8_t, AtCell, D> near_, wider_, wet_;
  bool all_ = false;
  CellRuns<D> cells_, beside_;
};

extern template class NearWater<2>;
extern template class NearWater<3>;

}  // namespace mudlark

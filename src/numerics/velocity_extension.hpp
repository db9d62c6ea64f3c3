#pragma once
/// Velocity on faces that no pressure governs: beyond the surface, and in spray and thin films.
#include <array>
#include <vector>

#include "numerics/cell_runs.hpp"
#include "numerics/ghosts.hpp"

namespace mudlark {

template <int D>
class VelocityExtension {
 public:
  VelocityExtension(const Grid<D>& grid, const CellRuns<D>& near);

  /// Faces that touch a cell with `unknown` = 1 keep their velocity. Faces next to them take
  /// theirs, constant along the normal of the surface. Farther faces with water fly on freely with
  /// what they have; those without water take the mean of their neighbours in two more layers, and
  /// zero beyond. Afterwards water that flies freely is kept from being squeezed: a cell without
  /// pressure may open but not close (a thin film on the floor would otherwise fall for ever).
  /// In cells of `drains` it may: drag holds it, and they fill until they have a pressure. Faces
  /// outside of those take nothing from faces between two of them: water over the ground does not
  /// move as that in it.
  /// Faces without `capacity` are closed like walls; films on bodies do not fly: they go with the
  /// water that reaches them within three cells, or lie still. All inputs and the result have valid
  /// ghosts.
  void extend(const CellField<D>& unknown, const CellField<D>& water, const CellField<D>& porosity,
              const FaceVector<D>& capacity, const CellField<D>& drains, FaceVector<D>& velocity);

 private:
  void mark(int component, const CellField<D>& unknown, const CellField<D>& water,
            const CellField<D>& porosity, const FaceVector<D>& capacity);
  void find_waiting(int component);
  void grow_along_normal(int component, const CellField<D>& water, const CellField<D>& porosity,
                         const CellField<D>& drains, double* velocity);
  void let_fly(int component);
  void grow_layer(int component, int layer, const double* drains, double* velocity);
  void keep_from_closing(const CellField<D>& unknown, const CellField<D>& water,
                         const CellField<D>& porosity, const CellField<D>& drains,
                         FaceVector<D>& velocity);
  void find_cells_to_keep(const double* unknown, const double* water, const double* porosity,
                          const double* drains);
  double squeeze(std::ptrdiff_t at, const FaceVector<D>& velocity) const;

  const Grid<D>* grid_;
  const CellRuns<D>* near_;
  Ghosts<D> ghosts_;
  FaceVector<D> state_;
  CellField<D> squeeze_;
  std::vector<std::ptrdiff_t> waiting_;  ///< places of the faces that have no value yet
  std::array<std::vector<std::ptrdiff_t>, D> flies_;  ///< of those that fly, with ghosts
  std::vector<std::ptrdiff_t> keeps_open_;            ///< of cells beside them that must not close
};

extern template class VelocityExtension<2>;
extern template class VelocityExtension<3>;

}  // namespace mudlark

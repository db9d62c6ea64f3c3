#pragma once
/// Numbers for the unknowns of an implicit step: which faces move, which cells have pore pressure.
#include <petscvec.h>

#include <vector>

#include "grid/halo.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"

namespace mudlark {

/// Displacement of grains and of water through faces [m], pore pressure of cells [Pa]; by local
/// offset. Places behind closed walls carry the number of their mirror image, and the sign that a
/// component changes by. -1: held at zero (no soil there, or a wall's own face).
template <int D>
struct ImplicitUnknowns {
  std::array<std::vector<PetscInt>, D> grains, water;
  std::array<std::vector<double>, D> sign;
  std::vector<PetscInt> pressure;
  PetscInt owned = 0;  ///< on this rank
  PetscInt first = 0;  ///< of this rank
};

/// Counts faces and cells with at least a small share of soil. `wet` says which bodies have pore
/// water. Collective.
template <int D>
ImplicitUnknowns<D> number_unknowns(const Grid<D>& grid, Kernel kernel,
                                    const std::vector<SoilParticles<D>>& bodies,
                                    const std::vector<bool>& wet);

/// Fields of the unknowns, and back to sums: mirrored walls and ghosts included.
template <int D>
struct ImplicitFields {
  explicit ImplicitFields(const Grid<D>& grid);

  FaceVector<D> grains, water;
  CellField<D> pressure;

  void clear();
  /// Values of a vector at all places; ghosts and mirrors valid.
  void load(const Grid<D>& grid, Halo<D>& halo, const ImplicitUnknowns<D>& unknowns, ::Vec values);
  /// Adds ghosts to owners, folds mirrors, and writes the sums into a vector.
  void store(const Grid<D>& grid, Halo<D>& halo, const ImplicitUnknowns<D>& unknowns, ::Vec values);
};

extern template struct ImplicitFields<2>;
extern template struct ImplicitFields<3>;

}  // namespace mudlark

#pragma once
/// Numbers for the unknowns of an implicit step: which faces move, which cells have pore pressure.
#include <petscvec.h>

#include <vector>

#include "grid/halo.hpp"
#include "soil/implicit_sides.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"

namespace mudlark {

/// Displacement of grains and of water through faces [m], pore pressure of cells [Pa]; by local
/// offset. Places behind closed sides carry the number of their mirror image, and the sign that it
/// changes by. -1: not an unknown (no soil there, or a face that a side holds).
template <int D>
struct ImplicitUnknowns {
  std::array<std::vector<PetscInt>, D> grains, water;
  std::array<std::vector<double>, D> grain_sign, water_sign;
  std::vector<PetscInt> pressure;
  std::vector<double> pressure_sign;
  PetscInt owned = 0;  ///< on this rank
  PetscInt total = 0;  ///< on all ranks
  PetscInt first = 0;  ///< of this rank
};

/// Counts faces and cells with at least a small share of soil. `wet` says which bodies have pore
/// water. Collective.
template <int D>
ImplicitUnknowns<D> number_unknowns(const SoilSides<D>& sides, Kernel kernel,
                                    const std::vector<SoilParticles<D>>& bodies,
                                    const std::vector<bool>& wet);

/// Fields of the unknowns, and back to sums: sides and ghosts included.
template <int D>
struct ImplicitFields {
  explicit ImplicitFields(const Grid<D>& grid);

  FaceVector<D> grains, water;
  CellField<D> pressure;

  void clear();
  /// Values of a vector at all places; ghosts and mirrors valid.
  void load(const ImplicitSides<D>& sides, Halo<D>& halo, const ImplicitUnknowns<D>& unknowns,
            ::Vec values);
  /// Adds ghosts to owners, folds mirrors, and writes the sums into a vector.
  void store(const ImplicitSides<D>& sides, Halo<D>& halo, const ImplicitUnknowns<D>& unknowns,
             ::Vec values);
};

extern template struct ImplicitFields<2>;
extern template struct ImplicitFields<3>;

}  // namespace mudlark

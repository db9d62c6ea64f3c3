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
  PetscInt first_body = 0;  ///< the first freedom of rigid bodies, which rank 0 owns
  int body_freedoms = 0;    ///< how many they are
  PetscInt owned = 0;       ///< on this rank
  PetscInt total = 0;       ///< on all ranks
  PetscInt first = 0;       ///< of this rank
};

/// Counts faces and cells with at least a small share of soil. `wet` says which bodies have pore
/// water; rigid bodies may move in `body_freedoms` ways. Collective.
template <int D>
ImplicitUnknowns<D> number_unknowns(const SoilSides<D>& sides, Kernel kernel,
                                    const std::vector<SoilParticles<D>>& bodies,
                                    const std::vector<bool>& wet, int body_freedoms);

/// Fields of the unknowns, and back to sums: sides and ghosts included.
template <int D>
struct ImplicitFields {
  explicit ImplicitFields(const Grid<D>& grid);

  FaceVector<D> grains, water;
  CellField<D> pressure;
  std::vector<double> bodies;  ///< ways of the freedoms of rigid bodies [m]; the same on all ranks

  void clear();
  /// Values of a vector at all places; ghosts and mirrors valid. Collective, as `store`.
  void load(const ImplicitSides<D>& sides, Halo<D>& halo, const ImplicitUnknowns<D>& unknowns,
            ::Vec values);
  /// Adds ghosts to owners, folds mirrors, and writes the sums into a vector; those of bodies are
  /// added over ranks.
  void store(const ImplicitSides<D>& sides, Halo<D>& halo, const ImplicitUnknowns<D>& unknowns,
             ::Vec values);
};

/// The freedoms of rigid bodies in a vector of all unknowns, to all ranks and, summed over them,
/// back. Collective.
template <int D>
void load_bodies(const Grid<D>& grid, const ImplicitUnknowns<D>& unknowns, ::Vec values,
                 std::vector<double>& bodies);
template <int D>
void store_bodies(const Grid<D>& grid, const ImplicitUnknowns<D>& unknowns,
                  const std::vector<double>& bodies, ::Vec values);

extern template struct ImplicitFields<2>;
extern template struct ImplicitFields<3>;

}  // namespace mudlark

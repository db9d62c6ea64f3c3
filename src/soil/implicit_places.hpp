#pragma once
/// Between vectors of unknowns and the places of the grid that carry them.
#include <petscvec.h>

#include <span>
#include <vector>

#include "soil/petsc_handle.hpp"

namespace mudlark {

/// The unknowns of one kind (displacement of grains, say) on this rank and all places that share
/// them: ghosts of other ranks, and mirror images behind walls with their sign.
class UnknownPlaces {
 public:
  /// The unknowns of a place's field: numbers by local offset, -1 where held; signs or nothing.
  struct Places {
    std::span<const PetscInt> numbers;
    std::span<const double> signs;
  };
  /// `first` and `owned` of the vector that `numbers` count; `all` has its layout. Unknowns of this
  /// kind get numbers of their own, in the order of the old ones. Collective.
  UnknownPlaces(::Vec all, std::span<const Places> fields);

  /// A vector of the unknowns of this kind.
  void make_vector(VecHandle& vector) const;
  PetscInt owned() const { return static_cast<PetscInt>(in_all_.size()); }
  /// Where they are in this rank's part of the vector of all unknowns.
  std::span<const PetscInt> in_all() const { return in_all_; }
  /// Numbers of this kind by field and local offset, -1 where held.
  const std::vector<PetscInt>& numbers(std::size_t field) const { return numbers_[field]; }
  PetscInt first() const { return first_; }

  void take_from_all(::Vec all, ::Vec own) const;
  void give_to_all(::Vec own, ::Vec all) const;
  /// Values at all places of the fields, zero where held.
  void to_places(::Vec own, std::span<double* const> fields);
  /// Sums over the places of each unknown.
  void to_unknowns(std::span<const double* const> fields, ::Vec own);

 private:
  struct Place {
    std::size_t field, at;
    double sign;
  };
  MPI_Comm comm_;
  std::vector<PetscInt> in_all_;
  std::vector<Place> places_;
  std::vector<std::vector<PetscInt>> numbers_;
  PetscInt first_ = 0;
  std::size_t field_size_ = 0;
  ScatterHandle scatter_;
  VecHandle at_places_;
};

}  // namespace mudlark

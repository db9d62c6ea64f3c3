#include "soil/implicit_places.hpp"

#include <algorithm>
#include <cmath>

namespace mudlark {

UnknownPlaces::UnknownPlaces(::Vec all, std::span<const Places> fields) {
  PetscObjectGetComm(reinterpret_cast<PetscObject>(all), &comm_);
  PetscInt begin = 0, end = 0;
  VecGetOwnershipRange(all, &begin, &end);
  std::vector<PetscInt> wanted;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    field_size_ = fields[f].numbers.size();
    for (std::size_t at = 0; at < field_size_; ++at) {
      const PetscInt number = fields[f].numbers[at];
      if (number < 0) continue;
      places_.push_back({f, at, fields[f].signs.empty() ? 1.0 : fields[f].signs[at]});
      wanted.push_back(number);
      if (number >= begin && number < end) in_all_.push_back(number - begin);
    }
  }
  std::sort(in_all_.begin(), in_all_.end());  // mirror images name an unknown more than once
  in_all_.erase(std::unique(in_all_.begin(), in_all_.end()), in_all_.end());

  // Own numbers of the unknowns, told to all places.
  const PetscInt count = owned();
  MPI_Exscan(&count, &first_, 1, MPIU_INT, MPI_SUM, comm_);
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  if (rank == 0) first_ = 0;
  const auto size = static_cast<PetscInt>(places_.size());
  VecHandle own_number;
  VecDuplicate(all, own_number.put());
  PetscScalar* values = nullptr;
  VecGetArray(own_number, &values);
  for (std::size_t i = 0; i < in_all_.size(); ++i)
    values[in_all_[i]] = static_cast<double>(first_ + static_cast<PetscInt>(i));
  VecRestoreArray(own_number, &values);
  VecCreateSeq(PETSC_COMM_SELF, size, at_places_.put());
  IndexSetHandle from, to;
  ISCreateGeneral(comm_, size, wanted.data(), PETSC_COPY_VALUES, from.put());
  ISCreateStride(PETSC_COMM_SELF, size, 0, 1, to.put());
  ScatterHandle ask;
  VecScatterCreate(own_number, from, at_places_, to, ask.put());
  VecScatterBegin(ask, own_number, at_places_, INSERT_VALUES, SCATTER_FORWARD);
  VecScatterEnd(ask, own_number, at_places_, INSERT_VALUES, SCATTER_FORWARD);
  numbers_.assign(fields.size(), std::vector<PetscInt>(field_size_, -1));
  VecGetArray(at_places_, &values);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    wanted[i] = static_cast<PetscInt>(std::lround(values[i]));
    numbers_[places_[i].field][places_[i].at] = wanted[i];
  }
  VecRestoreArray(at_places_, &values);
  VecHandle own;
  make_vector(own);
  IndexSetHandle own_from;
  ISCreateGeneral(comm_, size, wanted.data(), PETSC_COPY_VALUES, own_from.put());
  VecScatterCreate(own, own_from, at_places_, to, scatter_.put());
}

void UnknownPlaces::make_vector(VecHandle& vector) const {
  VecCreateMPI(comm_, owned(), PETSC_DETERMINE, vector.put());
}

void UnknownPlaces::take_from_all(::Vec all, ::Vec own) const {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  VecGetArrayRead(all, &from);
  VecGetArray(own, &to);
  for (std::size_t i = 0; i < in_all_.size(); ++i) to[i] = from[in_all_[i]];
  VecRestoreArray(own, &to);
  VecRestoreArrayRead(all, &from);
}

void UnknownPlaces::give_to_all(::Vec own, ::Vec all) const {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  VecGetArrayRead(own, &from);
  VecGetArray(all, &to);
  for (std::size_t i = 0; i < in_all_.size(); ++i) to[in_all_[i]] = from[i];
  VecRestoreArray(all, &to);
  VecRestoreArrayRead(own, &from);
}

void UnknownPlaces::to_places(::Vec own, std::span<double* const> fields) {
  VecScatterBegin(scatter_, own, at_places_, INSERT_VALUES, SCATTER_FORWARD);
  VecScatterEnd(scatter_, own, at_places_, INSERT_VALUES, SCATTER_FORWARD);
  for (double* field : fields) std::fill_n(field, field_size_, 0.0);
  const PetscScalar* values = nullptr;
  VecGetArrayRead(at_places_, &values);
  for (std::size_t i = 0; i < places_.size(); ++i)
    fields[places_[i].field][places_[i].at] = places_[i].sign * values[i];
  VecRestoreArrayRead(at_places_, &values);
}

void UnknownPlaces::to_unknowns(std::span<const double* const> fields, ::Vec own) {
  PetscScalar* values = nullptr;
  VecGetArray(at_places_, &values);
  for (std::size_t i = 0; i < places_.size(); ++i)
    values[i] = places_[i].sign * fields[places_[i].field][places_[i].at];
  VecRestoreArray(at_places_, &values);
  VecSet(own, 0.0);
  VecScatterBegin(scatter_, at_places_, own, ADD_VALUES, SCATTER_REVERSE);
  VecScatterEnd(scatter_, at_places_, own, ADD_VALUES, SCATTER_REVERSE);
}

}  // namespace mudlark

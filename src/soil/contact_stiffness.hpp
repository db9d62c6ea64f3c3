#pragma once
/// How contacts with rigid bodies answer to ways of the soil.
#include <petscmat.h>

#include <Eigen/Core>
#include <vector>

#include "soil/contact_search.hpp"

namespace mudlark {

/// How the forces of contacts on the grains change with the ways of the grains: df = -B C B^T du,
/// with the weights B of each contact's faces.
template <int D>
struct ContactStiffness {
  using Matrix = Eigen::Matrix<double, D, D>;
  const ContactList<D>* list = nullptr;  ///< none: no contacts on any rank
  std::vector<Matrix> of;                ///< C of each contact [N/m]

  /// Adds B C B^T `ways` to `forces`; fields by local offset.
  void apply(const FaceVector<D>& ways, FaceVector<D>& forces) const;
  void add_diagonal(FaceVector<D>& diagonal) const;
  /// Adds it to a matrix whose rows are numbered so (-1: held), with these signs.
  void add_to(::Mat matrix, const std::array<const std::vector<PetscInt>*, D>& numbers,
              const std::array<std::vector<double>, D>& signs) const;
};

extern template struct ContactStiffness<2>;
extern template struct ContactStiffness<3>;

}  // namespace mudlark

#pragma once
/// A cheap inverse of what a mass matrix of splines is, up to its diagonal.
#include <petscvec.h>

#include <span>
#include <vector>

#include "grid/grid.hpp"

namespace mudlark {

/// Sums V N N^T over points of splines on a grid are nearly products of one banded matrix per axis,
/// scaled by their diagonal. This class inverts that product: banded Cholesky sweeps along the rows
/// of unknowns, axis after axis and back, within this rank. Symmetric and positive definite
/// whatever the shape of the soil. High frequencies, to which splines give little mass, come out
/// right; a diagonal scaling misses them by a factor of 7.5 (quadratic) per axis.
template <int D>
class SplineMass {
 public:
  /// `numbers` of the unknowns of one rank by local offset, -1: none; `component` of the faces, or
  /// -1 for cells; may be called once per component. `first`: number of this rank's first unknown.
  void add(const Grid<D>& grid, int component, std::span<const PetscInt> numbers, PetscInt first);
  /// The diagonal of the matrix that is to be inverted, one value per unknown of this rank.
  void set_diagonal(::Vec diagonal);
  /// Inverse times `in`. Not collective.
  void apply(::Vec in, ::Vec out) const;

 private:
  /// Unknowns side by side along an axis.
  struct Run {
    std::size_t first, length;  ///< in `order`
    int degree;
  };
  struct Sweep {
    std::vector<PetscInt> order;
    std::vector<Run> runs;
  };
  std::array<Sweep, D> sweeps_;
  std::vector<double> scale_;  ///< one over the root of the diagonal
};

extern template class SplineMass<2>;
extern template class SplineMass<3>;

}  // namespace mudlark

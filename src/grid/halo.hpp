#pragma once
/// Exchange of ghost layers between ranks, and the sums over ranks.
#include <cstddef>
#include <span>
#include <vector>

#include "grid/field.hpp"
#include "grid/grid.hpp"

namespace mudlark {

/// Moves ghost layers of any number of fields in one message per neighbour. Axis after axis, so
/// edges and corners are right. Layers behind a wall (non-periodic) belong to the rank at the wall:
/// they travel to its neighbours sideways like any other value, and nothing is written across the
/// wall itself. Faces follow the same rule: the closing face of an axis lies in the first layer
/// behind the upper wall.
template <int D>
class Halo {
 public:
  explicit Halo(const Grid<D>& grid) : grid_(&grid) {}

  /// Fills ghost values from their owners. `components` doubles stand side by side at each place.
  void exchange(std::span<double* const> fields, std::size_t components = 1);
  /// The same with marks of one byte each.
  void exchange(Field<std::uint8_t, AtCell, D>& marks);
  /// Adds ghost values to their owners' values; afterwards ghosts are stale. (Particles to grid.)
  void add_to_owners(std::span<double* const> fields, std::size_t components = 1);

  void exchange(CellField<D>& field);
  void exchange(FaceVector<D>& field);

 private:
  template <class T>
  void shift(std::span<T* const> fields, std::size_t components, int axis, int side, bool add);

  const Grid<D>* grid_;
  std::vector<std::byte> send_, receive_;
};

extern template class Halo<2>;
extern template class Halo<3>;

/// Reductions over all ranks of the grid.
template <int D>
double sum_over_ranks(const Grid<D>& grid, double value);
template <int D>
double max_over_ranks(const Grid<D>& grid, double value);
template <int D>
double min_over_ranks(const Grid<D>& grid, double value);

}  // namespace mudlark

#pragma once
/// Ghost layers of the water's fields: neighbours' values, and the mirror region behind the walls.
#include <array>

#include "grid/field.hpp"
#include "grid/halo.hpp"

namespace mudlark {

template <int D>
class CellRuns;

/// Behind a wall: cell values are mirrored (no gradient, contact angle 90 degrees); the normal
/// velocity is odd at closed walls and continues unchanged at open ones; the tangential velocity is
/// even at slip and open walls and odd at no-slip walls.
template <int D>
class Ghosts {
 public:
  explicit Ghosts(const Grid<D>& grid) : grid_(&grid), halo_(grid) {}

  void update(CellField<D>& field);
  void update(Field<std::uint8_t, AtCell, D>& marks);
  void update_velocity(FaceVector<D>& velocity);
  /// Behind walls near the water only: farther ghosts keep what they have.
  void update(CellField<D>& field, const CellRuns<D>& near);
  void update_velocity(FaceVector<D>& velocity, const CellRuns<D>& near);
  /// Exchange between ranks only (fluxes, flags at faces).
  void exchange(FaceVector<D>& field) { halo_.exchange(field); }
  void exchange(CellField<D>& field) { halo_.exchange(field); }
  /// What ranks added to their neighbours' faces comes to the owners, and from them back to all.
  void add_to_owners(FaceVector<D>& field) {
    std::array<double*, D> all{};
    for (int a = 0; a < D; ++a) all[static_cast<std::size_t>(a)] = field[a].data();
    halo_.add_to_owners(all);
    halo_.exchange(all);
  }

 private:
  /// `where`: the grid, or what of it is near the water.
  template <class Where, class T>
  void mirror_cells(const Where& where, T* values) const;
  template <class Where>
  void fill_behind_walls(const Where& where, FaceVector<D>& velocity) const;
  template <class Where>
  void fill_normal(const Where& where, double* values, int axis, int side) const;

  const Grid<D>* grid_;
  Halo<D> halo_;
};

extern template class Ghosts<2>;
extern template class Ghosts<3>;

}  // namespace mudlark

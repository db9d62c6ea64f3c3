#pragma once
/// Soil that is taken out of a running case, and soil that is put into it.
#include "grid/halo.hpp"
#include "soil/redistribute.hpp"

namespace mudlark {

/// Removes the points at places of which `gone(place)` is true.
template <int D, class Gone>
void remove_where(SoilParticles<D>& points, const Gone& gone) {
  std::vector<char> flagged(points.size(), 0);
  for (std::size_t p = 0; p < points.size(); ++p)
    flagged[p] = gone(to_point3(points.position_of(p)));
  remove_points(points, flagged);
}

/// The sites of a lattice with some points per axis of a cell that soil already takes up: those
/// whose centre lies in the box that a point stands for, as long along each axis as its share of a
/// cell's volume asks for.
template <int D>
class TakenSites {
 public:
  TakenSites(const Grid<D>& grid, int per_axis);
  void add(const SoilParticles<D>& points);
  /// Brings together what the ranks have added. Collective.
  void gather();
  /// Removes the points of the lattice that stand on taken sites.
  void clear(SoilParticles<D>& fresh) const;

 private:
  std::ptrdiff_t at(const Index<D>& site) const;

  const Grid<D>* grid_;
  int per_axis_;
  std::size_t per_cell_ = 1;
  std::vector<double> taken_;  ///< per_cell_ counts per cell of the local box
};

extern template class TakenSites<2>;
extern template class TakenSites<3>;

}  // namespace mudlark

#include "coupling/pressure_extension.hpp"

#include <array>

namespace mudlark {

template <int D>
PressureExtension<D>::PressureExtension(const Grid<D>& grid)
    : grid_(&grid),
      halo_(grid),
      known_(grid, "known", "1"),
      wet_(grid, "wet", "1"),
      next_known_(grid, "known", "1"),
      next_wet_(grid, "wet", "1"),
      next_pressure_(grid, "pressure", "Pa") {}

/// p(upper cell) - p(lower cell) of water at rest between neighbours along an axis [Pa].
template <int D>
double PressureExtension<D>::hydrostatic_difference(int axis) const {
  return water_density_ * grid_->gravity()[axis] * grid_->spacing()[axis];
}

template <int D>
void PressureExtension<D>::extend(const CellField<D>& open, const CellField<D>& wetness,
                                  double water_density, const IndexBox<D>& box,
                                  CellField<D>& pressure, int layers) {
  water_density_ = water_density;
  const IndexBox<D> cells = box.intersected(grid_->owned());
  known_.copy_values_from(open);
  wet_.copy_values_from(wetness);
  const std::array<double*, 3> fields{known_.data(), wet_.data(), pressure.data()};
  halo_.exchange(fields);
  for (bool more = true; more && layers > 0; --layers) {
    const bool mine = extend_one_layer(cells, pressure);
    more = max_over_ranks(*grid_, mine ? 1.0 : 0.0) > 0.0;
    if (more) halo_.exchange(fields);
  }
  continue_behind_walls(pressure);
  halo_.exchange(pressure);
}

/// Gives a value to the unknown cells that touch known ones. False when there was nothing to do.
template <int D>
bool PressureExtension<D>::extend_one_layer(const IndexBox<D>& cells, CellField<D>& pressure) {
  bool changed = false;
  const IndexBox<D> domain = grid_->global();
  next_known_.copy_values_from(known_);
  for_each(cells, [&](const Index<D>& cell) {
    if (known_[cell] > 0.0) return;
    double sources = 0.0, sum = 0.0, wet = 0.0;
    for (int a = 0; a < D; ++a)
      for (int side = -1; side <= 1; side += 2) {
        const Index<D> from = cell.shifted(a, side);
        const bool inside = grid_->periodic(a) || domain.contains(from);
        if (!inside || known_[from] == 0.0) continue;
        sources += 1.0;
        sum += pressure[from] - side * wet_[from] * hydrostatic_difference(a);
        wet += wet_[from];
      }
    if (sources == 0.0) return;
    next_known_[cell] = 1.0;
    next_wet_[cell] = wet / sources;
    next_pressure_[cell] = sum / sources;
    changed = true;
  });
  if (!changed) return false;
  for_each(cells, [&](const Index<D>& cell) {
    if (known_[cell] > 0.0 || next_known_[cell] == 0.0) return;
    known_[cell] = 1.0;
    wet_[cell] = next_wet_[cell];
    pressure[cell] = next_pressure_[cell];
  });
  return true;
}

template <int D>
void PressureExtension<D>::continue_behind_walls(CellField<D>& pressure) {
  for (int a = 0; a < D; ++a)
    for (int side = 0; side < 2; ++side) {
      if (!grid_->touches(a, side)) continue;
      IndexBox<D> layer = grid_->local();
      const int outwards = side == 0 ? -1 : 1, wall = side == 0 ? 0 : grid_->cells()[a] - 1;
      for (int k = 1; k <= ghost_layers; ++k) {
        layer.lower[a] = wall + outwards * k;
        layer.upper[a] = layer.lower[a] + 1;
        for_each(layer, [&](const Index<D>& cell) {
          const Index<D> from = cell.shifted(a, -outwards);
          wet_[cell] = wet_[from];
          pressure[cell] = pressure[from] + outwards * wet_[from] * hydrostatic_difference(a);
        });
      }
    }
}

template class PressureExtension<2>;
template class PressureExtension<3>;

}  // namespace mudlark

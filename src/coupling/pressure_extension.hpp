#pragma once
/// The free water's pressure, continued smoothly into the soil.
#include <limits>

#include "grid/halo.hpp"

namespace mudlark {

/// Continues a pressure [Pa] from open cells (open = 1) layer by layer into the cells of `box` that
/// are not (open = 0), and behind the walls. From a wet neighbour the pressure goes on
/// hydrostatically, p + rho_w g.dx; from a dry one it stays. Cells between several sources take the
/// mean. Only then does the virtual stress
/// -(grad W p_e + W grad p_e) see a smooth field, whose value at the mudline is the water's
/// pressure there. Collective; on return pressure is valid in `box` with ghosts.
template <int D>
class PressureExtension {
 public:
  explicit PressureExtension(const Grid<D>& grid);

  /// `wetness`: 1 in cells with water, 0 in dry ones; read in open cells only. At most so many
  /// `layers` of cells are filled.
  void extend(const CellField<D>& open, const CellField<D>& wetness, double water_density,
              const IndexBox<D>& box, CellField<D>& pressure,
              int layers = std::numeric_limits<int>::max());

 private:
  bool extend_one_layer(const IndexBox<D>& cells, CellField<D>& pressure);
  void continue_behind_walls(CellField<D>& pressure);
  double hydrostatic_difference(int axis) const;

  const Grid<D>* grid_;
  Halo<D> halo_;
  CellField<D> known_, wet_, next_known_, next_wet_, next_pressure_;
  double water_density_ = 0.0;
};

extern template class PressureExtension<2>;
extern template class PressureExtension<3>;

}  // namespace mudlark

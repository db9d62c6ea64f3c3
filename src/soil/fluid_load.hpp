#pragma once
/// All that the soil knows of the free water: its pressure on the soil's surface, extended into the
/// soil.
#include "grid/field.hpp"

namespace mudlark {

/// What happens to pore water where the soil meets the free water.
enum class PoreOutlet {
  at_water_pressure,  ///< pore pressure equals the water's
  at_zero_pressure,   ///< the water's pressure loads the skeleton, pore water drains freely
  sealed              ///< no flux relative to the grains
};

template <int D>
struct FluidLoad {
  explicit FluidLoad(const Grid<D>& grid)
      : pressure_begin(grid, "water pressure", "Pa"), pressure_end(grid, "water pressure", "Pa") {}

  CellField<D>
      pressure_begin;  ///< at the begin of the flow step [Pa], smooth through the soil, with ghosts
  CellField<D> pressure_end;  ///< at its end [Pa]
  PoreOutlet outlet = PoreOutlet::at_water_pressure;
};

}  // namespace mudlark

#pragma once
/// Drag between water and grains of a known diameter, from a bed to a single grain that settles.
#include <optional>

#include "coupling/soil_in_water.hpp"
#include "flow/drag_laws.hpp"
#include "flow/moving_grains.hpp"

namespace mudlark {

/// Pressure loss (A + B|w|) w of water among grains, w = n (v - v_s): Ergun's of a bed while they
/// fill more than `bed`, below `cloud` that with which they settle as Soulsby (1997) and Richardson
/// & Zaki (1954) say, v = v_0 n^N with v_0 = nu/d (sqrt(10.36^2 + 1.049 D*^3) - 10.36) and Rowe's
/// N (1987); smooth in between (docs/decisions/0076).
class GrainDragLaw {
 public:
  static constexpr double cloud = 0.25, bed = 0.4;  ///< shares of the volume [-]

  GrainDragLaw(double viscosity, double water_density, double grain_density, double diameter);

  DragCoefficients operator()(double porosity) const;
  double settling_velocity() const { return settling_velocity_; }  ///< of one grain [m/s]
  double hindering_exponent() const { return exponent_; }          ///< N [-]

 private:
  Ergun packed_;
  double settling_velocity_, exponent_;
  DragCoefficients single_;  ///< per share of grains, as that share tends to zero
};

template <int D>
class GrainDrag {
 public:
  GrainDrag(const Grid<D>& grid, const SoilOptions& options);

  /// Do the grains have diameters? Otherwise their drag is that of a permeability.
  bool active() const { return law_.has_value(); }
  /// grains.resistance on this rank's own faces, from the share and velocity of the grains and the
  /// velocity of the water, both with ghosts.
  void find(const SoilInWater<D>& room, const Space<D>& space, const FaceVector<D>& water,
            MovingGrains<D>& grains) const;

 private:
  const Grid<D>* grid_;
  std::optional<GrainDragLaw> law_;  ///< all soils have grains of one diameter
};

extern template class GrainDrag<2>;
extern template class GrainDrag<3>;

}  // namespace mudlark

#pragma once
/// What points leave on the faces of the grid, and the motion that the faces give back.
#include "grid/field.hpp"

namespace mudlark {

/// Sums over the points around a face of one axis; vector quantities are the component along that
/// axis. Plain doubles, so that halos and walls treat them as eight components; the four of dry
/// soil lie side by side.
struct NodeSums {
  double water_mass = 0.0;      ///< pore water [kg]
  double drag = 0.0;            ///< integral of n^2 mu / kappa [kg/s]
  double grain_mass = 0.0;      ///< [kg]
  double volume = 0.0;          ///< of soil; where the water is the flow's, of its grains [m^D]
  double grain_momentum = 0.0;  ///< [kg m/s]
  double mixture_force =
      0.0;  ///< internal and surface forces on grains and pore water together [N]
  double water_momentum = 0.0;  ///< [kg m/s]
  double water_force = 0.0;     ///< - integral of grad p, as if water filled the whole volume [N]
};
inline constexpr std::size_t node_sums = 8;
inline constexpr std::size_t node_scalars = 4;  ///< the first four do not change sign in a mirror

/// Motion of a face after the momentum balance, along its axis.
struct NodeMotion {
  double grain_velocity = 0.0;  ///< v_s [m/s]
  double grain_change = 0.0;    ///< of v_s over the step [m/s]
  double water_velocity = 0.0;  ///< v_f, interstitial [m/s]
  double water_change = 0.0;    ///< of v_f over the step [m/s]
  double total_flux = 0.0;  ///< v_s + n (v_f - v_s) [m/s]: grains and water through a unit of area
};
inline constexpr std::size_t node_motions = 5;

template <class T, int D>
using NodeField = std::array<Field<T, AtFace, D>, static_cast<std::size_t>(D)>;

/// The components one behind the other, as halos take them.
template <class T, int D>
std::array<double*, D> as_doubles(NodeField<T, D>& nodes) {
  static_assert(sizeof(T) % sizeof(double) == 0);
  std::array<double*, D> all{};
  for (std::size_t a = 0; a < all.size(); ++a) all[a] = reinterpret_cast<double*>(nodes[a].data());
  return all;
}

/// Is there anybody to exchange ghost layers with, be it this rank itself across a periodic side?
template <int D>
bool exchanges_halos(const Grid<D>& grid) {
  bool periodic = false;
  for (int a = 0; a < D; ++a) periodic = periodic || grid.periodic(a);
  return periodic || grid.ranks() > 1;
}

}  // namespace mudlark

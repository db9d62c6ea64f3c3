#pragma once
/// What the case file says about the coupling of water and soil.

namespace mudlark {

/// surface: free and pore water meet at the soil's surface. unified: they are one water.
enum class CouplingMode { none, surface, unified };
/// Pore water at the soil's surface: consistent: p_soil = p_water; load_only: the water's pressure
/// loads the skeleton, the pore water drains at zero pressure (the paper's benchmark); membrane: no
/// relative flux.
enum class Mudline { consistent, load_only, membrane };
enum class PressureInTime { linear, constant };
/// Whose share of a face the grains answer to pressure with: that of the points around it, or what
/// the water of its cells leaves (docs/decisions/0085).
enum class GrainShare { points, cells };

struct CouplingOptions {
  CouplingMode mode = CouplingMode::none;
  Mudline mudline = Mudline::consistent;
  PressureInTime pressure_in_time = PressureInTime::linear;
  double ramp = 0.0;  ///< [s] over which the water's load is brought onto the soil (half cosine)
  GrainShare grain_share = GrainShare::points;
  double added_mass_factor = 1.0;  ///< scales the relaxation against added mass; 0: loose coupling
};

}  // namespace mudlark

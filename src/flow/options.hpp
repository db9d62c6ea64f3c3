#pragma once
/// What the case file says about the water, as plain data (SI units).
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/pore_filling.hpp"
#include "base/varying.hpp"
#include "flow/flow_sides.hpp"
#include "flow/ground_sides.hpp"
#include "flow/rain.hpp"
#include "flow/wave_source.hpp"
#include "grid/solid_options.hpp"

namespace mudlark {

struct WaterBody {
  Shape shape;
  std::array<Varying, 3> velocity{};  ///< initial velocity [m/s], per axis
};

enum class DragLaw { darcy, darcy_forchheimer, ergun, van_gent, cadmas };

/// Fixed porous ground: rubble mound, filter, breakwater, rigid bed.
struct PorousGround {
  std::string name;
  Shape shape;
  double porosity = 0.4;  ///< [-]
  DragLaw drag = DragLaw::darcy;
  double intrinsic_permeability = 0.0;  ///< [m2], darcy laws
  double forchheimer = 0.0;  ///< B of (A + B|w|) w [Pa s2/m3 per ... i.e. kg/m4], darcy_forchheimer
  double grain_size = 0.0;   ///< [m], ergun and van_gent
  double alpha = 1000.0, beta = 1.1;                 ///< van Gent (1995) coefficients [-]
  double keulegan_carpenter = 0.0;                   ///< KC [-]; 0: steady flow, no KC term
  double drag_coefficient = 0.0, drag_length = 0.0;  ///< C_D [-] and its length [m], cadmas
  double inertia_coefficient = 0.0;                  ///< C_A of the added mass C_A rho (1 - n) [-]
  PoreFilling filling{PermeabilityCurve::power, 1.0};  ///< k_r = S: each share of water by itself
};

/// Impermeable body in the water.
struct FlowSolid {
  std::string name;
  Shape shape;                   ///< where it is at time zero
  std::optional<Point3> centre;  ///< what it turns about [m]
  std::variant<FixedSolid, PrescribedSolid, FreeSolid> motion{};
  bool no_slip = false;   ///< else water slips along its surface
  double friction = 0.0;  ///< Coulomb's coefficient against other bodies and sides [-]
};

/// Friction of no-slip walls. resolved: the viscous profile between the wall and the first row of
/// velocities; werner_wengle: where that row lies beyond the viscous sublayer, the 1/7 power law;
/// logarithmic: the log law.
enum class WallLaw { resolved, werner_wengle, logarithmic };

/// The second fluid, where air counts.
struct Gas {
  double density = 1.2;                ///< [kg/m3]
  double viscosity = 1.8e-5;           ///< dynamic, [Pa s]
  std::optional<double> bulk_modulus;  ///< [Pa]; without it the gas keeps its volume
  std::array<Varying, 3> velocity{};   ///< at the start, outside the bodies of water [m/s]
};

enum class TurbulenceModel { none, smagorinsky, k_epsilon };

struct TurbulenceOptions {
  TurbulenceModel model = TurbulenceModel::none;
  double constant = 0.15;                 ///< C_s of Smagorinsky [-]
  double initial_k = 1e-6;                ///< [m2/s2], k-epsilon
  double initial_viscosity_ratio = 10.0;  ///< nu_t / nu at the start [-], k-epsilon
};

struct FlowOptions {
  double density = 1000.0;      ///< [kg/m3]
  double viscosity = 1.002e-3;  ///< dynamic, [Pa s]
  std::optional<Gas> gas;       ///< without it there is a void at zero pressure beside the water
  std::vector<WaterBody> bodies;
  std::vector<PorousGround> porous;
  std::vector<FlowSolid> solids;
  double courant = 0.4;  ///< of the interface's Courant number bound (NUMERICS B2)
  double pressure_tolerance =
      1e-10;  ///< bound on the largest residual divergence times the step [-]
  std::vector<WaveZoneOptions> waves;
  std::vector<WaveSourceOptions> wave_sources;
  TurbulenceOptions turbulence;
  std::vector<FlowSideOptions> sides;
  std::vector<GroundSideOptions> ground_sides;  ///< where water shares its pressure with grains
  std::vector<RainOptions> rains;
  WallLaw wall_law = WallLaw::resolved;
  bool advection = true;  ///< momentum advection (off: Stokes flow, for tests)
  std::optional<std::array<Varying, 3>> body_acceleration;  ///< beside gravity [m/s2]
};

}  // namespace mudlark

#pragma once
/// A whole case as plain data: what input/ makes of a case file and run/ builds the world from.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coupling/options.hpp"
#include "flow/options.hpp"
#include "grid/domain_options.hpp"
#include "soil/options.hpp"

namespace mudlark {

struct TimeOptions {
  double end = 0.0;                ///< [s]
  std::optional<double> step;      ///< fixed outer step [s]
  std::optional<double> max_step;  ///< upper bound of the outer step [s]
  double output_every =
      0.0;  ///< [s] of simulated time between field outputs; 0: start and end only
  std::vector<double> output_at;    ///< [s], further times of field output
  std::vector<double> stage_ends;   ///< [s], ascending, the last one is `end`; none: one stage
  double checkpoint_every = 600.0;  ///< [s] of wall-clock time
};

enum class GaugeQuantity {
  water_level,         ///< heights of the water surfaces in the column through `at` [m]
  pressure,            ///< of the flow at `at` [Pa]
  velocity,            ///< of the flow at `at`, one column per axis [m/s]
  front,               ///< largest x that water reaches [m] (no `at`)
  total_water,         ///< volume of free-flow water [m^D] (no `at`)
  kinetic_energy,      ///< of water and soil [J] (J/m in 2D) (no `at`)
  momentum,            ///< of water and soil, one column per axis [kg m/s] (per m in 2D) (no `at`)
  max_speed,           ///< largest speed of the water [m/s] (no `at`)
  section_flux,        ///< water through a section, mean over the last outer step [m^D/s]
  overtopping,         ///< water through a section since the start [m^D], and as section_flux
  run_up,              ///< highest surface of water that stands on the ground [m]
  energy,              ///< kinetic, potential and their sum, of the water [J] (J/m in 2D)
  settlement,          ///< downward displacement of the material that started at `at` [m]
  displacement,        ///< of the material that started at `at`, one column per axis [m]
  pore_pressure,       ///< of the material that started at `at` [Pa]
  effective_stress,    ///< xx, yy, zz, zx of the material that started at `at` [Pa]
  point_porosity,      ///< of the material that started at `at` [-]
  solid_force,         ///< of soil (mean over the last outer step) or water on a rigid body [N]
  solid_moment,        ///< of the same about the body's centre [N m]
  solid_displacement,  ///< of a rigid body's centre since the start [m]
  solid_rotation,      ///< of a rigid body since the start [rad]
  solid_velocity,      ///< of a rigid body's centre [m/s]
  solid_collision,     ///< force of other bodies and of the domain's sides on a free body [N]
  discharge,           ///< of pore water out through a boundary [m^D/s] (no `at`)
};

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Part of a plane across an axis, or of the ground: what water is counted through or looked for
/// on.
struct GaugeRange {
  std::size_t axis = 0;  ///< across the plane: 0 x, 1 y, 2 z
  double place = 0.0;    ///< of the plane along it [m]
  double sign = 1.0;     ///< +1 counts what flows towards larger coordinates
  Point3 from{-unbounded, -unbounded, -unbounded}, to{unbounded, unbounded, unbounded};  ///< [m]
};

struct GaugeOptions {
  std::string name;
  GaugeQuantity quantity = GaugeQuantity::water_level;
  Point3 at{};
  GaugeRange range;        ///< section_flux, overtopping, run_up; part of a body of solid_force
  double thickness = 0.0;  ///< run_up: of the water that counts as wet [m]
  int crossings = 1;       ///< water_level: surfaces that are written, the topmost first
  std::string of;          ///< name of the rigid body, or of the boundary
  double every = 0.0;      ///< [s]; 0: every outer step
};

struct CaseOptions {
  std::string title;
  DomainOptions domain;
  TimeOptions time;
  std::optional<FlowOptions> flow;  ///< set when the case has [[water.body]]
  std::optional<SoilOptions> soil;  ///< set when the case has [[soil]]
  CouplingOptions coupling;
  std::vector<GaugeOptions> gauges;
  std::string resolved_toml;  ///< the resolved input, every default written out
};

}  // namespace mudlark

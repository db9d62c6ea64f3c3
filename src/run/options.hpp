#pragma once
/// A whole case as plain data: what input/ makes of a case file and run/ builds the world from.
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
  water_level,         ///< height of the water surface in the column through `at` [m]
  pressure,            ///< of the flow at `at` [Pa]
  velocity,            ///< of the flow at `at`, one column per axis [m/s]
  front,               ///< largest x that water reaches [m] (no `at`)
  total_water,         ///< volume of free-flow water [m^D] (no `at`)
  kinetic_energy,      ///< of water and soil [J] (J/m in 2D) (no `at`)
  max_speed,           ///< largest speed of the water [m/s] (no `at`)
  settlement,          ///< downward displacement of the material that started at `at` [m]
  displacement,        ///< of the material that started at `at`, one column per axis [m]
  pore_pressure,       ///< of the material that started at `at` [Pa]
  effective_stress,    ///< xx, yy, zz, zx of the material that started at `at` [Pa]
  point_porosity,      ///< of the material that started at `at` [-]
  solid_force,         ///< of the soil on a rigid body, mean over the last outer step [N]
  solid_moment,        ///< of the same about the body's centre [N m]
  solid_displacement,  ///< of a rigid body's centre since the start [m]
  solid_rotation,      ///< of a rigid body since the start [rad]
  solid_velocity,      ///< of a rigid body's centre [m/s]
  discharge,           ///< of pore water out through a boundary [m^D/s] (no `at`)
};

struct GaugeOptions {
  std::string name;
  GaugeQuantity quantity = GaugeQuantity::water_level;
  Point3 at{};
  std::string of;      ///< name of the rigid body, or of the boundary
  double every = 0.0;  ///< [s]; 0: every outer step
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

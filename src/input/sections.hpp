#pragma once
/// The readers of the case file's sections, one source file each.
#include <optional>
#include <string>

#include "input/section.hpp"
#include "run/options.hpp"

namespace mudlark {

/// [water], which flow and pore water share.
struct WaterProperties {
  double density = FlowOptions{}.density;
  double viscosity = FlowOptions{}.viscosity;
  std::optional<double> bulk_modulus;
};

/// A shape of the case and the key that it was written under.
struct NamedShape {
  std::string what;  ///< "soil \"column\""
  Shape shape;
  Place place;
  std::size_t stage = 0;  ///< at which it is placed
};

/// A [[stage]] that is not checked against the rest of the case yet.
struct Stage {
  Section section;
  SoilStage soil;
  std::optional<std::vector<std::string>> load_names;
};

void read_domain(Section& root, CaseOptions& options);
/// [[domain.refinement]]: makes axes of cells that are smaller in some regions.
void read_refinements(Section& domain_section, DomainOptions& domain, bool domain_known);
/// [[stage]]: after [domain] and before [time].
std::vector<Stage> read_stages(Section& root, CaseOptions& options);
/// Checks the stages against soil, loads and solvers, and puts them into the options.
void finish_stages(std::vector<Stage>& stages, CaseOptions& options);
/// The stage at whose start a [[soil]] is placed.
std::size_t read_stage_of_soil(Section& soil, const std::vector<Stage>& stages);
/// Returns [time] courant, which holds for both solvers.
std::optional<double> read_time(Section& root, CaseOptions& options);
WaterProperties read_water(Section& root, CaseOptions& options);
/// [water.turbulence]
TurbulenceOptions read_turbulence(Section& water);
void read_porous(Section& root, CaseOptions& options, std::vector<NamedShape>& grounds);
void read_soil(Section& root, CaseOptions& options, const WaterProperties& water,
               const std::vector<Stage>& stages, std::vector<NamedShape>& grounds);
/// law = { ... } and the strain measure that goes with it; the water's viscosity in Pa s.
void read_law(Section& soil, double water_viscosity, SoilBody& body);
/// Keys that several laws share.
double read_young_modulus(Section& section);  ///< [Pa]
double read_poisson_ratio(Section& section);  ///< [-]
/// Laws that yield at a constant or softening strength.
SoilLawOptions read_mohr_coulomb(Section& law);
SoilLawOptions read_tresca(Section& law);
SoilLawOptions read_von_mises(Section& law);
SoilLawOptions read_drucker_prager(Section& law);
/// Laws of flow; the grain density of the body is set afterwards.
SoilLawOptions read_mu_i(Section& law);
SoilLawOptions read_mu_j(Section& law);
SoilLawOptions read_newtonian(Section& law);
/// Laws that know void ratio and critical state.
SoilLawOptions read_modified_cam_clay(Section& law);
SoilLawOptions read_sanisand(Section& law);
SoilLawOptions read_sekiguchi_ohta(Section& law);
/// M from D and the porosity of the body, where the case gives D.
void resolve_dilatancy(Section& section, double porosity, SekiguchiOhtaOptions& law);
/// Sand that liquefies settles to a void ratio below that of the body's porosity.
void check_settled_void_ratio(Section& section, double porosity, const SanisandOptions& law);
/// A law that the user compiled.
SoilLawOptions read_umat(Section& law);
/// How a [[wave]] is made: one of side, paddle, source, or else a zone.
struct WaveMaker {
  WaveZoneOptions zone;
  std::optional<FlowSideOptions> side;
  std::optional<BoxShape> paddle;  ///< the board at rest
  double backwards = 0.0;          ///< room behind its front [m]
  std::optional<BoxShape> source;
};
/// side, zone, paddle or source of a [[wave]].
WaveMaker read_wave_maker(Section& wave, const DomainOptions& domain);
/// Adds a wave that is read to the water, and the board of a paddle to its bodies.
void add_wave(Section& wave, CaseOptions& options, WaveMaker maker);
/// [[wave]]: after [domain] and [water].
void read_waves(Section& root, CaseOptions& options);
/// Spectrum, number and directions of the components of a sea; `random`: their phases are.
SeaComponents read_sea(Section& wave, bool random);
/// [[solid]]: after [[water.body]] and [[soil]].
void read_solids(Section& root, CaseOptions& options);
/// Free bodies feel the body_acceleration of what they stand in; after the solvers are read.
void accelerate_free_bodies(CaseOptions& options);
void read_loads(Section& root, CaseOptions& options);
/// A side of the domain by its name, `side = "lower_x"`.
struct SidePart {
  int axis = 0, side = 0;
};
SidePart read_side(Section& section, int dimension);
/// from and to, the part along a side of axis `across`: a number in the plane, a list of two in
/// space (the axes along the side).
void read_range(Section& section, int dimension, int across, Point3& from, Point3& to);
/// [[opening]]: after [domain] and [water].
void read_openings(Section& root, CaseOptions& options);
/// [[rain]]: after what [water], [[soil]] and [coupling] say.
void read_rain(Section& root, CaseOptions& options);
/// Checks what water does at a side against walls and other sides, and adds it.
void add_flow_side(Section& section, CaseOptions& options, const FlowSideOptions& side);
/// [[boundary]]: after [domain] and [[soil]].
void read_boundaries(Section& root, CaseOptions& options);
/// What boundaries do not go with, after [soil_solver] and [[solid]].
void check_boundaries(Section& root, const CaseOptions& options);
void read_solvers(Section& root, CaseOptions& options, std::optional<double> courant);
/// Settings of the soil that solver and stages share. `longest` [s]: upper bound of `after`.
Bounds damping_bounds();
Bounds mass_scaling_bounds();
TimeMethod read_time_method(Section& section, std::optional<TimeMethod> fallback);
RestCriterion read_rest(Section& parent, double longest);
void read_coupling(Section& root, CaseOptions& options);
/// What pore_water = "unified" goes with, after everything else of soil, flow and coupling.
void check_unified(Section& root, CaseOptions& options);
void read_gauges(Section& root, CaseOptions& options);
/// section = { x = 2.0, from = 0.3, to = 0.8, direction = "negative" } of a gauge.
void read_gauge_section(Section& gauge, GaugeRange& range);
/// from, to and thickness of a gauge of run-up.
/// from, to: the box around the part of a body's surface that counts.
void read_solid_part(Section& gauge, GaugeRange& range);
void read_run_up_range(Section& gauge, GaugeOptions& options);

/// How far a shape may reach. What lies beyond the domain's edge does not count, and over the top
/// that would be weight on what lies below it.
enum class Reach { below_the_top, anywhere };
/// The shape below `key`, at least a part of which lies in the domain; nothing after a mistake.
std::optional<Shape> read_shape(Section& section, std::string_view key,
                                Reach reach = Reach::below_the_top);
/// { line = ... } or { file = ... }: everything below that ground; nothing after a mistake.
std::optional<Shape> read_ground(Section& section);
/// { stl = "file.stl", scale = , offset = } of a shape; nothing after a mistake.
std::optional<Shape> read_stl(Section& shape);
/// kappa [m2] from intrinsic_permeability or, with the water's density [kg/m3] and viscosity [Pa
/// s], from hydraulic_conductivity k = kappa rho g / mu with g = 9.81 m/s2 whatever the case's
/// gravity.
std::optional<double> read_permeability(Section& section, double density, double viscosity,
                                        bool required);
/// relative_permeability and suction of pores that are not full. `has_curve`: false where gas fills
/// them and no default of the first holds.
PoreFilling read_pore_filling(Section& section, PoreFilling fallback, bool has_curve);
/// Reports bodies of ground, or rigid ones, that fill the same space.
void check_overlaps(Reading& reading, const std::vector<NamedShape>& grounds);

/// Place of an axis of the grid in (x, y, z).
inline std::size_t coordinate(int axis, int dimension) {
  return static_cast<std::size_t>(dimension == 2 && axis == 1 ? 2 : axis);
}
/// Do two parts of sides (axis, side, from and to along it) share a place?
template <class One, class Other>
bool parts_meet(const One& one, const Other& other, int dimension) {
  if (one.axis != other.axis || one.side != other.side) return false;
  for (int axis = 0; axis < dimension; ++axis) {
    const std::size_t a = coordinate(axis, dimension);
    if (axis != one.axis &&
        !(std::max(one.from[a], other.from[a]) < std::min(one.to[a], other.to[a])))
      return false;
  }
  return true;
}
/// Name of an axis in 2D (x, z) or 3D.
std::string_view axis_name(int dimension, std::size_t axis);
/// A position given per axis, as (x, y, z).
Point3 point_from_axes(const std::vector<double>& axes);

/// A name that can be a file's: letters, digits, space, _ - . +; reports others, and names used
/// twice.
std::string read_name(Section& section, std::vector<std::string>& used);

}  // namespace mudlark

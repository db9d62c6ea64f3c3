/// [soil_solver], [flow_solver], [coupling], [[load]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/sections.hpp"
#include "input/unified.hpp"

namespace mudlark {
namespace {

Bounds share(double upper, std::string reason, std::string cure = {}) {
  return {.lower = 0.0,
          .upper = upper,
          .lower_included = false,
          .reason = std::move(reason),
          .cure = std::move(cure)};
}

/// How small unbalanced force and kinetic energy are at rest.
void read_tolerances(Section& section, RestCriterion& rest) {
  rest.unbalanced_force = section.number(
      "unbalanced_force", quantity::number,
      share(1.0, "the unbalanced force as a share of the external one, above 0 and at most 1",
            "1e-3 to 1e-2 is usual."),
      rest.unbalanced_force);
  rest.kinetic_energy = section.number(
      "kinetic_energy", quantity::number,
      share(1.0, "the kinetic energy as a share of the external work, above 0 and at most 1",
            "1e-3 to 1e-2 is usual."),
      rest.kinetic_energy);
}

/// start_in_equilibrium = { longest = ..., ... }
EquilibriumStart read_equilibrium(Section& solver, const Bounds& coefficient) {
  Section section = solver.table("start_in_equilibrium", Record::Form::inline_table);
  EquilibriumStart start;
  start.longest =
      section.number("longest", quantity::time,
                     positive("the simulated time in which the soil must come to rest",
                              "Some ten times that in which a compression wave goes up and down."));
  read_tolerances(section, start.rest);
  start.damping = section.number("damping", quantity::number, coefficient, start.damping);
  start.reset_displacements = section.flag("reset_displacements", start.reset_displacements);
  section.finish();
  return start;
}
/// The same for implicit steps, which find it without moving there.
EquilibriumStart read_implicit_equilibrium(Section& solver) {
  Section section = solver.table("start_in_equilibrium", Record::Form::inline_table);
  EquilibriumStart start;
  start.longest = section
                      .number_if_set("longest", quantity::time,
                                     positive("the simulated time in which pore water may drain",
                                              "Leave it out to let all of it drain."))
                      .value_or(0.0);
  for (const std::string_view key : {"unbalanced_force", "kinetic_energy", "damping"})
    section.forbid(key, "implicit steps have no inertia: they end in equilibrium");
  start.reset_displacements = section.flag("reset_displacements", start.reset_displacements);
  section.finish();
  return start;
}

/// Local damping of both phases, scaled inertia, and when to stop.
void read_statics(Section& section, SoilOptions& soil, bool water_flows) {
  if (soil.method == TimeMethod::implicit_steps) {  // without their defaults in the resolved case
    for (const std::string_view key :
         {"damping", "water_damping", "mass_scaling", "stop_when_static"})
      section.forbid(key, "implicit steps have no inertia: they are at rest after each step");
    if (section.has("start_in_equilibrium"))
      soil.start_in_equilibrium = read_implicit_equilibrium(section);
    return;
  }
  const Bounds coefficient = damping_bounds();
  soil.damping = section.number("damping", quantity::number, coefficient, soil.damping);
  soil.water_damping = section.number("water_damping", quantity::number, coefficient,
                                      std::isnan(soil.damping) ? 0.0 : soil.damping);
  soil.mass_scaling =
      section.number("mass_scaling", quantity::number, mass_scaling_bounds(), soil.mass_scaling);
  if (soil.mass_scaling > 1.0 && water_flows && !is_unified(soil))
    section.fail("mass_scaling",
                 "water that flows would meet a soil of false inertia: [[water.body]] excludes it",
                 "With pore_water = \"unified\" it goes: only grains are scaled then.");
  if (section.has("start_in_equilibrium")) {
    if (water_flows && !is_unified(soil))
      section.fail("start_in_equilibrium",
                   "it is sought for soil alone, and the case has flowing water ([[water.body]])",
                   "With pore_water = \"unified\" it goes.");
    soil.start_in_equilibrium = read_equilibrium(section, coefficient);
  }
  if (!section.has("stop_when_static")) return;
  if (water_flows && !is_unified(soil))
    section.fail("stop_when_static",
                 "it watches the soil only, and the case has flowing water ([[water.body]])",
                 "With pore_water = \"unified\" it watches both.");
  soil.stop_when_static = read_rest(section, section.reading().end);
}

/// What belongs to the formulations of pore water that are not u-w.
void read_formulation_keys(Section& section, SoilOptions& soil) {
  if (soil.formulation != Formulation::u_p) {
    for (const std::string_view key : {"inertia_in_darcy", "loading_period"})
      section.forbid(key, "it belongs to formulation = \"u-p\" under [[soil]]");
    return;
  }
  soil.inertia_in_darcy = section.flag("inertia_in_darcy", soil.inertia_in_darcy);
  soil.loading_period = section.number_if_set(
      "loading_period", quantity::time,
      positive("a period lies above 0", "Give the shortest one of what loads the soil."));
}

void read_soil_solver(Section& root, SoilOptions& soil, bool water_flows,
                      std::optional<double> courant) {
  Section section = root.table("soil_solver", Record::Form::block);
  soil.kernel = section.choice<Kernel>("kernel",
                                       {{"linear", Kernel::linear},
                                        {"quadratic", Kernel::quadratic},
                                        {"composite", Kernel::composite}},
                                       soil.kernel);
  soil.transfer = section.choice<Transfer>(
      "transfer", {{"flip", Transfer::flip}, {"apic", Transfer::apic}}, soil.transfer);
  soil.flip_fraction =
      section.number("flip_fraction", quantity::number,
                     {.lower = 0.0, .upper = 1.0, .reason = "a share between 0 (PIC) and 1 (FLIP)"},
                     soil.flip_fraction);
  soil.method = read_time_method(section, soil.method);
  read_statics(section, soil, water_flows);
  soil.courant = section.number("courant", quantity::number,
                                share(1.0, "a share of the stable step, above 0 and at most 1"),
                                courant.value_or(soil.courant));
  soil.max_step =
      section.number_if_set("max_step", quantity::time, positive("a step needs a length above 0"));
  soil.step_tolerance = section.number(
      "step_tolerance", quantity::number,
      share(1.0, "the error of an implicit step as a share of the largest displacement so far"),
      soil.step_tolerance);
  read_formulation_keys(section, soil);
  soil.linear_solver = section.choice<LinearSolver>("linear_solver",
                                                    {{"auto", LinearSolver::automatic},
                                                     {"direct", LinearSolver::direct},
                                                     {"iterative", LinearSolver::iterative}},
                                                    soil.linear_solver);
  if (soil.linear_solver == LinearSolver::iterative && soil.kernel != Kernel::composite)
    section.fail("linear_solver", "the iterations rest on the divergence of composite splines",
                 "Use kernel = \"composite\", or linear_solver = \"direct\".");
  soil.load_form = section.choice<LoadForm>(
      "load_form", {{"virtual-stress", LoadForm::virtual_stress}, {"facets", LoadForm::facets}},
      soil.load_form);
  soil.split_stretched = section.number_if_set(
      "split_stretched", quantity::number,
      {.lower = 1.0,
       .reason = "the length in cells at which a point is split; shorter ones hold together",
       .cure = "1 to 1.5 is usual."});
  if (section.has("body_acceleration"))
    soil.body_acceleration = section.varying_per_axis("body_acceleration", quantity::acceleration);
  if (soil.method == TimeMethod::implicit_steps && soil.load_form == LoadForm::facets)
    section.fail("load_form", "implicit steps load the soil by a virtual stress",
                 "Leave the key out.");
  section.finish();
}

void read_flow_solver(Section& root, FlowOptions& flow, std::optional<double> courant) {
  Section section = root.table("flow_solver", Record::Form::block);
  const Bounds bounds =
      share(0.5, "the sharp water surface allows a Courant number above 0 and at most 0.5");
  if (courant && !section.has("courant") && !bounds.admits(*courant))
    root.reading().report.add(root.place("time"),
                              fmt::format("time.courant = {} is not possible\n  ({}). Write "
                                          "courant under [flow_solver].",
                                          *courant, bounds.reason));
  flow.courant =
      section.number("courant", quantity::number, bounds, courant.value_or(flow.courant));
  flow.pressure_tolerance = section.number(
      "pressure_tolerance", quantity::number,
      share(
          1e-2,
          "the bound on what the pressure solver leaves of the divergence, above 0, at most 0.01"),
      flow.pressure_tolerance);
  flow.advection = section.flag("advection", flow.advection);
  if (section.has("body_acceleration"))
    flow.body_acceleration = section.varying_per_axis("body_acceleration", quantity::acceleration);
  flow.wall_law = section.choice<WallLaw>("wall_law",
                                          {{"resolved", WallLaw::resolved},
                                           {"werner-wengle", WallLaw::werner_wengle},
                                           {"log", WallLaw::logarithmic}},
                                          flow.wall_law);
  if (flow.turbulence.model == TurbulenceModel::k_epsilon && flow.wall_law != WallLaw::logarithmic)
    section.fail("wall_law", "k-epsilon does not hold in the sublayer at walls: it needs \"log\"",
                 "Leave wall_law out.");
  section.finish();
}

/// What does not go together with implicit steps, or with an implicit pore pressure.
void check_method(Section& root, const SoilOptions& soil, bool water_flows) {
  Report& report = root.reading().report;
  const bool implicit = soil.method == TimeMethod::implicit_steps;
  if (implicit && water_flows)
    report.add(root.place("soil_solver"),
               "soil_solver.method = \"implicit\" has no inertia and cannot follow flowing water; "
               "leave out [[water.body]] or write method = \"explicit\"");
  if (implicit && soil.formulation != Formulation::u_w)
    report.add(
        root.place("soil_solver"),
        "soil_solver.method = \"implicit\" finds pore pressure in its own way\n  (formulation "
        "= \"u-w-p\" and \"u-p\" are explicit in the skeleton). Leave formulation out of "
        "[[soil]], or write method = \"explicit\".");
  if (soil.solids.empty()) return;
  for (const SolidOptions& solid : soil.solids)
    if (const auto* motion = std::get_if<FreeSolid>(&solid.motion);
        implicit && motion &&
        (motion->velocity != FreeSolid{}.velocity ||
         motion->angular_velocity != FreeSolid{}.angular_velocity))
      report.add(root.place("solid"),
                 fmt::format("solid \"{}\" starts with a velocity, and soil_solver.method = "
                             "\"implicit\" has no inertia\n  (a free body is where forces on it "
                             "balance). Leave velocity and angular_velocity out of its motion, or "
                             "write method = \"explicit\".",
                             solid.name));
  if (soil.formulation != Formulation::u_w)
    report.add(root.place("solid"),
               "[[solid]] needs formulation = \"u-w\" under [[soil]]\n  (the pore pressure of "
               "u-w-p and u-p does not know that bodies are impermeable).");
}

}  // namespace

Bounds damping_bounds() {
  return {.lower = 0.0,
          .upper = 1.0,
          .upper_included = false,
          .reason = "a coefficient from 0 to below 1"};
}
Bounds mass_scaling_bounds() {
  return {.lower = 1.0, .reason = "a factor of at least 1 on the inertia of the soil"};
}

TimeMethod read_time_method(Section& section, std::optional<TimeMethod> fallback) {
  return section.choice<TimeMethod>(
      "method",
      {{"explicit", TimeMethod::explicit_steps}, {"implicit", TimeMethod::implicit_steps}},
      fallback);
}

RestCriterion read_rest(Section& parent, double longest) {
  Section section = parent.table("stop_when_static", Record::Form::inline_table);
  RestCriterion rest;
  read_tolerances(section, rest);
  rest.after = section.number(
      "after", quantity::time,
      {.lower = 0.0, .upper = longest, .reason = "a time within the run, when all loads are on"},
      rest.after);
  section.finish();
  return rest;
}

void read_solvers(Section& root, CaseOptions& options, std::optional<double> courant) {
  Report& report = root.reading().report;
  if (options.soil) {
    read_soil_solver(root, *options.soil, options.flow.has_value(), courant);
    check_method(root, *options.soil, options.flow.has_value());
  } else if (root.has("soil_solver"))
    report.add(root.place("soil_solver"), "[soil_solver] is not used: the case has no [[soil]]");
  if (options.flow)
    read_flow_solver(root, *options.flow, courant);
  else if (root.has("flow_solver"))
    report.add(root.place("flow_solver"),
               "[flow_solver] is not used: the case has no [[water.body]]");
}

void read_coupling(Section& root, CaseOptions& options) {
  if (!root.has("coupling") && !(options.flow && options.soil)) return;
  Section section = root.table("coupling", Record::Form::block);
  CouplingOptions& coupling = options.coupling;
  coupling.mode = section.choice<CouplingMode>("mode",
                                               {{"none", CouplingMode::none},
                                                {"surface", CouplingMode::surface},
                                                {"unified", CouplingMode::unified}},
                                               coupling.mode);
  if (coupling.mode != CouplingMode::none && !(options.flow && options.soil))
    section.fail("mode", fmt::format("it joins flowing water and soil, and the case has no {}",
                                     options.soil ? "[[water.body]]" : "[[soil]]"));
  if (coupling.mode == CouplingMode::unified) {
    for (const char* key : {"mudline", "pressure_in_time", "ramp", "added_mass_factor"})
      section.forbid(key, "it is for mode = \"surface\": with one water nothing is handed over");
    coupling.grain_share = section.choice<GrainShare>(
        "grain_share", {{"points", GrainShare::points}, {"cells", GrainShare::cells}},
        coupling.grain_share);
    return section.finish();
  }
  section.forbid("grain_share",
                 "it is for mode = \"unified\", where one pressure moves grains and water");
  coupling.mudline = section.choice<Mudline>("mudline",
                                             {{"consistent", Mudline::consistent},
                                              {"load-only", Mudline::load_only},
                                              {"membrane", Mudline::membrane}},
                                             coupling.mudline);
  coupling.pressure_in_time = section.choice<PressureInTime>(
      "pressure_in_time",
      {{"linear", PressureInTime::linear}, {"constant", PressureInTime::constant}},
      coupling.pressure_in_time);
  coupling.ramp = section.number("ramp", quantity::time, not_negative("a time; 0 loads at once"),
                                 coupling.ramp);
  coupling.added_mass_factor = section.number(
      "added_mass_factor", quantity::number,
      not_negative("1 relaxes as the water over the soil asks for, 0 couples loosely"),
      coupling.added_mass_factor);
  section.finish();
}

void read_loads(Section& root, CaseOptions& options) {
  std::vector<Section> sections = root.tables("load");
  if (!sections.empty() && !options.soil)
    return root.reading().report.add(root.place("load"),
                                     "[[load]] presses on soil, but there is no [[soil]]");
  std::vector<std::string> names;
  for (Section& section : sections) {
    SurfaceLoad load;
    load.name = read_name(section, names);
    load.pressure = section.varying("pressure", quantity::pressure, {});
    load.on = section.choice<LoadedPhase>(
        "on", {{"skeleton", LoadedPhase::skeleton}, {"water", LoadedPhase::water}}, load.on);
    section.finish();
    options.soil->loads.push_back(std::move(load));
  }
}

}  // namespace mudlark

/// [[stage]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/sections.hpp"
#include "input/unified.hpp"

namespace mudlark {
namespace {

/// Names of the loads that act: ["footing", ...]. Nothing after a mistake.
std::optional<std::vector<std::string>> read_load_names(Section& section) {
  const Value* value = section.raw("loads");
  const auto* list = std::get_if<List>(&value->data);
  std::vector<std::string> names;
  std::string text;
  bool good = list != nullptr;
  for (std::size_t i = 0; good && i < list->size(); ++i) {
    const auto* name = std::get_if<std::string>(&(*list)[i].data);
    good = name != nullptr;
    if (!good) break;
    names.push_back(*name);
    text += (i > 0 ? ", " : "") + toml_text(*name);
  }
  if (!good) {
    section.fail("loads", "a list of names of [[load]] is expected",
                 "For example [\"footing\"]; [] for none.");
    return {};
  }
  section.record().value("loads", "[" + text + "]");
  return names;
}

/// What of it must not stand beside implicit steps or flowing water.
void check_method(Stage& stage, const SoilOptions& soil, bool water_flows) {
  Section& section = stage.section;
  SoilStage& own = stage.soil;
  const bool implicit = own.method.value_or(soil.method) == TimeMethod::implicit_steps;
  if (implicit) {
    for (const std::string_view key :
         {"damping", "water_damping", "mass_scaling", "stop_when_static"})
      section.forbid(key, "implicit steps have no inertia: they are at rest after each step");
    if (water_flows)
      section.fail("method", "it has no inertia and cannot follow flowing water ([[water.body]])");
    if (soil.formulation != Formulation::u_w)
      section.fail("method", "implicit steps find pore pressure in their own way",
                   "Leave formulation out of [[soil]].");
    if (soil.load_form == LoadForm::facets)
      section.fail("method", "implicit steps load the soil by a virtual stress",
                   "Leave soil_solver.load_form out.");
  }
  if (own.mass_scaling && !soil.solids.empty())
    section.fail("mass_scaling", "a [[solid]] has the same inertia throughout",
                 "Write mass_scaling under [soil_solver].");
  if (!water_flows) return;
  if (own.mass_scaling.value_or(1.0) > 1.0 && !is_unified(soil))
    section.fail("mass_scaling", "water that flows would meet a soil of false inertia");
  if (own.stop_when_static && !is_unified(soil))
    section.fail("stop_when_static",
                 "it watches the soil only, and the case has flowing water ([[water.body]])",
                 "With pore_water = \"unified\" it watches both.");
  if (own.remove)
    section.fail("remove",
                 "flowing water would find a hole without water: [[water.body]] "
                 "excludes it");
}

/// Which of the case's loads act.
void find_loads(Stage& stage, const SoilOptions& soil) {
  if (!stage.load_names) return;
  std::vector<bool> acting(soil.loads.size(), false);
  for (const std::string& name : *stage.load_names) {
    const auto found = std::find_if(soil.loads.begin(), soil.loads.end(),
                                    [&](const SurfaceLoad& load) { return load.name == name; });
    if (found != soil.loads.end())
      acting[static_cast<std::size_t>(found - soil.loads.begin())] = true;
    else
      stage.section.fail("loads", fmt::format("there is no [[load]] named {}", toml_text(name)),
                         "Write the name of a load, or leave the key out for all.");
  }
  stage.soil.loads = std::move(acting);
}

void read_settings(Stage& stage, double began, double end) {
  Section& section = stage.section;
  SoilStage& own = stage.soil;
  own.damping = section.number_if_set("damping", quantity::number, damping_bounds());
  own.water_damping = section.number_if_set("water_damping", quantity::number, damping_bounds());
  own.mass_scaling = section.number_if_set("mass_scaling", quantity::number, mass_scaling_bounds());
  if (section.has("method")) own.method = read_time_method(section, {});
  if (section.has("stop_when_static")) own.stop_when_static = read_rest(section, end - began);
  if (section.has("loads")) stage.load_names = read_load_names(section);
}

/// What the stage does not say itself, for the reader of the resolved case.
void remark_inherited(Stage& stage, const SoilOptions& soil) {
  Record& record = stage.section.record();
  const SoilStage& own = stage.soil;
  const bool steps_implicitly = own.method.value_or(soil.method) == TimeMethod::implicit_steps;
  if (!own.method)
    record.remark(fmt::format("method = \"{}\", that of [soil_solver]",
                              steps_implicitly ? "implicit" : "explicit"));
  const auto inherit = [&](std::string_view key, bool given, double value) {
    if (!given && !steps_implicitly)
      record.remark(fmt::format("{} = {}, that of [soil_solver]", key, toml_number(value)));
  };
  inherit("damping", own.damping.has_value(), soil.damping);
  if (!own.damping && !is_unified(soil))  // whose water is the flow's; with damping it is that
    inherit("water_damping", own.water_damping.has_value(),
            soil.water_damping.value_or(soil.damping));
  inherit("mass_scaling", own.mass_scaling.has_value(), soil.mass_scaling);
  if (!own.loads) record.remark("loads: all");
}

}  // namespace

std::vector<Stage> read_stages(Section& root, CaseOptions& options) {
  std::vector<Stage> stages;
  std::vector<std::string> names;
  double began = 0.0;
  for (Section& section : root.tables("stage")) {
    const bool first = stages.empty();
    Stage& stage = stages.emplace_back(Stage{section, {}, {}});
    stage.soil.name = read_name(stage.section, names);
    const double end = stage.section.number(
        "end", quantity::time,
        {.lower = began,
         .lower_included = false,
         .reason = first ? "a stage ends after the start at 0"
                         : fmt::format("a stage ends after the one before it, at {:g} s", began),
         .cure = "Times count from the start of the run."});
    read_settings(stage, began, end);
    if (!std::isnan(end)) began = end;
    options.time.stage_ends.push_back(end);
    for (const std::string_view key : {"remove", "reset_displacements"})
      if (first && stage.section.has(key))
        stage.section.fail(key, "it is for stages that follow another one",
                           "Write it in a later [[stage]].");
    if (stage.section.has("remove"))
      stage.soil.remove = read_shape(stage.section, "remove", Reach::anywhere);
    if (!first) stage.soil.reset_displacements = stage.section.flag("reset_displacements", false);
    stage.section.finish();
  }
  return stages;
}

void finish_stages(std::vector<Stage>& stages, CaseOptions& options) {
  if (stages.empty()) return;
  if (!options.soil) {
    stages.front().section.reading().report.add(
        stages.front().section.place("name"),
        "[[stage]] changes what happens to soil, and the case has no [[soil]]");
    return;
  }
  SoilOptions& soil = *options.soil;
  for (Stage& stage : stages) {
    find_loads(stage, soil);
    check_method(stage, soil, options.flow.has_value());
    remark_inherited(stage, soil);
    soil.stages.push_back(stage.soil);
  }
  if (soil.start_in_equilibrium && soil.stages.front().method.value_or(soil.method) != soil.method)
    stages.front().section.fail(
        "method", "soil_solver.start_in_equilibrium takes the steps of soil_solver.method",
        "Write the method of the first stage there, and that of later stages with them.");
}

std::size_t read_stage_of_soil(Section& soil, const std::vector<Stage>& stages) {
  if (!soil.has("stage")) return 0;
  const std::string name = soil.text("stage");
  for (std::size_t i = 0; i < stages.size(); ++i)
    if (stages[i].soil.name == name) return i;
  std::string known;
  for (const Stage& stage : stages) known += (known.empty() ? "" : ", ") + stage.soil.name;
  soil.fail("stage",
            stages.empty() ? "the case has no [[stage]]"
                           : fmt::format("there is no such stage; there are: {}", known),
            "The body is placed when that stage begins.");
  return 0;
}

}  // namespace mudlark

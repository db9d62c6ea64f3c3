/// [[porous]]: fixed porous ground for the flow
#include <fmt/format.h>

#include "input/sections.hpp"

namespace mudlark {
namespace {

/// Standard weight of water that hydraulic conductivities refer to, whatever the case's gravity
/// [m/s2].
constexpr double conductivity_gravity = 9.81;

void read_grain_laws(Section& drag, PorousGround& ground) {
  ground.grain_size =
      drag.number("grain_size", quantity::length, positive("a grain has a size above 0"));
  if (ground.drag != DragLaw::van_gent) return;
  ground.alpha =
      drag.number("alpha", quantity::number, not_negative("a coefficient of drag"), ground.alpha);
  ground.beta =
      drag.number("beta", quantity::number, not_negative("a coefficient of drag"), ground.beta);
  ground.keulegan_carpenter = drag.number(
      "keulegan_carpenter", quantity::number,
      not_negative("a Keulegan-Carpenter number; 0 for steady flow"), ground.keulegan_carpenter);
}

void read_cadmas(Section& drag, PorousGround& ground) {
  ground.drag_coefficient =
      drag.number("drag_coefficient", quantity::number,
                  not_negative("C_D, a coefficient of drag", "C_D = 1 to 3 is usual."));
  ground.drag_length = drag.number(
      "drag_length", quantity::length,
      positive("the length that C_D refers to lies above 0",
               "In CADMAS-SURF it is the cell size; rubble has about its stones' size."));
}

/// C_A of the added mass: van Gent's law brings its own, CADMAS-SURF's C_M belongs to its C_D.
void read_inertia(Section& drag, PorousGround& ground) {
  std::optional<double> usual = 0.0;
  if (ground.drag == DragLaw::van_gent) usual = 0.34;
  if (ground.drag == DragLaw::cadmas) usual.reset();
  ground.inertia_coefficient =
      drag.number("inertia_coefficient", quantity::number,
                  not_negative("C_A of the added mass C_A rho (1 - n); 0: none",
                               "0.34 is van Gent's, C_M = 0.5 to 1.2 is usual in CADMAS-SURF."),
                  usual);
}

void read_drag(Section& porous, PorousGround& ground, const FlowOptions& flow) {
  Section drag = porous.table("drag", Record::Form::block, true);
  if (!porous.has("drag")) return;
  ground.drag = drag.choice<DragLaw>("type", {{"darcy", DragLaw::darcy},
                                              {"darcy-forchheimer", DragLaw::darcy_forchheimer},
                                              {"ergun", DragLaw::ergun},
                                              {"van-gent", DragLaw::van_gent},
                                              {"cadmas", DragLaw::cadmas}});
  const bool cadmas = ground.drag == DragLaw::cadmas;
  const bool by_grains = ground.drag == DragLaw::ergun || ground.drag == DragLaw::van_gent;
  if (by_grains)
    read_grain_laws(drag, ground);
  else if (cadmas)
    read_cadmas(drag, ground);
  else
    ground.intrinsic_permeability =
        read_permeability(drag, flow.density, flow.viscosity, true).value_or(0.0);
  if (ground.drag == DragLaw::darcy_forchheimer)
    ground.forchheimer =
        drag.number("forchheimer", quantity::forchheimer, not_negative("a drag cannot push"));
  for (const char* key : {"hydraulic_conductivity", "intrinsic_permeability"})
    if (by_grains || cadmas)
      drag.forbid(key, cadmas ? "this type of drag follows from drag_coefficient"
                              : "this type of drag follows from the grain size");
  for (const char* key : {"grain_size", "alpha", "beta", "keulegan_carpenter"})
    if (!by_grains)
      drag.forbid(key, cadmas ? "this type of drag follows from drag_coefficient"
                              : "this type of drag follows from the permeability");
  for (const char* key : {"drag_coefficient", "drag_length"})
    if (!cadmas) drag.forbid(key, "it belongs to type = \"cadmas\"");
  if (ground.drag == DragLaw::ergun)
    for (const char* key : {"alpha", "beta", "keulegan_carpenter"})
      drag.forbid(key, "it belongs to type = \"van-gent\"");
  if (ground.drag != DragLaw::darcy_forchheimer)
    drag.forbid("forchheimer", "it belongs to type = \"darcy-forchheimer\"");
  read_inertia(drag, ground);
  drag.finish();
}

}  // namespace

std::optional<double> read_permeability(Section& section, double density, double viscosity,
                                        bool required) {
  const bool by_conductivity = section.has("hydraulic_conductivity");
  const bool by_permeability = section.has("intrinsic_permeability");
  const std::string cure = "Write one of the two.";
  if (by_conductivity && by_permeability) {
    section.fail("intrinsic_permeability", "hydraulic_conductivity is given too", cure);
    return {};
  }
  if (!by_permeability && !by_conductivity) {
    if (required)
      section.missing("hydraulic_conductivity",
                      "the drag of the water needs it, or intrinsic_permeability");
    return {};
  }
  const double weight_per_viscosity = density * conductivity_gravity / viscosity;
  const double permeability =
      by_permeability
          ? section.number_unrecorded(
                "intrinsic_permeability", quantity::permeability,
                positive("a permeability lies above 0", "Sand has about 1e-12 to 1e-9 m2."))
          : section.number_unrecorded(
                "hydraulic_conductivity", quantity::velocity,
                positive("a conductivity lies above 0", "Sand has about 1e-5 to 1e-2 m/s.")) /
                weight_per_viscosity;
  section.record().remark(
      fmt::format("hydraulic_conductivity = {:.6g} m/s", permeability * weight_per_viscosity));
  section.record().value("intrinsic_permeability", toml_number(permeability),
                         quantity::permeability.unit);
  return permeability;
}

void read_porous(Section& root, CaseOptions& options, std::vector<NamedShape>& grounds) {
  std::vector<std::string> names;
  if (root.has("porous") && !options.flow)
    return root.reading().report.add(
        root.place("porous"),
        "[[porous]] is ground for flowing water, but there is no [[water.body]]");
  for (Section& section : root.tables("porous")) {
    PorousGround ground;
    ground.name = read_name(section, names);
    const auto shape = read_shape(section, "shape", Reach::anywhere);
    ground.porosity =
        section.number("porosity", quantity::number,
                       {.lower = 0.0,
                        .upper = 1.0,
                        .lower_included = false,
                        .reason = "the share of pores in the volume lies between 0 and 1",
                        .cure = "Rubble has about 0.4."});
    read_drag(section, ground, *options.flow);
    ground.filling = read_pore_filling(section, ground.filling, !options.flow->gas);
    if (section.has("relative_permeability") && options.flow->gas)
      section.fail("relative_permeability",
                   "with gas beside the water both fill the pores, and both resist alike",
                   "Leave out air = \"gas\" under [water], or this key.");
    if (ground.filling.suction > 0.0 && options.flow->gas)
      section.fail("suction", "water that gas surrounds has no surface of its own to hold it",
                   "Leave out air = \"gas\" under [water], or the suction.");
    if (ground.filling.at_start > 0.0 && options.flow->gas)
      section.fail("initial_saturation", "water that gas surrounds is placed by [[water.body]]",
                   "Leave out air = \"gas\" under [water], or this key.");
    section.finish();
    if (!shape) continue;
    ground.shape = *shape;
    grounds.push_back(
        {fmt::format("porous ground \"{}\"", ground.name), *shape, section.place("shape")});
    options.flow->porous.push_back(std::move(ground));
  }
}

}  // namespace mudlark

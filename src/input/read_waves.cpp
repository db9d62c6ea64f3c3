/// [[wave]]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "flow/sea_components.hpp"
#include "input/sections.hpp"

namespace mudlark {
namespace {

enum class Kind { regular, solitary, irregular, focused, given, still, sponge };

RegularWave read_regular(Section& section) {
  RegularWave wave;
  wave.height = section.number("height", quantity::length,
                               positive("a wave has a height above 0, from trough to crest"));
  wave.period = section.number("period", quantity::time, positive("a wave has a period above 0"));
  wave.theory = section.choice<RegularTheory>("theory",
                                              {{"stream-function", RegularTheory::stream_function},
                                               {"stokes-5", RegularTheory::stokes_5},
                                               {"cnoidal", RegularTheory::cnoidal},
                                               {"linear", RegularTheory::linear}},
                                              wave.theory);
  return wave;
}

SolitaryWave read_solitary(Section& section) {
  SolitaryWave wave;
  wave.height =
      section.number("height", quantity::length, positive("a solitary wave rises above 0"));
  wave.crest = section.number("crest", quantity::length, {}, 0.0);
  return wave;
}

IrregularSea read_irregular(Section& section) {
  IrregularSea wave;
  wave.sea = read_sea(section, true);
  const bool given = wave.sea.spectrum.form == SpectrumForm::given;
  const bool readable = given && !wave.sea.spectrum.table.empty();
  wave.significant_height =
      section.number("significant_height", quantity::length, positive("H_m0 lies above 0"),
                     readable ? std::optional<double>(significant_height(wave.sea.spectrum))
                     : given  ? std::optional<double>(1.0)
                              : std::nullopt);
  return wave;
}

/// focus in coordinates of the case; the zone is known.
FocusedWave read_focused(Section& section, const WaveZoneOptions& zone) {
  FocusedWave wave;
  wave.sea = read_sea(section, false);
  wave.crest_height =
      section.number("crest_height", quantity::length, positive("the crest rises above 0"));
  wave.time = section.number("focus_time", quantity::time, {});
  const bool space = section.reading().dimension == 3;
  const std::vector<double> focus =
      space ? section.numbers("focus", quantity::length, 2)
            : std::vector<double>{section.number("focus", quantity::length, {})};
  if (focus.size() != (space ? 2u : 1u)) return wave;
  const auto axis = static_cast<std::size_t>(zone.axis);
  const double inwards = zone.inner > zone.outer ? 1.0 : -1.0;
  wave.focus = {inwards * (focus[space ? axis : 0] - zone.outer), space ? focus[1 - axis] : 0.0};
  return wave;
}

GivenWave read_given(Section& section) {
  GivenWave wave;
  if (!section.has("level"))
    section.missing("level", "the level above still water over time is needed");
  wave.level = section.varying("level", quantity::length, {}, 0.0);
  wave.has_velocity = section.has("velocity");
  if (wave.has_velocity) wave.velocity = section.varying("velocity", quantity::velocity, {});
  return wave;
}

/// zone = { outer = .., inner = .., axis = "x" }
void read_zone(Section& wave, WaveZoneOptions& zone) {
  Section section = wave.table("zone", Record::Form::inline_table, true);
  if (!wave.has("zone")) return;
  zone.outer = section.number("outer", quantity::length, {});
  zone.inner = section.number("inner", quantity::length, {});
  if (wave.reading().dimension == 3)
    zone.axis = section.choice<int>("axis", {{"x", 0}, {"y", 1}}, 0);
  if (zone.outer == zone.inner)
    section.fail("inner", "the zone has no length: outer and inner are equal",
                 "Make it at least one wave long.");
  section.finish();
}

/// side = "lower_x" in place of a zone: the wave comes in there, and what comes to it may leave.
std::optional<FlowSideOptions> read_wave_side(Section& wave, const DomainOptions& domain,
                                              WaveZoneOptions& zone) {
  if (!wave.has("side")) {
    if (!wave.has("zone")) {
      wave.missing("zone", "write side = \"lower_x\", or zone = { outer = .., inner = .. }");
      return {};
    }
    read_zone(wave, zone);
    const auto axis = static_cast<std::size_t>(zone.axis);
    if (std::max(zone.outer, zone.inner) <= domain.lower[axis] ||
        std::min(zone.outer, zone.inner) >= domain.upper[axis])
      wave.fail("zone", fmt::format("it lies beside the domain, which reaches from {:g} to {:g} m",
                                    domain.lower[axis], domain.upper[axis]));
    return {};
  }
  wave.forbid("zone", "a wave is made at a side or in a zone");
  const SidePart part = read_side(wave, domain.dimension);
  FlowSideOptions side;
  side.name = zone.name;
  side.flow = SideFlow::wave;
  side.axis = zone.axis = part.axis;
  side.side = part.side;
  const auto axis = static_cast<std::size_t>(part.axis);
  if (part.axis == domain.dimension - 1) wave.fail("side", "waves come in through a vertical side");
  zone.outer = part.side == 0 ? domain.lower[axis] : domain.upper[axis];
  zone.inner = part.side == 0 ? domain.upper[axis] : domain.lower[axis];
  return side;
}

WaveKind read_kind(Section& section, WaveZoneOptions& zone) {
  switch (section.choice<Kind>("type", {{"regular", Kind::regular},
                                        {"solitary", Kind::solitary},
                                        {"irregular", Kind::irregular},
                                        {"focused", Kind::focused},
                                        {"given", Kind::given},
                                        {"still", Kind::still},
                                        {"sponge", Kind::sponge}})) {
    case Kind::regular:
      return read_regular(section);
    case Kind::solitary:
      return read_solitary(section);
    case Kind::irregular:
      return read_irregular(section);
    case Kind::focused:
      return read_focused(section, zone);
    case Kind::given:
      return read_given(section);
    case Kind::still:
      break;
    case Kind::sponge:
      zone.action = ZoneAction::velocity;
      zone.damping = section.number("damping", quantity::rate,
                                    positive("the rate at which motion fades at the outer end",
                                             "Some five times the wave's frequency 2 pi/T."));
  }
  return StillWater{};
}

/// Where waves come from and what carries them.
void read_setting(Section& section, WaveZoneOptions& zone) {
  const bool made = !std::holds_alternative<StillWater>(zone.wave);
  if (section.reading().dimension == 3 && made) {
    const double degrees =
        section.number("direction", quantity::angle,
                       {.lower = -80.0,
                        .upper = 80.0,
                        .reason = "the angle to the zone's axis, towards the other horizontal axis",
                        .cure = "Turn the zone (axis = ...) for waves along it."},
                       0.0);
    zone.direction = degrees * std::numbers::pi / 180.0;
  } else {
    section.forbid("direction", made ? "in the plane waves go along x" : "no wave is made here");
  }
  if (std::holds_alternative<GivenWave>(zone.wave))
    section.forbid("current", "it is part of the given velocity");
  else
    zone.current = section.number("current", quantity::velocity, {}, 0.0);
}

void check_wave(Section& section, const WaveZoneOptions& zone, double gravity, std::size_t before) {
  if (section.reading().report.size() != before || gravity <= 0.0) return;
  try {
    const auto motion = make_wave(zone, gravity);
    const bool periodic = std::holds_alternative<RegularWave>(zone.wave) ||
                          std::holds_alternative<IrregularSea>(zone.wave) ||
                          std::holds_alternative<FocusedWave>(zone.wave);
    const double length = std::abs(zone.inner - zone.outer);
    if (periodic && section.has("zone") && length < 0.5 * motion->length())
      section.fail("zone",
                   fmt::format("it is {:.4g} m long, less than half of the wave of {:.4g} m",
                               length, motion->length()),
                   "Make it one wave long.");
  } catch (const InputError& error) {
    section.fail(section.has("height") ? "height" : "type", error.what());
  }
}

}  // namespace

void read_waves(Section& root, CaseOptions& options) {
  std::vector<Section> sections = root.tables("wave");
  if (sections.empty()) return;
  if (!options.flow)
    return root.reading().report.add(root.place("wave"),
                                     "[[wave]] moves water, but there is no [[water.body]]");
  const auto up = static_cast<std::size_t>(options.domain.dimension - 1);
  const double gravity = -options.domain.gravity[up];
  std::vector<std::string> names;
  for (Section& section : sections) {
    const std::size_t before = section.reading().report.size();
    WaveZoneOptions zone;
    zone.name = read_name(section, names);
    auto side = read_wave_side(section, options.domain, zone);
    zone.wave = read_kind(section, zone);
    if (side && zone.action == ZoneAction::velocity)
      section.fail("type", "a sponge is a zone", "Write zone = { outer = .., inner = .. }.");
    zone.still_level = section.number("still_level", quantity::length, {});
    const double bottom = options.domain.lower[up], top = options.domain.upper[up];
    if (zone.still_level <= bottom || zone.still_level >= top)
      section.fail("still_level",
                   fmt::format("the domain reaches from {:g} to {:g} m", bottom, top),
                   "It is the height of still water, on the vertical axis.");
    zone.depth = section.number("depth", quantity::length,
                                positive("waves need water; the depth lies above 0"),
                                zone.still_level - bottom);
    zone.ramp = section.number("ramp", quantity::time,
                               not_negative("the time over which the wave grows; 0: at once"), 0.0);
    read_setting(section, zone);
    if (gravity <= 0.0) section.fail("type", "waves need gravity, and it does not point down here");
    check_wave(section, zone, gravity, before);
    section.finish();
    if (!side) {
      options.flow->waves.push_back(std::move(zone));
      continue;
    }
    side->wave = std::move(zone);
    if (section.reading().report.size() == before) add_flow_side(section, options, *side);
  }
}

}  // namespace mudlark

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

RegularWave read_regular(Section& section, bool first_order) {
  RegularWave wave;
  if (first_order) wave.theory = RegularTheory::linear;
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

WaveKind read_kind(Section& section, WaveZoneOptions& zone, bool first_order) {
  switch (section.choice<Kind>("type", {{"regular", Kind::regular},
                                        {"solitary", Kind::solitary},
                                        {"irregular", Kind::irregular},
                                        {"focused", Kind::focused},
                                        {"given", Kind::given},
                                        {"still", Kind::still},
                                        {"sponge", Kind::sponge}})) {
    case Kind::regular:
      return read_regular(section, first_order);
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

/// Where waves come from and what carries them; `along`: made by a paddle or a source, which knows
/// neither.
void read_setting(Section& section, WaveZoneOptions& zone, bool along) {
  if (along) {
    for (const char* key : {"direction", "current"})
      section.forbid(key, "a paddle or a source makes waves along its axis in water at rest");
    return;
  }
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

/// McCowan (1894): no wave is higher than this share of the depth. Miche (1944): nor than this
/// share of its length times tanh k d.
constexpr double highest_of_depth = 0.78, highest_of_length = 0.142;

/// Height of the wave and the key that says it; for a sea that of its significant wave. Nothing for
/// still water and for levels that are given.
std::pair<const char*, double> height_of(const WaveKind& kind) {
  if (const auto* wave = std::get_if<RegularWave>(&kind)) return {"height", wave->height};
  if (const auto* wave = std::get_if<SolitaryWave>(&kind)) return {"height", wave->height};
  if (const auto* wave = std::get_if<IrregularSea>(&kind))
    return {"significant_height", wave->significant_height};
  if (const auto* wave = std::get_if<FocusedWave>(&kind))
    return {"crest_height", wave->crest_height};
  return {"", 0.0};
}

/// A wave that would break where it is made. Motions are computed for others without complaint.
void check_height(Section& section, const WaveZoneOptions& zone, const WaveMotion& motion) {
  const auto [key, height] = height_of(zone.wave);
  double highest = highest_of_depth * zone.depth;
  if (std::holds_alternative<RegularWave>(zone.wave)) {
    const double length = motion.length();
    highest = std::min(highest, highest_of_length * length *
                                    std::tanh(2.0 * std::numbers::pi * zone.depth / length));
  }
  if (height > highest)
    section.fail(key,
                 fmt::format("such a wave breaks at once: on {:g} m of water {:.3g} m are the most",
                             zone.depth, highest),
                 section.has("depth") ? "Write a lower wave."
                                      : "Write a lower wave, or the `depth` of the water.");
}

/// Still water under the wave, and how the wave grows.
void read_water_depth(Section& section, const DomainOptions& domain, WaveZoneOptions& zone) {
  const auto up = static_cast<std::size_t>(domain.dimension - 1);
  const double bottom = domain.lower[up], top = domain.upper[up];
  zone.still_level = section.number("still_level", quantity::length, {});
  if (zone.still_level <= bottom || zone.still_level >= top)
    section.fail("still_level", fmt::format("the domain reaches from {:g} to {:g} m", bottom, top),
                 "It is the height of still water, on the vertical axis.");
  zone.depth = section.number("depth", quantity::length,
                              positive("waves need water; the depth lies above 0"),
                              zone.still_level - bottom);
  zone.ramp = section.number("ramp", quantity::time,
                             not_negative("the time over which the wave grows; 0: at once"), 0.0);
}

void check_wave(Section& section, const WaveZoneOptions& zone, double gravity, std::size_t before) {
  if (section.reading().report.size() != before || gravity <= 0.0) return;
  try {
    const auto motion = make_wave(zone, gravity);
    check_height(section, zone, *motion);
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
    const std::string name = read_name(section, names);
    WaveMaker maker = read_wave_maker(section, options.domain);
    WaveZoneOptions& zone = maker.zone;
    zone.name = name;
    if (maker.side) maker.side->name = name;
    const bool along = maker.paddle || maker.source;
    zone.wave = read_kind(section, zone, maker.paddle.has_value());
    if (!section.has("zone") && zone.action == ZoneAction::velocity)
      section.fail("type", "a sponge is a zone", "Write zone = { outer = .., inner = .. }.");
    read_water_depth(section, options.domain, zone);
    read_setting(section, zone, along);
    if (gravity <= 0.0) section.fail("type", "waves need gravity, and it does not point down here");
    check_wave(section, zone, gravity, before);
    section.finish();
    if (section.reading().report.size() == before) add_wave(section, options, std::move(maker));
  }
}

}  // namespace mudlark

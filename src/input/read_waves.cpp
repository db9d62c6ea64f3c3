/// [[wave]]
#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"
#include "input/sections.hpp"

namespace mudlark {
namespace {

enum class Kind { regular, solitary, irregular, given, still };

RegularWave read_regular(Section& section) {
  RegularWave wave;
  wave.height = section.number("height", quantity::length,
                               positive("a wave has a height above 0, from trough to crest"));
  wave.period = section.number("period", quantity::time, positive("a wave has a period above 0"));
  wave.stream_function =
      section.choice<bool>("theory", {{"stream-function", true}, {"linear", false}}, true);
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
  IrregularSea sea;
  sea.significant_height =
      section.number("significant_height", quantity::length, positive("H_m0 lies above 0"));
  sea.peak_period =
      section.number("peak_period", quantity::time, positive("a period lies above 0"));
  sea.peak_enhancement = section.number(
      "peak_enhancement", quantity::number,
      {.lower = 1.0, .upper = 10.0, .reason = "gamma of JONSWAP; 1 is Pierson-Moskowitz"},
      sea.peak_enhancement);
  sea.components = section.integer(
      "components", {.lower = 1.0, .upper = 5000.0, .reason = "the number of linear waves"},
      sea.components);
  sea.seed = static_cast<std::uint64_t>(section.integer(
      "seed", {.lower = 0.0, .upper = 2e9, .reason = "the same seed gives the same sea"}, 1));
  return sea;
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

WaveKind read_kind(Section& section) {
  switch (section.choice<Kind>("type", {{"regular", Kind::regular},
                                        {"solitary", Kind::solitary},
                                        {"irregular", Kind::irregular},
                                        {"given", Kind::given},
                                        {"still", Kind::still}})) {
    case Kind::regular:
      return read_regular(section);
    case Kind::solitary:
      return read_solitary(section);
    case Kind::irregular:
      return read_irregular(section);
    case Kind::given:
      return read_given(section);
    case Kind::still:
      break;
  }
  return StillWater{};
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

void check_wave(Section& section, const WaveZoneOptions& zone, double gravity, std::size_t before) {
  if (section.reading().report.size() != before || gravity <= 0.0) return;
  try {
    const WaveMotion motion = make_wave(zone.wave, zone.depth, gravity);
    const auto* regular = std::get_if<RegularWave>(&zone.wave);
    if (regular && std::abs(zone.inner - zone.outer) < 0.5 * motion.length)
      section.fail("zone",
                   fmt::format("it is {:.4g} m long, less than half of the wave of {:.4g} m",
                               std::abs(zone.inner - zone.outer), motion.length),
                   "Make it one wave long.");
  } catch (const InputError& error) {
    section.fail("height", error.what());
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
    zone.wave = read_kind(section);
    read_zone(section, zone);
    zone.still_level = section.number("still_level", quantity::length, {});
    zone.depth = section.number("depth", quantity::length,
                                positive("waves need water; the depth lies above 0"),
                                zone.still_level - options.domain.lower[up]);
    zone.ramp = section.number("ramp", quantity::time,
                               not_negative("the time over which the wave grows"), 0.0);
    if (gravity <= 0.0) section.fail("type", "waves need gravity, and it does not point down here");
    check_wave(section, zone, gravity, before);
    section.finish();
    options.flow->waves.push_back(std::move(zone));
  }
}

}  // namespace mudlark

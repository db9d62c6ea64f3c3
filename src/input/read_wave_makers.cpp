/// Where a [[wave]] is made: at a side, in a zone, by a paddle or by a source in the water.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/sections.hpp"

namespace mudlark {
namespace {

/// zone = { outer = .., inner = .., axis = "x" }
void read_zone(Section& wave, const DomainOptions& domain, WaveZoneOptions& zone) {
  Section section = wave.table("zone", Record::Form::inline_table, true);
  zone.outer = section.number("outer", quantity::length, {});
  zone.inner = section.number("inner", quantity::length, {});
  if (wave.reading().dimension == 3)
    zone.axis = section.choice<int>("axis", {{"x", 0}, {"y", 1}}, 0);
  if (zone.outer == zone.inner)
    section.fail("inner", "the zone has no length: outer and inner are equal",
                 "Make it at least one wave long.");
  section.finish();
  const auto axis = static_cast<std::size_t>(zone.axis);
  if (std::max(zone.outer, zone.inner) <= domain.lower[axis] ||
      std::min(zone.outer, zone.inner) >= domain.upper[axis])
    wave.fail("zone", fmt::format("it lies beside the domain, which reaches from {:g} to {:g} m",
                                  domain.lower[axis], domain.upper[axis]));
}

/// From a side inwards; `outer` lies on it.
void set_way(const DomainOptions& domain, const SidePart& part, WaveZoneOptions& zone) {
  const auto axis = static_cast<std::size_t>(part.axis);
  zone.axis = part.axis;
  zone.outer = part.side == 0 ? domain.lower[axis] : domain.upper[axis];
  zone.inner = part.side == 0 ? domain.upper[axis] : domain.lower[axis];
}

/// side = "lower_x" in place of a zone: the wave comes in there, and what comes to it may leave.
void read_wave_side(Section& wave, const DomainOptions& domain, WaveMaker& maker) {
  const SidePart part = read_side(wave, domain.dimension);
  if (part.axis == domain.dimension - 1) wave.fail("side", "waves come in through a vertical side");
  set_way(domain, part, maker.zone);
  FlowSideOptions side;
  side.name = maker.zone.name;
  side.flow = SideFlow::wave;
  side.axis = part.axis;
  side.side = part.side;
  maker.side = side;
}

/// paddle = { side = "lower_x", front = 0.5 }: a board at that side that reaches to `front`.
void read_paddle(Section& wave, const DomainOptions& domain, WaveMaker& maker) {
  Section section = wave.table("paddle", Record::Form::inline_table, true);
  const std::size_t before = section.reading().report.size();
  const SidePart part = read_side(section, domain.dimension);
  const double front = section.number("front", quantity::length, {});
  section.finish();
  if (section.reading().report.size() != before) return;
  if (part.axis == domain.dimension - 1)
    return section.fail("side", "a paddle stands at a vertical side");
  set_way(domain, part, maker.zone);
  const double end = maker.zone.inner;
  if ((front - maker.zone.outer) * (front - end) >= 0.0)
    return section.fail(
        "front",
        fmt::format("the domain reaches from {:g} to {:g} m", std::min(maker.zone.outer, end),
                    std::max(maker.zone.outer, end)),
        "It is where the board's front stands at rest.");
  BoxShape board;
  for (std::size_t a = 0; a < 3; ++a) board.lower[a] = -1e6, board.upper[a] = 1e6;
  const auto axis = static_cast<std::size_t>(part.axis);
  (part.side == 0 ? board.upper : board.lower)[axis] = front;
  maker.backwards = std::abs(front - maker.zone.outer);
  maker.zone.outer = front;
  maker.paddle = board;
}

/// source = { lower = [..], upper = [..] }: a box under water.
void read_source(Section& wave, const DomainOptions& domain, WaveMaker& maker) {
  Section section = wave.table("source", Record::Form::inline_table, true);
  const auto axes = static_cast<std::size_t>(domain.dimension);
  const auto lower = section.numbers("lower", quantity::length, axes);
  const auto upper = section.numbers("upper", quantity::length, axes);
  int axis = 0;
  if (domain.dimension == 3) axis = section.choice<int>("axis", {{"x", 0}, {"y", 1}}, 0);
  section.finish();
  if (lower.size() != axes || upper.size() != axes) return;
  BoxShape box{point_from_axes(lower), point_from_axes(upper)};
  if (domain.dimension == 2) box.lower[1] = -1e6, box.upper[1] = 1e6;
  for (std::size_t a = 0; a < axes; ++a)
    if (!(upper[a] > lower[a]) || lower[a] >= domain.upper[a] || upper[a] <= domain.lower[a])
      return section.fail("upper",
                          "the upper corner must lie above the lower one along every axis, and a "
                          "part of the box in the domain");
  const auto along = static_cast<std::size_t>(axis);
  maker.zone.axis = axis;
  maker.zone.outer = 0.5 * (box.lower[along] + box.upper[along]);
  maker.zone.inner = domain.upper[along];
  maker.source = box;
}

/// Refuses what paddles and sources cannot make.
bool makes(Section& wave, const WaveMaker& maker) {
  const std::size_t before = wave.reading().report.size();
  const WaveKind& kind = maker.zone.wave;
  if (std::holds_alternative<StillWater>(kind))
    wave.fail("type", "a paddle or a source makes waves; it does not absorb them",
              "Write zone = { outer = .., inner = .. }.");
  const auto* regular = std::get_if<RegularWave>(&kind);
  if (maker.paddle && regular && regular->theory != RegularTheory::linear)
    wave.fail("theory", "the motion of a paddle follows from linear waves",
              "Write theory = \"linear\", or make the wave in a zone.");
  if (maker.paddle && std::holds_alternative<GivenWave>(kind))
    wave.fail("type", "a paddle does not follow from a level",
              "Give a [[solid]] its displacement: motion = { type = \"prescribed\", "
              "displacement = ... }.");
  const auto* sea = std::get_if<IrregularSea>(&kind);
  const auto* focused = std::get_if<FocusedWave>(&kind);
  if ((sea && sea->sea.spreading) || (focused && focused->sea.spreading))
    wave.fail("spreading", "crests from a paddle or a source are long");
  return wave.reading().report.size() == before;
}

/// The board as a body that moves as the wave asks for.
void add_paddle(Section& wave, CaseOptions& options, const WaveMaker& maker) {
  const WaveZoneOptions& zone = maker.zone;
  const auto up = static_cast<std::size_t>(options.domain.dimension - 1);
  const std::shared_ptr<const WaveMotion> motion = make_wave(zone, -options.domain.gravity[up]);
  const double sign = zone.inner > zone.outer ? 1.0 : -1.0, ramp = zone.ramp;
  const double start = ramp_share(ramp, 0.0) * motion->piston(0.0);
  const auto place = [motion, ramp, start](double time) {
    return ramp_share(ramp, time) * motion->piston(time) - start;
  };
  constexpr int samples = 4000;
  double farthest = 0.0;
  for (int i = 0; i <= samples; ++i)
    farthest = std::max(farthest, -place(options.time.end * i / samples));
  if (farthest > 0.9 * maker.backwards)
    return wave.fail("paddle",
                     fmt::format("the board draws back by {:.3g} m, and there are {:g} m behind it",
                                 farthest, maker.backwards),
                     "Place its front farther from the side.");
  FlowSolid board{zone.name, Shape{*maker.paddle}, Point3{}, {}, false};
  PrescribedSolid given;
  given.by_displacement = true;
  given.translation[static_cast<std::size_t>(zone.axis)] =
      Varying([place, sign](const Point3&, double time) { return sign * place(time); }, "paddle");
  board.motion = given;
  options.flow->solids.push_back(std::move(board));
}

/// What moving bodies and sources do not go with.
void check_surroundings(Section& wave, const CaseOptions& options, const WaveMaker& maker) {
  const FlowOptions& flow = *options.flow;
  const char* key = maker.paddle ? "paddle" : "source";
  if (flow.gas)
    wave.fail(key, "it makes waves under air of no mass; with air = \"gas\" it is not there yet",
              "Make the wave in a zone.");
  if (options.soil) wave.fail(key, "it does not go with soil yet", "Make the wave in a zone.");
  if (maker.source) {
    const double level = maker.zone.still_level;
    if (maker.source->upper[2] >= level)
      wave.fail("source",
                fmt::format("its box must stay under water, whose level is {:g} m", level),
                "Lower its upper corner, a wave height below the level at least.");
  }
  if (!maker.paddle) return;
  if (!flow.porous.empty())
    wave.fail(key, "a body that moves in a case with [[porous]] ground is not there yet",
              "Make the wave in a zone or by a source.");
  if (flow.turbulence.model != TurbulenceModel::none)
    wave.fail(key, "a body does not go with [water.turbulence] yet", "Make the wave in a zone.");
  for (const FlowSolid& other : flow.solids)
    if (other.name == maker.zone.name)
      wave.fail("name", fmt::format("a [[solid]] is called \"{}\" too", other.name));
}

}  // namespace

WaveMaker read_wave_maker(Section& wave, const DomainOptions& domain) {
  WaveMaker maker;
  const std::array<const char*, 4> ways{"side", "zone", "paddle", "source"};
  const char* chosen = nullptr;
  for (const char* way : ways) {
    if (!wave.has(way)) continue;
    if (chosen)
      wave.forbid(way, fmt::format("the wave has its `{}` already", chosen));
    else
      chosen = way;
  }
  const std::string_view way = chosen ? chosen : "";
  if (way == "side")
    read_wave_side(wave, domain, maker);
  else if (way == "zone")
    read_zone(wave, domain, maker.zone);
  else if (way == "paddle")
    read_paddle(wave, domain, maker);
  else if (way == "source")
    read_source(wave, domain, maker);
  else
    wave.missing("zone",
                 "write side = \"lower_x\", zone = { outer = .., inner = .. }, paddle = { side = "
                 "\"lower_x\", front = .. } or source = { lower = [..], upper = [..] }");
  return maker;
}

void add_wave(Section& wave, CaseOptions& options, WaveMaker maker) {
  if (maker.paddle || maker.source) {
    if (!makes(wave, maker)) return;
    const std::size_t before = wave.reading().report.size();
    check_surroundings(wave, options, maker);
    if (wave.reading().report.size() != before) return;
    if (maker.paddle)
      add_paddle(wave, options, maker);
    else
      options.flow->wave_sources.push_back({std::move(maker.zone), *maker.source});
    return;
  }
  if (!maker.side) {
    options.flow->waves.push_back(std::move(maker.zone));
    return;
  }
  maker.side->wave = std::move(maker.zone);
  add_flow_side(wave, options, *maker.side);
}

}  // namespace mudlark

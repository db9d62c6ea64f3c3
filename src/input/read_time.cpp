/// [time]
#include <fmt/format.h>

#include "input/sections.hpp"

namespace mudlark {

std::optional<double> read_time(Section& root, CaseOptions& options) {
  TimeOptions& time = options.time;
  const bool staged = !time.stage_ends.empty();
  Section section = root.table("time", Record::Form::block, !staged);
  if (!root.has("time") && !staged) return {};
  if (staged) {
    section.forbid("end", "the run ends with its last [[stage]]");
    time.end = time.stage_ends.back();
  } else {
    time.end = section.number("end", quantity::time,
                              positive("the end of the run lies after its start at 0"));
  }
  root.reading().end = time.end;
  const auto courant =
      section.number_if_set("courant", quantity::number,
                            {.lower = 0.0,
                             .upper = 1.0,
                             .lower_included = false,
                             .reason = "a share of the stable step between 0 and 1"});
  time.step =
      section.number_if_set("step", quantity::time, positive("a step needs a length above 0"));
  time.max_step =
      section.number_if_set("max_step", quantity::time, positive("a step needs a length above 0"));
  time.output_every = section.number(
      "output_every", quantity::time,
      not_negative("the time between outputs, 0 for start and end only"), time.output_every);
  constexpr double most_outputs = 1e6;
  if (time.output_every > 0.0 && time.end / time.output_every > most_outputs)
    section.fail("output_every",
                 fmt::format("{:.3g} outputs until the end", time.end / time.output_every));
  time.output_at = section.numbers("output_at", quantity::time, 0, std::vector<double>{});
  for (const double at : time.output_at)
    if (at < 0.0 || at > time.end) {
      section.fail("output_at", fmt::format("{} s lies outside the run, 0 to {} s", at, time.end));
      break;
    }
  time.checkpoint_every =
      section.number("checkpoint_every", quantity::time,
                     positive("the wall-clock time between checkpoints"), time.checkpoint_every);
  section.finish();
  return courant;
}

}  // namespace mudlark

/// [[rain]]
#include "input/sections.hpp"

namespace mudlark {
namespace {

/// The part of the horizontal that it falls on: numbers along x, in 3D lists along x and y.
void read_extent(Section& section, int dimension, RainOptions& rain) {
  for (const auto& [key, place] : {std::pair{"from", &rain.from}, {"to", &rain.to}}) {
    if (!section.has(key)) continue;
    if (dimension == 2) {
      (*place)[0] = section.number(key, quantity::length, {});
      continue;
    }
    const auto values = section.numbers(key, quantity::length, 0);
    if (values.size() == 2)
      (*place)[0] = values[0], (*place)[1] = values[1];
    else if (!values.empty())
      section.fail(key, "two lengths are expected, along x and y");
  }
}

}  // namespace

void read_rain(Section& root, CaseOptions& options) {
  std::vector<Section> sections = root.tables("rain");
  if (sections.empty()) return;
  if (!options.flow)
    return root.reading().report.add(
        root.place("rain"),
        "[[rain]] is flowing water, but there is no [[water.body]]\n  (a small "
        "one anywhere will do).");
  std::vector<std::string> names;
  for (Section& section : sections) {
    RainOptions rain;
    rain.name = read_name(section, names);
    rain.intensity = section.varying("intensity", quantity::velocity,
                                     not_negative("rain falls", "Write \"20 mm/h\"."));
    read_extent(section, options.domain.dimension, rain);
    section.finish();
    options.flow->rains.push_back(std::move(rain));
  }
  if (options.flow->gas)
    root.reading().report.add(root.place("rain"),
                              "rain does not go with water.air = \"gas\" yet\n  (gas would have to "
                              "make room for it). Leave out air.");
  if (options.soil && options.coupling.mode != CouplingMode::unified)
    root.reading().report.add(
        root.place("rain"),
        "rain on soil needs coupling.mode = \"unified\"\n  (elsewhere the water in the pores "
        "is not that which flows).");
}

}  // namespace mudlark

/// Spectra of [[wave]]
#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"
#include "flow/sea_components.hpp"
#include "input/sections.hpp"
#include "input/spectrum_file.hpp"

namespace mudlark {
namespace {

const std::vector<Choice<SpectrumForm>> forms{
    {"jonswap", SpectrumForm::jonswap},
    {"pierson-moskowitz", SpectrumForm::pierson_moskowitz},
    {"tma", SpectrumForm::tma}};

/// spectrum = { csv = "sea.csv" }
void read_table(Section& wave, Spectrum& spectrum) {
  Section section = wave.table("spectrum", Record::Form::inline_table);
  spectrum.form = SpectrumForm::given;
  const auto path = section.file("csv", "a CSV file", "\"spectrum.csv\"");
  section.finish();
  if (path.empty()) return;
  try {
    spectrum.table = read_spectrum_file(path, wave.reading().units);
  } catch (const InputError& error) {
    section.fail("csv", error.what());
  }
}

Spectrum read_spectrum(Section& section) {
  Spectrum spectrum;
  const Value* value = section.has("spectrum") ? section.raw("spectrum") : nullptr;
  if (value && std::holds_alternative<Table>(value->data)) {
    read_table(section, spectrum);
    for (const char* key : {"peak_period", "peak_enhancement"})
      section.forbid(key, "the spectrum is given by a file");
    return spectrum;
  }
  spectrum.form = section.choice<SpectrumForm>("spectrum", forms, spectrum.form);
  spectrum.peak_period =
      section.number("peak_period", quantity::time, positive("a period lies above 0"));
  if (spectrum.form == SpectrumForm::pierson_moskowitz) {
    section.forbid("peak_enhancement", "it belongs to \"jonswap\" and \"tma\"");
    return spectrum;
  }
  spectrum.peak_enhancement = section.number(
      "peak_enhancement", quantity::number,
      {.lower = 1.0, .upper = 10.0, .reason = "gamma of JONSWAP; 1 is Pierson-Moskowitz"},
      spectrum.peak_enhancement);
  return spectrum;
}

}  // namespace

SeaComponents read_sea(Section& section, bool random) {
  SeaComponents sea;
  sea.spectrum = read_spectrum(section);
  sea.count = section.integer(
      "components", {.lower = 1.0, .upper = 5000.0, .reason = "the number of linear waves"},
      sea.count);
  const bool space = section.reading().dimension == 3;
  if (space)
    sea.spreading = section.number_if_set(
        "spreading", quantity::number,
        {.lower = 1.0,
         .upper = 1000.0,
         .reason = "s of cos^2s((theta - mean)/2): 1 comes from all sides, 1000 from one",
         .cure = "10 is a wind sea, 75 a swell. Leave it out for long crests."});
  else
    section.forbid("spreading", "in the plane all waves go the same way");
  if (random || (space && sea.spreading))
    sea.seed = static_cast<std::uint64_t>(section.integer(
        "seed", {.lower = 0.0, .upper = 2e9, .reason = "the same seed gives the same sea"}, 1));
  else
    section.forbid("seed", "nothing is random here");
  return sea;
}

}  // namespace mudlark

#include "input/case_file.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "input/document.hpp"
#include "input/sections.hpp"

namespace mudlark {

namespace {

bool has_equal_cells(const DomainOptions& domain) {
  return std::all_of(domain.faces.begin(), domain.faces.end(),
                     [](const auto& faces) { return faces.empty(); });
}

}  // namespace

CaseOptions read_case(const std::filesystem::path& file, std::span<const std::string> overrides) {
  Reading reading;
  const Table document = read_document(file, overrides, reading.report);
  Record record;
  CaseOptions options;
  std::vector<NamedShape> grounds;

  Section root(&document, {file.string(), 1}, "", reading, record);
  options.title = root.text("title", file.stem().string());
  read_domain(root, options);
  std::vector<Stage> stages = read_stages(root, options);
  const std::optional<double> courant = read_time(root, options);
  const WaterProperties water = read_water(root, options);
  read_porous(root, options, grounds);
  read_soil(root, options, water, stages, grounds);
  if (options.soil && !has_equal_cells(options.domain))
    reading.report.add(
        root.place("soil"),
        "soil needs cells of one size, and [[domain.refinement]] stretches them\n  (its material "
        "points carry splines of a uniform grid). Leave the refinement out.");
  read_coupling(root, options);
  read_solids(root, options);
  read_loads(root, options);
  read_boundaries(root, options);
  read_waves(root, options);
  read_openings(root, options);
  read_rain(root, options);
  read_solvers(root, options, courant);
  finish_stages(stages, options);
  check_boundaries(root, options);
  check_unified(root, options);
  accelerate_free_bodies(options);
  read_gauges(root, options);
  check_overlaps(reading, grounds);
  if (!root.has("soil") && !options.flow)
    root.missing("soil or water.body",
                 "there is nothing to compute without [[soil]] or [[water.body]]");
  root.finish();

  if (!reading.report.empty()) throw InputError(reading.report.text());
  options.resolved_toml = record.block();
  return options;
}

std::string read_title(const std::filesystem::path& file) {
  Report report;
  const Table document = read_document(file, {}, report);
  const Entry* entry = find_entry(document, "title");
  const auto* title = entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
  return title ? *title : file.stem().string();
}

}  // namespace mudlark

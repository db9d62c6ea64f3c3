#include "output/summary.hpp"

#include <sys/resource.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "output/files.hpp"

namespace mudlark {
namespace {

using Json = nlohmann::ordered_json;

Json object_of(const std::vector<std::pair<std::string, double>>& entries) {
  Json object = Json::object();
  for (const auto& [name, value] : entries) object[name] = value;
  return object;
}

Json gauges_of(const std::vector<GaugeSummary>& gauges) {
  Json object = Json::object();
  for (const GaugeSummary& gauge : gauges) {
    Json entry = Json::object();
    if (gauge.extremes) {
      entry["time [s]"] = gauge.extremes->time;
      for (std::size_t i = 0; i < gauge.columns.size(); ++i)
        entry[gauge.columns[i]] = {{"last", gauge.extremes->last.at(i)},
                                   {"smallest", gauge.extremes->smallest.at(i)},
                                   {"largest", gauge.extremes->largest.at(i)}};
    }
    object[gauge.name] = entry;
  }
  return object;
}

Json stages_of(const std::vector<StageSummary>& stages) {
  Json list = Json::array();
  for (const StageSummary& stage : stages)
    list.push_back({{"name", stage.name},
                    {"began [s]", stage.began},
                    {"ended [s]", stage.ended},
                    {"at rest [s]", stage.rested ? Json(*stage.rested) : Json(nullptr)},
                    {"grains taken out [kg]", stage.excavated},
                    {"grains placed [kg]", stage.placed}});
  return list;
}

double sum_over(MPI_Comm comm, double value) {
  double sum = 0.0;
  MPI_Allreduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return sum;
}

rusage usage() {
  rusage own{};
  getrusage(RUSAGE_SELF, &own);
  return own;
}

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json;
  json["status"] = summary.status;
  if (!summary.message.empty()) json["message"] = summary.message;
  json["title"] = summary.title;
  json["version"] = summary.version;
  json["commit"] = summary.commit;
  json["dimension"] = summary.dimension;
  json["ranks"] = summary.ranks;
  json["resumed"] = summary.resumed;
  json["cells"] = summary.cells;
  json["points"] = summary.points;
  json["time [s]"] = summary.time;
  json["end time [s]"] = summary.end_time;
  json["steps"] = summary.steps;
  json["soil steps"] = summary.soil_steps;
  json["smallest step [s]"] = summary.smallest_step;
  json["largest step [s]"] = summary.largest_step;
  json["wall time [s]"] = summary.wall_seconds;
  json["CPU time [s]"] = summary.cpu_seconds;
  json["time per phase [s]"] = object_of(summary.phase_seconds);
  if (!summary.flow_effort.empty()) json["flow"] = object_of(summary.flow_effort);
  json["conservation errors"] = object_of(summary.conservation_errors);
  if (!summary.soil_energy.empty()) json["energy of the soil [J]"] = object_of(summary.soil_energy);
  if (!summary.soil_statics.empty()) json["rest of the soil"] = object_of(summary.soil_statics);
  for (const SolidSummary& solid : summary.solids)
    for (const auto& [title, values] : solid.values) json["solids"][solid.name][title] = values;
  if (!summary.stages.empty()) json["stages"] = stages_of(summary.stages);
  if (!summary.implicit_effort.empty()) json["implicit steps"] = object_of(summary.implicit_effort);
  json["gauges"] = gauges_of(summary.gauges);
  json["peak memory [bytes]"] = summary.peak_memory_bytes;
  // A title may hold bytes that are no UTF-8; they are replaced, not refused.
  return dump(json);
}

void write_summary(const std::filesystem::path& folder, const Summary& summary, MPI_Comm comm) {
  on_rank_zero(comm, [&] { write_atomically(folder / "summary.json", to_json(summary)); });
}

void mark_failed(const std::filesystem::path& folder, const std::string& message) {
  std::ifstream file(folder / "summary.json");
  const Json last = Json::parse(file, nullptr, false);
  Json json = {{"status", "failed"}, {"message", message}};
  if (last.is_object())
    for (const auto& [key, value] : last.items())
      if (!json.contains(key)) json[key] = value;
  try {
    write_atomically(folder / "summary.json", dump(json));
  } catch (const std::exception&) {  // no room for a second file: over the first, then
    std::ofstream(folder / "summary.json", std::ios::trunc) << dump(json);
  }
}

double peak_memory(MPI_Comm comm) {
  return sum_over(comm, 1024.0 * static_cast<double>(usage().ru_maxrss));
}

double cpu_seconds(MPI_Comm comm) {
  const rusage own = usage();
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return sum_over(comm, seconds(own.ru_utime) + seconds(own.ru_stime));
}

}  // namespace mudlark

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_summary(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) return {};
  Json summary = Json::parse(stream, nullptr, false);
  if (summary.is_discarded() || !summary.is_object())
    throw InputError(
        fmt::format("{}: this is not a summary of a run (damaged JSON)", file.string()));
  return summary;
}

std::string value_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void print_object(const Json& object, int indent) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      fmt::print("{:{}}{}\n", "", indent, key);
      print_object(value, indent + 2);
    } else {
      fmt::print("{:{}}{:<{}} {}\n", "", indent, key, std::max(4, 30 - indent), value_text(value));
    }
  }
}

void print_gauge(const fs::path& file) {
  std::ifstream stream(file);
  std::string header, line, last;
  std::getline(stream, header);
  long long rows = 0;
  while (std::getline(stream, line))
    if (!line.empty()) ++rows, last = line;
  fmt::print("  {:<28} {} values of {}; last: {}\n", file.filename().string(), rows, header,
             last.empty() ? "none" : last);
}

void print_gauges(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  if (files.empty()) return;
  std::sort(files.begin(), files.end());
  fmt::print("\ngauges\n");
  for (const fs::path& file : files) print_gauge(file);
}

/// The times that an XDMF file lists: <Time Value="..."/>.
void print_outputs(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) return;
  const std::string mark = "<Time Value=\"";
  std::vector<std::string> times;
  for (std::string line; std::getline(stream, line);)
    for (std::size_t at = line.find(mark); at != std::string::npos; at = line.find(mark, at + 1))
      times.push_back(
          line.substr(at + mark.size(), line.find('"', at + mark.size()) - at - mark.size()));
  if (times.empty()) return;
  fmt::print("\n{:<28}   {} times from {} to {} s\n", file.filename().string(), times.size(),
             times.front(), times.back());
}

}  // namespace

ExitCode info_command(const std::string& results) {
  const fs::path folder(results);
  if (!fs::is_directory(folder))
    throw InputError(fmt::format("{}: there is no such folder", results));
  const Json summary = read_summary(folder / "summary.json");
  if (summary.is_null() && !fs::exists(folder / "case.toml"))
    throw InputError(fmt::format(
        "{}: this is not a results folder (it has neither summary.json nor case.toml)", results));
  if (summary.is_null())
    fmt::print("no summary yet: the run goes on, or was ended from outside\n");
  else
    print_object(summary, 0);
  if (!summary.contains("gauges")) print_gauges(folder / "gauges");
  print_outputs(folder / "fields.xdmf");
  print_outputs(folder / "points.xdmf");
  if (fs::is_directory(folder / "checkpoint"))
    fmt::print(
        "\ncheckpoint                     go on with: mudlark run CASE.toml --resume -o {}\n",
        results);
  return ExitCode::done;
}

}  // namespace mudlark

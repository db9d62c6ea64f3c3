#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "commands.hpp"
#include "input/case_file.hpp"
#include "installation.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sorted_entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

void list_cases(const fs::path& cases) {
  fmt::print("Cases (copy a folder here with \"mudlark cases NAME\"):\n");
  for (const fs::path& folder : sorted_entries(cases)) {
    if (!fs::is_directory(folder)) continue;
    fmt::print("\n{}\n", folder.filename().string());
    for (const fs::path& file : sorted_entries(folder))
      if (file.extension() == ".toml")
        fmt::print("  {:<24} {}\n", file.filename().string(), read_title(file));
  }
}

}  // namespace

ExitCode cases_command(const std::string& name) {
  const fs::path cases = shipped_folder("cases");
  if (name.empty()) {
    list_cases(cases);
    return ExitCode::done;
  }
  const fs::path source = cases / fs::path(name).filename();
  if (fs::path(name).filename() != fs::path(name) || name.starts_with('.') ||
      !fs::is_directory(source))
    throw InputError(fmt::format("there is no case {}; \"mudlark cases\" lists them", name));
  const fs::path target = fs::current_path() / name;
  if (fs::exists(target))
    throw InputError(fmt::format("{} exists here already and is not overwritten", name));
  std::error_code error;
  fs::copy(source, target, fs::copy_options::recursive, error);
  if (error) throw InputError(fmt::format("{}: cannot be copied here ({})", name, error.message()));
  fmt::print("copied to {}\n", name);
  for (const fs::path& file : sorted_entries(target))
    if (file.extension() == ".toml")
      fmt::print("  mudlark run {}/{}\n", name, file.filename().string());
  return ExitCode::done;
}

}  // namespace mudlark

#include "run/continuation.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace mudlark {
namespace {

constexpr std::array<std::string_view, 2> free_tables{"[time]", "[[gauge]]"};
constexpr std::array<std::string_view, 3> solver_tables{"[soil_solver]", "[flow_solver]",
                                                        "[[stage]]"};
constexpr std::array<std::string_view, 6> free_solver_keys{
    "courant", "max_step", "damping", "water_damping", "stop_when_static", "pressure_tolerance"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string lasting_part(const std::string& resolved_toml) {
  std::istringstream lines(resolved_toml);
  std::string lasting, table;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) table = line;
    const std::string_view key = std::string_view(line).substr(0, line.find(' '));
    const bool may_change = line.empty() || contains(free_tables, table) ||
                            (table.empty() && key == "title") ||
                            (contains(solver_tables, table) && contains(free_solver_keys, key));
    if (!may_change) lasting += line + "\n";
  }
  return lasting;
}

}  // namespace mudlark

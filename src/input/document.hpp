#pragma once
/// TOML text to values.
#include <filesystem>
#include <span>
#include <string>

#include "input/report.hpp"
#include "input/value.hpp"

namespace mudlark {

/// The file with the overrides ("soil.0.porosity=0.35") put in their places. Throws InputError when
/// the file cannot be read or is not TOML; overrides that fit nowhere are reported.
Table read_document(const std::filesystem::path& file, std::span<const std::string> overrides,
                    Report& report);

}  // namespace mudlark

#pragma once
/// The entrance: a case file in, checked options out.
#include <filesystem>
#include <span>
#include <string>

#include "run/options.hpp"

namespace mudlark {

/// Reads and checks a case file. `overrides` are "key=value" texts, applied as if written in the
/// file. Throws InputError whose text lists every mistake of the file.
CaseOptions read_case(const std::filesystem::path& file, std::span<const std::string> overrides);

/// Only the title, for lists of cases; the file's stem when it has none.
std::string read_title(const std::filesystem::path& file);

}  // namespace mudlark

#pragma once
/// The spectrum of a sea from a file.
#include <array>
#include <filesystem>
#include <vector>

#include "input/quantity.hpp"

namespace mudlark {

/// Frequency [Hz] and density [m2 s] per line, separated by commas, semicolons, tabs or blanks;
/// lines that are empty or begin with # are skipped. A header may give units in brackets. Throws
/// InputError with file and line.
std::vector<std::array<double, 2>> read_spectrum_file(const std::filesystem::path& file,
                                                      const Units& units);

}  // namespace mudlark

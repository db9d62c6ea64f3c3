#pragma once
/// Where the program's own files are: beside the program in its source tree or its place of
/// installation.
#include <filesystem>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace mudlark {

std::filesystem::path program_path();
/// "cases" or "python" in the folders above the program, or in share/mudlark there. Throws when
/// missing.
std::filesystem::path shipped_folder(const std::string& name);
/// `python3 -m module arguments...` with the shipped package; waits and returns its exit code.
/// MUDLARK_PYTHON names another interpreter.
ExitCode run_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace mudlark

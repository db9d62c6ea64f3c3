#include <fmt/format.h>

#include <filesystem>

#include "commands.hpp"
#include "installation.hpp"

namespace mudlark {

ExitCode python_command(const std::string& module, const std::string& results,
                        const std::vector<std::string>& arguments) {
  if (!std::filesystem::is_directory(results))
    throw InputError(fmt::format("{}: there is no such folder", results));
  std::vector<std::string> words{results};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_python("mudlark." + module, words);
}

}  // namespace mudlark

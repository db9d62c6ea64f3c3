#include "installation.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace mudlark {
namespace {

std::string interpreter() {
  if (const char* chosen = std::getenv("MUDLARK_PYTHON")) return chosen;
  // Debian's packages of packages.txt belong to Debian's own interpreter, not to the first one in
  // PATH.
  const char* system = "/usr/bin/python3";
  return access(system, X_OK) == 0 ? system : "python3";
}

}  // namespace

std::filesystem::path program_path() { return std::filesystem::read_symlink("/proc/self/exe"); }

std::filesystem::path shipped_folder(const std::string& name) {
  std::filesystem::path folder = program_path().parent_path();
  constexpr int levels = 5;
  for (int i = 0; i < levels; ++i, folder = folder.parent_path())
    for (const auto& candidate : {folder / "share" / "mudlark" / name, folder / name})
      if (std::filesystem::is_directory(candidate)) return candidate;
  throw InputError(
      fmt::format("the program's folder {} is not found beside {}", name, program_path().string()));
}

ExitCode run_python(const std::string& module, const std::vector<std::string>& arguments) {
  const std::string package = shipped_folder("python").string();
  std::vector<std::string> words{interpreter(), "-m", module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no further process can be started");
  constexpr int not_found = 127;
  if (child == 0) {
    const char* before = std::getenv("PYTHONPATH");
    setenv("PYTHONPATH", (before ? package + ":" + before : package).c_str(), 1);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    _exit(not_found);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status)) return ExitCode::interrupted;
  if (WEXITSTATUS(status) == not_found)
    throw InputError(fmt::format("{} is not found; pictures need python3", words.front()));
  return WEXITSTATUS(status) == 0 ? ExitCode::done : ExitCode::wrong_input;
}

}  // namespace mudlark

#include "launcher.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "installation.hpp"
#include "parallel/session_folder.hpp"
#include "parallel_session.hpp"

namespace mudlark {
namespace {

// A signal handler can reach nothing but static data.
volatile std::sig_atomic_t launcher_process = 0;
volatile std::sig_atomic_t signals_seen = 0;

/// The first signal asks the ranks to write a checkpoint and stop, a second one ends them.
extern "C" void pass_on(int) {
  signals_seen = signals_seen + 1;
  if (launcher_process > 0)
    kill(static_cast<pid_t>(launcher_process), signals_seen == 1 ? SIGUSR1 : SIGTERM);
}

/// A file of our own that removes itself.
class ExitCodeFile {
 public:
  ExitCodeFile()
      : name_((std::filesystem::temp_directory_path() / "mudlark-exit-XXXXXX").string()) {
    const int file = mkstemp(name_.data());
    if (file < 0) throw InputError(fmt::format("{}: cannot be written", name_));
    close(file);
  }
  ~ExitCodeFile() { unlink(name_.c_str()); }
  ExitCodeFile(const ExitCodeFile&) = delete;
  ExitCodeFile& operator=(const ExitCodeFile&) = delete;

  const std::string& name() const { return name_; }
  int code() const {
    int value = -1;
    std::ifstream(name_) >> value;
    return value;
  }

 private:
  std::string name_;
};

/// Open MPI refuses root and more ranks than cores unless told; both are the user's own choice
/// here. It would also tie the ranks of every run to the same first cores, where two runs at a time
/// wait for each other.
void set_environment(const std::string& exit_code_file) {
  const std::array<std::pair<const char*, const char*>, 6> settings{{
      {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
      {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
      {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
      {"OMPI_MCA_mpi_yield_when_idle", "1"},
      {"OMPI_MCA_hwloc_base_binding_policy", "none"},
      {exit_code_variable, exit_code_file.c_str()},
  }};
  for (const auto& [name, value] : settings) setenv(name, value, 1);
}

[[noreturn]] void become_launcher(std::vector<std::string> words,
                                  const std::string& exit_code_file) {
  setpgid(0, 0);  // Ctrl-C reaches only the waiting program, which passes it on gently
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  set_environment(exit_code_file);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  constexpr int not_found = 127;
  _exit(not_found);
}

}  // namespace

ExitCode run_on_ranks(int ranks, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"mpiexec", "-n", std::to_string(ranks), program_path().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const ExitCodeFile file;
  const SessionFolder folder;
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no further process can be started");
  if (child == 0) become_launcher(words, file.name());
  launcher_process = child;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, pass_on);

  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  launcher_process = 0;
  constexpr int not_found = 127;
  if (const int code = file.code(); code >= 0) return static_cast<ExitCode>(code);
  if (WIFEXITED(status) && WEXITSTATUS(status) == not_found)
    throw InputError(
        "-n needs MPI's launcher mpiexec, which is not found\n"
        "  (install openmpi-bin), or run without -n.");
  if (signals_seen > 0) return ExitCode::interrupted;
  throw std::runtime_error("the ranks ended without a result");
}

}  // namespace mudlark

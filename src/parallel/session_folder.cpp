#include "parallel/session_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace mudlark {
namespace {

constexpr const char* setting = "OMPI_MCA_orte_tmpdir_base";

}  // namespace

SessionFolder::SessionFolder() {
  for (const char* mark : {setting, "OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(mark)) return;
  std::error_code error;
  name_ = (std::filesystem::temp_directory_path(error) / "mudlark-mpi-XXXXXX").string();
  if (!error && mkdtemp(name_.data()))
    setenv(setting, name_.c_str(), 1);
  else
    name_.clear();  // Open MPI's own message says what is wrong with /tmp
}

SessionFolder::~SessionFolder() {
  if (name_.empty()) return;
  unsetenv(setting);
  std::error_code ignored;
  std::filesystem::remove_all(name_, ignored);
}

}  // namespace mudlark

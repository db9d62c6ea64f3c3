#include "folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "base/errors.hpp"

namespace mudlark {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  using namespace std::chrono_literals;
  if (file_ < 0) return;
  for (auto waited = 0ms; flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
       waited += 50ms) {
    if (waited >= 2s) {
      close(file_);
      throw InputError(fmt::format(
          "-o {}: another run is writing into this folder. Give this one a folder of its "
          "own, or wait.",
          folder.string()));
    }
    std::this_thread::sleep_for(50ms);
  }
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace mudlark

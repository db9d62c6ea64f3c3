#pragma once
/// One run at a time writes into a results folder.
#include <filesystem>

namespace mudlark {

/// Holds a folder until it is destroyed or the process ends, however it ends. Throws InputError
/// when another process holds it and does not let go within two seconds (a run that was killed may
/// still be ending). Where the file system knows no locks, nothing is held.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace mudlark

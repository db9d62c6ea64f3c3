#pragma once
/// A folder of its own for the files that Open MPI keeps while a program runs.
#include <string>

namespace mudlark {

/// Open MPI makes one folder per user below /tmp when a program starts, and removes it when the
/// last one ends. Two programs of a user that start or end at the same moment take it away from
/// each other, and one dies in MPI_Init (Open MPI 4.1). Make this before MPI_Init, or before
/// mpiexec is started, and let it live until after MPI_Finalize. Does nothing below a launcher or
/// where a folder is set.
class SessionFolder {
 public:
  SessionFolder();
  ~SessionFolder();
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;

 private:
  std::string name_;  ///< empty: none of our own
};

}  // namespace mudlark

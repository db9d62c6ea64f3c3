#pragma once
/// A folder of its own for a test on all ranks, and a small grid.
#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "grid/grid.hpp"

namespace mudlark::testing_support {

/// Made empty at construction, removed at the end; the same on all ranks.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    static int number = 0;
    int key[2] = {static_cast<int>(::getpid()), number++};
    MPI_Bcast(key, 2, MPI_INT, 0, MPI_COMM_WORLD);
    path_ = std::filesystem::temp_directory_path() /
            ("mudlark-test-" + std::to_string(key[0]) + "-" + std::to_string(key[1]));
    if (rank_ == 0) std::filesystem::create_directories(path_);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~TemporaryFolder() {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank_ == 0) std::filesystem::remove_all(path_);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  bool first_rank() const { return rank_ == 0; }

 private:
  std::filesystem::path path_;
  int rank_ = 0;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// 12 x 10 (x 8) cells, wide enough for three ranks.
template <int D>
Grid<D> small_grid(bool periodic_x = false, MPI_Comm comm = MPI_COMM_WORLD) {
  DomainOptions options;
  options.dimension = D;
  options.lower = {-1.0, 0.5, 2.0};
  options.upper = {2.0, 3.0, 6.0};
  options.cells = {12, 10, 8};
  if (periodic_x) options.walls[0] = {Wall::periodic, Wall::periodic};
  return Grid<D>(options, comm);
}

}  // namespace mudlark::testing_support

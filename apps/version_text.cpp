#include <HYPRE_config.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <mpi.h>
#include <petscsys.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <array>
#include <nlohmann/json.hpp>

#include "base/version.hpp"
#include "commands.hpp"

namespace mudlark {
namespace {

std::string mpi_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string all(text.data(), static_cast<std::size_t>(length));
  return all.substr(0, all.find_first_of(",\n"));
}

std::string petsc_version() {
  PetscInt major = 0, minor = 0, subminor = 0, release = 0;
  PetscGetVersionNumber(&major, &minor, &subminor, &release);
  return fmt::format("{}.{}.{}", major, minor, subminor);
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

std::string fmt_version() {
  return fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

}  // namespace

std::string version_text() {
  return fmt::format(
      "mudlark {} (commit {})\n"
      "MPI     {}\nPETSc   {}\nhypre   {}\nHDF5    {}\nEigen   {}.{}.{}\nfmt     {}\nCLI11   {}\n"
      "json    {}.{}.{}\ncompiler {}",
      program_version(), program_commit(), mpi_version(), petsc_version(), HYPRE_RELEASE_VERSION,
      hdf5_version(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, fmt_version(),
      CLI11_VERSION, NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
      NLOHMANN_JSON_VERSION_PATCH, __VERSION__);
}

}  // namespace mudlark

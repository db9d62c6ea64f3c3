#include "output/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "base/errors.hpp"

namespace mudlark {
namespace {

enum class Outcome : int { fine, input_error, other_error };

void force_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  if (descriptor < 0)
    throw std::runtime_error(
        fmt::format("cannot open {} ({})", path.string(), std::strerror(errno)));
  const int failed = ::fsync(descriptor);
  const int reason = errno;
  ::close(descriptor);
  // Some file systems cannot sync a folder (EINVAL); there the rename alone has to do.
  if (failed && reason != EINVAL)
    throw std::runtime_error(
        fmt::format("cannot write {} to the disk ({})", path.string(), std::strerror(reason)));
}

std::filesystem::path parent_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

void on_rank_zero(MPI_Comm comm, const std::function<void()>& action) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  int told[2] = {static_cast<int>(Outcome::fine), 0};
  std::string text;
  if (rank == 0) {
    try {
      action();
    } catch (const InputError& error) {
      told[0] = static_cast<int>(Outcome::input_error);
      text = error.what();
    } catch (const std::exception& error) {
      told[0] = static_cast<int>(Outcome::other_error);
      text = error.what();
    }
    told[1] = static_cast<int>(text.size());
  }
  MPI_Bcast(told, 2, MPI_INT, 0, comm);
  if (told[0] == static_cast<int>(Outcome::fine)) return;
  text.resize(static_cast<std::size_t>(told[1]));
  MPI_Bcast(text.data(), told[1], MPI_CHAR, 0, comm);
  if (told[0] == static_cast<int>(Outcome::input_error)) throw InputError(text);
  throw std::runtime_error(text);
}

void prepare_folder(const std::filesystem::path& folder, MPI_Comm comm) {
  on_rank_zero(comm, [&] {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (!problem) {
      const auto probe = folder / ".mudlark-write-test";
      if (std::FILE* file = std::fopen(probe.c_str(), "w")) {
        // A full disk shows when the bytes go out, not when the file is made.
        const bool written = std::fputs("x\n", file) >= 0;
        const bool closed = std::fclose(file) == 0;
        if (!written || !closed) problem = std::error_code(errno, std::generic_category());
        std::error_code ignored;
        std::filesystem::remove(probe, ignored);
      } else {
        problem = std::error_code(errno, std::generic_category());
      }
    }
    if (problem)
      throw InputError(
          fmt::format("cannot write results into the folder {} ({}).\n  Name another folder with "
                      "-o DIR, or make "
                      "room or give yourself the right to write there.",
                      folder.string(), problem.message()));
  });
}

void write_atomically(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = file.string() + ".part";
  std::FILE* stream = std::fopen(temporary.c_str(), "w");
  if (!stream)
    throw std::runtime_error(
        fmt::format("cannot write {} ({})", file.string(), std::strerror(errno)));
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  const int reason = errno;
  const bool closed = std::fclose(stream) == 0;
  if (!written || !closed) {
    const std::string why = std::strerror(written ? errno : reason);
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(fmt::format("cannot write {} ({})", file.string(), why));
  }
  rename_durably(temporary, file);
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  force_to_disk(from);
  std::error_code problem;
  std::filesystem::rename(from, to, problem);
  if (problem)
    throw std::runtime_error(
        fmt::format("cannot give {} its name ({})", to.string(), problem.message()));
  force_to_disk(parent_of(to));
}

}  // namespace mudlark

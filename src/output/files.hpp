#pragma once
/// Folders and small text files of the results, and errors that one rank meets but every rank must
/// share.
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>

namespace mudlark {

/// Runs `action` on rank 0 only. What it throws is thrown on every rank: InputError as InputError,
/// all else as std::runtime_error, so that no rank waits for one that has left. Collective.
void on_rank_zero(MPI_Comm comm, const std::function<void()>& action);

/// Makes the folder when missing and proves that files can be written there. Throws InputError.
/// Collective.
void prepare_folder(const std::filesystem::path& folder, MPI_Comm comm);

/// Writes a text file so that a reader sees the old text or the new one, never a part: a temporary
/// file in the same folder, forced to the disk, renamed. Throws std::runtime_error. One rank.
void write_atomically(const std::filesystem::path& file, const std::string& text);

/// Forces a finished file to the disk and gives it its final name. Throws std::runtime_error. One
/// rank.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace mudlark

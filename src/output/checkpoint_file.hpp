#pragma once
/// What writer and reader of checkpoints share: names, header, checksums.
#include <mpi.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "output/hdf5_file.hpp"

namespace mudlark::checkpoint_file {

inline constexpr std::int64_t format_version = 1;
inline constexpr const char* state_names[2] = {"state-A.h5", "state-B.h5"};

/// Kept as attributes of the file.
struct Header {
  std::int64_t version = format_version, sequence = 0, step = 0, ranks = 0, case_hash = 0,
               grid_hash = 0;
  std::int64_t datasets = 0;
  double time = 0.0;
};

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): every bit of the input changes half of the
/// output's.
inline std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Contribution of one number at one place of an array. The sum over an array does not depend on
/// the order of summation, so any split over ranks gives the same checksum.
template <class T>
std::uint64_t checksum_of(std::uint64_t place, const T& value) {
  return mixed(std::bit_cast<std::uint64_t>(value) ^ mixed(place));
}

std::int64_t hash_of(std::string_view text);

/// Checksum of this rank's part of an array, summed over ranks. Collective.
template <class T>
std::int64_t checksum(const Slab& slab, const T* values, MPI_Comm comm);

void write_header(Hdf5File& file, const Header& header);
/// Empty when the header is not there or its checksum is wrong.
std::optional<Header> read_header(Hdf5File& file);
/// The header of a file, empty when the file is absent or not readable. Collective.
std::optional<Header> header_of(const std::filesystem::path& path, MPI_Comm comm);
/// Why the file is damaged, empty when every checksum is right. Collective.
std::string damage_of(const std::filesystem::path& path, MPI_Comm comm);

}  // namespace mudlark::checkpoint_file

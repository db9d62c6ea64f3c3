#include "output/checkpoint_file.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace mudlark::checkpoint_file {
namespace {

std::int64_t header_checksum(const Header& header) {
  std::uint64_t sum = 0, place = 0;
  for (const std::int64_t value : {header.version, header.sequence, header.step, header.ranks,
                                   header.case_hash, header.grid_hash, header.datasets})
    sum += checksum_of(place++, value);
  return std::bit_cast<std::int64_t>(sum + checksum_of(place, header.time));
}

/// Does the array carry its checksum? Each rank reads an even share of its rows.
template <class T>
bool is_intact(Hdf5File& file, const std::string& dataset, MPI_Comm comm) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  Slab slab;
  slab.extent = slab.count = file.extent_of(dataset);
  if (slab.extent.empty()) return false;
  slab.start.assign(slab.extent.size(), 0);
  const hsize_t rows = slab.extent[0], n = static_cast<hsize_t>(ranks),
                r = static_cast<hsize_t>(rank);
  slab.start[0] = rows * r / n;
  slab.count[0] = rows * (r + 1) / n - slab.start[0];
  std::vector<T> values(slab.size());
  file.read(dataset, slab, values.data());
  return checksum(slab, values.data(), comm) == file.integer(dataset, "checksum");
}

}  // namespace

std::int64_t hash_of(std::string_view text) {
  std::uint64_t hash = mixed(text.size());
  for (const char c : text) hash = mixed(hash ^ static_cast<unsigned char>(c));
  return std::bit_cast<std::int64_t>(hash);
}

template <class T>
std::int64_t checksum(const Slab& slab, const T* values, MPI_Comm comm) {
  // Arrays have up to four axes; the innermost row of a slab is contiguous in the array.
  const std::size_t axes = slab.extent.size();
  std::uint64_t sum = 0, total = 0;
  const std::size_t size = slab.size();
  if (size > 0) {
    std::vector<hsize_t> at(axes, 0);
    const std::size_t row = slab.count[axes - 1];
    for (std::size_t k = 0; k < size; k += row) {
      std::uint64_t place = 0;
      for (std::size_t a = 0; a < axes; ++a) place = place * slab.extent[a] + slab.start[a] + at[a];
      for (std::size_t i = 0; i < row; ++i) sum += checksum_of(place + i, values[k + i]);
      for (std::size_t a = axes - 1; a-- > 0;) {
        if (++at[a] < slab.count[a]) break;
        at[a] = 0;
      }
    }
  }
  MPI_Allreduce(&sum, &total, 1, MPI_UINT64_T, MPI_SUM, comm);
  for (const hsize_t extent : slab.extent) total = mixed(total ^ extent);
  return std::bit_cast<std::int64_t>(total);
}

void write_header(Hdf5File& file, const Header& header) {
  file.set_attribute("/", "version", header.version);
  file.set_attribute("/", "sequence", header.sequence);
  file.set_attribute("/", "step", header.step);
  file.set_attribute("/", "ranks", header.ranks);
  file.set_attribute("/", "case hash", header.case_hash);
  file.set_attribute("/", "grid hash", header.grid_hash);
  file.set_attribute("/", "datasets", header.datasets);
  file.set_attribute("/", "time", header.time);
  file.set_attribute("/", "checksum", header_checksum(header));
}

std::optional<Header> read_header(Hdf5File& file) {
  Header header;
  header.version = file.integer("/", "version");
  header.sequence = file.integer("/", "sequence");
  header.step = file.integer("/", "step");
  header.ranks = file.integer("/", "ranks");
  header.case_hash = file.integer("/", "case hash");
  header.grid_hash = file.integer("/", "grid hash");
  header.datasets = file.integer("/", "datasets");
  header.time = file.number("/", "time");
  const bool right = file.integer("/", "checksum") == header_checksum(header);
  if (file.failed() || !right) return std::nullopt;
  return header;
}

std::optional<Header> header_of(const std::filesystem::path& path, MPI_Comm comm) {
  try {
    Hdf5File file(path, Hdf5File::Mode::read, comm);
    return read_header(file);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

std::string damage_of(const std::filesystem::path& path, MPI_Comm comm) {
  try {
    Hdf5File file(path, Hdf5File::Mode::read, comm);
    const auto header = read_header(file);
    if (!header) return "its header is damaged";
    if (header->version != format_version) return "";  // another format: judged by its header alone
    const auto names = file.names_in("/");
    if (static_cast<std::int64_t>(names.size()) != header->datasets)
      return "arrays are missing in it";
    for (const std::string& name : names) {
      const std::string dataset = "/" + name;
      const bool intact = file.holds_integers(dataset)
                              ? is_intact<std::int64_t>(file, dataset, comm)
                              : is_intact<double>(file, dataset, comm);
      if (!intact) return fmt::format("the numbers of \"{}\" do not fit their checksum", name);
    }
    file.close();
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

template std::int64_t checksum(const Slab&, const double*, MPI_Comm);
template std::int64_t checksum(const Slab&, const std::int64_t*, MPI_Comm);

}  // namespace mudlark::checkpoint_file

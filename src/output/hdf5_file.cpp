#include "output/hdf5_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace mudlark {
namespace {

/// Closes an HDF5 object when the scope ends.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), closer_(closer) {}
  ~Handle() {
    if (id_ >= 0) closer_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool fine() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*closer_)(hid_t);
};

template <class T>
hid_t type_of();
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}

herr_t take_description(unsigned depth, const H5E_error2_t* error, void* text) {
  auto& reason = *static_cast<std::string*>(text);
  if (depth == 0 && error->desc) reason = error->desc;
  return 0;
}

/// The innermost reason in HDF5's own words.
std::string last_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_description, &reason);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

hid_t open_file(const std::filesystem::path& path, Hdf5File::Mode mode) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Version 1.10 of the format guards all its own bookkeeping with checksums.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V110);
  H5Pset_file_locking(access, false, true);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  if (mode == Hdf5File::Mode::create)
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  const unsigned flags = mode == Hdf5File::Mode::append ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
  return H5Fopen(path.c_str(), flags, access);
}

void broadcast(std::string& text, MPI_Comm comm) {
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, comm);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm);
}

/// Points the file's descriptor at memory, so that closing cannot fail. After a failed H5Fclose
/// HDF5 1.10 keeps a dangling entry and crashes when MPI finalises; what was not written is lost
/// either way, and what was in the file before stays as it was.
void divert_to_memory(hid_t file) {
  int* descriptor = nullptr;
  if (H5Fget_vfd_handle(file, H5P_DEFAULT, reinterpret_cast<void**>(&descriptor)) < 0) return;
  const int memory = ::memfd_create("mudlark-abandoned-output", 0);
  if (memory < 0) return;
  ::dup2(memory, *descriptor);
  ::close(memory);
}

/// What HDF5 may still allocate beside numbers before a file is closed; what it has allocated
/// counts in the size of the file.
constexpr hsize_t bookkeeping_bytes = 8192;

/// Messages have at most this many bytes, for MPI counts them with an int.
constexpr std::size_t message_bytes = std::size_t{1} << 26;
constexpr int slab_tag = 31, value_tag = 32;

template <class T, class Transfer>
void in_pieces(T* values, std::size_t size, Transfer&& transfer) {
  const std::size_t piece = message_bytes / sizeof(T);
  for (std::size_t at = 0; at < size; at += piece)
    transfer(values + at, static_cast<int>(std::min(piece, size - at) * sizeof(T)));
}

/// Start and count of a slab to rank 0, which knows the extent.
void send_slab(const Slab& slab, MPI_Comm comm) {
  std::vector<hsize_t> numbers = slab.start;
  numbers.insert(numbers.end(), slab.count.begin(), slab.count.end());
  MPI_Send(numbers.data(), static_cast<int>(numbers.size() * sizeof(hsize_t)), MPI_BYTE, 0,
           slab_tag, comm);
}

Slab receive_slab(const std::vector<hsize_t>& extent, int from, MPI_Comm comm) {
  const std::size_t axes = extent.size();
  std::vector<hsize_t> numbers(2 * axes);
  MPI_Recv(numbers.data(), static_cast<int>(numbers.size() * sizeof(hsize_t)), MPI_BYTE, from,
           slab_tag, comm, MPI_STATUS_IGNORE);
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(axes);
  return {extent, {numbers.begin(), middle}, {middle, numbers.end()}};
}

}  // namespace

std::size_t Slab::size() const {
  std::size_t n = 1;
  for (const hsize_t c : count) n *= c;
  return n;
}

Slab Slab::rows(std::int64_t total, std::int64_t first, std::int64_t rows, int width) {
  Slab slab{
      {static_cast<hsize_t>(total)}, {static_cast<hsize_t>(first)}, {static_cast<hsize_t>(rows)}};
  if (width != 1) {
    slab.extent.push_back(static_cast<hsize_t>(width));
    slab.start.push_back(0);
    slab.count.push_back(static_cast<hsize_t>(width));
  }
  return slab;
}

Hdf5File::Hdf5File(std::filesystem::path path, Mode mode, MPI_Comm comm)
    : path_(std::move(path)), comm_(comm), mode_(mode) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &ranks_);
  if (rank_ == 0) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // messages come from us, not from HDF5's stack
    file_ = open_file(path_, mode);
    keep(file_ >= 0, "open it");
  }
  share_problem();
}

Hdf5File::~Hdf5File() {
  if (file_ < 0) return;
  if (mode_ != Mode::read) divert_to_memory(file_);  // left without close(): something else failed
  H5Fclose(file_);
}

void Hdf5File::keep(bool fine, const std::string& what) {
  if (!fine && problem_.empty())
    problem_ = fmt::format("{}: cannot {} ({})", path_.string(), what, last_reason());
}

bool Hdf5File::failed() {
  int failed = !problem_.empty();
  MPI_Bcast(&failed, 1, MPI_INT, 0, comm_);
  return failed != 0;
}

void Hdf5File::share_problem() {
  if (!failed()) return;
  broadcast(problem_, comm_);
  // A constructor that throws runs no destructor.
  if (file_ >= 0) H5Fclose(std::exchange(file_, -1));
  throw std::runtime_error(problem_);
}

void Hdf5File::close() {
  if (rank_ == 0) {
    if (mode_ != Mode::read && reserve(0))
      keep(H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0, "write it to the disk");
    if (mode_ != Mode::read && !problem_.empty()) divert_to_memory(file_);
    keep(H5Fclose(std::exchange(file_, -1)) >= 0, "close it");
    if (mode_ != Mode::read) release();
  }
  share_problem();
}

void Hdf5File::make_group(const std::string& name) {
  if (rank_ != 0) return;
  const Handle group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
  keep(group.fine(), fmt::format("make the group {}", name));
}

void Hdf5File::remove(const std::string& name) {
  if (rank_ == 0)
    keep(H5Ldelete(file_, name.c_str(), H5P_DEFAULT) >= 0, fmt::format("remove {}", name));
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) {
  std::vector<std::string> names;
  if (rank_ == 0) {
    const Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
    H5G_info_t info{};
    const bool fine = opened.fine() && H5Gget_info(opened, &info) >= 0;
    keep(fine, fmt::format("list {}", group));
    for (hsize_t i = 0; fine && i < info.nlinks; ++i) {
      char name[256] = "";
      const ssize_t length = H5Lget_name_by_idx(opened, ".", H5_INDEX_NAME, H5_ITER_INC, i, name,
                                                sizeof name, H5P_DEFAULT);
      keep(length > 0, fmt::format("list {}", group));
      if (length > 0) names.emplace_back(name);
    }
  }
  int count = static_cast<int>(names.size());
  MPI_Bcast(&count, 1, MPI_INT, 0, comm_);
  names.resize(static_cast<std::size_t>(count));
  for (std::string& name : names) broadcast(name, comm_);
  return names;
}

/// Takes the disk space for so many bytes more; false, and a problem, where there is none. HDF5 is
/// asked to write only afterwards: a file that it could not flush it cannot close either, and then
/// it crashes when MPI finalises (HDF5 1.10: "slist already enabled").
bool Hdf5File::reserve(std::size_t bytes) {
  int* descriptor = nullptr;
  hsize_t size = 0;
  if (!problem_.empty() || file_ < 0 || H5Fget_filesize(file_, &size) < 0 ||
      H5Fget_vfd_handle(file_, H5P_DEFAULT, reinterpret_cast<void**>(&descriptor)) < 0)
    return problem_.empty();
  size += bytes + bookkeeping_bytes;
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && size > limit.rlim_cur)
    problem_ = fmt::format(
        "{}: cannot grow beyond {:.4g} MB, the limit on the size of files here (ulimit -f)",
        path_.string(), 1e-6 * static_cast<double>(limit.rlim_cur));
  else if (::fallocate(*descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size)) != 0 &&
           (errno == ENOSPC || errno == EDQUOT || errno == EFBIG))
    problem_ =
        fmt::format("{}: cannot write it to the disk ({})", path_.string(), std::strerror(errno));
  return problem_.empty();
}

/// Gives back what was reserved beyond the end of the file; where that fails it stays reserved.
void Hdf5File::release() const {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path_, ignored);
  if (!ignored) std::filesystem::resize_file(path_, size, ignored);
}

template <class T>
void Hdf5File::write_block(hid_t dataset, const Slab& slab, const T* values) {
  if (dataset < 0 || slab.size() == 0) return;
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const Handle memory(
      H5Screate_simple(static_cast<int>(slab.count.size()), slab.count.data(), nullptr), H5Sclose);
  const bool fine = H5Sselect_hyperslab(space, H5S_SELECT_SET, slab.start.data(), nullptr,
                                        slab.count.data(), nullptr) >= 0 &&
                    H5Dwrite(dataset, type_of<T>(), memory, space, H5P_DEFAULT, values) >= 0;
  keep(fine, "write numbers");
}

template <class T>
void Hdf5File::write(const std::string& dataset, const Slab& slab, const T* values) {
  if (rank_ != 0) {
    send_slab(slab, comm_);
    in_pieces(values, slab.size(), [&](const T* piece, int bytes) {
      MPI_Send(piece, bytes, MPI_BYTE, 0, value_tag, comm_);
    });
    return;
  }
  const Handle space(
      H5Screate_simple(static_cast<int>(slab.extent.size()), slab.extent.data(), nullptr),
      H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);  // every number is written by one rank
  const Slab whole{slab.extent, {}, slab.extent};
  const Handle data(reserve(whole.size() * sizeof(T))
                        ? H5Dcreate2(file_, dataset.c_str(), type_of<T>(), space, H5P_DEFAULT,
                                     properties, H5P_DEFAULT)
                        : -1,
                    H5Dclose);
  keep(data.fine(), fmt::format("make {}", dataset));
  write_block(data, slab, values);
  std::vector<T> received;
  for (int rank = 1; rank < ranks_; ++rank) {
    const Slab part = receive_slab(slab.extent, rank, comm_);
    received.resize(part.size());
    in_pieces(received.data(), received.size(), [&](T* piece, int bytes) {
      MPI_Recv(piece, bytes, MPI_BYTE, rank, value_tag, comm_, MPI_STATUS_IGNORE);
    });
    write_block(data, part, received.data());
  }
}

template <class T>
void Hdf5File::read_block(hid_t dataset, const Slab& slab, T* values) {
  if (dataset < 0 || slab.size() == 0) return;
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const Handle memory(
      H5Screate_simple(static_cast<int>(slab.count.size()), slab.count.data(), nullptr), H5Sclose);
  const bool fine = H5Sselect_hyperslab(space, H5S_SELECT_SET, slab.start.data(), nullptr,
                                        slab.count.data(), nullptr) >= 0 &&
                    H5Dread(dataset, type_of<T>(), memory, space, H5P_DEFAULT, values) >= 0;
  keep(fine, "read numbers");
}

template <class T>
void Hdf5File::read(const std::string& dataset, const Slab& slab, T* values) {
  if (extent_of(dataset) != slab.extent) {
    if (rank_ == 0) keep(false, fmt::format("read {}: it has another size than expected", dataset));
    return;
  }
  if (rank_ != 0) {
    send_slab(slab, comm_);
    in_pieces(values, slab.size(), [&](T* piece, int bytes) {
      MPI_Recv(piece, bytes, MPI_BYTE, 0, value_tag, comm_, MPI_STATUS_IGNORE);
    });
    return;
  }
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  read_block(data, slab, values);
  std::vector<T> sent;
  for (int rank = 1; rank < ranks_; ++rank) {
    const Slab part = receive_slab(slab.extent, rank, comm_);
    sent.assign(part.size(), T{});
    read_block(data, part, sent.data());
    in_pieces(sent.data(), sent.size(), [&](const T* piece, int bytes) {
      MPI_Send(piece, bytes, MPI_BYTE, rank, value_tag, comm_);
    });
  }
}

std::vector<hsize_t> Hdf5File::extent_of(const std::string& dataset) {
  std::vector<hsize_t> extent;
  if (rank_ == 0) {
    const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    keep(data.fine(), fmt::format("find {}", dataset));
    if (data.fine()) {
      const Handle space(H5Dget_space(data), H5Sclose);
      extent.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
      H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    }
  }
  int axes = static_cast<int>(extent.size());
  MPI_Bcast(&axes, 1, MPI_INT, 0, comm_);
  extent.resize(static_cast<std::size_t>(axes));
  MPI_Bcast(extent.data(), axes * static_cast<int>(sizeof(hsize_t)), MPI_BYTE, 0, comm_);
  return extent;
}

bool Hdf5File::holds_integers(const std::string& dataset) {
  int integers = 0;
  if (rank_ == 0) {
    const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(data.fine() ? H5Dget_type(data) : -1, H5Tclose);
    integers = type.fine() && H5Tget_class(type) == H5T_INTEGER;
  }
  MPI_Bcast(&integers, 1, MPI_INT, 0, comm_);
  return integers != 0;
}

void Hdf5File::put_attribute(const std::string& object, const std::string& name, hid_t type,
                             hid_t space, const void* value) {
  const Handle attribute(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space,
                                           H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  keep(attribute.fine() && H5Awrite(attribute, type, value) >= 0,
       fmt::format("write {} of {}", name, object));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  if (rank_ != 0) return;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  put_attribute(object, name, H5T_NATIVE_DOUBLE, space, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::int64_t value) {
  if (rank_ != 0) return;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  put_attribute(object, name, H5T_NATIVE_INT64, space, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::string& value) {
  if (rank_ != 0) return;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  put_attribute(object, name, type, space, value.c_str());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<double>& value) {
  if (rank_ != 0) return;
  const hsize_t length = value.size();
  const Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  put_attribute(object, name, H5T_NATIVE_DOUBLE, space, value.data());
}

template <class T>
T Hdf5File::get_attribute(const std::string& object, const std::string& name) {
  T value{};
  if (rank_ == 0) {
    const Handle attribute(
        H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    keep(attribute.fine() && H5Aread(attribute, type_of<T>(), &value) >= 0,
         fmt::format("read {} of {}", name, object));
  }
  MPI_Bcast(&value, sizeof(T), MPI_BYTE, 0, comm_);
  return value;
}

double Hdf5File::number(const std::string& object, const std::string& name) {
  return get_attribute<double>(object, name);
}

std::int64_t Hdf5File::integer(const std::string& object, const std::string& name) {
  return get_attribute<std::int64_t>(object, name);
}

std::string Hdf5File::text(const std::string& object, const std::string& name) {
  std::string value;
  if (rank_ == 0) {
    const Handle attribute(
        H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Handle type(attribute.fine() ? H5Aget_type(attribute) : -1, H5Tclose);
    bool fine = type.fine() && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    if (fine) {
      value.resize(H5Tget_size(type));
      fine = H5Aread(attribute, type, value.data()) >= 0;
      value.resize(std::min(value.size(), value.find('\0')));
    }
    keep(fine, fmt::format("read {} of {}", name, object));
  }
  broadcast(value, comm_);
  return value;
}

template void Hdf5File::write(const std::string&, const Slab&, const double*);
template void Hdf5File::write(const std::string&, const Slab&, const std::int64_t*);
template void Hdf5File::read(const std::string&, const Slab&, double*);
template void Hdf5File::read(const std::string&, const Slab&, std::int64_t*);

}  // namespace mudlark

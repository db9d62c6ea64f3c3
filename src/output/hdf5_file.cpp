#include "output/hdf5_file.hpp"

#include <fmt/format.h>

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

hid_t open_file(const std::filesystem::path& path, Hdf5File::Mode mode, MPI_Comm comm,
                bool parallel) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Version 1.10 of the format guards all its own bookkeeping with checksums.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V110);
  H5Pset_file_locking(access, false, true);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  if (parallel) {
    H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL);
    H5Pset_all_coll_metadata_ops(access, true);
    H5Pset_coll_metadata_write(access, true);
  }
  if (mode == Hdf5File::Mode::create)
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  const unsigned flags = mode == Hdf5File::Mode::append ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
  return H5Fopen(path.c_str(), flags, access);
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
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // messages come from us, not from HDF5's stack
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  parallel_ = ranks > 1;
  file_ = open_file(path_, mode, comm_, parallel_);
  keep(file_ >= 0, "open it");
  transfer_ = H5Pcreate(H5P_DATASET_XFER);
  if (parallel_) H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE);
  share_problem();
}

Hdf5File::~Hdf5File() {
  if (transfer_ >= 0) H5Pclose(transfer_);
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::keep(bool fine, const std::string& what) {
  if (!fine && problem_.empty())
    problem_ = fmt::format("{}: cannot {} ({})", path_.string(), what, last_reason());
}

void Hdf5File::share_problem() {
  int rank = 0, ranks = 1, first = 0;
  MPI_Comm_rank(comm_, &rank);
  MPI_Comm_size(comm_, &ranks);
  const int mine = problem_.empty() ? ranks : rank;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm_);
  if (first == ranks) return;
  int length = static_cast<int>(problem_.size());
  MPI_Bcast(&length, 1, MPI_INT, first, comm_);
  problem_.resize(static_cast<std::size_t>(length));
  MPI_Bcast(problem_.data(), length, MPI_CHAR, first, comm_);
  // A constructor that throws runs no destructor.
  if (transfer_ >= 0) H5Pclose(std::exchange(transfer_, -1));
  if (file_ >= 0) H5Fclose(std::exchange(file_, -1));
  throw std::runtime_error(problem_);
}

void Hdf5File::close() {
  if (mode_ != Mode::read) keep(H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0, "write it to the disk");
  keep(H5Fclose(std::exchange(file_, -1)) >= 0, "close it");
  share_problem();
}

void Hdf5File::make_group(const std::string& name) {
  const Handle group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
  keep(group.fine(), fmt::format("make the group {}", name));
}

void Hdf5File::remove(const std::string& name) {
  keep(H5Ldelete(file_, name.c_str(), H5P_DEFAULT) >= 0, fmt::format("remove {}", name));
}

bool Hdf5File::has(const std::string& name) {
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) {
  std::vector<std::string> names;
  const Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  const bool fine = opened.fine() && H5Gget_info(opened, &info) >= 0;
  keep(fine, fmt::format("list {}", group));
  if (!fine) return names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    std::string name(255, '\0');
    const ssize_t length = H5Lget_name_by_idx(opened, ".", H5_INDEX_NAME, H5_ITER_INC, i,
                                              name.data(), name.size() + 1, H5P_DEFAULT);
    keep(length > 0, fmt::format("list {}", group));
    if (length <= 0) break;
    name.resize(std::min(name.size(), static_cast<std::size_t>(length)));
    names.push_back(name);
  }
  return names;
}

template <class T>
void Hdf5File::write(const std::string& dataset, const Slab& slab, const T* values) {
  const int axes = static_cast<int>(slab.extent.size());
  const Handle space(H5Screate_simple(axes, slab.extent.data(), nullptr), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);  // every number is written by one rank
  const Handle data(
      H5Dcreate2(file_, dataset.c_str(), type_of<T>(), space, H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose);
  keep(data.fine(), fmt::format("make {}", dataset));
  if (!data.fine() || H5Sget_simple_extent_npoints(space) == 0) return;
  const Handle memory(H5Screate_simple(axes, slab.count.data(), nullptr), H5Sclose);
  if (slab.size() > 0) {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, slab.start.data(), nullptr, slab.count.data(),
                        nullptr);
  } else {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  }
  keep(H5Dwrite(data, type_of<T>(), memory, space, transfer_, values) >= 0,
       fmt::format("write {}", dataset));
}

template <class T>
void Hdf5File::read(const std::string& dataset, const Slab& slab, T* values) {
  const auto extent = extent_of(dataset);
  if (extent != slab.extent) {
    keep(false, fmt::format("read {}: it has another size than expected", dataset));
    return;
  }
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) == 0) return;
  const Handle memory(
      H5Screate_simple(static_cast<int>(slab.count.size()), slab.count.data(), nullptr), H5Sclose);
  if (slab.size() > 0) {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, slab.start.data(), nullptr, slab.count.data(),
                        nullptr);
  } else {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  }
  keep(H5Dread(data, type_of<T>(), memory, space, transfer_, values) >= 0,
       fmt::format("read {}", dataset));
}

std::vector<hsize_t> Hdf5File::extent_of(const std::string& dataset) {
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  keep(data.fine(), fmt::format("find {}", dataset));
  if (!data.fine()) return {};
  const Handle space(H5Dget_space(data), H5Sclose);
  std::vector<hsize_t> extent(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  return extent;
}

bool Hdf5File::holds_integers(const std::string& dataset) {
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(data), H5Tclose);
  return H5Tget_class(type) == H5T_INTEGER;
}

namespace {

bool put_attribute(hid_t file, const std::string& object, const std::string& name, hid_t type,
                   hid_t space, const void* value) {
  const Handle attribute(H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space,
                                           H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  return attribute.fine() && H5Awrite(attribute, type, value) >= 0;
}

template <class T>
bool get_attribute(hid_t file, const std::string& object, const std::string& name, T& value) {
  const Handle attribute(
      H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.fine() && H5Aread(attribute, type_of<T>(), &value) >= 0;
}

}  // namespace

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  keep(put_attribute(file_, object, name, H5T_NATIVE_DOUBLE, space, &value),
       fmt::format("write {}", name));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::int64_t value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  keep(put_attribute(file_, object, name, H5T_NATIVE_INT64, space, &value),
       fmt::format("write {}", name));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::string& value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  keep(put_attribute(file_, object, name, type, space, value.c_str()),
       fmt::format("write {}", name));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<double>& value) {
  const hsize_t length = value.size();
  const Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  keep(put_attribute(file_, object, name, H5T_NATIVE_DOUBLE, space, value.data()),
       fmt::format("write {}", name));
}

double Hdf5File::number(const std::string& object, const std::string& name) {
  double value = 0.0;
  keep(get_attribute(file_, object, name, value), fmt::format("read {} of {}", name, object));
  return value;
}

std::int64_t Hdf5File::integer(const std::string& object, const std::string& name) {
  std::int64_t value = 0;
  keep(get_attribute(file_, object, name, value), fmt::format("read {} of {}", name, object));
  return value;
}

std::string Hdf5File::text(const std::string& object, const std::string& name) {
  const Handle attribute(
      H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  bool fine = attribute.fine();
  std::string value;
  if (fine) {
    const Handle type(H5Aget_type(attribute), H5Tclose);
    fine = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    if (fine) {
      value.resize(H5Tget_size(type));
      fine = H5Aread(attribute, type, value.data()) >= 0;
      value.resize(value.find('\0') == std::string::npos ? value.size() : value.find('\0'));
    }
  }
  keep(fine, fmt::format("read {} of {}", name, object));
  return value;
}

template void Hdf5File::write(const std::string&, const Slab&, const double*);
template void Hdf5File::write(const std::string&, const Slab&, const std::int64_t*);
template void Hdf5File::read(const std::string&, const Slab&, double*);
template void Hdf5File::read(const std::string&, const Slab&, std::int64_t*);

}  // namespace mudlark

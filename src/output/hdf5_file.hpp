#pragma once
/// The little of HDF5 that Mudlark needs: named blocks of numbers written by all ranks together,
/// with attributes.
#include <hdf5.h>
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mudlark {

/// The part of an array that this rank writes or reads: array extents, first index, number of
/// indices (slowest axis first, as in C and NumPy).
struct Slab {
  std::vector<hsize_t> extent, start, count;

  std::size_t size() const;
  /// A list of `total` rows of `width` numbers each (width 1: a plain list), of which this rank has
  /// `rows` from `first` on.
  static Slab rows(std::int64_t total, std::int64_t first, std::int64_t rows, int width = 1);
};

/// One file of all ranks of `comm`. Every member is collective, and what it returns is the same on
/// all ranks. Failures after opening are kept, not thrown, until `close`, which throws on every
/// rank. File locks are off: a run must not stop because someone looks at its results.
class Hdf5File {
 public:
  enum class Mode { create, append, read };

  /// Throws std::runtime_error on every rank when any of them cannot open the file.
  Hdf5File(std::filesystem::path path, Mode mode, MPI_Comm comm);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void make_group(const std::string& name);
  void remove(const std::string& name);
  std::vector<std::string> names_in(const std::string& group);

  /// T is double or std::int64_t.
  template <class T>
  void write(const std::string& dataset, const Slab& slab, const T* values);
  template <class T>
  void read(const std::string& dataset, const Slab& slab, T* values);
  std::vector<hsize_t> extent_of(const std::string& dataset);
  bool holds_integers(const std::string& dataset);

  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, const std::string& value);
  void set_attribute(const std::string& object, const std::string& name,
                     const std::vector<double>& value);
  double number(const std::string& object, const std::string& name);
  std::int64_t integer(const std::string& object, const std::string& name);
  std::string text(const std::string& object, const std::string& name);

  bool failed();
  /// Sends everything to the disk and closes. Throws std::runtime_error on every rank when anything
  /// failed on any rank since opening.
  void close();

 private:
  template <class T>
  void write_block(hid_t dataset, const Slab& slab, const T* values);
  template <class T>
  void read_block(hid_t dataset, const Slab& slab, T* values);
  void put_attribute(const std::string& object, const std::string& name, hid_t type, hid_t space,
                     const void* value);
  template <class T>
  T get_attribute(const std::string& object, const std::string& name);
  void keep(bool fine, const std::string& what);
  bool reserve(std::size_t bytes);
  void release() const;
  void share_problem();

  std::filesystem::path path_;
  MPI_Comm comm_;
  Mode mode_;
  int rank_ = 0, ranks_ = 1;
  hid_t file_ = -1;  ///< on rank 0
  std::string problem_;
};

}  // namespace mudlark

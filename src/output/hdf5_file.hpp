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

/// One file, open on all ranks of `comm`. Every member is collective. Failures after opening are
/// kept, not thrown, so that no rank leaves a collective call that others wait in; `close` tells
/// every rank of them. File locks are off: a run must not stop because someone looks at its
/// results.
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
  bool has(const std::string& name);

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

  bool failed() const { return !problem_.empty(); }
  /// Sends everything to the disk and closes. Throws std::runtime_error on every rank when anything
  /// failed on any rank since opening.
  void close();

 private:
  void keep(bool fine, const std::string& what);
  void share_problem();

  std::filesystem::path path_;
  MPI_Comm comm_;
  Mode mode_;
  bool parallel_ = false;
  hid_t file_ = -1, transfer_ = -1;
  std::string problem_;
};

}  // namespace mudlark

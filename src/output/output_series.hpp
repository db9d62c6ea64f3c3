#pragma once
/// A file of results at several times (fields.h5, points.h5) and the XDMF file that shows it to
/// ParaView.
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/hdf5_file.hpp"

namespace mudlark {

/// What the XDMF file needs to know of one array.
struct StoredArray {
  std::string dataset;  ///< its name in the HDF5 file: the quantity's name with _ for blanks
  std::string name, unit;
  int components = 1;  ///< 1 scalar, 3 vector (x y z), 6 symmetric tensor (xx yy zz xy yz zx)
  bool integers = false;
};

/// One output time: a group of the HDF5 file.
struct StoredOutput {
  std::string group;  ///< "/000012"
  double time = 0.0;  ///< [s]
  std::int64_t step = 0;
  std::int64_t count = 0;  ///< rows of each array (material points, or cells)
  std::vector<StoredArray> arrays;
};

/// Keeps the HDF5 file and its XDMF companion in step. The HDF5 file is open only while an output
/// is written, and the XDMF file is replaced as a whole afterwards, so a killed run leaves both
/// readable.
class OutputSeries {
 public:
  using Describe = std::function<std::string(const std::vector<StoredOutput>&)>;
  using Fill = std::function<void(Hdf5File&, StoredOutput&)>;

  /// `name`: "fields" makes fields.h5 and fields.xdmf in `folder`. Without `resumed_at` the series
  /// starts empty; with it, outputs later than that time are removed and the others kept.
  /// `describe` makes the text of the XDMF file. Throws InputError when the folder cannot be
  /// written. Collective.
  OutputSeries(std::filesystem::path folder, std::string name, MPI_Comm comm,
               std::optional<double> resumed_at, Describe describe);

  /// Adds an output; `fill` writes its arrays and lists them. An output at this time or later that
  /// is already there is replaced. Collective.
  void write(double time, std::int64_t step, const Fill& fill);

  const std::vector<StoredOutput>& outputs() const { return outputs_; }

 private:
  std::filesystem::path data_path() const { return folder_ / (name_ + ".h5"); }
  void start_empty();
  void pick_up(double time);
  void remove_outputs(Hdf5File& file, const std::function<bool(const StoredOutput&)>& unwanted);
  void write_xdmf() const;

  std::filesystem::path folder_;
  std::string name_;
  MPI_Comm comm_;
  Describe describe_;
  std::vector<StoredOutput> outputs_;
  std::int64_t next_number_ = 0;
};

/// Name of a dataset for a quantity: blanks and slashes become _.
std::string dataset_name(const std::string& quantity);

/// Writes one array into an output and notes it there, with name and unit as attributes.
template <class T>
void store_array(Hdf5File& file, StoredOutput& output, StoredArray array, const Slab& slab,
                 const T* values);

}  // namespace mudlark

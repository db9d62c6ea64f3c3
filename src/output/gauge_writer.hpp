#pragma once
/// Time series of one gauge: gauges/NAME.csv.
#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mudlark {

/// Last, smallest and largest value of each column over the whole run, resumed parts included.
struct GaugeExtremes {
  double time = 0.0;  ///< of the last sample [s]
  std::vector<double> last, smallest, largest;
};

/// Rank 0 writes; the other ranks call the same members and only take part in `flush`. Numbers have
/// 17 digits, so what is read back is the same double.
class GaugeWriter {
 public:
  /// `columns`: titles with units, time left out, as "settlement [m]".
  /// Starts FOLDER/gauges/NAME.csv with its header, or, with `resumed_at` [s], keeps the complete
  /// rows up to that time and cuts off the rest. A name with characters other than letters, digits,
  /// blank, . _ - is refused (InputError), so is a folder that cannot be written. Collective.
  GaugeWriter(MPI_Comm comm, const std::filesystem::path& folder, std::string name,
              std::vector<std::string> columns, std::optional<double> resumed_at = std::nullopt);

  /// Adds a row; values as many as columns, the same as on rank 0. A time not later than the last
  /// row's is left out: that row is there already (first sample after resuming). Not collective.
  void sample(double time, std::span<const double> values);

  /// Hands all rows to the operating system; call it before a checkpoint is written, or a resumed
  /// run misses rows. Throws std::runtime_error on every rank when rows could not be written.
  /// Collective.
  void flush();

  const std::string& name() const { return name_; }
  const std::vector<std::string>& columns() const { return columns_; }
  /// Known on rank 0; empty before the first sample.
  const std::optional<GaugeExtremes>& extremes() const { return extremes_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string header() const;
  void start(bool resume, double resumed_at);
  std::string keep_rows(double resumed_at);
  void note(double time, std::span<const double> values);

  MPI_Comm comm_;
  int rank_ = 0;
  std::filesystem::path file_path_;
  std::string name_;
  std::vector<std::string> columns_;
  std::unique_ptr<std::FILE, Close> file_;
  std::string problem_;
  std::optional<GaugeExtremes> extremes_;
};

}  // namespace mudlark

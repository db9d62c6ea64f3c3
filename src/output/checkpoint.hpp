#pragma once
/// Saving and loading the whole state of a run: results/checkpoint/state-A.h5 and state-B.h5, the
/// last two good ones. Both classes below are archives as output/archive.hpp describes them.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid/field.hpp"
#include "grid/grid.hpp"
#include "output/checkpoint_file.hpp"
#include "output/hdf5_file.hpp"

namespace mudlark {

/// Saves a state:
///
///   CheckpointWriter<D> archive(grid, results / "checkpoint", case_text, step, time);
///   flow.archive(archive);  soil.archive(archive);
///   archive.commit();
///
/// The file is written under a temporary name, forced to the disk and renamed over the older of the
/// two states, so the newer one stays good whatever happens meanwhile. Every number enters a
/// checksum that does not depend on how the ranks share the grid. All members are collective.
///
/// What is stored: cells that a rank owns, faces that it owns (the closing face of the domain
/// included) and points in the order of the ranks. Ghost values are not stored: whoever owns the
/// state restores them after loading (halo exchange and walls) before anything reads them.
template <int D>
class CheckpointWriter {
 public:
  static constexpr bool loading = false;

  /// `case_text`: what must be equal for a state to be continued (the resolved input). Throws
  /// InputError when the folder cannot be written.
  CheckpointWriter(const Grid<D>& grid, std::filesystem::path folder, const std::string& case_text,
                   std::int64_t step, double time);

  void number(const std::string& name, const double& value);
  void number_if_known(const std::string& name, const double& value) { number(name, value); }
  void integer(const std::string& name, const std::int64_t& value);
  void cells(const std::string& name, const CellField<D>& field);
  void faces(const std::string& name, const FaceVector<D>& vector);
  void points(const std::string& name, const std::vector<double>& values, int per_point);
  void point_ids(const std::string& name, const std::vector<std::int64_t>& ids);

  /// Makes the state valid. Throws std::runtime_error on every rank when anything could not be
  /// written; the earlier states are then untouched.
  void commit();

 private:
  template <class T>
  void store(const std::string& name, const Slab& slab, const T* values);
  template <class T>
  void store_points(const std::string& name, const std::vector<T>& values, int per_point);

  const Grid<D>* grid_;
  std::filesystem::path folder_, target_;
  std::unique_ptr<Hdf5File> file_;
  checkpoint_file::Header header_;
};

/// Loads the newest good state; its archive calls are those of the writer, in any order.
///
/// With as many ranks as the state was saved with, each rank gets its points back in their order.
/// With another number, points are shared out evenly in their stored order and belong to no
/// particular rank: the soil solver migrates them. Fields fit any number of ranks.
template <int D>
class CheckpointReader {
 public:
  static constexpr bool loading = true;

  /// Checks the states, newest first. A damaged one is told to `note` (rank 0), renamed *.damaged
  /// and passed over. Throws InputError when no good state is there or it belongs to another case,
  /// grid or version.
  CheckpointReader(const Grid<D>& grid, const std::filesystem::path& folder,
                   const std::string& case_text,
                   const std::function<void(const std::string&)>& note = {});

  std::int64_t step() const { return step_; }
  double time() const { return time_; }  ///< [s]
  int saved_ranks() const { return saved_ranks_; }

  void number(const std::string& name, double& value);
  /// Leaves the value as it is when the state knows nothing of that name.
  void number_if_known(const std::string& name, double& value);
  void integer(const std::string& name, std::int64_t& value);
  void cells(const std::string& name, CellField<D>& field);
  void faces(const std::string& name, FaceVector<D>& vector);
  void points(const std::string& name, std::vector<double>& values, int per_point);
  void point_ids(const std::string& name, std::vector<std::int64_t>& ids);

  /// Throws std::runtime_error on every rank when anything asked for could not be read. Call it
  /// after all archive calls and before the state is used.
  void finish();

 private:
  std::optional<checkpoint_file::Header> newest_good_state(
      const std::filesystem::path& folder, const std::function<void(const std::string&)>& note);
  template <class T>
  void load_single(const std::string& name, T& value);
  template <class T>
  void load_points(const std::string& name, std::vector<T>& values, int per_point);

  const Grid<D>* grid_;
  std::unique_ptr<Hdf5File> file_;
  std::int64_t step_ = 0;
  double time_ = 0.0;
  int saved_ranks_ = 0;
};

/// Removes the states of an earlier run, so that a fresh start cannot be continued from them.
/// Collective.
void remove_checkpoints(const std::filesystem::path& folder, MPI_Comm comm);

extern template class CheckpointWriter<2>;
extern template class CheckpointWriter<3>;
extern template class CheckpointReader<2>;
extern template class CheckpointReader<3>;

}  // namespace mudlark

#pragma once
/// The results folder of a run: fields, points, gauges, checkpoints, summary, log.
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "output/field_writer.hpp"
#include "output/gauge_writer.hpp"
#include "output/point_writer.hpp"
#include "output/summary.hpp"
#include "run/world.hpp"

namespace mudlark {

template <int D>
class Results {
 public:
  /// Opens the folder; with `resumed_at` [s] earlier results up to then are kept. Collective.
  Results(World<D>& world, std::filesystem::path folder, std::optional<double> resumed_at);

  /// Writes what is due at the world's present time. Collective.
  void write_due(World<D>& world);
  /// Writes fields and points now, due or not. Collective.
  void write_fields(World<D>& world);
  /// Saves the state to continue from. Collective.
  void write_checkpoint(World<D>& world);
  /// Writes summary.json. Collective.
  void write_summary(World<D>& world, const std::string& status, const std::string& message);
  /// Adds a line to log.txt (rank 0).
  void log(const std::string& line);

  const std::filesystem::path& folder() const { return folder_; }

 private:
  void write_points(World<D>& world);
  void write_gauges(World<D>& world);
  Summary describe(World<D>& world) const;

  std::filesystem::path folder_;
  bool resumed_;
  double started_;  ///< wall clock [s]
  std::optional<FieldWriter<D>> fields_;
  std::vector<PointWriter> points_;
  std::vector<GaugeWriter> gauges_;
  std::ofstream log_;
  std::optional<double> last_output_;
};

extern template class Results<2>;
extern template class Results<3>;

}  // namespace mudlark

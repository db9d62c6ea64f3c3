#pragma once
/// Material points for pictures and evaluation: points.h5 and points.xdmf.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/output_series.hpp"

namespace mudlark {

/// One quantity of this rank's points: an array of one value per point for each component.
/// 1 component: scalar; 2: vector (x z) in 2D; 3: vector; 6: symmetric tensor xx yy zz xy yz zx.
/// Other numbers of components are stored, but not shown to ParaView.
struct PointArray {
  std::string name, unit;
  std::vector<const double*> components;
};

/// The number of points may differ from rank to rank and from time to time; their order in the file
/// is that of the ranks, so follow a point by its id. Vectors of two components are stored as (x,
/// 0, z).
class PointWriter {
 public:
  /// The series starts empty, or with what the earlier run wrote up to `resumed_at` [s].
  /// Collective.
  PointWriter(MPI_Comm comm, const std::filesystem::path& folder,
              std::optional<double> resumed_at = std::nullopt);

  /// Adds the points at `time` [s]. `arrays` has the same names on every rank and one named
  /// "position". Collective.
  void write(double time, std::int64_t step, std::span<const std::int64_t> ids,
             std::span<const PointArray> arrays);

  const std::vector<StoredOutput>& outputs() const { return series_.outputs(); }

 private:
  MPI_Comm comm_;
  OutputSeries series_;
};

}  // namespace mudlark

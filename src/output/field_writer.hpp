#pragma once
/// Grid fields for pictures and evaluation: fields.h5 and fields.xdmf.
#include <filesystem>
#include <optional>
#include <span>

#include "grid/field.hpp"
#include "grid/grid.hpp"
#include "output/output_series.hpp"

namespace mudlark {

/// Writes cell fields as they are and face vectors averaged to the cell centres, u_i = (u_i- +
/// u_i+) / 2. Arrays in the file: [z][y][x], in 2D with one layer along y; vectors have three
/// components more (x y z, in 2D y = 0).
template <int D>
class FieldWriter {
 public:
  /// The series starts empty, or with what the earlier run wrote up to `resumed_at` [s].
  /// Collective.
  FieldWriter(const Grid<D>& grid, const std::filesystem::path& folder,
              std::optional<double> resumed_at = std::nullopt);

  /// Adds the state at `time` [s]. Ghost values need not be up to date. Collective.
  void write(double time, std::int64_t step, std::span<const CellField<D>* const> cells,
             std::span<const FaceVector<D>* const> faces);

  const std::vector<StoredOutput>& outputs() const { return series_.outputs(); }

 private:
  Slab slab(int components) const;
  void store(Hdf5File& file, StoredOutput& output, const CellField<D>& field);
  void store(Hdf5File& file, StoredOutput& output, const FaceVector<D>& vector);

  const Grid<D>* grid_;
  OutputSeries series_;
};

extern template class FieldWriter<2>;
extern template class FieldWriter<3>;

}  // namespace mudlark

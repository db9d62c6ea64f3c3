#include "output/field_writer.hpp"

#include <fmt/format.h>

#include <array>

#include "grid/halo.hpp"
#include "output/xdmf.hpp"

namespace mudlark {
namespace {

template <int D>
std::vector<double> faces_of(const Grid<D>& grid, int axis) {
  std::vector<double> faces;
  for (int i = 0; i <= grid.cells()[axis]; ++i) faces.push_back(grid.face_position(axis, i));
  return faces;
}

template <int D>
XdmfGrid shown_grid(const Grid<D>& grid) {
  XdmfGrid shown;
  shown.spacing[1] = grid.spacing()[0];
  shown.cells[1] = 1;
  for (int a = 0; a < D; ++a) {
    const auto to = static_cast<std::size_t>(a == D - 1 ? 2 : a);
    shown.lower[to] = grid.lower()[a];
    shown.spacing[to] = grid.spacing()[a];
    shown.cells[to] = grid.cells()[a];
    if (grid.stretched(a)) shown.faces[to] = faces_of(grid, a);
  }
  return shown;
}

template <int D>
std::size_t cell_count(const IndexBox<D>& box) {
  std::size_t n = 1;
  for (int a = 0; a < D; ++a) n *= static_cast<std::size_t>(box.upper[a] - box.lower[a]);
  return n;
}

}  // namespace

template <int D>
FieldWriter<D>::FieldWriter(const Grid<D>& grid, const std::filesystem::path& folder,
                            std::optional<double> resumed_at)
    : grid_(&grid),
      series_(folder, "fields", grid.comm(), resumed_at,
              [shown = shown_grid(grid)](const std::vector<StoredOutput>& outputs) {
                return xdmf_of_fields("fields.h5", shown, outputs);
              }) {}

template <int D>
Slab FieldWriter<D>::slab(int components) const {
  Slab slab;
  const auto add = [&](int extent, int start, int count) {
    slab.extent.push_back(static_cast<hsize_t>(extent));
    slab.start.push_back(static_cast<hsize_t>(start));
    slab.count.push_back(static_cast<hsize_t>(count));
  };
  const IndexBox<D>& owned = grid_->owned();
  for (int a = D - 1; a >= 0; --a) {
    if (D == 2 && a == 0) add(1, 0, 1);  // the one layer along y
    add(grid_->cells()[a], owned.lower[a], owned.upper[a] - owned.lower[a]);
  }
  if (components > 1) add(components, 0, components);
  return slab;
}

template <int D>
void FieldWriter<D>::write(double time, std::int64_t step,
                           std::span<const CellField<D>* const> cells,
                           std::span<const FaceVector<D>* const> faces) {
  series_.write(time, step, [&](Hdf5File& file, StoredOutput& output) {
    output.count = 1;
    std::vector<double> lower, spacing;
    for (int a = 0; a < D; ++a) {
      output.count *= grid_->cells()[a];
      lower.push_back(grid_->lower()[a]);
      spacing.push_back(grid_->spacing()[a]);
    }
    file.set_attribute(output.group, "lower", lower);
    file.set_attribute(output.group, "spacing", spacing);
    for (int a = 0; a < D; ++a)
      if (grid_->stretched(a))
        file.set_attribute(output.group, fmt::format("faces_{}", "xyz"[a == D - 1 ? 2 : a]),
                           faces_of(*grid_, a));
    for (const CellField<D>* field : cells) store(file, output, *field);
    for (const FaceVector<D>* vector : faces) store(file, output, *vector);
  });
}

template <int D>
void FieldWriter<D>::store(Hdf5File& file, StoredOutput& output, const CellField<D>& field) {
  std::vector<double> values;
  values.reserve(cell_count(grid_->owned()));
  for_each(grid_->owned(), [&](const Index<D>& cell) { values.push_back(field[cell]); });
  store_array(file, output, {"", field.name(), field.unit(), 1, false}, slab(1), values.data());
}

template <int D>
void FieldWriter<D>::store(Hdf5File& file, StoredOutput& output, const FaceVector<D>& vector) {
  std::vector<double> values(3 * cell_count(grid_->owned()));
  Halo<D> halo(*grid_);
  for (int a = 0; a < D; ++a) {
    FaceField<D> faces =
        vector[a].copy();  // the upper face of the last own cell may be a neighbour's
    const std::array<double*, 1> one{faces.data()};
    halo.exchange(one);
    std::size_t at = static_cast<std::size_t>(a == D - 1 ? 2 : a);
    for_each(grid_->owned(), [&](const Index<D>& cell) {
      values[at] = 0.5 * (faces[cell] + faces[cell.shifted(a, 1)]);
      at += 3;
    });
  }
  store_array(file, output, {"", vector.name(), vector.unit(), 3, false}, slab(3), values.data());
}

template class FieldWriter<2>;
template class FieldWriter<3>;

}  // namespace mudlark

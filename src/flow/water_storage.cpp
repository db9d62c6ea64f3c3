#include "flow/water_storage.hpp"

#include "numerics/loops.hpp"

namespace mudlark {

template <int D>
WaterStorage<D>::WaterStorage(const Grid<D>& grid, double compressibility)
    : grid_(&grid),
      compressibility_(compressibility),
      stored_(grid, "stored water", "1"),
      gives_way_(grid, "storage", "1/(Pa s)"),
      before_(grid, "pressure before", "Pa") {}

template <int D>
const CellField<D>& WaterStorage<D>::with_water(const CellField<D>& give_way,
                                                const CellField<D>& water,
                                                const CellField<D>& pressure, double dt) {
  before_.copy_values_from(pressure);
  const double rate = compressibility_ / dt;
  const double *given = give_way.data(), *w = water.data();
  double* sum = gives_way_.data();
  for_each_offset(*grid_, grid_->owned(),
                  [&](std::ptrdiff_t at) { sum[at] = given[at] + rate * w[at]; });
  return gives_way_;
}

template <int D>
void WaterStorage<D>::count(const CellField<D>& water, const CellField<D>& unknown,
                            const CellField<D>& pressure) {
  const double *w = water.data(), *acts = unknown.data(), *p = pressure.data();
  const double* before = before_.data();
  double* stored = stored_.data();
  for_each_offset(*grid_, grid_->owned(), [&](std::ptrdiff_t at) {
    const double more = compressibility_ * w[at] * (p[at] - before[at]);
    stored[at] = acts[at] > 0.0 ? stored[at] + more : 0.0;
  });
}

template class WaterStorage<2>;
template class WaterStorage<3>;

}  // namespace mudlark

#include "flow/rain.hpp"

#include <algorithm>

#include "numerics/loops.hpp"

namespace mudlark {

template <int D>
Rain<D>::Rain(const Grid<D>& grid, const std::vector<RainOptions>& options)
    : grid_(&grid), rains_(options) {
  std::size_t columns = 1;
  for (int a = 0; a < D - 1; ++a) columns *= static_cast<std::size_t>(grid.cells()[a]);
  amounts_.resize(empty() ? 0 : columns);
  targets_.resize(empty() ? 0 : columns);
}

template <int D>
std::size_t Rain<D>::column(const Index<D>& cell) const {
  int number = cell[0];
  if constexpr (D == 3) number += grid_->cells()[0] * cell[1];
  return static_cast<std::size_t>(number);
}

/// A cell that has no room, or is a body, leaves it to the one above.
template <int D>
void Rain<D>::find_targets(const CellField<D>& ground, const CellField<D>& porosity,
                           const CellField<D>& water) {
  std::fill(targets_.begin(), targets_.end(), 0);
  for_each(grid_->owned(), [&](const Index<D>& cell) {
    const double theta = porosity[cell], w = water[cell];
    if (theta > 0.0 && ground[cell] == 0.0 && 2.0 * w < theta) return;
    const std::size_t c = column(cell);
    const bool takes = theta > 0.0 && theta - w >= amounts_[c];
    targets_[c] = std::max(targets_[c], cell[D - 1] + (takes ? 0 : 1));
  });
  MPI_Allreduce(MPI_IN_PLACE, targets_.data(), static_cast<int>(targets_.size()), MPI_INT, MPI_MAX,
                grid_->comm());
}

template <int D>
double Rain<D>::fall(const CellField<D>& ground, const CellField<D>& porosity, double time,
                     double dt, CellField<D>& water) {
  if (empty()) return 0.0;
  const Grid<D>& grid = *grid_;
  std::fill(amounts_.begin(), amounts_.end(), 0.0);
  IndexBox<D> floor = grid.owned();  // the columns of this rank
  if (!floor.empty()) floor.upper[D - 1] = floor.lower[D - 1] + 1;
  for_each(floor, [&](const Index<D>& cell) {
    Index<D> foot = cell;  // the same place whatever part of the column is this rank's
    foot[D - 1] = 0;
    const Point3 place = to_point3(grid.cell_centre(foot));
    double area = 1.0;  // of mean cells
    for (int a = 0; a < D - 1; ++a) area *= grid.width(a, cell[a]) / grid.spacing()[a];
    for (const RainOptions& rain : rains_) {
      bool under = true;
      for (std::size_t a = 0; a + 1 < D; ++a)
        under = under && place[a] >= rain.from[a] && place[a] < rain.to[a];
      if (under)
        amounts_[column(cell)] +=
            rain.intensity(place, time + 0.5 * dt) * dt * area / grid.spacing()[D - 1];
    }
  });
  find_targets(ground, porosity, water);
  double added = 0.0;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const std::size_t c = column(cell);
    if (targets_[c] != cell[D - 1]) return;
    const double takes = std::clamp(porosity[cell] - water[cell], 0.0, amounts_[c]);
    water[cell] += takes;
    added += takes;
  });
  return added * grid.cell_volume();
}

template class Rain<2>;
template class Rain<3>;

}  // namespace mudlark

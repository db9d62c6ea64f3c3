#include "soil/placing.hpp"

#include <cmath>

namespace mudlark {
namespace {

int floor_division(int value, int by) { return value / by - (value % by < 0 ? 1 : 0); }

}  // namespace

template <int D>
TakenSites<D>::TakenSites(const Grid<D>& grid, int per_axis) : grid_(&grid), per_axis_(per_axis) {
  for (int a = 0; a < D; ++a) per_cell_ *= static_cast<std::size_t>(per_axis);
  taken_.assign(grid.local_size() * per_cell_, 0.0);
}

/// Where a site's count stands, or -1 when it lies outside this rank's local box.
template <int D>
std::ptrdiff_t TakenSites<D>::at(const Index<D>& site) const {
  Index<D> cell;
  std::ptrdiff_t sub = 0;
  for (int a = D - 1; a >= 0; --a) {
    cell[a] = floor_division(site[a], per_axis_);
    sub = sub * per_axis_ + site[a] - cell[a] * per_axis_;
  }
  if (!grid_->local().contains(cell)) return -1;
  return grid_->offset(cell) * static_cast<std::ptrdiff_t>(per_cell_) + sub;
}

template <int D>
void TakenSites<D>::add(const SoilParticles<D>& points) {
  constexpr double hair = 1e-6;  // sites whose centre lies on the box's edge are free
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double half =
        0.5 * per_axis_ * std::pow(points.volume[p] / grid_->cell_volume(), 1.0 / D) - hair;
    IndexBox<D> box;
    for (int a = 0; a < D; ++a) {
      const double middle =
          (points.position[a][p] - grid_->lower()[a]) / grid_->spacing()[a] * per_axis_ - 0.5;
      box.lower[a] = static_cast<int>(std::ceil(middle - half));
      box.upper[a] = static_cast<int>(std::floor(middle + half)) + 1;
    }
    for_each(box, [&](const Index<D>& site) {
      if (const std::ptrdiff_t place = at(site); place >= 0)
        taken_[static_cast<std::size_t>(place)] += 1.0;
    });
  }
}

template <int D>
void TakenSites<D>::gather() {
  const std::array<double*, 1> counts{taken_.data()};
  Halo<D>(*grid_).add_to_owners(counts, per_cell_);
}

template <int D>
void TakenSites<D>::clear(SoilParticles<D>& fresh) const {
  std::vector<char> gone(fresh.size(), 0);
  for (std::size_t p = 0; p < fresh.size(); ++p) {
    Index<D> site;
    for (int a = 0; a < D; ++a)
      site[a] = static_cast<int>(
          std::floor((fresh.position[a][p] - grid_->lower()[a]) / grid_->spacing()[a] * per_axis_));
    const std::ptrdiff_t place = at(site);
    gone[p] = place >= 0 && taken_[static_cast<std::size_t>(place)] > 0.0;
  }
  remove_points(fresh, gone);
}

template class TakenSites<2>;
template class TakenSites<3>;

}  // namespace mudlark

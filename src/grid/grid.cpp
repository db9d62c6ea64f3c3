#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>

namespace mudlark {

template <int D>
Grid<D>::Grid(const DomainOptions& options, MPI_Comm comm) {
  std::array<bool, D> wraps{};
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    cells_[a] = options.cells[u];
    lower_[a] = options.lower[u];
    spacing_[a] = (options.upper[u] - options.lower[u]) / options.cells[u];
    gravity_[a] = options.gravity[u];
    walls_[u] = options.walls[u];
    wall_friction_[u] = options.wall_friction[u];
    volume_ *= spacing_[a];
    wraps[u] = walls_[u][0] == Wall::periodic;
  }
  partition_ = make_partition<D>(comm, cells_, wraps, ghost_layers);
  local_ = partition_.owned.grown(ghost_layers);
  for (int a = 0; a < D; ++a) {
    strides_[static_cast<std::size_t>(a)] = static_cast<std::ptrdiff_t>(local_size_);
    local_size_ *= static_cast<std::size_t>(local_.upper[a] - local_.lower[a]);
  }
}

template <int D>
Vec<D> Grid<D>::upper() const {
  Vec<D> corner = lower_;
  for (int a = 0; a < D; ++a) corner[a] += cells_[a] * spacing_[a];
  return corner;
}

template <int D>
double Grid<D>::smallest_spacing() const {
  return *std::min_element(spacing_.component.begin(), spacing_.component.end());
}

template <int D>
IndexBox<D> Grid<D>::owned_faces(int axis) const {
  return owned().extended(axis, touches(axis, 1) ? 1 : 0);
}

template <int D>
bool Grid<D>::touches(int axis, int side) const {
  return partition_.neighbour[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] ==
         MPI_PROC_NULL;
}

template <int D>
Vec<D> Grid<D>::cell_centre(const Index<D>& cell) const {
  Vec<D> centre;
  for (int a = 0; a < D; ++a) centre[a] = lower_[a] + (cell[a] + 0.5) * spacing_[a];
  return centre;
}

template <int D>
Vec<D> Grid<D>::face_centre(int axis, const Index<D>& face) const {
  Vec<D> centre = cell_centre(face);
  centre[axis] = lower_[axis] + face[axis] * spacing_[axis];
  return centre;
}

template <int D>
Index<D> Grid<D>::cell_at(const Vec<D>& position) const {
  Index<D> cell;
  for (int a = 0; a < D; ++a)
    cell[a] = static_cast<int>(std::floor((position[a] - lower_[a]) / spacing_[a]));
  return cell;
}

template class Grid<2>;
template class Grid<3>;

}  // namespace mudlark

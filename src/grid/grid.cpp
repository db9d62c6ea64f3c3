#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>

namespace mudlark {
namespace {

/// Faces of a stretched axis with those of the ghost layers: mirrored at walls, continued around
/// periodic ends. A domain thinner than the layers repeats its last cell.
std::vector<double> with_ghosts(const std::vector<double>& faces, bool periodic) {
  const int cells = static_cast<int>(faces.size()) - 1;
  const auto width = [&](int cell) {
    const auto c = static_cast<std::size_t>(std::clamp(cell, 0, cells - 1));
    return faces[c + 1] - faces[c];
  };
  std::vector<double> all = faces;
  for (int layer = 0; layer < ghost_layers; ++layer) {
    all.insert(all.begin(), all.front() - width(periodic ? cells - 1 - layer : layer));
    all.push_back(all.back() + width(periodic ? layer : cells - 1 - layer));
  }
  return all;
}

}  // namespace

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
    if (!options.faces[u].empty()) faces_[u] = with_ghosts(options.faces[u], wraps[u]);
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
  Vec<D> corner;
  for (int a = 0; a < D; ++a) corner[a] = face_position(a, cells_[a]);
  return corner;
}

template <int D>
double Grid<D>::smallest_spacing() const {
  double smallest = spacing_[0];
  for (int a = 0; a < D; ++a) {
    smallest = std::min(smallest, spacing_[a]);
    for (int c = 0; stretched(a) && c < cells_[a]; ++c) smallest = std::min(smallest, width(a, c));
  }
  return smallest;
}

template <int D>
bool Grid<D>::stretched() const {
  return std::any_of(faces_.begin(), faces_.end(), [](const auto& f) { return !f.empty(); });
}

template <int D>
double Grid<D>::face_position(int axis, int face) const {
  return stretched(axis)
             ? faces_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(face + ghost_layers)]
             : lower_[axis] + face * spacing_[axis];
}

template <int D>
double Grid<D>::width(int axis, int cell) const {
  return stretched(axis) ? face_position(axis, cell + 1) - face_position(axis, cell)
                         : spacing_[axis];
}

template <int D>
double Grid<D>::gap(int axis, int face) const {
  return stretched(axis) ? 0.5 * (face_position(axis, face + 1) - face_position(axis, face - 1))
                         : spacing_[axis];
}

template <int D>
int Grid<D>::index_along(int axis, std::ptrdiff_t at) const {
  const std::ptrdiff_t within = axis + 1 < D ? at % stride(axis + 1) : at;
  return static_cast<int>(within / stride(axis)) + local_.lower[axis];
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
  for (int a = 0; a < D; ++a)
    centre[a] = stretched(a) ? face_position(a, cell[a]) + 0.5 * width(a, cell[a])
                             : lower_[a] + (cell[a] + 0.5) * spacing_[a];
  return centre;
}

template <int D>
Vec<D> Grid<D>::face_centre(int axis, const Index<D>& face) const {
  Vec<D> centre = cell_centre(face);
  centre[axis] = face_position(axis, face[axis]);
  return centre;
}

template <int D>
Index<D> Grid<D>::cell_at(const Vec<D>& position) const {
  Index<D> cell;
  for (int a = 0; a < D; ++a) {
    const auto& faces = faces_[static_cast<std::size_t>(a)];
    cell[a] = faces.empty()
                  ? static_cast<int>(std::floor((position[a] - lower_[a]) / spacing_[a]))
                  : static_cast<int>(std::upper_bound(faces.begin(), faces.end(), position[a]) -
                                     faces.begin()) -
                        1 - ghost_layers;
  }
  return cell;
}

template class Grid<2>;
template class Grid<3>;

}  // namespace mudlark

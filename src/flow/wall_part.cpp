#include "flow/wall_part.hpp"

#include <algorithm>
#include <cmath>

namespace mudlark {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

/// What counts as touching, as a share of a cell.
constexpr double touch = 1e-9;
/// Surfaces whose components have centres nearer to each other than this, as a share of a cell, are
/// planes.
constexpr double plane = 1e-3;

/// A cell, one metre thick in the plane.
template <int D>
BoxShape box_of_cell(const Grid<D>& grid, const Index<D>& cell) {
  BoxShape box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  for (int a = 0; a < D; ++a) {
    const auto c = static_cast<std::size_t>(axis_in_space<D>(a));
    box.lower[c] = grid.face_centre(a, cell)[a];
    box.upper[c] = grid.face_centre(a, cell.shifted(a, 1))[a];
  }
  return box;
}

BoxShape common(const BoxShape& one, const BoxShape& other) {
  BoxShape box;
  for (std::size_t a = 0; a < 3; ++a) {
    box.lower[a] = std::max(one.lower[a], other.lower[a]);
    box.upper[a] = std::min(one.upper[a], other.upper[a]);
  }
  return box;
}

/// Sutherland & Hodgman (1974): what of a polygon lies on one side of a plane across an axis.
Corners clipped(const Corners& corners, int axis, double bound, double sign) {
  Corners left;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d &one = corners[i], &next = corners[(i + 1) % corners.size()];
    const double a = sign * (bound - one[axis]), b = sign * (bound - next[axis]);
    if (a >= 0.0) left.push_back(one);
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
      left.push_back(one + a / (a - b) * (next - one));
  }
  return left;
}

struct Polygon {
  double area = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// What of the plane through a place lies in a box, a little of which counts as touching.
Polygon in_box(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, const BoxShape& box,
               double size) {
  const Eigen::Vector3d one = normal.unitOrthogonal(), two = normal.cross(one);
  const double far = 4.0 * std::max(size, 1.0);
  Corners corners;
  for (const auto& [s, t] : {std::pair{-far, -far}, {far, -far}, {far, far}, {-far, far}})
    corners.emplace_back(place + s * one + t * two);
  for (int a = 0; a < 3; ++a) {
    corners = clipped(corners, a, box.upper[static_cast<std::size_t>(a)] + touch * size, 1.0);
    corners = clipped(corners, a, box.lower[static_cast<std::size_t>(a)] - touch * size, -1.0);
  }
  Polygon polygon;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const double area = 0.5 * (corners[k - 1] - corners[0]).cross(corners[k] - corners[0]).norm();
    polygon.area += area;
    polygon.centre += area / 3.0 * (corners[0] + corners[k - 1] + corners[k]);
  }
  if (polygon.area > 0.0) polygon.centre /= polygon.area;
  return polygon;
}

/// A plane surface.
template <int D>
std::vector<CutCell<D>> part_of_plane(const CutCell<D>& cut, const BoxShape& cell,
                                      const BoxShape& box, double size) {
  const Eigen::Vector3d place = to_space<D>(cut.middle);
  const Eigen::Vector3d normal = to_space<D>(cut.area).normalized();
  const Polygon whole = in_box(place, normal, cell, size), left = in_box(place, normal, box, size);
  if (!(left.area > 0.0) || !(whole.area > 0.0)) return {};
  CutCell<D> part = cut;
  part.spread = {};
  part.area = (left.area / whole.area) * cut.area;
  part.middle = cut.middle + to_axes<D>(left.centre - whole.centre);
  return {part};
}

/// The component of a surface along an axis: a rectangle across it around its own centre, which
/// reaches to that side of the cell which is nearer.
template <int D>
std::vector<CutCell<D>> part_of_component(const CutCell<D>& cut, int axis, const BoxShape& cell,
                                          const BoxShape& box, double size) {
  const double area = cut.area[axis];
  if (std::abs(area) < touch * norm(cut.area)) return {};
  CutCell<D> part{cut.cell, cut.body, {}, {}, {}};
  part.middle = cut.middle + (1.0 / area) * cut.spread[static_cast<std::size_t>(axis)];
  double share = 1.0;
  for (int a = 0; a < D; ++a) {
    const auto c = static_cast<std::size_t>(axis_in_space<D>(a));
    double& centre = part.middle[a];
    centre = std::clamp(centre, cell.lower[c], cell.upper[c]);
    if (a == axis) {
      if (centre < box.lower[c] - touch * size || centre > box.upper[c] + touch * size) return {};
      continue;
    }
    const double half = std::min(centre - cell.lower[c], cell.upper[c] - centre);
    const double low = std::max(centre - half, box.lower[c]);
    const double high = std::min(centre + half, box.upper[c]);
    if (half <= touch * size) continue;
    if (!(low < high)) return {};
    share *= 0.5 * (high - low) / half;
    centre = 0.5 * (low + high);
  }
  part.area[axis] = share * area;
  return {part};
}

/// Opposite surfaces in one cell, as of a thin plate: their pull stays together, and goes by the
/// share of the cell.
template <int D>
std::vector<CutCell<D>> part_of_pair(const CutCell<D>& cut, const BoxShape& cell,
                                     const BoxShape& box) {
  CutCell<D> part = cut;
  double share = 1.0;
  for (int a = 0; a < D; ++a) {
    const auto c = static_cast<std::size_t>(axis_in_space<D>(a));
    share *= std::max(0.0, box.upper[c] - box.lower[c]) / (cell.upper[c] - cell.lower[c]);
    part.middle[a] = std::min(std::max(part.middle[a], box.lower[c]), box.upper[c]);
  }
  part.area *= share;
  for (Vec<D>& spread : part.spread) spread *= share;
  return {part};
}

}  // namespace

template <int D>
std::vector<CutCell<D>> part_of_wall(const Grid<D>& grid, const CutCell<D>& cut,
                                     const BoxShape& box) {
  const BoxShape cell = box_of_cell(grid, cut.cell);
  bool whole = true, away = false;
  double size = 0.0;
  for (int a = 0; a < D; ++a) {
    const auto c = static_cast<std::size_t>(axis_in_space<D>(a));
    size = std::max(size, cell.upper[c] - cell.lower[c]);
    whole = whole && box.lower[c] <= cell.lower[c] && box.upper[c] >= cell.upper[c];
    away = away || box.lower[c] > cell.upper[c] || box.upper[c] < cell.lower[c];
  }
  if (whole) return {cut};
  if (away) return {};
  double bend = 0.0;
  bool pair = false;
  for (int a = 0; a < D; ++a) {
    const double way = norm(cut.spread[static_cast<std::size_t>(a)]);
    bend = std::max(bend, way);
    pair = pair || way > size * std::max(std::abs(cut.area[a]), touch * norm(cut.area));
  }
  BoxShape left = common(cell, box);
  if constexpr (D == 2) left.lower[1] = cell.lower[1], left.upper[1] = cell.upper[1];
  if (pair) return part_of_pair<D>(cut, cell, left);
  if (bend <= plane * size * norm(cut.area)) return part_of_plane<D>(cut, cell, left, size);
  std::vector<CutCell<D>> parts;
  for (int a = 0; a < D; ++a)
    for (const CutCell<D>& part : part_of_component<D>(cut, a, cell, left, size))
      parts.push_back(part);
  return parts;
}

template std::vector<CutCell<2>> part_of_wall(const Grid<2>&, const CutCell<2>&, const BoxShape&);
template std::vector<CutCell<3>> part_of_wall(const Grid<3>&, const CutCell<3>&, const BoxShape&);

}  // namespace mudlark

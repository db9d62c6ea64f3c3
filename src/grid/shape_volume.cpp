#include "grid/shape_volume.hpp"

#include <cmath>

#include "grid/triangle_mesh.hpp"

namespace mudlark {
namespace {

/// Cells per axis that a shape is summed over.
constexpr int cells_in_plane = 1000, cells_in_space = 150;

/// Sums of 1, x and x x^T over a body, about the origin.
struct Sums {
  double volume = 0.0;
  Point3 first{};
  std::array<std::array<double, 3>, 3> second{};

  void add(double weight, const Point3& place) {
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) second[a][b] += weight * place[a] * place[b];
  }
};

/// Tetrahedra between the origin and the triangles, with the sign of their volume.
Sums sum_over(const TriangleMesh& mesh) {
  Sums sums;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const auto [a, b, c] = mesh.triangle(i);
    const double det = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
    Point3 corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = a[k] + b[k] + c[k];
    sums.volume += det / 6.0;
    for (std::size_t k = 0; k < 3; ++k) sums.first[k] += det / 24.0 * corners[k];
    for (const Point3& place : {a, b, c, corners}) sums.add(det / 120.0, place);
  }
  return sums;
}

/// Cells of the box around the shape whose middle lies inside.
Sums sum_over(const Shape& shape, const BoxShape& box, int dimension) {
  const int count = dimension == 2 ? cells_in_plane : cells_in_space;
  const int across = dimension == 2 ? 1 : count;
  Point3 size{};
  double cell = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (dimension == 2 && a == 1) continue;
    size[a] = (box.upper[a] - box.lower[a]) / count;
    cell *= size[a];
  }
  const auto middle = [&](std::size_t axis, int i) {
    return size[axis] == 0.0 ? 0.0 : box.lower[axis] + (i + 0.5) * size[axis];
  };
  Sums sums;
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < count; ++i) {
        const Point3 place{middle(0, i), middle(1, j), middle(2, k)};
        if (!shape.contains(place)) continue;
        sums.volume += cell;
        for (std::size_t a = 0; a < 3; ++a) {
          sums.first[a] += cell * place[a];
          sums.second[a][a] += cell * size[a] * size[a] / 12.0;
        }
        sums.add(cell, place);
      }
  return sums;
}

}  // namespace

std::optional<SolidVolume> volume_of(const Shape& shape, int dimension) {
  const BoxShape box = bounds(shape);
  for (std::size_t a = 0; a < 3; ++a)
    if (!(dimension == 2 && a == 1) && !std::isfinite(box.upper[a] - box.lower[a])) return {};
  const auto* stl = std::get_if<StlShape>(&shape.form);
  const Sums sums = stl ? sum_over(*stl->mesh) : sum_over(shape, box, dimension);
  if (!(sums.volume > 0.0)) return {};
  SolidVolume solid;
  solid.volume = sums.volume;
  for (std::size_t a = 0; a < 3; ++a) solid.centre[a] = sums.first[a] / sums.volume;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      solid.moments[a][b] = sums.second[a][b] - sums.volume * solid.centre[a] * solid.centre[b];
  return solid;
}

}  // namespace mudlark

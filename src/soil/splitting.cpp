#include "soil/splitting.hpp"

#include <algorithm>
#include <cmath>

#include "materials/invariants.hpp"
#include "soil/mirror.hpp"
#include "soil/point_group.hpp"
#include "soil/redistribute.hpp"

namespace mudlark {
namespace {

/// The halves of point `id` get the ids of a binary tree: the upper bits hold 1 and then a bit for
/// every split since the start, the lower ones the number that the point was seeded with.
constexpr int tree_at = 45;
constexpr std::int64_t largest_tree = std::int64_t{1} << (62 - tree_at);

std::int64_t tree_of(std::int64_t id) { return std::max<std::int64_t>(1, id >> tree_at); }
std::int64_t half_of(std::int64_t id, int which) {
  const std::int64_t seed = id & ((std::int64_t{1} << tree_at) - 1);
  return ((2 * tree_of(id) + which) << tree_at) | seed;
}

/// Extent in units of cells; in the plane without thickness.
template <int D>
SymTensor extent_in_cells(const Grid<D>& grid, const SoilParticles<D>& points, std::size_t p) {
  const auto& e = points.extent;
  const Vec<D>& h = grid.spacing();
  SymTensor t;
  if constexpr (D == 2) {
    t.xx = e[0][p] / (h[0] * h[0]), t.zz = e[1][p] / (h[1] * h[1]), t.zx = e[2][p] / (h[0] * h[1]);
  } else {
    t.xx = e[0][p] / (h[0] * h[0]), t.yy = e[1][p] / (h[1] * h[1]), t.zz = e[2][p] / (h[2] * h[2]);
    t.xy = e[3][p] / (h[0] * h[1]), t.yz = e[4][p] / (h[1] * h[2]), t.zx = e[5][p] / (h[2] * h[0]);
  }
  return t;
}

template <int D>
void set_extent_in_cells(const Grid<D>& grid, const SymTensor& t, std::size_t p,
                         SoilParticles<D>& points) {
  auto& e = points.extent;
  const Vec<D>& h = grid.spacing();
  if constexpr (D == 2) {
    e[0][p] = t.xx * h[0] * h[0], e[1][p] = t.zz * h[1] * h[1], e[2][p] = t.zx * h[0] * h[1];
  } else {
    e[0][p] = t.xx * h[0] * h[0], e[1][p] = t.yy * h[1] * h[1], e[2][p] = t.zz * h[2] * h[2];
    e[3][p] = t.xy * h[0] * h[1], e[4][p] = t.yz * h[1] * h[2], e[5][p] = t.zx * h[2] * h[0];
  }
}

/// Largest principal extent [cells], squared, and its direction as n n^T.
struct Longest {
  double squared;
  SymTensor projector;
};
Longest longest_of(const SymTensor& extent) {
  const PrincipalAxes axes(extent);
  return {axes.values()[0], axes.tensor({1.0, 0.0, 0.0})};
}

/// n from n n^T, with a positive largest component.
template <int D>
Vec<D> direction_of(const SymTensor& projector) {
  int largest = 0;
  for (int a = 1; a < D; ++a)
    if (projector.between<D>(a, a) > projector.between<D>(largest, largest)) largest = a;
  Vec<D> n;
  for (int a = 0; a < D; ++a)
    n[a] = projector.between<D>(a, largest) / std::sqrt(projector.between<D>(largest, largest));
  return n;
}

/// How much of `way` both ways from `place` stays off the closed walls.
template <int D>
double free_share(const SoilSides<D>& sides, const Vec<D>& place, const Vec<D>& way) {
  const Grid<D>& grid = sides.grid();
  const Index<D> cell = grid.cell_at(place);
  double share = 1.0;
  for (int a = 0; a < D; ++a) {
    const double length = std::abs(way[a]);
    if (length == 0.0) continue;
    if (sides.grains(a, 0, cell) != GrainSide::open)
      share = std::min(share, 0.99 * (place[a] - grid.lower()[a]) / length);
    if (sides.grains(a, 1, cell) != GrainSide::open)
      share = std::min(share, 0.99 * (grid.upper()[a] - place[a]) / length);
  }
  return share;
}

/// Points that are too long, in cells that have room.
template <int D>
std::vector<std::size_t> too_long(const Grid<D>& grid, const Splitting& splitting,
                                  const SoilParticles<D>& points) {
  std::vector<std::size_t> found;
  const double limit = splitting.longest * splitting.longest;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SymTensor extent = extent_in_cells(grid, points, p);
    if (extent.trace() > limit && tree_of(points.id[p]) < largest_tree &&
        longest_of(extent).squared > limit)
      found.push_back(p);
  }
  if (found.empty()) return found;
  std::vector<int> count(grid.local_size(), 0);
  const auto in_cell_of = [&](std::size_t p) -> int& {
    return count[static_cast<std::size_t>(grid.offset(grid.cell_at(points.position_of(p))))];
  };
  for (std::size_t p = 0; p < points.size(); ++p) ++in_cell_of(p);
  std::erase_if(found, [&](std::size_t p) { return in_cell_of(p) > splitting.most; });
  return found;
}

template <int D>
void split(const SoilSides<D>& sides, const std::vector<std::size_t>& chosen,
           SoilParticles<D>& points) {
  const Grid<D>& grid = sides.grid();
  const std::size_t before = points.size();
  points.for_each_array([&](std::vector<double>& array) {
    for (const std::size_t p : chosen) array.push_back(array[p]);
  });
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::size_t p = chosen[i], q = before + i;
    const SymTensor extent = extent_in_cells(grid, points, p);
    const Longest longest = longest_of(extent);
    // A quarter of the length from the middle to that of each half, which is half as long.
    Vec<D> way = direction_of<D>(longest.projector);
    for (int a = 0; a < D; ++a) way[a] *= 0.25 * std::sqrt(longest.squared) * grid.spacing()[a];
    way *= free_share(sides, points.position_of(p), way);
    const SymTensor half = extent + (-0.75 * longest.squared) * longest.projector;
    const std::int64_t id = points.id[p];
    points.id.push_back(half_of(id, 1));
    points.id[p] = half_of(id, 0);
    for (const std::size_t both : {p, q}) {
      points.grain_mass[both] *= 0.5;
      points.volume[both] *= 0.5, points.start_volume[both] *= 0.5;
      set_extent_in_cells(grid, half, both, points);
    }
    for (int a = 0; a < D; ++a) points.position[a][p] -= way[a], points.position[a][q] += way[a];
  }
}

}  // namespace

template <int D>
void set_extent(const Grid<D>& grid, int per_axis, std::size_t p, SoilParticles<D>& points) {
  const double own = 1.0 / (static_cast<double>(per_axis) * per_axis);
  set_extent_in_cells(grid, SymTensor{own, own, own, 0.0, 0.0, 0.0}, p, points);
}

template <int D>
void follow_extent(std::span<const double> gradient, PointRange range, SoilParticles<D>& points) {
  auto& e = points.extent;
  for_each_group(range, [&](const PointGroup& group) {
    MatrixLanes f = group.gradient<D>(gradient.data(), range);
    for (const std::size_t diagonal : {0u, 4u, 8u}) f[diagonal] += 1.0;
    TensorLanes a;
    if constexpr (D == 2) {
      a.xx = group.get(e[0]), a.zz = group.get(e[1]), a.zx = group.get(e[2]);
      a = congruent(a, f);
      group.set(a.xx, e[0]), group.set(a.zz, e[1]), group.set(a.zx, e[2]);
    } else {
      group.set(congruent(group.get(e), f), e);
    }
  });
}

template <int D>
double split_stretched(const SoilSides<D>& sides, const Splitting& splitting,
                       SoilParticles<D>& points) {
  const Grid<D>& grid = sides.grid();
  double removed = 0.0;
  for (int any = 1; any > 0;) {
    const std::vector<std::size_t> chosen = too_long(grid, splitting, points);
    split(sides, chosen, points);
    const int mine = chosen.empty() ? 0 : 1;
    MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, grid.comm());
    if (any > 0) removed += migrate(sides, points);
  }
  return removed;
}

template void set_extent(const Grid<2>&, int, std::size_t, SoilParticles<2>&);
template void set_extent(const Grid<3>&, int, std::size_t, SoilParticles<3>&);
template void follow_extent(std::span<const double>, PointRange, SoilParticles<2>&);
template void follow_extent(std::span<const double>, PointRange, SoilParticles<3>&);
template double split_stretched(const SoilSides<2>&, const Splitting&, SoilParticles<2>&);
template double split_stretched(const SoilSides<3>&, const Splitting&, SoilParticles<3>&);

}  // namespace mudlark

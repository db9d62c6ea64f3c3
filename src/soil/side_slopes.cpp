#include "soil/side_slopes.hpp"

#include "soil/point_stencil.hpp"

namespace mudlark {
namespace {

/// Rows of nodes on a side and behind it.
template <int D>
IndexBox<D> rows_of(const Grid<D>& grid, int axis, int side, bool faces_of_axis) {
  IndexBox<D> box = grid.local();
  if (side == 0)
    box.upper[axis] = faces_of_axis ? 1 : 0;
  else
    box.lower[axis] = grid.cells()[axis];
  return box;
}

template <int D, class K, int Component>
void add_points(const Grid<D>& grid, const SoilParticles<D>& points, const SideSum& which, int side,
                const SideWeight<D>& weight, FaceField<D>& slopes) {
  const Vec<D> per_spacing = inverse(grid.spacing());
  const int axis = which.axis, last_behind = Component == axis ? 0 : -1;
  const double reach = 2.0, cells = grid.cells()[axis];  // of the splines behind the side
  double* values = slopes.data();
  const std::vector<double>& along = points.position[axis];
  const double lower = grid.lower()[axis], scale = per_spacing[axis];
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double place = (along[p] - lower) * scale;
    if (side == 0 ? place > reach : place < cells - reach) continue;
    const double amount = points.volume[p] * weight(side, points.position_of(p));
    if (amount == 0.0) continue;
    const PointSplines<D, K> splines(in_cells(grid, per_spacing, points.position_of(p)));
    const auto u = static_cast<std::size_t>(axis);
    const int first = Component == axis ? splines.face[u].first : splines.centre[u].first;
    splines.template for_each_node<Component>(
        grid, per_spacing,
        [&](std::ptrdiff_t at, double, const Vec<D>& slope, const Vec<D>& count) {
          const int node = first + static_cast<int>(count[axis]);
          if (side == 0 ? node <= last_behind : node >= grid.cells()[axis])
            values[at] += amount * slope[which.direction];
        });
  }
}

template <int D>
void add_points(const Grid<D>& grid, Kernel kernel, const SoilParticles<D>& points,
                const SideSum& which, int side, const SideWeight<D>& weight, FaceField<D>& slopes) {
  with_kernel(kernel, [&]<class K>(K) {
    PointSplines<D, K>::template static_for<D>([&]<int Component>() {
      if (Component == which.component)
        add_points<D, K, Component>(grid, points, which, side, weight, slopes);
    });
  });
}

}  // namespace

template <int D>
void measure_side_slopes(const SoilSides<D>& sides, Halo<D>& halo, Kernel kernel,
                         const std::vector<SoilParticles<D>>& bodies, const SideSum& which,
                         const SideWeight<D>& weight, FaceField<D>& slopes) {
  const Grid<D>& grid = sides.grid();
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(which.axis, side)) continue;
    for_each(rows_of(grid, which.axis, side, which.component == which.axis),
             [&](const Index<D>& node) { slopes[node] = 0.0; });
    for (const auto& points : bodies) add_points(grid, kernel, points, which, side, weight, slopes);
  }
  const std::array<double*, 1> one{slopes.data()};
  halo.add_to_owners(one);
  for (int other = 0; other < which.folded; ++other) {
    if (other == which.axis) continue;
    const double sign = other == which.direction ? -1.0 : 1.0;
    for_each_image(sides, grid.local(), other, which.component,
                   [&](const SideNode&, const Index<D>& from, const Index<D>& to) {
                     slopes[to] += sign * slopes[from];
                   });
  }
}

template void measure_side_slopes(const SoilSides<2>&, Halo<2>&, Kernel,
                                  const std::vector<SoilParticles<2>>&, const SideSum&,
                                  const SideWeight<2>&, FaceField<2>&);
template void measure_side_slopes(const SoilSides<3>&, Halo<3>&, Kernel,
                                  const std::vector<SoilParticles<3>>&, const SideSum&,
                                  const SideWeight<3>&, FaceField<3>&);

}  // namespace mudlark

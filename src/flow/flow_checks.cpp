#include "flow/flow_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Where the water ends along an axis: seen from a cell with alpha >= 1/2 whose neighbour has less.
template <int D>
double end_of_water(const Grid<D>& grid, const CellField<D>& saturation, const Index<D>& cell,
                    int axis) {
  const double here = std::min(saturation[cell], 1.0);
  const double beyond =
      cell[axis] + 1 < grid.cells()[axis] ? saturation[cell.shifted(axis, 1)] : 0.0;
  const int index = cell[axis];
  const double next = index + 1 < grid.cells()[axis] ? grid.width(axis, index + 1) : 0.0;
  return grid.face_position(axis, index) + here * grid.width(axis, index) +
         std::max(beyond, 0.0) * next;
}

/// Largest of the ranks' values; `position` becomes the centre of its cell, given by the place
/// `where` in the local arrays of the rank that holds it. Collective.
template <int D>
double largest_over_ranks(const Grid<D>& grid, double value, std::ptrdiff_t where,
                          Vec<D>& position) {
  struct {
    double value;
    int rank;
  } mine{value, grid.rank()}, best{};
  MPI_Allreduce(&mine, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, grid.comm());
  position = place_of(grid, where);
  MPI_Bcast(position.component.data(), D, MPI_DOUBLE, best.rank, grid.comm());
  return best.value;
}

}  // namespace

template <int D>
IndexBox<D> wall_faces(const Grid<D>& grid, int axis, int side) {
  IndexBox<D> box = grid.owned();
  box.lower[axis] = side == 0 ? box.lower[axis] : box.upper[axis];
  box.upper[axis] = box.lower[axis] + 1;
  return box;
}

template <int D>
void zero_wall(const Grid<D>& grid, int axis, int side, FaceField<D>& field) {
  double* values = field.data();
  for_each_offset(grid, wall_faces(grid, axis, side), [&](std::ptrdiff_t at) { values[at] = 0.0; });
}

template <int D>
Vec<D> place_of(const Grid<D>& grid, std::ptrdiff_t at) {
  Index<D> cell;
  for (int a = D - 1; a >= 0; --a) {
    cell[a] = static_cast<int>(at / grid.stride(a)) + grid.local().lower[a];
    at %= grid.stride(a);
  }
  return grid.cell_centre(cell);
}

template <int D>
std::string place_text(const Vec<D>& position) {
  if constexpr (D == 2) return fmt::format("(x, z) = ({:.6g}, {:.6g}) m", position[0], position[1]);
  return fmt::format("(x, y, z) = ({:.6g}, {:.6g}, {:.6g}) m", position[0], position[1],
                     position[D - 1]);
}

template <int D>
Vec<D> place_of_largest(const Grid<D>& grid, const CellField<D>& field) {
  double largest = -1.0;
  std::ptrdiff_t where = grid.offset(grid.owned().lower);
  const double* values = field.data();
  for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {
    const double size = std::isfinite(values[at]) ? std::abs(values[at]) : HUGE_VAL;
    if (size > largest) largest = size, where = at;
  });
  Vec<D> position;
  largest_over_ranks(grid, largest, where, position);
  return position;
}

template <int D>
std::string not_finite(const Grid<D>& grid, const IndexBox<D>& box, const double* values,
                       const char* quantity) {
  std::ptrdiff_t where = -1;
  for_each_offset(grid, box, [&](std::ptrdiff_t at) {
    if (!std::isfinite(values[at])) where = at;
  });
  if (where < 0) return {};
  return fmt::format("The {} is {} at {}.", quantity, values[where],
                     place_text(place_of(grid, where)));
}

template <int D>
double kinetic_energy(const Grid<D>& grid, const CellField<D>& water, const FaceVector<D>& velocity,
                      double density) {
  double sum = 0.0;
  const double* w = water.data();
  for (int axis = 0; axis < D; ++axis) {
    const double* v = velocity[axis].data();
    const std::ptrdiff_t s = grid.stride(axis);
    for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {  // each cell: half on either side
      sum += 0.25 * w[at] * (v[at] * v[at] + v[at + s] * v[at + s]);
    });
  }
  return density * grid.cell_volume() * sum_over_ranks(grid, sum);
}

template <int D>
Vec<D> momentum(const Grid<D>& grid, const CellField<D>& water, const FaceVector<D>& velocity,
                double density) {
  Vec<D> sum{};
  const double* w = water.data();
  for (int axis = 0; axis < D; ++axis) {
    const double* v = velocity[axis].data();
    const std::ptrdiff_t s = grid.stride(axis);
    for_each_offset(grid, grid.owned(),
                    [&](std::ptrdiff_t at) { sum[axis] += 0.5 * w[at] * (v[at] + v[at + s]); });
    sum[axis] = density * grid.cell_volume() * sum_over_ranks(grid, sum[axis]);
  }
  return sum;
}

template <int D>
double fastest_water(const Grid<D>& grid, const CellField<D>& water, const FaceVector<D>& velocity,
                     Vec<D>& position) {
  double fastest = 0.0;
  std::ptrdiff_t where = grid.offset(grid.owned().lower);
  const double* w = water.data();
  for (int axis = 0; axis < D; ++axis) {
    const double* v = velocity[axis].data();
    const std::ptrdiff_t s = grid.stride(axis);
    for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {
      if (w[at] < 1e-6) return;
      const double speed = std::max(std::abs(v[at]), std::abs(v[at + s]));
      if (speed > fastest) fastest = speed, where = at;
    });
  }
  return largest_over_ranks(grid, fastest, where, position);
}

template <int D>
IndexBox<D> own_column(const Grid<D>& grid, const Vec<D>& position) {
  const Index<D> cell = grid.cell_at(position);
  IndexBox<D> column = grid.owned();
  for (int a = 0; a < D - 1; ++a) {
    // A position on the domain's upper end belongs to the last cell.
    const int place = std::clamp(cell[a], 0, grid.cells()[a] - 1);
    column.lower[a] = std::max(column.lower[a], place);
    column.upper[a] = std::min(column.upper[a], place + 1);
  }
  return column;
}

template <int D>
double surface_height(const Grid<D>& grid, const CellField<D>& saturation, const Vec<D>& position) {
  constexpr int up = D - 1;
  const IndexBox<D> column = own_column(grid, position);
  double height = grid.lower()[up];
  for_each(column, [&](const Index<D>& c) {
    if (saturation[c] >= 0.5) height = std::max(height, end_of_water(grid, saturation, c, up));
  });
  return max_over_ranks(grid, height);
}

template <int D>
double water_front(const Grid<D>& grid, const CellField<D>& saturation) {
  double front = grid.lower()[0];
  for_each(grid.owned(), [&](const Index<D>& c) {
    if (saturation[c] >= 0.5) front = std::max(front, end_of_water(grid, saturation, c, 0));
  });
  return max_over_ranks(grid, front);
}

template <int D>
double interpolate(const Grid<D>& grid, const double* values, int axis, const Vec<D>& position) {
  Index<D> cell = grid.cell_at(position);
  for (int a = 0; a < D; ++a)  // a gauge on the domain's upper end stands on the last cell
    if (cell[a] == grid.cells()[a] && position[a] <= grid.upper()[a] + 1e-9 * grid.spacing()[a])
      cell[a] -= 1;
  double sum = 0.0;
  if (grid.owned().contains(cell)) {
    Index<D> corner;
    Vec<D> share;
    for (int a = 0; a < D; ++a) {
      corner[a] = cell[a];
      if (a == axis) {
        share[a] = (position[a] - grid.face_position(a, cell[a])) / grid.width(a, cell[a]);
        continue;
      }
      double beyond = position[a] - grid.cell_centre(cell)[a];
      if (beyond < 0.0) corner[a] -= 1, beyond += grid.gap(a, cell[a]);
      share[a] = beyond / grid.gap(a, corner[a] + 1);
    }
    for (int k = 0; k < (1 << D); ++k) {
      Index<D> index = corner;
      double weight = 1.0;
      for (int a = 0; a < D; ++a) {
        const bool upper = (k >> a) & 1;
        index[a] += upper ? 1 : 0;
        weight *= upper ? share[a] : 1.0 - share[a];
      }
      sum += weight * values[grid.offset(index)];
    }
  }
  return sum_over_ranks(grid, sum);
}

template IndexBox<2> wall_faces(const Grid<2>&, int, int);
template IndexBox<3> wall_faces(const Grid<3>&, int, int);
template void zero_wall(const Grid<2>&, int, int, FaceField<2>&);
template void zero_wall(const Grid<3>&, int, int, FaceField<3>&);
template Vec<2> place_of(const Grid<2>&, std::ptrdiff_t);
template Vec<3> place_of(const Grid<3>&, std::ptrdiff_t);
template std::string place_text(const Vec<2>&);
template std::string place_text(const Vec<3>&);
template Vec<2> place_of_largest(const Grid<2>&, const CellField<2>&);
template Vec<3> place_of_largest(const Grid<3>&, const CellField<3>&);
template std::string not_finite(const Grid<2>&, const IndexBox<2>&, const double*, const char*);
template std::string not_finite(const Grid<3>&, const IndexBox<3>&, const double*, const char*);
template Vec<2> momentum(const Grid<2>&, const CellField<2>&, const FaceVector<2>&, double);
template Vec<3> momentum(const Grid<3>&, const CellField<3>&, const FaceVector<3>&, double);
template double kinetic_energy(const Grid<2>&, const CellField<2>&, const FaceVector<2>&, double);
template double kinetic_energy(const Grid<3>&, const CellField<3>&, const FaceVector<3>&, double);
template double fastest_water(const Grid<2>&, const CellField<2>&, const FaceVector<2>&, Vec<2>&);
template double fastest_water(const Grid<3>&, const CellField<3>&, const FaceVector<3>&, Vec<3>&);
template IndexBox<2> own_column(const Grid<2>&, const Vec<2>&);
template IndexBox<3> own_column(const Grid<3>&, const Vec<3>&);
template double surface_height(const Grid<2>&, const CellField<2>&, const Vec<2>&);
template double surface_height(const Grid<3>&, const CellField<3>&, const Vec<3>&);
template double water_front(const Grid<2>&, const CellField<2>&);
template double water_front(const Grid<3>&, const CellField<3>&);
template double interpolate(const Grid<2>&, const double*, int, const Vec<2>&);
template double interpolate(const Grid<3>&, const double*, int, const Vec<3>&);

}  // namespace mudlark

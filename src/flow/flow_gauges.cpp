#include "flow/flow_gauges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "flow/flow_checks.hpp"
#include "numerics/loops.hpp"
#include "numerics/plic.hpp"

namespace mudlark {
namespace {

/// Share of the cell `index` along an axis between from and to.
template <int D>
double share_between(const Grid<D>& grid, int axis, int index, double from, double to) {
  const double h = grid.width(axis, index), lower = grid.face_position(axis, index);
  return std::clamp((std::min(lower + h, to) - std::max(lower, from)) / h, 0.0, 1.0);
}

/// The face of an axis that lies nearest to a place.
template <int D>
int nearest_face(const Grid<D>& grid, int axis, double place) {
  Vec<D> position = grid.lower();
  position[axis] = place;
  const int cell = std::clamp(grid.cell_at(position)[axis], 0, grid.cells()[axis] - 1);
  return place - grid.face_position(axis, cell) < 0.5 * grid.width(axis, cell) ? cell : cell + 1;
}

}  // namespace

template <int D>
double own_water_through(const Grid<D>& grid, const FaceVector<D>& through,
                         const FlowSection<D>& section) {
  const int axis = section.axis, cells = grid.cells()[axis];
  int plane = nearest_face(grid, axis, section.place);
  if (grid.periodic(axis)) plane %= cells;
  IndexBox<D> faces = grid.owned_faces(axis);
  faces.lower[axis] = std::max(faces.lower[axis], plane);
  faces.upper[axis] = std::min(faces.upper[axis], plane + 1);
  double sum = 0.0;
  for_each(faces, [&](const Index<D>& face) {
    double share = 1.0;
    for (int a = 0; a < D; ++a)
      if (a != axis) share *= share_between(grid, a, face[a], section.from[a], section.to[a]);
    sum += share * through[axis][face];
  });
  return sum * grid.cell_volume();
}

template <int D>
std::vector<double> surfaces_over(const Grid<D>& grid, const CellField<D>& saturation,
                                  const Vec<D>& position) {
  constexpr int up = D - 1;
  const IndexBox<D> column = own_column(grid, position);
  const auto height = static_cast<std::size_t>(grid.cells()[up]);
  std::vector<double> mine(height, 0.0), alpha(height, 0.0);
  for_each(column, [&](const Index<D>& c) {
    mine[static_cast<std::size_t>(c[up])] = std::clamp(saturation[c], 0.0, 1.0);
  });
  MPI_Allreduce(mine.data(), alpha.data(), static_cast<int>(height), MPI_DOUBLE, MPI_SUM,
                grid.comm());
  std::vector<double> surfaces;
  const auto width = [&](std::size_t k) { return grid.width(up, static_cast<int>(k)); };
  const auto wet = [&](std::size_t k) { return k < height && alpha[k] >= 0.5; };
  for (std::size_t k = height; k-- > 0;) {
    const double above = k + 1 < height ? alpha[k + 1] : 0.0;
    const double h = width(k), next = width(k + 1);
    const double floor = grid.face_position(up, static_cast<int>(k));
    if (wet(k) && !wet(k + 1)) surfaces.push_back(floor + alpha[k] * h + above * next);
    if (!wet(k) && wet(k + 1))  // water over air: it fills its cells from above
      surfaces.push_back(floor + (1.0 - alpha[k]) * h + (1.0 - above) * next);
  }
  return surfaces;
}

namespace {

/// What one rank knows of a column between its lowest and highest cell.
struct ColumnPiece {
  double ground = 0.0;   ///< its highest ground, mean over the column [m]; NaN: none
  double depth = 0.0;    ///< of the water on that ground, or on the piece's lower end [m]
  double through = 0.0;  ///< 1: that water reaches the piece's upper end
  double raised = 0.0;   ///< by what bodies take of the wet cells on the piece's lower end [m]
};

/// A cell that a body cuts holds the body's surface: what the body takes of it lies below the water
/// if the cell below is closed; over wet cells (a steep wall) its level is its saturation.
template <int D>
ColumnPiece read_piece(const Grid<D>& grid, const CellField<D>& saturation,
                       const PorousMedium<D>& medium, Index<D> cell) {
  constexpr int up = D - 1;
  const CellField<D>& room = medium.space.volume;
  const double none = std::numeric_limits<double>::quiet_NaN();
  ColumnPiece piece{none, 0.0, 1.0, 0.0};
  if (grid.owned().lower[up] == 0) piece.ground = grid.lower()[up];
  for (cell[up] = grid.owned().lower[up]; cell[up] < grid.owned().upper[up]; ++cell[up]) {
    double size = 1.0;  // of the cell over that of a mean one, as its capacity counts
    for (int a = 0; a < D; ++a) size *= grid.width(a, cell[a]) / grid.spacing()[a];
    if (room[cell] == 0.0 || medium.porosity[cell] < 1.0 - 1e-6) {
      piece = {grid.face_position(up, cell[up] + 1), 0.0, 1.0, 0.0};
    } else if (piece.through > 0.0) {
      const double alpha = std::clamp(saturation[cell], 0.0, 1.0), h = grid.width(up, cell[up]);
      const double open = room[cell] / size;
      const bool on_ground = cell[up] == 0 || room[cell.shifted(up, -1)] == 0.0;
      piece.raised += (on_ground ? 1.0 : alpha) * (1.0 - open) * h;
      piece.depth += alpha * open * h;
      piece.through = alpha >= 0.5 ? 1.0 : 0.0;
    }
  }
  return piece;
}

/// Surface of the water on the ground of a column from its pieces, the lowest first; NaN when it is
/// thinner than asked for.
double surface_of(const ColumnPiece* pieces, int count, double thickness) {
  ColumnPiece column = pieces[0];
  for (int p = 1; p < count; ++p) {
    const ColumnPiece& next = pieces[p];
    if (!std::isnan(next.ground)) {
      column = next;
    } else if (column.through > 0.0) {
      column.depth += next.depth, column.raised += next.raised;
      column.through = next.through;
    }
  }
  return column.depth >= thickness ? column.ground + column.raised + column.depth
                                   : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

template <int D>
double run_up(const Grid<D>& grid, const CellField<D>& saturation, const PorousMedium<D>& medium,
              const RunUpRange<D>& range) {
  constexpr int up = D - 1;
  IndexBox<D> columns = grid.global();
  columns.lower[up] = 0, columns.upper[up] = 1;
  std::size_t wide = 1;
  for (int a = 0; a < up; ++a) {
    const double nothing = 1e-9 * grid.spacing()[a];
    int first = 0, last = 0;
    for (Index<D> cell{}; cell[a] < grid.cells()[a]; ++cell[a]) {
      const double centre = grid.cell_centre(cell)[a];
      if (centre < range.from[a] - nothing) first = cell[a] + 1;
      if (centre <= range.to[a] + nothing) last = cell[a] + 1;
    }
    columns.lower[a] = first, columns.upper[a] = std::max(first, last);
    wide *= static_cast<std::size_t>(std::max(0, columns.upper[a] - columns.lower[a]));
  }
  const int high = grid.partition().processes[up], place = grid.partition().place[up];
  std::vector<ColumnPiece> mine(wide * static_cast<std::size_t>(high)), all(mine.size());
  IndexBox<D> own = columns;
  for (int a = 0; a < up; ++a) {
    own.lower[a] = std::max(own.lower[a], grid.owned().lower[a]);
    own.upper[a] = std::min(own.upper[a], grid.owned().upper[a]);
  }
  for_each(own, [&](const Index<D>& column) {
    std::size_t number = 0;
    for (int a = up - 1; a >= 0; --a)
      number = number * static_cast<std::size_t>(columns.upper[a] - columns.lower[a]) +
               static_cast<std::size_t>(column[a] - columns.lower[a]);
    mine[number * static_cast<std::size_t>(high) + static_cast<std::size_t>(place)] =
        read_piece(grid, saturation, medium, column);
  });
  // Each piece has one rank; the others add zeros.
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(4 * mine.size()), MPI_DOUBLE, MPI_SUM,
                grid.comm());
  double highest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t n = 0; n < wide; ++n)
    highest = std::fmax(
        highest, surface_of(&all[n * static_cast<std::size_t>(high)], high, range.thickness));
  return highest;
}

namespace {

/// Centre of the water along an axis in a cell cut by a plane, 0..1. With V(s) the water below s,
/// integral of s dV = V(1) - integral of V(s) ds; V is a cubic in pieces, so three Gauss points on
/// each of four parts leave 1e-5 of a cell.
template <int D>
double centre_of_water(const Plane<D>& plane, int axis) {
  constexpr int parts = 4;
  constexpr std::array<double, 3> places{0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const double all = volume_below(plane);
  double below = 0.0;
  for (int part = 0; part < parts; ++part)
    for (std::size_t g = 0; g < 3; ++g)
      below += weights[g] / parts * water_in_slab(plane, axis, 0.0, (part + places[g]) / parts);
  return (all - below) / all;
}

}  // namespace

template <int D>
double potential_energy(const Grid<D>& grid, const CellField<D>& water,
                        const CellField<D>& saturation, double density) {
  std::array<std::ptrdiff_t, D> strides;
  for (int a = 0; a < D; ++a) strides[static_cast<std::size_t>(a)] = grid.stride(a);
  double sum = 0.0;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const double alpha = saturation[cell];
    if (alpha <= 1e-12) return;
    const bool cut = alpha < 1.0 - 1e-9;
    const double* here = saturation.data() + grid.offset(cell);
    for (int axis = 0; axis < D; ++axis) {
      const double gravity = grid.gravity()[axis];
      if (gravity == 0.0) continue;
      double centre = 0.5;
      if (cut)
        centre = centre_of_water(
            plane_of_volume<D>(interface_normal<D>(here, strides.data()), alpha), axis);
      const double height = grid.face_position(axis, cell[axis]) - grid.lower()[axis] +
                            centre * grid.width(axis, cell[axis]);
      sum -= gravity * water[cell] * height;
    }
  });
  return density * grid.cell_volume() * sum_over_ranks(grid, sum);
}

template double own_water_through(const Grid<2>&, const FaceVector<2>&, const FlowSection<2>&);
template double own_water_through(const Grid<3>&, const FaceVector<3>&, const FlowSection<3>&);
template std::vector<double> surfaces_over(const Grid<2>&, const CellField<2>&, const Vec<2>&);
template std::vector<double> surfaces_over(const Grid<3>&, const CellField<3>&, const Vec<3>&);
template double run_up(const Grid<2>&, const CellField<2>&, const PorousMedium<2>&,
                       const RunUpRange<2>&);
template double run_up(const Grid<3>&, const CellField<3>&, const PorousMedium<3>&,
                       const RunUpRange<3>&);
template double potential_energy(const Grid<2>&, const CellField<2>&, const CellField<2>&, double);
template double potential_energy(const Grid<3>&, const CellField<3>&, const CellField<3>&, double);

}  // namespace mudlark

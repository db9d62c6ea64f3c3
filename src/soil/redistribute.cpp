#include "soil/redistribute.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "parallel/collective_error.hpp"

namespace mudlark {

template <int D>
void remove_points(SoilParticles<D>& points, const std::vector<char>& flagged) {
  const auto compact = [&](auto& array) {
    std::size_t kept = 0;
    for (std::size_t p = 0; p < flagged.size(); ++p)
      if (!flagged[p]) array[kept++] = array[p];
    array.resize(kept);
  };
  compact(points.id);
  points.for_each_array(compact);
}

namespace {

/// All values of the flagged points, point after point.
template <int D>
std::vector<double> pack(SoilParticles<D>& points, const std::vector<char>& flagged) {
  std::vector<double> buffer;
  for (std::size_t p = 0; p < flagged.size(); ++p) {
    if (!flagged[p]) continue;
    buffer.push_back(std::bit_cast<double>(points.id[p]));
    points.for_each_array([&](std::vector<double>& array) { buffer.push_back(array[p]); });
  }
  return buffer;
}

template <int D>
void unpack(SoilParticles<D>& points, const std::vector<double>& buffer) {
  std::size_t at = 0;
  while (at < buffer.size()) {
    points.id.push_back(std::bit_cast<std::int64_t>(buffer[at++]));
    points.for_each_array([&](std::vector<double>& array) { array.push_back(buffer[at++]); });
  }
}

std::vector<double> exchange(MPI_Comm comm, const std::vector<double>& send, int to, int from) {
  int outgoing = static_cast<int>(send.size()), incoming = 0;
  MPI_Sendrecv(&outgoing, 1, MPI_INT, to, 11, &incoming, 1, MPI_INT, from, 11, comm,
               MPI_STATUS_IGNORE);
  std::vector<double> received(static_cast<std::size_t>(incoming));
  MPI_Sendrecv(send.data(), outgoing, MPI_DOUBLE, to, 12, received.data(), incoming, MPI_DOUBLE,
               from, 12, comm, MPI_STATUS_IGNORE);
  return received;
}

template <int D>
std::string place_text(const Vec<D>& position) {
  const Point3 x = to_point3(position);
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]);
}

/// Cell of the domain that a point belongs to. Round-off, or a side that moves, may put a point
/// that lies at a side into the cell behind it, which nobody owns.
template <int D>
Index<D> home_cell(const Grid<D>& grid, const Vec<D>& position) {
  Index<D> cell = grid.cell_at(position);
  for (int a = 0; a < D; ++a) cell[a] = std::clamp(cell[a], 0, grid.cells()[a] - 1);
  return cell;
}

/// Has a point that is beyond a side gone through an open part? It may have moved on along the side
/// by up to a cell since.
template <int D>
bool went_through(const SoilSides<D>& sides, int axis, int side, const Index<D>& cell) {
  if (sides.grains(axis, side, cell) == GrainSide::open) return true;
  if (!sides.lets_through(axis, side)) return false;
  for (int a = 0; a < D; ++a)
    for (const int step : {-1, 1})
      if (a != axis && sides.grains(axis, side, cell.shifted(a, step)) == GrainSide::open)
        return true;
  return false;
}

/// Deals with the points beyond a side: wraps, removes, or reports them. Returns the grain mass
/// removed.
template <int D>
double treat_walls(const SoilSides<D>& sides, SoilParticles<D>& points) {
  const Grid<D>& grid = sides.grid();
  std::vector<char> gone(points.size(), 0);
  std::string problem;
  double removed = 0.0;
  for (int a = 0; a < D; ++a) {
    const double lower = grid.lower()[a], upper = grid.upper()[a], length = upper - lower;
    const double reach = 0.5 * grid.spacing()[a];
    for (std::size_t p = 0; p < points.size(); ++p) {
      double& x = points.position[a][p];
      const int side = x < lower ? 0 : x >= upper ? 1 : -1;
      if (side < 0 || gone[p]) continue;
      if (grid.periodic(a)) {
        const double turns = length * std::floor((x - lower) / length);
        x -= turns;
        points.start[a][p] -= turns;
        continue;
      }
      const Index<D> cell = home_cell(grid, points.position_of(p));
      if (went_through(sides, a, side, cell)) {
        gone[p] = 1;
        removed += points.grain_mass[p];
        continue;
      }
      const GrainSide kind = sides.grains(a, side, cell);
      const bool follows = kind == GrainSide::moving || kind == GrainSide::absorbing;
      if (!problem.empty() || (follows && x > lower - reach && x < upper + reach)) continue;
      problem = fmt::format(
          "a material point (id {}) went {} on the {} side of axis {} at {}", points.id[p],
          follows ? "more than half a cell out of the domain" : "through the closed wall",
          side == 0 ? "lower" : "upper", "xyz"[D == 2 && a == 1 ? 2 : a],
          place_text(points.position_of(p)));
    }
  }
  throw_divergence_if_any(grid.comm(), problem);
  if (removed > 0.0) remove_points(points, gone);
  return removed;
}

template <int D>
void send_to_side(const Grid<D>& grid, SoilParticles<D>& points, int axis, int side) {
  const auto& neighbour = grid.partition().neighbour[static_cast<std::size_t>(axis)];
  const int to = neighbour[static_cast<std::size_t>(side)],
            from = neighbour[static_cast<std::size_t>(1 - side)];
  std::vector<char> leaving(points.size(), 0);
  if (to != MPI_PROC_NULL)
    for (std::size_t p = 0; p < points.size(); ++p) {
      const int cell = home_cell(grid, points.position_of(p))[axis];
      leaving[p] = side == 0 ? cell < grid.owned().lower[axis] : cell >= grid.owned().upper[axis];
    }
  const std::vector<double> received = exchange(grid.comm(), pack(points, leaving), to, from);
  remove_points(points, leaving);
  unpack(points, received);
}

}  // namespace

template <int D>
double migrate(const SoilSides<D>& sides, SoilParticles<D>& points) {
  const Grid<D>& grid = sides.grid();
  const double removed = treat_walls(sides, points);
  if (grid.ranks() == 1) return removed;
  for (int away = 1; away > 0;) {
    for (int axis = 0; axis < D; ++axis)
      for (int side = 0; side < 2; ++side)
        if (grid.partition().processes[axis] > 1) send_to_side(grid, points, axis, side);
    int mine = 0;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (!grid.owned().contains(home_cell(grid, points.position_of(p)))) mine = 1;
    MPI_Allreduce(&mine, &away, 1, MPI_INT, MPI_MAX, grid.comm());
  }
  return removed;
}

namespace {

/// Notes where each cell's points begin; `cell` holds positions in the local arrays, ascending.
template <int D>
void note_runs(const Grid<D>& grid, const std::vector<std::ptrdiff_t>& cell,
               SoilParticles<D>& points) {
  points.runs.clear();
  for (std::size_t p = 0; p < cell.size(); ++p)
    if (p == 0 || cell[p] != cell[p - 1])
      points.runs.push_back({grid.cell_at(points.position_of(p)), p});
}

}  // namespace

template <int D>
void sort_by_cell(const Grid<D>& grid, SoilParticles<D>& points) {
  std::vector<std::ptrdiff_t> cell(points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    cell[p] = grid.offset(grid.cell_at(points.position_of(p)));
  if (!std::is_sorted(cell.begin(), cell.end())) {
    std::vector<std::size_t> start(grid.local_size() + 1, 0);
    for (const std::ptrdiff_t c : cell) ++start[static_cast<std::size_t>(c) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::size_t> target(points.size());
    for (std::size_t p = 0; p < points.size(); ++p)
      target[p] = start[static_cast<std::size_t>(cell[p])]++;
    const auto reorder = [&](auto& array) {
      auto sorted = array;
      for (std::size_t p = 0; p < target.size(); ++p) sorted[target[p]] = array[p];
      array.swap(sorted);
    };
    reorder(cell);
    reorder(points.id);
    points.for_each_array(reorder);
  }
  note_runs(grid, cell, points);
}

template void remove_points(SoilParticles<2>&, const std::vector<char>&);
template void remove_points(SoilParticles<3>&, const std::vector<char>&);
template double migrate(const SoilSides<2>&, SoilParticles<2>&);
template double migrate(const SoilSides<3>&, SoilParticles<3>&);
template void sort_by_cell(const Grid<2>&, SoilParticles<2>&);
template void sort_by_cell(const Grid<3>&, SoilParticles<3>&);

}  // namespace mudlark

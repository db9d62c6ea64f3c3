#include "flow/solid_load.hpp"

#include <algorithm>
#include <cmath>

#include "flow/wall_part.hpp"
#include "numerics/loops.hpp"

namespace mudlark {

/// Differences to neighbours with a pressure; where there is none along an axis, that of water at
/// rest.
template <int D>
Vec<D> WallPressure<D>::gradient(const Index<D>& cell) const {
  const Grid<D>& grid = *grid_;
  Vec<D> slope;
  for (int a = 0; a < D; ++a) {
    const Index<D> lower = cell.shifted(a, -1), upper = cell.shifted(a, 1);
    const bool below = known(lower), above = known(upper);
    const double p = (*pressure_)[cell];
    const double down = grid.gap(a, cell[a]), up = grid.gap(a, upper[a]);
    if (below && above)
      slope[a] = ((*pressure_)[upper] - (*pressure_)[lower]) / (down + up);
    else if (below)
      slope[a] = (p - (*pressure_)[lower]) / down;
    else
      slope[a] = above ? ((*pressure_)[upper] - p) / up : density_ * grid.gravity()[a];
  }
  return slope;
}

template <int D>
std::optional<Index<D>> WallPressure<D>::source(const Index<D>& cell) const {
  if (known(cell)) return cell;
  for (int a = D - 1; a >= 0; --a)
    for (const int step : {-1, 1})
      if (known(cell.shifted(a, step))) return cell.shifted(a, step);
  std::optional<Index<D>> found;
  IndexBox<D> around{cell, cell};
  for (int a = 0; a < D; ++a) around.lower[a] -= 1, around.upper[a] += 2;
  for_each(around, [&](const Index<D>& other) {
    if (!found && known(other)) found = other;
  });
  return found;
}

template <int D>
double WallPressure<D>::at(const Index<D>& cell, const Vec<D>& place) const {
  const auto from = source(cell);
  if (!from) return 0.0;
  return (*pressure_)[*from] + dot(gradient(*from), place - grid_->cell_centre(*from));
}

template <int D>
Vec<D> WallPressure<D>::slope(const Index<D>& cell) const {
  const auto from = source(cell);
  return from ? gradient(*from) : Vec<D>{};
}

template <int D>
double WallPressure<D>::mean(const Index<D>& cell, const Vec<D>& place, double height) const {
  constexpr double dry = 1e-6, full = 1.0 - 1e-6;
  const double alpha = (*saturation_)[cell];
  const auto from = source(cell);
  if (!from || (!known(cell) && (*room_)[cell] > 0.0 && alpha < dry)) return 0.0;
  const double middle = at(cell, place);
  if (known(cell) && alpha > full) return middle;
  const double half = 0.5 * height * std::abs(gradient(*from)[D - 1]);
  const double low = middle - half, high = middle + half;
  if (low >= 0.0) return middle;
  return high <= 0.0 ? 0.0 : 0.5 * high * high / (high - low);
}

namespace {

/// Stress per tangential speed beside the wall [Pa s/m]: the water's centre lies a quarter of a
/// cell away at least.
template <int D>
double stress_per_speed(const Grid<D>& grid, const CutCell<D>& cut, double viscosity) {
  const Vec<D> out = grid.cell_centre(cut.cell) - cut.middle;
  const double away = std::abs(dot(out, cut.area)) / norm(cut.area);
  return viscosity / std::max(away, 0.25 * grid.smallest_spacing());
}

/// Integral of the way from the middle across the normal: what uniform pressure on the two sides of
/// an edge turns with.
template <int D>
Eigen::Vector3d turning(const CutCell<D>& cut) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int a = 0; a < D; ++a)
    sum += to_space<D>(cut.spread[static_cast<std::size_t>(a)])
               .cross(Eigen::Vector3d::Unit(axis_in_space<D>(a)));
  return sum;
}

/// Height of a cell's wall: its area seen from the side over its width.
template <int D>
double wall_height(const Grid<D>& grid, const CutCell<D>& cut) {
  constexpr int up = D - 1;
  double height2 = 0.0;
  for (int a = 0; a < up; ++a) {
    double width = 1.0;
    for (int b = 0; b < up; ++b) width *= b == a ? 1.0 : grid.width(b, cut.cell[b]);
    height2 += (cut.area[a] / width) * (cut.area[a] / width);
  }
  return std::min(grid.width(up, cut.cell[up]), std::sqrt(height2));
}

}  // namespace

template <int D>
void find_body_friction(const Grid<D>& grid, const SolidBodies<D>& solids,
                        const CellField<D>& capacity, double viscosity, FaceVector<D>& resistance) {
  resistance.fill(0.0);
  for (const CutCell<D>& cut : solids.surface()) {
    if (!solids.options(cut.body).no_slip) continue;
    const double drag = stress_per_speed(grid, cut, viscosity) * norm(cut.area);
    for (int a = 0; a < D; ++a)
      for (const Index<D>& face : {cut.cell, cut.cell.shifted(a, 1)}) {
        const double room = 0.5 * (capacity[face] + capacity[face.shifted(a, -1)]);
        if (room > 0.0) resistance[a][face] += 0.5 * drag / (room * grid.cell_volume());
      }
  }
}

namespace {

/// Adds what the water does to one piece of a body's surface.
template <int D>
void add_piece(const Grid<D>& grid, const SolidBodies<D>& solids, const CutCell<D>& cut,
               const WallPressure<D>& pressure, const FaceVector<D>& velocity, double viscosity,
               double ahead, SolidLoad& load) {
  const RigidVelocity& motion = solids.velocity(cut.body);
  const Eigen::Vector3d centre = solids.pose(cut.body).centre() + ahead * motion.velocity;
  const Vec<D> middle = cut.middle + ahead * solids.velocity_at(cut.body, cut.middle);
  const Eigen::Vector3d area = to_space<D>(cut.area);
  const double p = pressure.mean(cut.cell, middle, wall_height(grid, cut));
  Vec<D> total = (-p) * to_axes<D>(area + ahead * motion.spin.cross(area));
  if (solids.options(cut.body).no_slip && pressure.wet(cut.cell)) {
    const double drag = stress_per_speed(grid, cut, viscosity) * norm(cut.area);
    for (int a = 0; a < D; ++a)
      total[a] += 0.5 * drag * (velocity[a][cut.cell] + velocity[a][cut.cell.shifted(a, 1)]);
  }
  if (p == pressure.at(cut.cell, middle)) {  // no surface of the water in the cell
    const Vec<D> slope = pressure.slope(cut.cell);
    for (int a = 0; a < D; ++a) total[a] -= dot(slope, cut.spread[static_cast<std::size_t>(a)]);
  }
  const Eigen::Vector3d force = to_space<D>(total);
  load.force += force;
  load.moment += (to_space<D>(middle) - centre).cross(force) - p * turning(cut);
}

}  // namespace

template <int D>
SolidLoad load_on(const Grid<D>& grid, const SolidBodies<D>& solids, std::size_t body,
                  const std::optional<BoxShape>& part, const WallPressure<D>& pressure,
                  const FaceVector<D>& velocity, double viscosity, double ahead) {
  SolidLoad load;
  for (const CutCell<D>& cut : solids.surface()) {
    if (cut.body != body) continue;
    const auto add = [&](const CutCell<D>& piece) {
      add_piece(grid, solids, piece, pressure, velocity, viscosity, ahead, load);
    };
    if (!part) {
      add(cut);
      continue;
    }
    for (const CutCell<D>& piece : part_of_wall(grid, cut, *part)) add(piece);
  }
  for (int a = 0; a < 3; ++a) {
    load.force[a] = sum_over_ranks(grid, load.force[a]);
    load.moment[a] = sum_over_ranks(grid, load.moment[a]);
  }
  return load;
}

template class WallPressure<2>;
template class WallPressure<3>;
template SolidLoad load_on(const Grid<2>&, const SolidBodies<2>&, std::size_t,
                           const std::optional<BoxShape>&, const WallPressure<2>&,
                           const FaceVector<2>&, double, double);
template void find_body_friction(const Grid<2>&, const SolidBodies<2>&, const CellField<2>&, double,
                                 FaceVector<2>&);
template SolidLoad load_on(const Grid<3>&, const SolidBodies<3>&, std::size_t,
                           const std::optional<BoxShape>&, const WallPressure<3>&,
                           const FaceVector<3>&, double, double);
template void find_body_friction(const Grid<3>&, const SolidBodies<3>&, const CellField<3>&, double,
                                 FaceVector<3>&);

}  // namespace mudlark

#include "numerics/interface_advection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {
/// Below this saturation a cell holds nothing but round-off, above 1 - this nothing but water.
constexpr double sharp = 1e-12;
/// What a donor gives: by its plane; spray a mixture; a small cell with a pressure nothing but
/// water, because its host answers for it (docs/decisions/0097).
constexpr double by_plane = 0.0, mixture = 1.0, from_host = 2.0;
}  // namespace

template <int D>
InterfaceAdvection<D>::InterfaceAdvection(const Grid<D>& grid, const CellRuns<D>& near)
    : grid_(&grid),
      near_(&near),
      ghosts_(grid),
      alpha_(grid, "saturation", "1"),
      dilates_(grid, "dilates", "1"),
      mixed_(grid, "mixed spray", "1"),
      planes_(grid.local_size()),
      water_flux_(grid, "water flux", "1") {
  for (int a = 0; a < D; ++a) strides_[static_cast<std::size_t>(a)] = grid.stride(a);
}

namespace {

/// Each order is followed by its reverse, so no axis is preferred; x and z take turns as in the
/// plane, so space one cell thick is the plane.
template <int D>
std::array<int, D> axes_in_order(std::int64_t step) {
  std::array<int, D> axes;
  if constexpr (D == 2) {
    axes = {0, 1};
  } else {
    constexpr std::array<std::array<int, 3>, 3> forwards{{{0, 1, 2}, {1, 0, 2}, {0, 2, 1}}};
    axes = forwards[static_cast<std::size_t>(step / 2 % 3)];
  }
  if (step % 2 == 1) std::reverse(axes.begin(), axes.end());
  return axes;
}

}  // namespace

template <int D>
Plane<D> InterfaceAdvection<D>::plane(const double* alpha, std::ptrdiff_t at) const {
  return plane_of_volume<D>(interface_normal<D>(alpha + at, strides_.data()), alpha[at]);
}

template <int D>
void InterfaceAdvection<D>::sweep(CellField<D>& water, const CellField<D>& porosity,
                                  const FaceVector<D>& flux, double dt, std::int64_t order,
                                  Spray spray, const WallBand<D>* walls,
                                  const FaceVector<D>* inflow) {
  inflow_ = inflow;
  const double* w = water.data();
  const double* theta = porosity.data();
  double* c = dilates_.data();
  for_each_apart(
      *near_, grid_->owned().grown(1),
      [&](std::ptrdiff_t at) { c[at] = dilates(w[at], theta[at]) ? 1.0 : 0.0; }, w, theta, c);
  if (spray == Spray::mixed) find_spray(water, porosity);
  if (walls)
    for (const SmallCell& small : walls->small())
      if (c[small.at] > 0.0) mixed_.data()[small.at] = from_host;
  for (const int axis : axes_in_order<D>(order))
    sweep_axis(water, porosity, flux[axis], axis, dt, walls);
}

template <int D>
void InterfaceAdvection<D>::sweep_axis(CellField<D>& water, const CellField<D>& porosity,
                                       const FaceField<D>& flux, int axis, double dt,
                                       const WallBand<D>* walls) {
  const Grid<D>& grid = *grid_;
  const double* w = water.data();
  const double* theta = porosity.data();
  double* alpha = alpha_.data();
  for_each_apart(*near_, grid.owned(),
                 [&](std::ptrdiff_t at) { alpha[at] = theta[at] > 0.0 ? w[at] / theta[at] : 0.0; });
  ghosts_.update(alpha_, *near_);
  if (walls) walls->extend_saturation(porosity, alpha_);
  find_planes(axis);

  const std::ptrdiff_t s = grid.stride(axis);
  const double courant = dt / grid.spacing()[axis];
  const double* u = flux.data();
  double* through = water_flux_[axis].data();
  for_each_offset(
      *near_, bounding_faces(grid, axis),
      [&](std::ptrdiff_t at) {
        const std::ptrdiff_t donor = u[at] > 0.0 ? at - s : at;
        through[at] =
            u[at] == 0.0 ? 0.0 : water_through(u[at] * courant, donor, axis, theta[donor]);
      },
      u, alpha, theta, mixed_.data(), through);
  for (int side = 0; side < 2; ++side) {  // only air comes in through a wall, or what is let in
    if (!grid.touches(axis, side)) continue;
    IndexBox<D> wall = grid.owned();
    wall.lower[axis] = side == 0 ? wall.lower[axis] : wall.upper[axis];
    wall.upper[axis] = wall.lower[axis] + 1;
    for_each_offset(grid, wall, [&](std::ptrdiff_t at) {
      if (side == 0 ? u[at] > 0.0 : u[at] < 0.0)
        through[at] = inflow_ ? (*inflow_)[axis].data()[at] * u[at] * courant : 0.0;
    });
  }
  double* out = water.data();
  const double* c = dilates_.data();
  for_each_apart(
      *near_, grid.owned(),
      [&](std::ptrdiff_t at) {
        out[at] += through[at] - through[at + s] + c[at] * courant * (u[at + s] - u[at]);
      },
      through, c, u, out);
}

template <int D>
void InterfaceAdvection<D>::find_spray(const CellField<D>& water, const CellField<D>& porosity) {
  const double* w = water.data();
  const double* theta = porosity.data();
  double* mixed = mixed_.data();
  for_each_offset(
      *near_, grid_->owned().grown(1),
      [&](std::ptrdiff_t at) {
        bool alone = true;
        for (int a = 0; a < D; ++a) {
          if (grid_->cells()[a] == 1) continue;  // there it would meet its own images only
          for (const std::ptrdiff_t other : {at - grid_->stride(a), at + grid_->stride(a)})
            alone = alone && !dilates(w[other], theta[other]);
        }
        mixed[at] = alone ? mixture : by_plane;
      },
      w + grid_->stride(D - 1), theta + grid_->stride(D - 1), mixed);
}

/// Planes of the cells that may give water through faces of this axis: one layer more than the
/// owned ones.
template <int D>
void InterfaceAdvection<D>::find_planes(int axis) {
  IndexBox<D> box = grid_->owned();
  box.lower[axis] -= 1;
  box.upper[axis] += 1;
  const double* alpha = alpha_.data();
  for_each_offset(
      *near_, box,
      [&](std::ptrdiff_t at) {
        if (alpha[at] > sharp && alpha[at] < 1.0 - sharp)
          planes_[static_cast<std::size_t>(at)] = plane(alpha, at);
      },
      alpha);
}

/// Water carried through a face when the mixture moves by `shift` (cells, signed) into or out of
/// the donor.
template <int D>
double InterfaceAdvection<D>::water_through(double shift, std::ptrdiff_t donor, int axis,
                                            double porosity) const {
  if (mixed_.data()[donor] == from_host) return shift;
  const double alpha = alpha_.data()[donor];
  if (alpha <= 0.0) return 0.0;
  const double width = std::abs(shift) / porosity;
  double share;  // water in the slab per pore volume of the cell
  if (alpha >= 1.0 - sharp)
    share = width * std::min(alpha, 1.0);
  else if (alpha <= sharp || mixed_.data()[donor] == mixture)
    share = std::min(width, 1.0) * alpha;
  else
    share = water_in_slab(planes_[static_cast<std::size_t>(donor)], axis,
                          shift > 0.0 ? 1.0 - width : 0.0, width);
  return std::copysign(porosity * std::min(share, alpha), shift);
}

template <int D>
void InterfaceAdvection<D>::follow_porosity(const CellRuns<D>& where, CellField<D>& water,
                                            CellField<D>& porosity,
                                            const CellField<D>& new_porosity) const {
  double* w = water.data();
  double* theta = porosity.data();
  const double* moved = new_porosity.data();
  const double* c = dilates_.data();
  for_each_apart(
      where, grid_->owned(),
      [&](std::ptrdiff_t at) {
        w[at] += c[at] * (moved[at] - theta[at]);
        theta[at] = moved[at];
      },
      w, theta, moved, c);
}

template <int D>
void move_porosity(const Grid<D>& grid, const CellRuns<D>& where, const CellField<D>& porosity,
                   const FaceVector<D>& flux, double dt, CellField<D>& moved) {
  const double* theta = porosity.data();
  double* out = moved.data();
  for_each_apart(
      where, grid.owned(), [&](std::ptrdiff_t at) { out[at] = theta[at]; }, theta, out);
  for (int axis = 0; axis < D; ++axis) {
    const double* u = flux[axis].data();
    const std::ptrdiff_t s = grid.stride(axis);
    const double courant = dt / grid.spacing()[axis];
    for_each_apart(where, grid.owned(),
                   [&](std::ptrdiff_t at) { out[at] -= courant * (u[at + s] - u[at]); });
  }
}

template class InterfaceAdvection<2>;
template class InterfaceAdvection<3>;
template void move_porosity(const Grid<2>&, const CellRuns<2>&, const CellField<2>&,
                            const FaceVector<2>&, double, CellField<2>&);
template void move_porosity(const Grid<3>&, const CellRuns<3>&, const CellField<3>&,
                            const FaceVector<3>&, double, CellField<3>&);

}  // namespace mudlark

#include "flow/two_fluids.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "numerics/loops.hpp"
#include "numerics/plic.hpp"

namespace mudlark {
namespace {

/// Cells with less of one fluid than this are not cut by the surface.
constexpr double sharp = 1e-12;
/// A column of cells ends in one fluid when its last cell holds at most this much of the other.
constexpr double closed_column = 1e-3;

}  // namespace

template <int D>
TwoFluids<D>::TwoFluids(const Grid<D>& grid, const FlowOptions& options)
    : grid_(&grid),
      density_(options.density),
      viscosity_(options.viscosity),
      gas_(options.gas.value()),
      ghosts_(grid),
      mixture_(grid),
      old_mass_(grid, "old mass", "1"),
      mass_(grid, "mass", "1"),
      mass_flux_(grid, "carried mass", "1"),
      rise_(grid, "rise of the surface", "m2/s2"),
      resolved_(grid, "resolved surface", "1"),
      storage_(grid, "storage", "1/(Pa s)") {}

template <int D>
void TwoFluids<D>::find_mass(const CellField<D>& water, const CellField<D>& porosity,
                             CellField<D>& mass) const {
  const double ratio = gas_.density / density_;
  const double *w = water.data(), *theta = porosity.data();
  double* m = mass.data();
  for_each_offset(*grid_, grid_->local(),
                  [&](std::ptrdiff_t at) { m[at] = w[at] + ratio * (theta[at] - w[at]); });
}

template <int D>
void TwoFluids<D>::begin(const CellField<D>& water, const CellField<D>& porosity) {
  find_mass(water, porosity, old_mass_);
}

template <int D>
void TwoFluids<D>::move_momentum(const CellField<D>& water, const CellField<D>& porosity,
                                 const FaceVector<D>& flux, const FaceVector<D>& water_flux,
                                 double dt, MomentumTransport<D>& momentum,
                                 FaceVector<D>& velocity) {
  const double ratio = gas_.density / density_;
  for (int axis = 0; axis < D; ++axis) {
    const double courant = dt / grid_->spacing()[axis];
    const double *u = flux[axis].data(), *through = water_flux[axis].data();
    double* carried = mass_flux_[axis].data();
    for_each_offset(*grid_, bounding_faces(*grid_, axis), [&](std::ptrdiff_t at) {
      carried[at] = through[at] + ratio * (u[at] * courant - through[at]);
    });
  }
  ghosts_.exchange(mass_flux_);
  find_mass(water, porosity, mass_);
  momentum.advance(Inertia::water_and_gas, {&old_mass_, &mass_, &porosity, &mass_flux_}, velocity);
}

/// Where the surface lies on the axis through the cell's centre, from it towards the gas [m]: the
/// water in the column of cells along that axis says it exactly for a plane. The column must end in
/// water on one side and in gas on the other, and hold one surface only.
template <int D>
double TwoFluids<D>::height_in_column(const double* alpha, std::ptrdiff_t at, int axis,
                                      int direction, bool& found) const {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t out_of_water = direction * grid.stride(axis);
  const int cell = grid.index_along(axis, at);
  double height = (alpha[at] - 0.5) * grid.width(axis, cell), above = alpha[at], below = alpha[at];
  bool falling = true;
  for (int k = 1; k <= ghost_layers && above > sharp; ++k) {
    const double next = alpha[at + k * out_of_water];
    falling = falling && next <= above;
    height += next * grid.width(axis, cell + k * direction);
    above = next;
  }
  for (int k = 1; k <= ghost_layers && below < 1.0 - sharp; ++k) {
    const double next = alpha[at - k * out_of_water];
    falling = falling && next >= below;
    height -= (1.0 - next) * grid.width(axis, cell - k * direction);
    below = next;
  }
  found = falling && above < closed_column && below > 1.0 - closed_column;
  return height;
}

/// In each cell that the surface cuts: how far gravity's potential at the surface differs from that
/// at the cell's centre. Along the axis that is nearest to the surface's normal.
template <int D>
void TwoFluids<D>::find_surface_height(const CellField<D>& alpha) {
  const Grid<D>& grid = *grid_;
  std::array<std::ptrdiff_t, D> strides;
  for (int a = 0; a < D; ++a) strides[static_cast<std::size_t>(a)] = grid.stride(a);
  const double* share = alpha.data();
  double *rise = rise_.data(), *resolved = resolved_.data();
  for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {
    resolved[at] = 0.0;
    if (share[at] <= sharp || share[at] >= 1.0 - sharp) return;
    const Vec<D> normal = interface_normal<D>(share + at, strides.data());
    int axis = 0;
    for (int a = 1; a < D; ++a)
      if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
    const int direction = normal[axis] > 0.0 ? 1 : -1;
    bool found = false;
    rise[at] =
        grid.gravity()[axis] * direction * height_in_column(share, at, axis, direction, found);
    resolved[at] = found ? 1.0 : 0.0;
  });
  ghosts_.update(rise_);
  ghosts_.update(resolved_);
}

/// Balanced weight (NUMERICS B4; Popinet 2018, Annu. Rev. Fluid Mech. 50, sec. 4): with the density
/// rho of each cell,
///   rho_f g  becomes  mean(rho - rho_gas) g + d(rho)/dx (g.x - g.x_surface),
/// which is d/dx of (rho - rho_gas) g.(x - x_surface) and has no curl where g.x_surface is the same
/// along the surface: water at rest stays at rest. Where no surface is resolved (spray, bubbles) it
/// is the plain weight, so that they fall and rise.
template <int D>
void TwoFluids<D>::find_weight(int axis, const CellField<D>& porosity, const CellField<D>& alpha) {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t s = grid.stride(axis);
  const double g = grid.gravity()[axis];
  const double contrast = density_ - gas_.density;
  const double *mass = mass_.data(), *theta = porosity.data(), *share = alpha.data();
  const double *rise = rise_.data(), *resolved = resolved_.data();
  double *density = mixture_.density[axis].data(),
         *acceleration = mixture_.acceleration[axis].data();
  for_each_offset(grid, bounding_faces(grid, axis), [&](std::ptrdiff_t at) {
    const double room = theta[at] + theta[at - s];
    density[at] = room > 0.0 ? density_ * (mass[at] + mass[at - s]) / room : density_;
    double weight = 0.5 * (share[at] + share[at - s]) * g;
    const double known = resolved[at] + resolved[at - s];
    if (known > 0.0) {
      const double h = grid.gap(axis, grid.index_along(axis, at));
      const double surface = (resolved[at] > 0.0 ? rise[at] + 0.5 * g * h : 0.0) +
                             (resolved[at - s] > 0.0 ? rise[at - s] - 0.5 * g * h : 0.0);
      weight -= (share[at] - share[at - s]) / h * (surface / known);
    }
    acceleration[at] = contrast * weight / density[at];
  });
}

template <int D>
void TwoFluids<D>::find_mixture(const CellField<D>& water, const CellField<D>& porosity,
                                const CellField<D>& alpha) {
  find_mass(water, porosity, mass_);
  find_surface_height(alpha);
  for (int axis = 0; axis < D; ++axis) find_weight(axis, porosity, alpha);
  // Harmonic mean: layers of fluid sheared one upon the other.
  const double* share = alpha.data();
  double* viscosity = mixture_.viscosity.data();
  for_each_offset(*grid_, grid_->local(), [&](std::ptrdiff_t at) {
    const double mixed = share[at] * gas_.viscosity + (1.0 - share[at]) * viscosity_;
    viscosity[at] = mixed > 0.0 ? viscosity_ * gas_.viscosity / mixed : 0.0;
  });
}

template <int D>
const CellField<D>& TwoFluids<D>::with_gas_storage(const CellField<D>& give_way,
                                                   const CellField<D>& water,
                                                   const CellField<D>& porosity, double dt) {
  const double per_room = 1.0 / (gas_.bulk_modulus.value() * dt);
  const double *given = give_way.data(), *w = water.data(), *theta = porosity.data();
  double* storage = storage_.data();
  for_each_offset(*grid_, grid_->owned(), [&](std::ptrdiff_t at) {
    const bool gas = !InterfaceAdvection<D>::dilates(w[at], theta[at]);
    storage[at] = given[at] + (gas ? (theta[at] - w[at]) * per_room : 0.0);
  });
  return storage_;
}

template <int D>
const CellField<D>& TwoFluids<D>::find_reference(const CellField<D>& alpha) {
  const Grid<D>& grid = *grid_;
  int up = D - 1;  // without gravity the last axis
  for (int a = 0; a < D; ++a)
    if (std::abs(grid.gravity()[a]) > std::abs(grid.gravity()[up])) up = a;
  const int highest = grid.gravity()[up] > 0.0 ? 0 : grid.cells()[up] - 1;
  storage_.fill(0.0);
  double gas = 0.0;
  const auto count = [&](const Index<D>& cell, bool counts) {
    storage_[cell] = counts ? std::max(1.0 - alpha[cell], 0.0) : 0.0;
    gas += storage_[cell];
  };
  for_each(grid.owned(), [&](const Index<D>& cell) { count(cell, cell[up] == highest); });
  if (sum_over_ranks(grid, gas) < 1e-6)
    for_each(grid.owned(), [&](const Index<D>& cell) { count(cell, true); });
  return storage_;
}

template class TwoFluids<2>;
template class TwoFluids<3>;

}  // namespace mudlark

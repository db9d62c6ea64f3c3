#include "flow/viscous_force.hpp"

#include <algorithm>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// mu on the edge between the cells at, at - sa, at - sb and at - sa - sb.
double edge_viscosity(const double* viscosity, Mean mean, std::ptrdiff_t at, std::ptrdiff_t sa,
                      std::ptrdiff_t sb) {
  const double m0 = viscosity[at], m1 = viscosity[at - sa], m2 = viscosity[at - sb],
               m3 = viscosity[at - sa - sb];
  if (mean == Mean::arithmetic) return 0.25 * (m0 + m1 + m2 + m3);
  if (std::min({m0, m1, m2, m3}) <= 0.0) return 0.0;  // none there, or a wall where it is odd
  const double pairs = m0 * m1 * (m2 + m3) + m2 * m3 * (m0 + m1);
  return 4.0 * m0 * m1 * m2 * m3 / pairs;
}

}  // namespace

template <int D>
ViscousForce<D>::ViscousForce(const Grid<D>& grid) : grid_(&grid) {
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    for (int i = grid.local().lower[a]; i < grid.local().upper[a]; ++i) {
      inverse_width_[u].push_back(1.0 / grid.width(a, i));
      // No stencil reaches across the lowest face of the ghost layers.
      inverse_gap_[u].push_back(1.0 / grid.gap(a, std::max(i, -ghost_layers + 1)));
    }
  }
}

/// The capacities theta hold the volumes of cells and, divided by the distance across, areas.
template <int D>
void ViscousForce<D>::find(int component, const CellField<D>& viscosity, const CellField<D>* eddy,
                           Mean mean, const CellField<D>& porosity, const FaceVector<D>& velocity,
                           FaceField<D>& force) const {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t sa = grid.stride(component);
  const double *mu = viscosity.data(), *theta = porosity.data(), *v = velocity[component].data();
  const double* turbulent = eddy ? eddy->data() : nullptr;
  double* out = force.data();
  const auto local = [&](const Index<D>& face, int axis) {
    return static_cast<std::size_t>(face[axis] - grid.local().lower[axis]);
  };
  const auto& widths = inverse_width_[static_cast<std::size_t>(component)];
  const auto& gaps = inverse_gap_[static_cast<std::size_t>(component)];
  for_each_place(
      grid, bounding_faces(grid, component), [&](std::ptrdiff_t at, const Index<D>& face) {
        const std::size_t i = local(face, component);
        const auto normal = [&](std::ptrdiff_t cell, double inverse) {
          const double all = turbulent ? mu[cell] + turbulent[cell] : mu[cell];
          return 2.0 * theta[cell] * all * (v[cell + sa] - v[cell]) * inverse * inverse;
        };
        double sum = normal(at, widths[i]) - normal(at - sa, widths[i - 1]);
        for (int axis = 0; axis < D; ++axis) {
          if (axis == component) continue;
          const std::ptrdiff_t s = grid.stride(axis);
          const double* across = velocity[axis].data();
          const double* inverse =
              inverse_gap_[static_cast<std::size_t>(axis)].data() + local(face, axis);
          const auto tangential = [&](std::ptrdiff_t edge, double gap) {
            const double rate =
                (v[edge] - v[edge - s]) * gap + (across[edge] - across[edge - sa]) * gaps[i];
            double all = edge_viscosity(mu, Mean::harmonic, edge, sa, s);
            if (turbulent) all += edge_viscosity(turbulent, mean, edge, sa, s);
            const double room =
                0.25 * (theta[edge] + theta[edge - sa] + theta[edge - s] + theta[edge - sa - s]);
            return room * all * rate * gap;
          };
          sum += tangential(at + s, inverse[1]) - tangential(at, inverse[0]);
        }
        const double held = 0.5 * (theta[at] + theta[at - sa]);
        out[at] = held > 0.0 ? sum / held : 0.0;
      });
}

template class ViscousForce<2>;
template class ViscousForce<3>;

}  // namespace mudlark

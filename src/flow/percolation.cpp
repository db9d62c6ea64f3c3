#include "flow/percolation.hpp"

#include <algorithm>

#include "numerics/interface_advection.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Water of a cell that is free to move, and its room [-].
struct Free {
  double water, room;
};

}  // namespace

template <int D>
void fall_to_surface(const Grid<D>& grid, const PorousMedium<D>& medium,
                     const CellField<D>& porosity, const Percolation<D>& step,
                     CellField<D>& water) {
  constexpr int up = D - 1;
  const std::ptrdiff_t s = grid.stride(up);
  const double *drains = medium.drains.data(), *resistance = step.resistance[up].data();
  const double* carried = step.carried[up].data();
  const auto free_in = [&](std::ptrdiff_t at) {
    const double w = water.data()[at];
    const double held = std::min(w, medium.residual.data()[at] * medium.space.volume.data()[at]);
    return Free{w - held, porosity.data()[at] - held};
  };
  for_each_place(grid, bounding_faces(grid, up), [&](std::ptrdiff_t at, const Index<D>& face) {
    if (face[up] == 0 || face[up] == grid.cells()[up]) return;
    if (drains[at] == 0.0 || drains[at - s] == 0.0 || resistance[at] <= 0.0) return;
    const Free above = free_in(at), below = free_in(at - s);
    if (above.water <= 0.0 || InterfaceAdvection<D>::dilates(above.water, above.room)) return;
    if (!InterfaceAdvection<D>::dilates(below.water, below.room)) return;
    const double k = step.filling.relative_permeability(above.water / above.room);
    const double falls = step.weight * k / resistance[at] * step.dt / grid.spacing()[up];
    const double lacks = std::max(falls - std::max(-carried[at], 0.0), 0.0);
    const double amount = std::min({lacks, above.water, std::max(below.room - below.water, 0.0)});
    // No cell both gives and takes, so each is changed once.
    water.data()[at] -= amount;
    water.data()[at - s] += amount;
  });
}

template void fall_to_surface(const Grid<2>&, const PorousMedium<2>&, const CellField<2>&,
                              const Percolation<2>&, CellField<2>&);
template void fall_to_surface(const Grid<3>&, const PorousMedium<3>&, const CellField<3>&,
                              const Percolation<3>&, CellField<3>&);

}  // namespace mudlark

#pragma once
/// The transfers of transfer.hpp for points that are taken a cell at a time: kernels that are
/// quadratic across. Same sums as point by point, in another order.
#include "soil/cell_batches.hpp"
#include "soil/point_stencil.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

template <int D, class K, bool affine>
void scatter_by_cell(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                     const SurfacePressure<D>& surface, NodeField<NodeSums, D>& nodes);

template <int D, class K, bool affine>
void gather_by_cell(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes,
                    const PointUpdate& update, PointRange range, SoilParticles<D>& points,
                    PointMotion& motion);

}  // namespace mudlark

#include "flow/projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "flow/flow_checks.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Shortest distance from a pressure point to the surface, in cells: a shorter one only stiffens
/// the system.
constexpr double shortest = 0.05;
/// Passes of the solve for the rise of pressure, and how far each takes the divergence down.
constexpr int most_passes = 4;
constexpr double pass_reduction = 1e-8;
/// A start this much better than asked for needs no pass; any other gets one, or water at rest
/// would drift within the tolerance, step by step in the same direction.
constexpr double good_start = 1e-6;

/// Where the plane cuts the axis through the cell's centre: cells beyond the centre along the axis.
template <int D>
double crossing(const Plane<D>& plane, int axis) {
  double rest = plane.constant;
  for (int a = 0; a < D; ++a)
    if (a != axis) rest -= 0.5 * plane.normal[a];
  return rest / plane.normal[axis] - 0.5;
}

}  // namespace

template <int D>
Projection<D>::Projection(const Grid<D>& grid, const NearWater<D>& near, const FlowOptions& options)
    : grid_(&grid),
      near_(&near.cells()),
      beside_(&near.beside()),
      density_(options.density),
      ghosts_(grid),
      unknown_(grid, "pressure unknown", "1"),
      distance_(grid, "pressure distance", "1"),
      rise_(grid, "rise of pressure", "Pa"),
      risen_(grid, "rise of pressure", "Pa"),
      system_(grid),
      solver_(grid) {}

/// Distance xi from the centre of the wet cell towards its dry neighbour: by the interface plane in
/// the wet cell, else by that in the dry one, else between the saturations.
template <int D>
double Projection<D>::distance(const double* alpha, std::ptrdiff_t wet, int axis, int direction,
                               const InterfaceAdvection<D>& interface) const {
  const std::ptrdiff_t dry = wet + direction * grid_->stride(axis);
  if (alpha[wet] < 1.0 - 1e-9) {
    const Plane<D> plane = interface.plane(alpha, wet);
    if (plane.normal[axis] * direction > 1e-6) {
      const double xi = direction * crossing(plane, axis);
      if (xi <= 0.5) return std::max(xi, shortest);
    }
  }
  if (alpha[dry] > 1e-9) {
    const Plane<D> plane = interface.plane(alpha, dry);
    if (plane.normal[axis] * direction > 1e-6) {
      const double xi = 1.0 + direction * crossing(plane, axis);
      if (xi >= 0.5 && xi <= 1.0) return xi;
    }
  }
  return std::clamp((alpha[wet] - 0.5) / (alpha[wet] - alpha[dry]), shortest, 1.0);
}

/// xi counts in widths of the wet cell up to its end and in those of the dry one beyond; on a
/// stretched axis they differ.
template <int D>
double Projection<D>::in_mean_cells(double xi, std::ptrdiff_t wet, int axis, int direction) const {
  const Grid<D>& grid = *grid_;
  if (!grid.stretched(axis)) return xi;
  const int cell = grid.index_along(axis, wet);
  const double inside = std::min(xi, 0.5) * grid.width(axis, cell);
  const double beyond = std::max(xi - 0.5, 0.0) * grid.width(axis, cell + direction);
  return (inside + beyond) / grid.spacing()[axis];
}

/// Distance between the centres of the cells beside a face.
template <int D>
double Projection<D>::in_mean_cells(std::ptrdiff_t face, int axis) const {
  const Grid<D>& grid = *grid_;
  if (!grid.stretched(axis)) return 1.0;
  return grid.gap(axis, grid.index_along(axis, face)) / grid.spacing()[axis];
}

template <int D>
void Projection<D>::find_surface(const CellField<D>& water, const CellField<D>& porosity,
                                 const FaceVector<D>& capacity, const CellField<D>& alpha,
                                 const InterfaceAdvection<D>& interface,
                                 const FaceVector<D>* passes) {
  const Grid<D>& grid = *grid_;
  const double* w = water.data();
  const double* theta = porosity.data();
  double* unknown = unknown_.data();
  for_each_apart(
      *near_, grid.local(),
      [&](std::ptrdiff_t at) {
        unknown[at] = InterfaceAdvection<D>::dilates(w[at], theta[at]) ? 1.0 : 0.0;
      },
      w, theta, unknown);
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    double* distance_here = distance_[axis].data();
    const double* open = capacity[axis].data();
    for_each_apart(
        *near_, bounding_faces(grid, axis),
        [&](std::ptrdiff_t at) {
          if (open[at] == 0.0) {
            distance_here[at] = 0.0;
            return;
          }
          const bool above = unknown[at] > 0.0, below = unknown[at - s] > 0.0;
          double& here = distance_here[at];
          if (above && below)
            here = in_mean_cells(at, axis);
          else if (below)
            here =
                in_mean_cells(distance(alpha.data(), at - s, axis, 1, interface), at - s, axis, 1);
          else if (above)
            here = in_mean_cells(distance(alpha.data(), at, axis, -1, interface), at, axis, -1);
          else
            here = 0.0;
        },
        open, unknown, distance_here);
  }
  find_wall_distances(passes);
}

template <int D>
void Projection<D>::cover_all(const CellField<D>& porosity, const CellField<D>& reference) {
  const Grid<D>& grid = *grid_;
  const double* theta = porosity.data();
  double* unknown = unknown_.data();
  reference_ = &reference;
  for_each_offset(grid, grid.local(),
                  [&](std::ptrdiff_t at) { unknown[at] = theta[at] > 0.0 ? 1.0 : 0.0; });
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    double* distance_here = distance_[axis].data();
    for_each_offset(grid, bounding_faces(grid, axis), [&](std::ptrdiff_t at) {
      const bool joined = unknown[at] * unknown[at - s] > 0.0;
      distance_here[at] = joined ? in_mean_cells(at, axis) : 0.0;
    });
  }
  find_wall_distances(nullptr);
}

template <int D>
void Projection<D>::find_wall_distances(const FaceVector<D>* passes) {
  const Grid<D>& grid = *grid_;
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!grid.touches(axis, side)) continue;
      const bool open = grid.wall(axis, side) == Wall::open;
      IndexBox<D> wall = grid.owned();
      wall.lower[axis] = side == 0 ? wall.lower[axis] : wall.upper[axis];
      wall.upper[axis] = wall.lower[axis] + 1;
      const double half =
          0.5 * grid.width(axis, side == 0 ? 0 : grid.cells()[axis] - 1) / grid.spacing()[axis];
      const std::ptrdiff_t inside = side == 0 ? 0 : -grid.stride(axis);
      double* distance_here = distance_[axis].data();
      const double* unknown = unknown_.data();
      for_each_offset(grid, wall, [&](std::ptrdiff_t at) {
        const bool through = open || (passes && (*passes)[axis].data()[at] > 0.0);
        distance_here[at] = through && unknown[at + inside] > 0.0 ? half : 0.0;
      });
      // Nothing behind a wall is an unknown: the mirror cell only served the interface.
      IndexBox<D> behind = grid.owned();
      behind.lower[axis] = side == 0 ? behind.lower[axis] - 1 : behind.upper[axis];
      behind.upper[axis] = behind.lower[axis] + 1;
      double* flag = unknown_.data();
      for_each_offset(grid, behind, [&](std::ptrdiff_t at) { flag[at] = 0.0; });
    }
}

/// Couplings and Dirichlet terms of all faces. Returns whether any face of this rank sees a given
/// pressure.
template <int D>
bool Projection<D>::assemble_faces(const FaceVector<D>& capacity, const FaceVector<D>& mobility) {
  const Grid<D>& grid = *grid_;
  const double* unknown = unknown_.data();
  double* diagonal = system_.diagonal.data();
  std::int64_t given = 0;
  for (int axis = 0; axis < D; ++axis) {
    const double inverse = 1.0 / grid.spacing()[axis];
    const double* theta = capacity[axis].data();
    const double* m = mobility[axis].data();
    const double* reach = distance_[axis].data();
    double* coupling = system_.coupling[axis].data();
    for_each_apart(
        *beside_, bounding_faces(grid, axis),
        [&](std::ptrdiff_t at) {
          const double joined = theta[at] * m[at] * inverse * inverse / reach[at];
          coupling[at] = reach[at] > 0.0 ? joined : 0.0;
        },
        theta, m, reach, coupling);
  }
  const auto couplings = system_.coupling.data();
  const auto& strides = grid.strides();
  for_each_apart(
      *beside_, grid.owned(),
      [&](std::ptrdiff_t at) {
        double sum = diagonal[at];
        for (std::size_t a = 0; a < D; ++a) sum += couplings[a][at] + couplings[a][at + strides[a]];
        diagonal[at] = unknown[at] > 0.0 ? sum : diagonal[at];
      },
      couplings, diagonal, unknown);
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    const double* reach = distance_[axis].data();
    double* coupling = system_.coupling[axis].data();
    for_each_apart(
        *beside_, bounding_faces(grid, axis),
        [&](std::ptrdiff_t at) {
          const bool both = unknown[at] > 0.0 && unknown[at - s] > 0.0;
          given += reach[at] > 0.0 && !both ? 1 : 0;
          coupling[at] = both ? coupling[at] : 0.0;
        },
        unknown, reach, coupling);
  }
  return given > 0;
}

/// The velocity is corrected with the pressure at hand first, and the system is solved for the rise
/// of pressure alone: so the divergence that is left is round-off of the rise, not of the pressure
/// itself (forty metres of water would leave a hundred times more). Each further pass refines the
/// one before.
template <int D>
SolveReport Projection<D>::project(const FaceVector<D>& capacity, const FaceVector<D>& mobility,
                                   const CellField<D>& target, const CellField<D>& give_way,
                                   CellField<D>& pressure, FaceVector<D>& velocity,
                                   double tolerance) {
  const Grid<D>& grid = *grid_;
  const double* unknown = unknown_.data();
  double* p = pressure.data();
  for_each_apart(*beside_, grid.local(), [&](std::ptrdiff_t at) {
    if (unknown[at] == 0.0) p[at] = 0.0;  // atmosphere
  });
  ghosts_.update(pressure, *beside_);
  push(mobility, pressure, velocity);
  const auto clear = [&](CellField<D>& field) {
    for_each_apart(*beside_, grid.local(), [&](std::ptrdiff_t at) { field.data()[at] = 0.0; });
  };
  clear(risen_);
  assemble(capacity, mobility, give_way);
  SolveReport report;
  for (int pass = 0; pass < most_passes && !report.converged; ++pass) {
    const double left = find_divergence(capacity, target, give_way, velocity);
    report.residual = left;
    report.converged = left <= (pass == 0 ? good_start * tolerance : tolerance);
    if (report.converged || !std::isfinite(left)) break;
    clear(rise_);
    const SolveReport pass_report =
        solver_.solve(system_, rise_, std::max(0.1 * tolerance, pass_reduction * left),
                      pass == 0 ? Hierarchy::fresh : Hierarchy::kept);
    report.iterations += pass_report.iterations;
    push(mobility, rise_, velocity);
    const double* rise = rise_.data();
    for_each_apart(*beside_, grid.local(), [&](std::ptrdiff_t at) {
      p[at] += rise[at];
      risen_.data()[at] += rise[at];
    });
  }
  if (!report.converged) {
    report.residual = find_divergence(capacity, target, give_way, velocity);
    report.converged = report.residual <= tolerance;
  }
  if (!report.converged)
    throw DivergenceError(
        fmt::format("The water's pressure could not be found: after {} iterations the largest "
                    "divergence left is {:.3g} 1/s at {} (allowed {:.3g}).",
                    report.iterations, report.residual,
                    place_text(place_of_largest(grid, system_.right_side)), tolerance));
  if (system_.constant_free) fix_constant(pressure);
  return report;
}

/// The matrix, which is that of every pass. Collective.
template <int D>
void Projection<D>::assemble(const FaceVector<D>& capacity, const FaceVector<D>& mobility,
                             const CellField<D>& give_way) {
  const Grid<D>& grid = *grid_;
  const double* unknown = unknown_.data();
  bool storage = false;
  double* diagonal = system_.diagonal.data();
  for_each_apart(*beside_, grid.owned(), [&](std::ptrdiff_t at) {
    diagonal[at] = unknown[at] > 0.0 ? give_way.data()[at] : 0.0;
    storage = storage || diagonal[at] > 0.0;
  });
  const bool given = assemble_faces(capacity, mobility);
  const auto in_system = [&](std::ptrdiff_t at) { return diagonal[at] > 0.0; };
  find_spans(*beside_, grid.owned(), in_system, system_.unknowns);
  system_.constant_free = max_over_ranks(grid, given || storage ? 1.0 : 0.0) == 0.0;
}

/// The right side for a further rise of pressure: what is left of the divergence. Returns the
/// largest of it [1/s], over all ranks.
template <int D>
double Projection<D>::find_divergence(const FaceVector<D>& capacity, const CellField<D>& target,
                                      const CellField<D>& give_way, const FaceVector<D>& velocity) {
  const Grid<D>& grid = *grid_;
  const double* unknown = unknown_.data();
  double* right = system_.right_side.data();
  const double *wanted = target.data(), *given = give_way.data(), *risen = risen_.data();
  const auto theta = capacity.data(), v = velocity.data();
  const auto& strides = grid.strides();
  std::array<double, D> inverse;
  for (int a = 0; a < D; ++a) inverse[static_cast<std::size_t>(a)] = 1.0 / grid.spacing()[a];
  for_each_apart(
      *beside_, grid.owned(),
      [&](std::ptrdiff_t at) {
        double left = wanted[at] - given[at] * risen[at];
        for (std::size_t a = 0; a < D; ++a) {
          const std::ptrdiff_t next = at + strides[a];
          left -= (theta[a][next] * v[a][next] - theta[a][at] * v[a][at]) * inverse[a];
        }
        right[at] = unknown[at] > 0.0 ? left : 0.0;
      },
      theta, v, wanted, given, risen, unknown, right);
  return solver_.largest_right_side(system_);
}

/// In a closed full box only pressure differences count; the mean is set to that of water at rest
/// with zero pressure in its highest corner, or to zero where the reference says.
template <int D>
void Projection<D>::fix_constant(CellField<D>& pressure) {
  const Grid<D>& grid = *grid_;
  double* p = pressure.data();
  if (reference_) {
    const double* weight = reference_->data();
    double weights = 0.0, weighted = 0.0;
    for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {
      weights += weight[at];
      weighted += weight[at] * p[at];
    });
    weights = sum_over_ranks(grid, weights);
    weighted = sum_over_ranks(grid, weighted);
    if (weights > 0.0) {
      for_each_offset(grid, grid.local(), [&](std::ptrdiff_t at) { p[at] -= weighted / weights; });
      return;
    }
  }
  double cells = 0.0, missing = 0.0;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    if (unknown_[cell] == 0.0) return;  // all body
    cells += 1.0;
    const Vec<D> centre = grid.cell_centre(cell);
    for (int a = 0; a < D; ++a) {
      if (grid.periodic(a)) continue;
      const double g = grid.gravity()[a];
      missing += density_ * g * (centre[a] - (g < 0.0 ? grid.upper() : grid.lower())[a]);
    }
    missing -= pressure[cell];
  });
  const double shift = sum_over_ranks(grid, missing) / sum_over_ranks(grid, cells);
  const double* unknown = unknown_.data();
  for_each_offset(grid, grid.owned(), [&](std::ptrdiff_t at) {
    if (unknown[at] > 0.0) p[at] += shift;
  });
  ghosts_.update(pressure);
}

template <int D>
void Projection<D>::push(const FaceVector<D>& mobility, const CellField<D>& pressure,
                         FaceVector<D>& velocity) const {
  const Grid<D>& grid = *grid_;
  const double* unknown = unknown_.data();
  const double* p = pressure.data();
  for (int axis = 0; axis < D; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis);
    const double inverse = 1.0 / grid.spacing()[axis];
    const double* m = mobility[axis].data();
    const double* reach = distance_[axis].data();
    double* v = velocity[axis].data();
    for_each_apart(
        *beside_, bounding_faces(grid, axis),
        [&](std::ptrdiff_t at) {
          const double above = unknown[at] > 0.0 ? p[at] : 0.0,
                       below = unknown[at - s] > 0.0 ? p[at - s] : 0.0;
          const double change = m[at] * (above - below) * inverse / reach[at];
          v[at] -= reach[at] > 0.0 ? change : 0.0;
        },
        m, reach, p, unknown, v);
  }
}

/// Calls body(face, suction, direction) on faces between water and air; direction from the water to
/// the air. At the rim of the ground the suction fades with the grains: a surface that leaves them
/// is held back by ever less, and comes to rest where what is left carries it.
template <int D>
template <class Body>
void Projection<D>::for_each_meniscus(int axis, IndexBox<D> faces, const CellField<D>& suction,
                                      Body&& body) const {
  const Grid<D>& grid = *grid_;
  const std::ptrdiff_t s = grid.stride(axis);
  const double *unknown = unknown_.data(), *reach = distance_[axis].data();
  const double* pull = suction.data();
  for (int side = 0; side < 2; ++side)
    if (grid.touches(axis, side)) {
      if (side == 0)
        ++faces.lower[axis];
      else
        faces.upper[axis] = grid.cells()[axis];
    }
  for_each_offset(
      *beside_, faces,
      [&](std::ptrdiff_t at) {
        const bool above = unknown[at] > 0.0, below = unknown[at - s] > 0.0;
        if (reach[at] == 0.0 || above == below) return;
        const std::ptrdiff_t wet = above ? at : at - s, dry = above ? at - s : at;
        const double here = pull[wet] + std::min(reach[at], 1.0) * (pull[dry] - pull[wet]);
        if (here > 0.0) body(at, here, above ? -1.0 : 1.0);
      },
      unknown, reach);
}

template <int D>
void Projection<D>::pull(const FaceVector<D>& mobility, const CellField<D>& suction,
                         FaceVector<D>& velocity) const {
  for (int axis = 0; axis < D; ++axis) {
    const double *m = mobility[axis].data(), *reach = distance_[axis].data();
    double* v = velocity[axis].data();
    const double inverse = 1.0 / grid_->spacing()[axis];
    for_each_meniscus(axis, bounding_faces(*grid_, axis), suction,
                      [&](std::ptrdiff_t at, double here, double direction) {
                        v[at] += direction * m[at] * here * inverse / reach[at];
                      });
  }
}

template <int D>
void Projection<D>::hang(const CellField<D>& suction, FaceVector<D>& force) const {
  for (int axis = 0; axis < D; ++axis) {
    double* f = force[axis].data();
    const double inverse = 1.0 / grid_->spacing()[axis];
    const std::ptrdiff_t s = grid_->stride(axis);
    for_each_meniscus(axis, grid_->owned_faces(axis), suction,
                      [&](std::ptrdiff_t at, double here, double direction) {
                        const double pull = direction * here * inverse;
                        f[at - s] -= pull / 6.0;  // the cubic spline at its nodes
                        f[at] -= pull * 2.0 / 3.0;
                        f[at + s] -= pull / 6.0;
                      });
  }
}

template class Projection<2>;
template class Projection<3>;

}  // namespace mudlark

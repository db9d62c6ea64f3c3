#pragma once
/// The nodes around a point and their weights, for one component of the staggered grid or for
/// cells.
#include <array>
#include <utility>

#include "grid/bspline.hpp"
#include "grid/field.hpp"
#include "soil/options.hpp"

namespace mudlark {

/// Degrees of the splines along a component's own axis and across it.
struct LinearKernel {
  static constexpr int along = 1, across = 1;
};
struct QuadraticKernel {
  static constexpr int along = 2, across = 2;
};
struct CompositeKernel {  // Gruninger & Griffith (2025), NUMERICS C2
  static constexpr int along = 3, across = 2;
};

/// Splines of one point on every axis: about the faces and about the cell centres.
template <int D, class K>
struct PointSplines {
  template <std::size_t... A>
  PointSplines(const Vec<D>& cells_from_lower, std::index_sequence<A...>)
      : face{BSpline<K::along>(cells_from_lower[static_cast<int>(A)])...},
        centre{BSpline<K::across>(cells_from_lower[static_cast<int>(A)] - 0.5)...} {}
  explicit PointSplines(const Vec<D>& cells_from_lower)
      : PointSplines(cells_from_lower, std::make_index_sequence<static_cast<std::size_t>(D)>{}) {}

  std::array<BSpline<K::along>, D> face;
  std::array<BSpline<K::across>, D> centre;

  /// Spline on `axis` for component `Component` (-1: cell centres).
  template <int Component, int Axis>
  const auto& on() const {
    if constexpr (Component == Axis)
      return face[static_cast<std::size_t>(Axis)];
    else
      return centre[static_cast<std::size_t>(Axis)];
  }

  /// Calls f(offset, weight, gradient [1/m], from_first) for each node of a component; from_first
  /// counts nodes from the stencil's first node per axis.
  template <int Component, class F>
  void for_each_node(const Grid<D>& grid, const Vec<D>& per_spacing, F&& f) const {
    const auto& sx = on<Component, 0>();
    if constexpr (D == 2) {
      const auto& sz = on<Component, 1>();
      const std::ptrdiff_t base = grid.offset(Index<2>{{sx.first, sz.first}});
      for (std::size_t k = 0; k < sz.weight.size(); ++k)
        for (std::size_t i = 0; i < sx.weight.size(); ++i)
          f(base + static_cast<std::ptrdiff_t>(i) + static_cast<std::ptrdiff_t>(k) * grid.stride(1),
            sx.weight[i] * sz.weight[k],
            Vec<2>{{sx.slope[i] * sz.weight[k] * per_spacing[0],
                    sx.weight[i] * sz.slope[k] * per_spacing[1]}},
            Vec<2>{{static_cast<double>(i), static_cast<double>(k)}});
    } else {
      const auto& sy = on<Component, 1>();
      const auto& sz = on<Component, 2>();
      const std::ptrdiff_t base = grid.offset(Index<3>{{sx.first, sy.first, sz.first}});
      for (std::size_t k = 0; k < sz.weight.size(); ++k)
        for (std::size_t j = 0; j < sy.weight.size(); ++j) {
          const double wyz = sy.weight[j] * sz.weight[k];
          const double gy = sy.slope[j] * sz.weight[k] * per_spacing[1];
          const double gz = sy.weight[j] * sz.slope[k] * per_spacing[2];
          const std::ptrdiff_t row = base + static_cast<std::ptrdiff_t>(j) * grid.stride(1) +
                                     static_cast<std::ptrdiff_t>(k) * grid.stride(2);
          for (std::size_t i = 0; i < sx.weight.size(); ++i)
            f(row + static_cast<std::ptrdiff_t>(i), sx.weight[i] * wyz,
              Vec<3>{{sx.slope[i] * wyz * per_spacing[0], sx.weight[i] * gy, sx.weight[i] * gz}},
              Vec<3>{{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}});
        }
    }
  }

  /// Position of the stencil's first node relative to the point, in cells.
  template <int Component>
  Vec<D> first_from_point(const Vec<D>& cells_from_lower) const {
    Vec<D> distance;
    static_for<D>([&]<int Axis>() {
      const double node = on<Component, Axis>().first + (Component == Axis ? 0.0 : 0.5);
      distance[Axis] = node - cells_from_lower[Axis];
    });
    return distance;
  }

  /// Runs f.operator()<0>() .. <N-1>().
  template <int N, class F>
  static void static_for(F&& f) {
    [&]<int... I>(std::integer_sequence<int, I...>) { (f.template operator()<I>(), ...); }
    (std::make_integer_sequence<int, N>{});
  }
};

/// Calls f with the kernel as a type, so that loops are compiled for it.
template <class F>
void with_kernel(Kernel kernel, F&& f) {
  switch (kernel) {
    case Kernel::linear:
      return f(LinearKernel{});
    case Kernel::quadratic:
      return f(QuadraticKernel{});
    case Kernel::composite:
      return f(CompositeKernel{});
  }
}

template <int D>
Vec<D> inverse(const Vec<D>& spacing) {
  Vec<D> out;
  for (int a = 0; a < D; ++a) out[a] = 1.0 / spacing[a];
  return out;
}

/// Position in cells from the domain's lower corner.
template <int D>
Vec<D> in_cells(const Grid<D>& grid, const Vec<D>& per_spacing, const Vec<D>& position) {
  Vec<D> out;
  for (int a = 0; a < D; ++a) out[a] = (position[a] - grid.lower()[a]) * per_spacing[a];
  return out;
}

/// Value and gradient of a cell field at a point.
template <int D>
struct Sample {
  double value = 0.0;
  Vec<D> gradient{};
};

template <int D, class K>
Sample<D> sample(const Grid<D>& grid, const PointSplines<D, K>& splines, const Vec<D>& per_spacing,
                 const CellField<D>* field) {
  Sample<D> s;
  if (!field) return s;
  const double* values = field->data();
  splines.template for_each_node<-1>(
      grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>& g, const Vec<D>&) {
        s.value += w * values[at];
        s.gradient += values[at] * g;
      });
  return s;
}

}  // namespace mudlark

#include "soil/implicit_operator.hpp"

#include "soil/implicit_rows.hpp"
#include "soil/point_stencil.hpp"

namespace mudlark {
namespace {

/// Runs f.operator()<0>() .. <D-1>().
template <int D, class F>
void for_components(F&& f) {
  PointSplines<D, CompositeKernel>::template static_for<D>(f);
}

template <int D>
Vec<D> row(const typename LinearPoint<D>::Gradient& matrix, int component) {
  Vec<D> values;
  for (int j = 0; j < D; ++j) values[j] = matrix(component, j);
  return values;
}

template <int D>
typename LinearPoint<D>::Gradient gradient(const PointRows<D>& rows,
                                           const std::array<double*, D>& faces) {
  typename LinearPoint<D>::Gradient all;
  for_components<D>([&]<int Component>() {
    const Vec<D> slopes =
        rows.template gradient<Component>(faces[static_cast<std::size_t>(Component)]);
    for (int j = 0; j < D; ++j) all(Component, j) = slopes[j];
  });
  return all;
}

template <int D>
void push(const PointRows<D>& rows, const typename LinearPoint<D>::Gradient& stress,
          const std::array<double*, D>& force) {
  for_components<D>([&]<int Component>() {
    rows.template push<Component>(row<D>(stress, Component),
                                  force[static_cast<std::size_t>(Component)]);
  });
}

/// Written out: GCC 12 warns about Eigen's own sum with 512-bit registers.
template <int D>
double inner(const typename LinearPoint<D>::Gradient& a,
             const typename LinearPoint<D>::Gradient& b) {
  double sum = 0.0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += a(i, j) * b(i, j);
  return sum;
}

/// Tangent : gradient, column after column.
template <int D>
typename LinearPoint<D>::Gradient stress_of(const LinearPoint<D>& point,
                                            const typename LinearPoint<D>::Gradient& gradient) {
  constexpr int G = D * D;
  typename LinearPoint<D>::Gradient stress = LinearPoint<D>::Gradient::Zero();
  const double* entry = point.tangent.data();
  for (int c = 0; c < G; ++c) {
    const double g = gradient.data()[c];
    for (int r = 0; r < G; ++r) stress.data()[r] += *entry++ * g;
  }
  return stress;
}

}  // namespace

template <int D>
PointOperator<D>::PointOperator(const Grid<D>& grid, const Points& points)
    : grid_(&grid), per_spacing_(inverse(grid.spacing())), points_(&points) {}

template <int D>
template <class F>
void PointOperator<D>::for_each(F&& f) const {
  for (const LinearPoint<D>& point : *points_)
    f(point, PointRows<D>(*grid_, per_spacing_, point.position));
}

template <int D>
void PointOperator<D>::apply(const Faces& grains, const double* pressure, const double* flow,
                             const Sums& sums) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    const auto slopes = gradient<D>(rows, grains);
    auto stress = stress_of<D>(point, slopes);
    if (point.wet) {
      const double p = rows.at_cells(pressure);
      stress -= p * point.cofactor;
      const double stretch = inner<D>(point.cofactor, slopes);
      rows.add_to_cells(point.volume * (point.storage * p + stretch + rows.at_cells(flow)),
                        sums.storage);
      rows.add_to_cells(point.volume * p, sums.pore_push);
    }
    stress *= point.volume;
    push<D>(rows, stress, sums.force);
  });
}

template <int D>
void PointOperator<D>::apply_stiffness(const Faces& grains, const Faces& force) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    auto stress = stress_of<D>(point, gradient<D>(rows, grains));
    stress *= point.volume;
    push<D>(rows, stress, force);
  });
}

template <int D>
void PointOperator<D>::add_stiffness_diagonal(const Faces& diagonal) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    for_components<D>([&]<int Component>() {
      const Eigen::Matrix<double, D, D> stiffness =
          point.volume * point.tangent.template block<D, D>(Component * D, Component * D);
      rows.template add_diagonal<Component>(stiffness,
                                            diagonal[static_cast<std::size_t>(Component)]);
    });
  });
}

template <int D>
void PointOperator<D>::apply_volume(const Faces& grains, const double* flow,
                                    double* storage) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    if (!point.wet) return;
    const auto slopes = gradient<D>(rows, grains);
    const double stretch = inner<D>(point.cofactor, slopes);
    rows.add_to_cells(point.volume * (stretch + rows.at_cells(flow)), storage);
  });
}

template <int D>
void PointOperator<D>::apply_mass(const double* cells, double* sums) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    if (point.wet) rows.add_to_cells(point.volume * rows.at_cells(cells), sums);
  });
}
template <int D>
void PointOperator<D>::add_mass_diagonal(double* diagonal) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    if (point.wet) rows.add_squares(point.volume, diagonal);
  });
}

template <int D>
void PointOperator<D>::add_compliance(double* volume, double* compliance) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    if (!point.wet) return;
    double confined = 0.0, largest = 0.0;
    for (int i = 0; i < D; ++i) {
      const double stiffness = point.tangent(i * D + i, i * D + i);
      confined += stiffness / D;
      largest = std::max(largest, stiffness);
    }
    confined = std::max(confined, 1e-3 * std::max(largest, 1.0));
    rows.add_to_cells(point.volume, volume);
    rows.add_to_cells(point.volume * (point.storage + 1.0 / confined), compliance);
  });
}

template <int D>
void PointOperator<D>::add_drag(const Faces& drag) const {
  for_each([&](const LinearPoint<D>& point, const PointRows<D>& rows) {
    if (!point.wet) return;
    for_components<D>([&]<int Component>() {
      rows.template add_to_faces<Component>(point.volume * point.drag,
                                            drag[static_cast<std::size_t>(Component)]);
    });
  });
}

template class PointOperator<2>;
template class PointOperator<3>;

}  // namespace mudlark

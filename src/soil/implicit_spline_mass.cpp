#include "soil/implicit_spline_mass.hpp"

#include <cmath>

namespace mudlark {
namespace {

/// Rows of the Cholesky factor L of the infinite banded matrix of B-spline products, diagonal one:
/// l[i][k] stands k before the diagonal. They converge within some ten rows; the last is repeated.
template <int Degree>
class BandedFactor {
 public:
  static constexpr std::size_t rows = 48;
  struct Row {
    std::array<double, Degree + 1> before;  ///< [0]: one over the diagonal entry
  };
  BandedFactor() {
    // Integrals of products of B-splines k apart: values of the spline of degree 2 Degree + 1.
    constexpr std::array<double, 4> of_degree_2{66.0, 26.0, 1.0, 0.0};
    constexpr std::array<double, 4> of_degree_3{2416.0, 1191.0, 120.0, 1.0};
    const auto& product = Degree == 2 ? of_degree_2 : of_degree_3;
    std::array<std::array<double, Degree + 1>, rows> factor{};  // with the diagonal itself
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t k = std::min<std::size_t>(Degree, i) + 1; k-- > 0;) {
        double rest = product[k] / product[0];
        for (std::size_t m = k + 1; m <= Degree && m <= i; ++m)
          rest -= factor[i][m] * factor[i - k][m - k];
        factor[i][k] = k == 0 ? std::sqrt(rest) : rest / factor[i - k][0];
      }
    for (std::size_t i = 0; i < rows; ++i) {
      row_[i].before = factor[i];
      row_[i].before[0] = 1.0 / factor[i][0];
    }
  }
  const Row& operator[](std::size_t i) const { return row_[std::min(i, rows - 1)]; }

 private:
  std::array<Row, rows> row_;
};

template <int Degree>
const BandedFactor<Degree>& factor() {
  static const BandedFactor<Degree> the;
  return the;
}

/// values <- L^-1 values along a run.
template <int Degree>
void forward(const PetscInt* order, std::size_t length, double* values) {
  const auto& rows = factor<Degree>();
  for (std::size_t i = 0; i < length; ++i) {
    const auto& row = rows[i].before;
    double rest = values[order[i]];
    for (std::size_t k = 1; k <= Degree && k <= i; ++k) rest -= row[k] * values[order[i - k]];
    values[order[i]] = rest * row[0];
  }
}
/// values <- L^-T values along a run.
template <int Degree>
void backward(const PetscInt* order, std::size_t length, double* values) {
  const auto& rows = factor<Degree>();
  for (std::size_t i = length; i-- > 0;) {
    double rest = values[order[i]];
    for (std::size_t k = 1; k <= Degree && i + k < length; ++k)
      rest -= rows[i + k].before[k] * values[order[i + k]];
    values[order[i]] = rest * rows[i].before[0];
  }
}

}  // namespace

template <int D>
void SplineMass<D>::add(const Grid<D>& grid, int component, std::span<const PetscInt> numbers,
                        PetscInt first) {
  const IndexBox<D> box = component < 0 ? grid.owned() : grid.owned_faces(component);
  for (int axis = 0; axis < D; ++axis) {
    Sweep& sweep = sweeps_[static_cast<std::size_t>(axis)];
    IndexBox<D> starts = box;
    starts.upper[axis] = starts.lower[axis] + 1;
    for_each(starts, [&](const Index<D>& start) {
      bool open = false;
      for (int i = 0; i < box.upper[axis] - box.lower[axis]; ++i) {
        const PetscInt number =
            numbers[static_cast<std::size_t>(grid.offset(start.shifted(axis, i)))];
        if (number < 0) {
          open = false;
          continue;
        }
        if (!open) sweep.runs.push_back({sweep.order.size(), 0, component == axis ? 3 : 2});
        open = true;
        sweep.order.push_back(number - first);
        ++sweep.runs.back().length;
      }
    });
  }
}

template <int D>
void SplineMass<D>::set_diagonal(::Vec diagonal) {
  PetscInt size = 0;
  const PetscScalar* values = nullptr;
  VecGetLocalSize(diagonal, &size);
  VecGetArrayRead(diagonal, &values);
  scale_.resize(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < scale_.size(); ++i)
    scale_[i] = values[i] > 0.0 ? 1.0 / std::sqrt(values[i]) : 0.0;
  VecRestoreArrayRead(diagonal, &values);
}

template <int D>
void SplineMass<D>::apply(::Vec in, ::Vec out) const {
  const PetscScalar* from = nullptr;
  PetscScalar* values = nullptr;
  VecGetArrayRead(in, &from);
  VecGetArray(out, &values);
  for (std::size_t i = 0; i < scale_.size(); ++i) values[i] = scale_[i] * from[i];
  for (int axis = 0; axis < D; ++axis) {
    const Sweep& sweep = sweeps_[static_cast<std::size_t>(axis)];
    for (const Run& run : sweep.runs)
      run.degree == 3 ? forward<3>(&sweep.order[run.first], run.length, values)
                      : forward<2>(&sweep.order[run.first], run.length, values);
  }
  for (int axis = D - 1; axis >= 0; --axis) {
    const Sweep& sweep = sweeps_[static_cast<std::size_t>(axis)];
    for (const Run& run : sweep.runs)
      run.degree == 3 ? backward<3>(&sweep.order[run.first], run.length, values)
                      : backward<2>(&sweep.order[run.first], run.length, values);
  }
  for (std::size_t i = 0; i < scale_.size(); ++i) values[i] *= scale_[i];
  VecRestoreArray(out, &values);
  VecRestoreArrayRead(in, &from);
}

template class SplineMass<2>;
template class SplineMass<3>;

}  // namespace mudlark

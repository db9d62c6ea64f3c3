#pragma once
/// One point's splines for sums over its nodes, row by row along x: lanes are the nodes of a row.
/// Composite kernel only: cubic about faces along a component's axis, quadratic otherwise.
#include <cmath>

#include "soil/cell_splines.hpp"
#include "soil/mirror.hpp"

namespace mudlark {

template <int D>
class PointRows {
 public:
  PointRows(const Grid<D>& grid, const Vec<D>& per_spacing, const Vec<D>& position)
      : stride_{1, D == 3 ? grid.stride(1) : 0, grid.stride(D - 1)} {
    Index<D> corner;
    for (int a = 0; a < D; ++a) {
      const double from_lower = (position[a] - grid.lower()[a]) * per_spacing[a];
      const double cell = std::floor(from_lower), place = from_lower - cell;
      corner[a] = static_cast<int>(cell) - 1;
      const auto u = static_cast<std::size_t>(a);
      if (a == 0) {
        face_x_ = NodeSpline::about_faces<3>(place, per_spacing[0]);
        centre_x_ = NodeSpline::about_centres(place, per_spacing[0]);
      } else {
        face_[u] = face_spline<3>(place, per_spacing[a]);
        centre_[u] = centre_spline(place, per_spacing[a]);
      }
    }
    first_ = grid.offset(corner);
  }

  /// Slopes of the value of one component [unit of the field per m].
  template <int Component>
  Vec<D> gradient(const double* faces) const {
    const NodeSpline& x = along_x<Component>();
    Lanes<4> along{}, across{}, up{};
    for_each_row<Component>(
        [&](std::ptrdiff_t at, const auto& y, const auto& z, std::size_t j, std::size_t k) {
          const Lanes<4> row = load<4>(faces + first_ + at);
          if constexpr (D == 3) {
            along += (y.weight[j] * z.weight[k]) * row;
            across += (y.slope[j] * z.weight[k]) * row;
            up += (y.weight[j] * z.slope[k]) * row;
          } else {
            along += z.weight[k] * row;
            up += z.slope[k] * row;
          }
        });
    Vec<D> slopes;
    slopes[0] = sum(x.slope * along);
    if constexpr (D == 3) slopes[1] = sum(x.weight * across);
    slopes[D - 1] = sum(x.weight * up);
    return slopes;
  }
  /// Adds forces whose work on a displacement is `stress` times its slopes.
  template <int Component>
  void push(const Vec<D>& stress, double* faces) const {
    const NodeSpline& x = along_x<Component>();
    for_each_row<Component>([&](std::ptrdiff_t at, const auto& y, const auto& z, std::size_t j,
                                std::size_t k) {
      double* nodes = faces + first_ + at;
      Lanes<4> row = load<4>(nodes);
      if constexpr (D == 3)
        row += (stress[0] * (y.weight[j] * z.weight[k])) * x.slope +
               (stress[1] * (y.slope[j] * z.weight[k]) + stress[2] * (y.weight[j] * z.slope[k])) *
                   x.weight;
      else
        row += (stress[0] * z.weight[k]) * x.slope + (stress[1] * z.slope[k]) * x.weight;
      store<4>(row, nodes);
    });
  }
  /// Adds the squares of what `push` would write for unit displacements, weighted by `stiffness`
  /// (row i, column j): the diagonal of a stiffness.
  template <int Component, class Stiffness>
  void add_diagonal(const Stiffness& stiffness, double* faces) const {
    const NodeSpline& x = along_x<Component>();
    for_each_row<Component>(
        [&](std::ptrdiff_t at, const auto& y, const auto& z, std::size_t j, std::size_t k) {
          double* nodes = faces + first_ + at;
          std::array<Lanes<4>, D> slope;
          if constexpr (D == 3) {
            slope = {(y.weight[j] * z.weight[k]) * x.slope, (y.slope[j] * z.weight[k]) * x.weight,
                     (y.weight[j] * z.slope[k]) * x.weight};
          } else {
            slope = {z.weight[k] * x.slope, z.slope[k] * x.weight};
          }
          Lanes<4> row = load<4>(nodes);
          for (int i = 0; i < D; ++i)
            for (int l = 0; l < D; ++l)
              row += stiffness(i, l) * slope[static_cast<std::size_t>(i)] *
                     slope[static_cast<std::size_t>(l)];
          store<4>(row, nodes);
        });
  }
  /// Adds the weights of a component's nodes times `value`.
  template <int Component>
  void add_to_faces(double value, double* faces) const {
    add_weights<Component>(value, faces);
  }
  double at_cells(const double* cells) const {
    Lanes<4> all{};
    for_each_row<-1>(
        [&](std::ptrdiff_t at, const auto& y, const auto& z, std::size_t j, std::size_t k) {
          const double w = D == 3 ? y.weight[j] * z.weight[k] : z.weight[k];
          all += w * load<4>(cells + first_ + at);
        });
    return sum(centre_x_.weight * all);
  }
  void add_to_cells(double value, double* cells) const { add_weights<-1>(value, cells); }
  /// Adds the squares of the cells' weights times `value`.
  void add_squares(double value, double* cells) const {
    for_each_row<-1>(
        [&](std::ptrdiff_t at, const auto& y, const auto& z, std::size_t j, std::size_t k) {
          const double w = D == 3 ? y.weight[j] * z.weight[k] : z.weight[k];
          double* nodes = cells + first_ + at;
          store<4>(load<4>(nodes) + (value * w * w) * centre_x_.weight * centre_x_.weight, nodes);
        });
  }

 private:
  static double sum(const Lanes<4>& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

  template <int Component>
  const NodeSpline& along_x() const {
    if constexpr (Component == 0)
      return face_x_;
    else
      return centre_x_;
  }
  template <int Component, int Axis>
  const auto& on() const {
    if constexpr (Component == Axis)
      return face_[static_cast<std::size_t>(Axis)];
    else
      return centre_[static_cast<std::size_t>(Axis)];
  }
  /// f(offset of the row from the first node, splines along y and z, row's number on them).
  template <int Component, class F>
  void for_each_row(F&& f) const {
    const auto& z = on<Component, D - 1>();
    if constexpr (D == 2) {
      for (std::size_t k = 0; k < z.weight.size(); ++k)
        f(static_cast<std::ptrdiff_t>(k) * stride_[2], z, z, 0, k);
    } else {
      const auto& y = on<Component, 1>();
      for (std::size_t k = 0; k < z.weight.size(); ++k)
        for (std::size_t j = 0; j < y.weight.size(); ++j)
          f(static_cast<std::ptrdiff_t>(j) * stride_[1] +
                static_cast<std::ptrdiff_t>(k) * stride_[2],
            y, z, j, k);
    }
  }
  template <int Component>
  void add_weights(double value, double* nodes_of_grid) const {
    const NodeSpline& x = along_x<Component>();
    for_each_row<Component>(
        [&](std::ptrdiff_t at, const auto& y, const auto& z, std::size_t j, std::size_t k) {
          const double w = D == 3 ? y.weight[j] * z.weight[k] : z.weight[k];
          double* nodes = nodes_of_grid + first_ + at;
          store<4>(load<4>(nodes) + (value * w) * x.weight, nodes);
        });
  }

  std::array<std::ptrdiff_t, 3> stride_;
  std::ptrdiff_t first_ = 0;
  NodeSpline face_x_, centre_x_;
  std::array<AxisSpline<double, 4>, D> face_;
  std::array<AxisSpline<double, 3>, D> centre_;
};

}  // namespace mudlark

#pragma once
/// The linearised points of an implicit step as an operator on fields: no matrix.
#include <array>
#include <utility>
#include <vector>

#include "grid/field.hpp"
#include "soil/implicit_tangent.hpp"
#include "soil/options.hpp"

namespace mudlark {

/// Where the components of face values begin.
template <int D>
std::array<double*, D> pointers(FaceVector<D>& faces) {
  std::array<double*, D> all{};
  for (int a = 0; a < D; ++a) all[static_cast<std::size_t>(a)] = faces[a].data();
  return all;
}
template <int D>
std::array<const double*, D> pointers(const FaceVector<D>& faces) {
  std::array<const double*, D> all{};
  for (int a = 0; a < D; ++a) all[static_cast<std::size_t>(a)] = faces[a].data();
  return all;
}

/// Sums over points that are given as LinearPoint, composite kernel. All fields by local offset;
/// what is read has valid ghosts and mirrors, what is written is added up and not folded.
template <int D>
class PointOperator {
 public:
  using Points = std::vector<LinearPoint<D>>;
  using Faces = std::array<double*, D>;

  PointOperator(const Grid<D>& grid, const Points& points);

  /// What the mixture, the water and the storage of cells get of ways and pressure. `flow`:
  /// divergence of the water's way in cells; `pore_push`: sum of V N dp, whose differences push the
  /// water.
  struct Sums {
    Faces force;
    double *storage, *pore_push;
  };
  void apply(const Faces& grains, const double* pressure, const double* flow,
             const Sums& sums) const;
  /// Stiffness of the grains alone.
  void apply_stiffness(const Faces& grains, const Faces& force) const;
  void add_stiffness_diagonal(const Faces& diagonal) const;
  /// Change of stored volume by ways alone: sum of V N (cofactor : grad u + flow).
  void apply_volume(const Faces& grains, const double* flow, double* storage) const;
  /// Sum of V N N^T of wet points, and its diagonal.
  void apply_mass(const double* cells, double* sums) const;
  void add_mass_diagonal(double* diagonal) const;
  /// Sums of V N and of V N (storage + 1 / stiffness to confined compression) of wet points.
  void add_compliance(double* volume, double* compliance) const;
  /// Sum of V W drag.
  void add_drag(const Faces& drag) const;

  const Points& points() const { return *points_; }

 private:
  template <class F>
  void for_each(F&& f) const;

  const Grid<D>* grid_;
  Vec<D> per_spacing_;
  const Points* points_;
};

extern template class PointOperator<2>;
extern template class PointOperator<3>;

}  // namespace mudlark

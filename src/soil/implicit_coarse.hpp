#pragma once
/// Displacements on a grid of twice the cell size, for the multigrid of implicit steps.
#include <vector>

#include "grid/grid.hpp"
#include "soil/contact_stiffness.hpp"
#include "soil/implicit_places.hpp"
#include "soil/implicit_tangent.hpp"

namespace mudlark {

/// A spline of a coarse grid is a sum of splines of the fine one (two-scale relation: weights 1 4 6
/// 4 1 over 8 for cubic ones about faces, 1 3 3 1 over 4 for quadratic ones about cells), so the
/// coarse space is a part of the fine one and no displacement that matters is missed. The coarse
/// stiffness is that of the points, all points of a fine cell taken as one. Walls need no care:
/// what lies behind them belongs to no unknown.
template <int D>
class CoarseDisplacements {
 public:
  /// `places` of the grains' displacements on the fine grid. Collective.
  CoarseDisplacements(const Grid<D>& grid, const UnknownPlaces& places,
                      const std::vector<LinearPoint<D>>& points,
                      const ContactStiffness<D>& contacts,
                      const std::array<std::vector<double>, D>& signs);
  CoarseDisplacements(const CoarseDisplacements&) = delete;
  CoarseDisplacements& operator=(const CoarseDisplacements&) = delete;

  /// Adds the displacement that nearly balances `residual` on the coarse grid to `fine`.
  void correct(::Vec residual, ::Vec fine);
  PetscInt size() const { return static_cast<PetscInt>(size_); }

 private:
  struct Tap {
    std::size_t coarse;  ///< place in the box of all coarse splines
    double weight;
  };
  void find_taps(int component, const Index<D>& fine, std::vector<Tap>& taps) const;
  Index<D> inside(int component, Index<D> fine) const;
  void choose_splines(const UnknownPlaces& places);
  void make_interpolation(const UnknownPlaces& places);
  void make_stiffness(const UnknownPlaces& places, const std::vector<LinearPoint<D>>& points,
                      const std::array<std::vector<double>, D>& signs);
  void add_point(const UnknownPlaces& places, const LinearPoint<D>& point,
                 const std::array<std::vector<double>, D>& signs);
  void add_contacts(const UnknownPlaces& places, const ContactStiffness<D>& contacts,
                    const std::array<std::vector<double>, D>& signs);
  void add_rigid_motions();
  void make_solver();

  const Grid<D>* grid_;
  std::array<bool, D> halved_{};
  Index<D> box_;  ///< coarse splines per axis, those behind walls included
  std::size_t component_size_ = 1, size_ = 0;
  std::vector<PetscInt> number_;  ///< of the coarse splines in use, -1: none
  MatHandle interpolation_, stiffness_;
  VecHandle load_, way_;
  PcHandle solver_;
};

extern template class CoarseDisplacements<2>;
extern template class CoarseDisplacements<3>;

}  // namespace mudlark

#include "soil/implicit_coarse.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "soil/implicit_nodes.hpp"

namespace mudlark {
namespace {

/// Axes with fewer cells keep them.
constexpr int fewest_cells = 4;
/// Coarse splines with less than this share of their weight on unknowns are left out: next to
/// nothing is lost, and they would make the coarse stiffness singular.
constexpr double smallest_share = 0.15;
/// Added to the coarse stiffness, as a share of its diagonal.
constexpr double shift = 1e-6;
/// Up to this many coarse unknowns are solved directly.
constexpr std::size_t largest_direct = 1500;
/// Coarse indices start here, so that those behind the lower walls are not negative.
constexpr int behind_lower_wall = 2;

/// Coarse splines that hold the fine spline `at` of an axis, and their weights there.
struct AxisTaps {
  std::array<int, 3> coarse{};
  std::array<double, 3> weight{};
  int count = 0;

  AxisTaps(bool halved, bool cubic, int at) {
    if (!halved) {
      add(at, 1.0);
    } else if (cubic) {  // 1 4 6 4 1 about the coarse face
      if (at % 2 == 0) {
        add(at / 2 - 1, 0.125), add(at / 2, 0.75), add(at / 2 + 1, 0.125);
      } else {
        add((at - 1) / 2, 0.5), add((at + 1) / 2, 0.5);
      }
    } else {  // 1 3 3 1 about the coarse cell
      add(at / 2, 0.75);
      add(at % 2 == 0 ? at / 2 - 1 : at / 2 + 1, 0.25);
    }
  }
  void add(int index, double w) {
    coarse[static_cast<std::size_t>(count)] = index;
    weight[static_cast<std::size_t>(count++)] = w;
  }
};

}  // namespace

template <int D>
CoarseDisplacements<D>::CoarseDisplacements(const Grid<D>& grid, const UnknownPlaces& places,
                                            const std::vector<LinearPoint<D>>& points,
                                            const ContactStiffness<D>& contacts,
                                            const std::array<std::vector<double>, D>& signs)
    : grid_(&grid) {
  for (int a = 0; a < D; ++a) {
    const int cells = grid.cells()[a];
    // A period must fit into the coarse grid too.
    halved_[static_cast<std::size_t>(a)] =
        cells >= fewest_cells && !(grid.periodic(a) && cells % 2 != 0);
    const int coarse = halved_[static_cast<std::size_t>(a)] ? (cells + 1) / 2 : cells;
    box_[a] = coarse + 2 * behind_lower_wall + 1;
    component_size_ *= static_cast<std::size_t>(box_[a]);
  }
  choose_splines(places);
  make_interpolation(places);
  make_stiffness(places, points, signs);
  add_contacts(places, contacts, signs);
  make_solver();
}

/// The place that a place behind a side is the image of (others have no unknown), or that a
/// periodic one repeats.
template <int D>
Index<D> CoarseDisplacements<D>::inside(int component, Index<D> fine) const {
  for (int a = 0; a < D; ++a) {
    const int cells = grid_->cells()[a];
    if (grid_->periodic(a)) {
      fine[a] = (fine[a] % cells + cells) % cells;
      continue;
    }
    const int last = component == a ? cells : cells - 1;
    for (int fold = 0; fold < 4; ++fold) {  // narrow domains mirror more than once
      if (fine[a] < 0) fine[a] = component == a ? -fine[a] : -1 - fine[a];
      if (fine[a] > last) fine[a] = 2 * last - fine[a] + (component == a ? 0 : 1);
    }
  }
  return fine;
}

template <int D>
void CoarseDisplacements<D>::find_taps(int component, const Index<D>& fine,
                                       std::vector<Tap>& taps) const {
  taps.assign(1, {static_cast<std::size_t>(component), 1.0});
  for (int a = 0; a < D; ++a) {
    const AxisTaps axis(halved_[static_cast<std::size_t>(a)], component == a, fine[a]);
    const std::size_t before = taps.size();
    taps.resize(before * static_cast<std::size_t>(axis.count));
    for (std::size_t t = taps.size(); t-- > 0;) {
      const std::size_t k = t / before;
      int coarse = axis.coarse[k];
      if (grid_->periodic(a)) {
        const int period =
            halved_[static_cast<std::size_t>(a)] ? grid_->cells()[a] / 2 : grid_->cells()[a];
        coarse = (coarse % period + period) % period;
      }
      const Tap& from = taps[t % before];
      taps[t] = {from.coarse * static_cast<std::size_t>(box_[a]) +
                     static_cast<std::size_t>(coarse + behind_lower_wall),
                 from.weight * axis.weight[k]};
    }
  }
}

/// Numbers the coarse splines that fine unknowns hang on; all ranks know all of them.
template <int D>
void CoarseDisplacements<D>::choose_splines(const UnknownPlaces& places) {
  std::vector<double> share(component_size_ * D, 0.0);
  std::vector<Tap> taps;
  double full = 1.0;  // sum of a spline's weights
  for (const bool halved : halved_) full *= halved ? 2.0 : 1.0;
  for (int d = 0; d < D; ++d)
    for_each(grid_->owned_faces(d), [&](const Index<D>& face) {
      if (places.numbers(
              static_cast<std::size_t>(d))[static_cast<std::size_t>(grid_->offset(face))] < 0)
        return;
      find_taps(d, face, taps);
      for (const Tap& tap : taps) share[tap.coarse] += tap.weight / full;
    });
  MPI_Allreduce(MPI_IN_PLACE, share.data(), static_cast<int>(share.size()), MPI_DOUBLE, MPI_SUM,
                grid_->comm());
  number_.assign(share.size(), -1);
  for (std::size_t i = 0; i < share.size(); ++i)
    if (share[i] > smallest_share) number_[i] = static_cast<PetscInt>(size_++);
}

template <int D>
void CoarseDisplacements<D>::make_interpolation(const UnknownPlaces& places) {
  constexpr PetscInt most_taps = D == 2 ? 6 : 12;
  MatCreateAIJ(grid_->comm(), places.owned(), PETSC_DECIDE, PETSC_DETERMINE, size(), most_taps,
               nullptr, most_taps, nullptr, interpolation_.put());
  std::vector<Tap> taps;
  for (int d = 0; d < D; ++d)
    for_each(grid_->owned_faces(d), [&](const Index<D>& face) {
      const PetscInt row = places.numbers(
          static_cast<std::size_t>(d))[static_cast<std::size_t>(grid_->offset(face))];
      if (row < 0) return;
      find_taps(d, face, taps);
      for (const Tap& tap : taps)
        if (number_[tap.coarse] >= 0)
          MatSetValue(interpolation_, row, number_[tap.coarse], tap.weight, ADD_VALUES);
    });
  MatAssemblyBegin(interpolation_, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(interpolation_, MAT_FINAL_ASSEMBLY);
}

template <int D>
void CoarseDisplacements<D>::make_stiffness(const UnknownPlaces& places,
                                            const std::vector<LinearPoint<D>>& points,
                                            const std::array<std::vector<double>, D>& signs) {
  PetscInt columns = 0;
  MatGetLocalSize(interpolation_, nullptr, &columns);
  // Splines of one component share points with 7 x 5 (x 5) others, of another with 6 x 6 (x 5).
  const PetscInt bound = std::min<PetscInt>(D == 2 ? 35 + 36 : 175 + 2 * 180, size());
  MatCreateAIJ(grid_->comm(), columns, columns, size(), size(), std::min(bound, columns), nullptr,
               std::min(bound, size() - columns), nullptr, stiffness_.put());
  MatSetOption(stiffness_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE);
  LinearPoint<D> mean;
  Index<D> mean_cell;
  for (const LinearPoint<D>& point : points) {
    const Index<D> cell = grid_->cell_at(point.position);
    if (mean.volume > 0.0 && !(cell == mean_cell)) {
      add_point(places, mean, signs);
      mean.volume = 0.0;
    }
    const double volume = mean.volume + point.volume, share = point.volume / volume;
    if (mean.volume == 0.0) {
      mean = point;
    } else {
      mean.position = mean.position + share * (point.position - mean.position);
      mean.tangent += share * (point.tangent - mean.tangent);
      mean.volume = volume;
    }
    mean_cell = cell;
  }
  if (mean.volume > 0.0) add_point(places, mean, signs);
  MatAssemblyBegin(stiffness_, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(stiffness_, MAT_FINAL_ASSEMBLY);
  MatCreateVecs(stiffness_, load_.put(), way_.put());
  MatGetDiagonal(stiffness_, load_);
  VecScale(load_, shift);
  MatDiagonalSet(stiffness_, load_, ADD_VALUES);
}

/// The point's share of the stiffness, slopes of fine splines put together to those of coarse ones.
template <int D>
void CoarseDisplacements<D>::add_point(const UnknownPlaces& places, const LinearPoint<D>& point,
                                       const std::array<std::vector<double>, D>& signs) {
  constexpr int G = D * D;
  const Vec<D> per_spacing = inverse(grid_->spacing());
  const PointSplines<D, CompositeKernel> splines(in_cells(*grid_, per_spacing, point.position));
  std::vector<PetscInt> columns;
  std::vector<std::array<double, D>> slopes;
  std::vector<int> components;
  std::vector<Tap> taps;
  PointSplines<D, CompositeKernel>::template static_for<D>([&]<int Component>() {
    constexpr auto u = static_cast<std::size_t>(Component);
    const std::size_t first = columns.size();
    Index<D> corner;
    for (int a = 0; a < D; ++a)
      corner[a] = a == Component ? splines.face[static_cast<std::size_t>(a)].first
                                 : splines.centre[static_cast<std::size_t>(a)].first;
    splines.template for_each_node<Component>(
        *grid_, per_spacing,
        [&](std::ptrdiff_t at, double, const Vec<D>& slope, const Vec<D>& from_first) {
          const auto offset = static_cast<std::size_t>(at);
          if (places.numbers(u)[offset] < 0) return;
          Index<D> face = corner;
          for (int a = 0; a < D; ++a) face[a] += static_cast<int>(from_first[a]);
          find_taps(Component, inside(Component, face), taps);
          for (const Tap& tap : taps) {
            const PetscInt number = number_[tap.coarse];
            if (number < 0) continue;
            const auto found = std::find(columns.begin() + static_cast<std::ptrdiff_t>(first),
                                         columns.end(), number);
            const auto k = static_cast<std::size_t>(found - columns.begin());
            if (found == columns.end())
              columns.push_back(number), slopes.push_back({}), components.push_back(Component);
            for (int j = 0; j < D; ++j)
              slopes[k][static_cast<std::size_t>(j)] += signs[u][offset] * tap.weight * slope[j];
          }
        });
  });
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::Matrix<double, G, Eigen::Dynamic> gradients =
      Eigen::Matrix<double, G, Eigen::Dynamic>::Zero(G, count);
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (int j = 0; j < D; ++j)
      gradients(components[k] * D + j, static_cast<Eigen::Index>(k)) =
          slopes[k][static_cast<std::size_t>(j)];
  const Eigen::Matrix<double, G, Eigen::Dynamic> stress = point.volume * point.tangent * gradients;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block =
      gradients.transpose() * stress;
  MatSetValues(stiffness_, static_cast<PetscInt>(count), columns.data(),
               static_cast<PetscInt>(count), columns.data(), block.data(), ADD_VALUES);
}

/// Tells the stiffness which motions cost it nothing.
/// P^T C P, with C the stiffness of the contacts on the fine grid and P the interpolation.
template <int D>
void CoarseDisplacements<D>::add_contacts(const UnknownPlaces& places,
                                          const ContactStiffness<D>& contacts,
                                          const std::array<std::vector<double>, D>& signs) {
  if (!contacts.list) return;
  MatHandle fine, coarse;
  MatCreateAIJ(grid_->comm(), places.owned(), places.owned(), PETSC_DETERMINE, PETSC_DETERMINE, 0,
               nullptr, 0, nullptr, fine.put());
  MatSetOption(fine, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE);
  std::array<const std::vector<PetscInt>*, D> numbers;
  for (std::size_t d = 0; d < D; ++d) numbers[d] = &places.numbers(d);
  contacts.add_to(fine, numbers, signs);
  MatAssemblyBegin(fine, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(fine, MAT_FINAL_ASSEMBLY);
  MatPtAP(fine, interpolation_, MAT_INITIAL_MATRIX, PETSC_DEFAULT, coarse.put());
  MatAXPY(stiffness_, 1.0, coarse, DIFFERENT_NONZERO_PATTERN);
}

template <int D>
void CoarseDisplacements<D>::add_rigid_motions() {
  std::vector<VecHandle> motions(D + D * (D - 1) / 2);
  std::vector<::Vec> vectors;
  for (VecHandle& motion : motions) VecDuplicate(load_, motion.put()), vectors.push_back(motion);
  PetscInt begin = 0, end = 0;
  VecGetOwnershipRange(load_, &begin, &end);
  for (std::size_t i = 0; i < number_.size(); ++i) {
    const PetscInt row = number_[i];
    if (row < begin || row >= end) continue;
    const int component = static_cast<int>(i / component_size_);
    Vec<D> place;  // in fine cells
    std::size_t rest = i % component_size_;
    for (int a = D - 1; a >= 0; --a) {
      const auto index = static_cast<double>(rest % static_cast<std::size_t>(box_[a]));
      rest /= static_cast<std::size_t>(box_[a]);
      place[a] = (index + (component == a ? 0.0 : 0.5)) * grid_->spacing()[a] *
                 (halved_[static_cast<std::size_t>(a)] ? 2.0 : 1.0);
    }
    VecSetValue(vectors[static_cast<std::size_t>(component)], row, 1.0, INSERT_VALUES);
    std::size_t turn = D;
    for (int a = 0; a < D; ++a)
      for (int b = a + 1; b < D; ++b, ++turn) {
        if (component == a) VecSetValue(vectors[turn], row, -place[b], INSERT_VALUES);
        if (component == b) VecSetValue(vectors[turn], row, place[a], INSERT_VALUES);
      }
  }
  std::vector<::Vec> basis;  // orthonormal; motions that the walls leave no unknown for drop out
  for (::Vec motion : vectors) {
    VecAssemblyBegin(motion);
    VecAssemblyEnd(motion);
    PetscReal length = 0.0, left = 0.0;
    VecNorm(motion, NORM_2, &length);
    for (::Vec other : basis) {
      PetscScalar product = 0.0;
      VecDot(motion, other, &product);
      VecAXPY(motion, -product, other);
    }
    VecNorm(motion, NORM_2, &left);
    if (!(left > 1e-6 * length)) continue;
    VecScale(motion, 1.0 / left);
    basis.push_back(motion);
  }
  MatNullSpace rigid = nullptr;
  MatNullSpaceCreate(grid_->comm(), PETSC_FALSE, static_cast<PetscInt>(basis.size()), basis.data(),
                     &rigid);
  MatSetNearNullSpace(stiffness_, rigid);
  MatNullSpaceDestroy(&rigid);
}

/// Few unknowns directly, many by smoothed aggregation that knows the rigid motions. Aggregates of
/// less unknowns than there are motions leave empty rows on the next grid, which PETSc 3.18 divides
/// by: so that grid is solved directly as long as it is small, and classical multigrid takes over
/// where the trial fails.
template <int D>
void CoarseDisplacements<D>::make_solver() {
  PCCreate(grid_->comm(), solver_.put());
  PCSetOperators(solver_, stiffness_, stiffness_);
  if (size_ <= largest_direct) {
    PCSetType(solver_, PCLU);
    PCFactorSetMatSolverType(solver_, MATSOLVERMUMPS);
    PCSetUp(solver_);
    return;
  }
  add_rigid_motions();
  PCSetOptionsPrefix(solver_, "mudlark_coarse_");
  for (const auto& [key, value] : {std::pair{"-mudlark_coarse_mg_levels_ksp_type", "richardson"},
                                   std::pair{"-mudlark_coarse_mg_levels_ksp_max_it", "1"},
                                   std::pair{"-mudlark_coarse_mg_levels_pc_type", "sor"},
                                   std::pair{"-mudlark_coarse_pc_gamg_coarse_eq_limit", "2000"}})
    PetscOptionsSetValue(nullptr, key, value);
  PCSetType(solver_, PCGAMG);
  PCSetFromOptions(solver_);
  PCSetUp(solver_);
  PetscReal size = 0.0;
  VecSet(load_, 1.0);
  PCApply(solver_, load_, way_);
  VecNorm(way_, NORM_2, &size);
  if (std::isfinite(size)) return;
  PCReset(solver_);
  PCSetOperators(solver_, stiffness_, stiffness_);
  PCSetType(solver_, PCHYPRE);
  PCHYPRESetType(solver_, "boomeramg");
  PCSetUp(solver_);
}

template <int D>
void CoarseDisplacements<D>::correct(::Vec residual, ::Vec fine) {
  MatMultTranspose(interpolation_, residual, load_);
  PCApply(solver_, load_, way_);
  MatMultAdd(interpolation_, way_, fine, fine);
}

template class CoarseDisplacements<2>;
template class CoarseDisplacements<3>;

}  // namespace mudlark

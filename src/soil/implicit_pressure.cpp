#include "soil/implicit_pressure.hpp"

#include <petscpc.h>

#include <algorithm>
#include <cmath>

#include "grid/halo.hpp"

namespace mudlark {
namespace {

/// Up to this ratio of what flows in a step to what is stored, at the shortest wave, the pressure
/// counts as undrained. Between 3 and 30 either form takes some more iterations (decision 0017).
template <int D>
constexpr double undrained_below = D == 2 ? 10.0 : 30.0;
/// Coefficient of the neighbour differences in T: half the bound 7.5 of m/M per axis and wave.
constexpr double neighbour_weight = 1.0;
constexpr double mass_tolerance = 1e-2;
constexpr int most_mass_iterations = 30;

}  // namespace

template <int D>
PressurePreconditioner<D>::PressurePreconditioner(const Grid<D>& grid,
                                                  const PointOperator<D>& points,
                                                  UnknownPlaces& pressure,
                                                  const std::vector<double>& signs,
                                                  const UnknownPlaces& water, ::Vec drag, double dt)
    : grid_(&grid),
      points_(&points),
      places_(&pressure),
      signs_(&signs),
      cells_(grid, "pressure", "Pa"),
      sums_(grid, "volume", "m^D") {
  for (VecHandle* vector :
       {&volume_, &compliance_, &first_, &second_, &residual_, &direction_, &product_, &improved_})
    pressure.make_vector(*vector);
  cells_.fill(0.0), sums_.fill(0.0);
  points.add_compliance(cells_.data(), sums_.data());
  drop_signs(cells_), drop_signs(sums_);
  const std::array<const double*, 1> volume{cells_.data()}, compliance{sums_.data()};
  pressure.to_unknowns(volume, volume_);
  pressure.to_unknowns(compliance, compliance_);
  sums_.fill(0.0);
  points.add_mass_diagonal(sums_.data());
  drop_signs(sums_);
  pressure.to_unknowns(compliance, first_);
  mass_.add(grid, -1, pressure.numbers(0), pressure.first());
  mass_.set_diagonal(first_);
  make_laplacian(water, drag, dt);
}

/// Makes sums add up, not cancel, behind sides with a pressure, and back.
template <int D>
void PressurePreconditioner<D>::drop_signs(CellField<D>& field) const {
  for (std::size_t at = 0; at < signs_->size(); ++at) field.data()[at] *= (*signs_)[at];
}

template <int D>
void PressurePreconditioner<D>::make_laplacian(const UnknownPlaces& water, ::Vec drag, double dt) {
  const std::array<double*, 1> volume{cells_.data()}, compliance{sums_.data()};
  places_->to_places(volume_, volume);
  places_->to_places(compliance_, compliance);
  drop_signs(cells_), drop_signs(sums_);
  const auto& number = places_->numbers(0);
  const PetscScalar* resistance = nullptr;
  VecGetArrayRead(drag, &resistance);
  // Faces between cells with pressure: f(the two cells' offsets, what flows through).
  const auto for_each_link = [&](auto&& f) {
    for (int d = 0; d < D; ++d)
      for_each(grid_->owned_faces(d), [&](const Index<D>& face) {
        const auto upper = static_cast<std::size_t>(grid_->offset(face));
        const PetscInt unknown = water.numbers(static_cast<std::size_t>(d))[upper];
        if (unknown < 0) return;
        const double h = grid_->spacing()[d];
        const auto lower = upper - static_cast<std::size_t>(grid_->stride(d));
        f(lower, upper, dt / (h * h * resistance[unknown - water.first()]));
      });
  };
  // What flows at the shortest wave against what is stored, mean over the soil.
  double flowing = 0.0, soil = 0.0;
  for_each_link([&](std::size_t lower, std::size_t upper, double flow) {
    for (const std::size_t cell : {lower, upper})
      if (number[cell] >= 0) {
        flowing +=
            2.0 * flow * volume[0][cell] * volume[0][cell] * volume[0][cell] / compliance[0][cell];
        soil += volume[0][cell] / D;
      }
  });
  flowing = sum_over_ranks(*grid_, flowing);
  soil = sum_over_ranks(*grid_, soil);
  flows_ = flowing > undrained_below<D> * soil;
  MatCreateAIJ(grid_->comm(), places_->owned(), places_->owned(), PETSC_DETERMINE, PETSC_DETERMINE,
               2 * D + 1, nullptr, 2 * D, nullptr, laplacian_.put());
  MatSetOption(laplacian_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE);
  const auto add = [&](PetscInt row, PetscInt column, double value) {
    if (row >= 0 && column >= 0) MatSetValue(laplacian_, row, column, value, ADD_VALUES);
  };
  const auto stored = [&](std::size_t cell) {  // c / m
    return compliance[0][cell] / (volume[0][cell] * volume[0][cell]);
  };
  for_each(grid_->owned(), [&](const Index<D>& index) {
    const auto cell = static_cast<std::size_t>(grid_->offset(index));
    if (number[cell] >= 0) add(number[cell], number[cell], stored(cell));
  });
  for_each_link([&](std::size_t lower, std::size_t upper, double flow) {
    if (number[lower] == number[upper] && (*signs_)[lower] != (*signs_)[upper]) {
      add(number[upper], number[upper], flow);  // to a side with a pressure
      return;
    }
    double below = flow, above = flow, between = flow;
    if (flows_ && number[lower] >= 0 && number[upper] >= 0) {
      below += neighbour_weight * stored(lower);
      above += neighbour_weight * stored(upper);
      between += neighbour_weight * std::sqrt(stored(lower) * stored(upper));
    }
    add(number[lower], number[lower], below);
    add(number[upper], number[upper], above);
    add(number[lower], number[upper], -between);
    add(number[upper], number[lower], -between);
  });
  VecRestoreArrayRead(drag, &resistance);
  MatAssemblyBegin(laplacian_, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(laplacian_, MAT_FINAL_ASSEMBLY);
  PCCreate(grid_->comm(), multigrid_.put());
  PCSetOperators(multigrid_, laplacian_, laplacian_);
  PCSetType(multigrid_, PCHYPRE);
  PCHYPRESetType(multigrid_, "boomeramg");
  PCSetUp(multigrid_);
}

template <int D>
void PressurePreconditioner<D>::multiply_mass(::Vec in, ::Vec out) {
  const std::array<double*, 1> cells{cells_.data()};
  const std::array<const double*, 1> sums{sums_.data()};
  places_->to_places(in, cells);
  sums_.fill(0.0);
  points_->apply_mass(cells_.data(), sums_.data());
  places_->to_unknowns(sums, out);
}

/// Conjugate gradients; a tenth of a digit more or less does not matter, the outer method allows
/// for it.
template <int D>
void PressurePreconditioner<D>::divide_by_mass(::Vec in, ::Vec out) {
  VecSet(out, 0.0);
  VecCopy(in, residual_);
  mass_.apply(residual_, improved_);
  VecCopy(improved_, direction_);
  PetscScalar energy = 0.0, start = 0.0;
  VecDot(residual_, improved_, &energy);
  start = energy;
  for (int i = 0; i < most_mass_iterations && energy > mass_tolerance * mass_tolerance * start;
       ++i) {
    multiply_mass(direction_, product_);
    PetscScalar curvature = 0.0, next = 0.0;
    VecDot(direction_, product_, &curvature);
    if (!(curvature > 0.0)) return;
    VecAXPY(out, energy / curvature, direction_);
    VecAXPY(residual_, -energy / curvature, product_);
    mass_.apply(residual_, improved_);
    VecDot(residual_, improved_, &next);
    VecAYPX(direction_, next / energy, improved_);
    energy = next;
  }
}

template <int D>
void PressurePreconditioner<D>::apply(::Vec volume, ::Vec pressure) {
  divide_by_mass(volume, first_);
  PCApply(multigrid_, first_, second_);
  if (flows_)
    divide_by_mass(second_, pressure);
  else
    VecPointwiseDivide(pressure, second_, volume_);
}

template class PressurePreconditioner<2>;
template class PressurePreconditioner<3>;

}  // namespace mudlark

#include "numerics/multigrid.hpp"

#include <HYPRE_struct_ls.h>
#include <HYPRE_utilities.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

void check(HYPRE_Int code, const char* what) {
  if (code) {
    HYPRE_ClearAllErrors();
    throw std::runtime_error(fmt::format("hypre failed to {} (error {})", what, code));
  }
}

/// hypre's structured multigrid closes a period only when it halves evenly down to one cell.
template <int D>
bool closes_seam(const Grid<D>& grid, int axis) {
  return grid.periodic(axis) && std::has_single_bit(static_cast<unsigned>(grid.cells()[axis]));
}

}  // namespace

template <int D>
struct Multigrid<D>::Hypre {
  HYPRE_StructGrid grid = nullptr;
  HYPRE_StructStencil stencil = nullptr;
  HYPRE_StructMatrix matrix = nullptr;
  HYPRE_StructVector residual = nullptr, correction = nullptr;
  HYPRE_StructSolver solver = nullptr;
  HYPRE_Int lower[D], upper[D];
  bool empty;  // no cells on this rank

  Hypre(const Grid<D>& mesh, const IndexBox<D>& box) : empty(box.empty()) {
    static const bool initialised =
        HYPRE_Init() == 0;  // once per process; harmless beside PETSc's own use
    if (!initialised) throw std::runtime_error("hypre failed to start");
    for (int a = 0; a < D; ++a) {
      lower[a] = box.lower[a];
      upper[a] = box.upper[a] - 1;
    }
    check(HYPRE_StructGridCreate(mesh.comm(), D, &grid), "make a grid");
    if (!empty) check(HYPRE_StructGridSetExtents(grid, lower, upper), "make a grid");
    HYPRE_Int period[D];
    for (int a = 0; a < D; ++a) period[a] = closes_seam(mesh, a) ? mesh.cells()[a] : 0;
    check(HYPRE_StructGridSetPeriodic(grid, period), "make a grid");
    check(HYPRE_StructGridAssemble(grid), "make a grid");
    check(HYPRE_StructStencilCreate(D, D + 1, &stencil), "make a stencil");
    for (int entry = 0; entry <= D; ++entry) {
      HYPRE_Int offset[D] = {};
      if (entry > 0)
        offset[entry - 1] = -1;  // symmetric storage: the diagonal and the lower neighbours
      check(HYPRE_StructStencilSetElement(stencil, entry, offset), "make a stencil");
    }
    check(HYPRE_StructMatrixCreate(mesh.comm(), grid, stencil, &matrix), "make a matrix");
    check(HYPRE_StructMatrixSetSymmetric(matrix, 1), "make a matrix");
    check(HYPRE_StructMatrixInitialize(matrix), "make a matrix");
    for (HYPRE_StructVector* vector : {&residual, &correction}) {
      check(HYPRE_StructVectorCreate(mesh.comm(), grid, vector), "make a vector");
      check(HYPRE_StructVectorInitialize(*vector), "make a vector");
      check(HYPRE_StructVectorSetConstantValues(*vector, 0.0), "make a vector");
      check(HYPRE_StructVectorAssemble(*vector), "make a vector");
    }
  }
  ~Hypre() {
    if (solver) HYPRE_StructPFMGDestroy(solver);
    HYPRE_StructVectorDestroy(correction);
    HYPRE_StructVectorDestroy(residual);
    HYPRE_StructMatrixDestroy(matrix);
    HYPRE_StructStencilDestroy(stencil);
    HYPRE_StructGridDestroy(grid);
  }
};

template <int D>
Multigrid<D>::Multigrid(const Grid<D>& grid) : grid_(&grid) {
  cover(grid.owned());
}

template <int D>
void Multigrid<D>::cover(const IndexBox<D>& box) {
  box_ = box;
  hypre_ = std::make_unique<Hypre>(*grid_, box);
  std::size_t count = box.empty() ? 0 : 1;
  for (int a = 0; a < D && count > 0; ++a)
    count *= static_cast<std::size_t>(box.upper[a] - box.lower[a]);
  buffer_.resize(count);
}

template <int D>
Multigrid<D>::~Multigrid() = default;

template <int D>
void Multigrid<D>::build(const PressureSystem<D>& system) {
  const Grid<D>& grid = *grid_;
  Hypre& h = *hypre_;
  const double* diagonal = system.diagonal.data();
  double largest = 0.0;
  for_each_offset(grid, box_,
                  [&](std::ptrdiff_t at) { largest = std::max(largest, diagonal[at]); });
  // Cells without an unknown become rows of their own, of the size of the others.
  const double alone = std::max(max_over_ranks(grid, largest), 1e-300);
  std::size_t k = 0;
  for_each_offset(grid, box_, [&](std::ptrdiff_t at) {
    buffer_[k++] = diagonal[at] > 0.0 ? diagonal[at] : alone;
  });
  for (HYPRE_Int entry = 0; entry <= D; ++entry) {
    if (entry > 0) {
      const int axis = entry - 1;
      const bool seam = closes_seam(grid, axis);
      const double* coupling = system.coupling[axis].data();
      k = 0;
      for_each(box_, [&](const Index<D>& cell) {
        buffer_[k++] = cell[axis] == 0 && !seam ? 0.0 : -coupling[grid.offset(cell)];
      });
    }
    if (!h.empty)
      check(HYPRE_StructMatrixSetBoxValues(h.matrix, h.lower, h.upper, 1, &entry, buffer_.data()),
            "fill a matrix");
  }
  check(HYPRE_StructMatrixAssemble(h.matrix), "assemble a matrix");
  if (h.solver) HYPRE_StructPFMGDestroy(h.solver);  // hypre has no other way to take a new matrix
  check(HYPRE_StructPFMGCreate(grid.comm(), &h.solver), "make a solver");
  HYPRE_StructPFMGSetMaxIter(h.solver, 1);
  HYPRE_StructPFMGSetTol(h.solver, 0.0);
  HYPRE_StructPFMGSetZeroGuess(h.solver);
  HYPRE_StructPFMGSetRelaxType(
      h.solver, 2);  // red-black Gauss-Seidel, reversed after the coarse solve: symmetric
  HYPRE_StructPFMGSetRAPType(h.solver, 0);
  HYPRE_StructPFMGSetNumPreRelax(h.solver, 1);
  HYPRE_StructPFMGSetNumPostRelax(h.solver, 1);
  HYPRE_StructPFMGSetSkipRelax(h.solver, 0);  // thin and stretched grids need every level
  check(HYPRE_StructPFMGSetup(h.solver, h.matrix, h.residual, h.correction), "set up multigrid");
}

template <int D>
void Multigrid<D>::apply(const CellField<D>& residual, CellField<D>& out) {
  Hypre& h = *hypre_;
  const double* r = residual.data();
  std::size_t k = 0;
  for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) { buffer_[k++] = r[at]; });
  if (!h.empty)
    check(HYPRE_StructVectorSetBoxValues(h.residual, h.lower, h.upper, buffer_.data()),
          "fill a vector");
  HYPRE_StructPFMGSolve(h.solver, h.matrix, h.residual,
                        h.correction);  // one cycle: its "not converged" is no error
  HYPRE_ClearAllErrors();
  if (!h.empty)
    check(HYPRE_StructVectorGetBoxValues(h.correction, h.lower, h.upper, buffer_.data()),
          "read a vector");
  double* z = out.data();
  k = 0;
  for_each_offset(*grid_, box_, [&](std::ptrdiff_t at) { z[at] = buffer_[k++]; });
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace mudlark

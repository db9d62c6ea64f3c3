#include "numerics/pfmg.hpp"

#include <HYPRE_struct_ls.h>
#include <HYPRE_utilities.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace mudlark {
namespace {

void check(HYPRE_Int code, const char* what) {
  if (code) {
    HYPRE_ClearAllErrors();
    throw std::runtime_error(fmt::format("hypre failed to {} (error {})", what, code));
  }
}

}  // namespace

template <int D>
struct Pfmg<D>::Hypre {
  HYPRE_StructGrid grid = nullptr;
  HYPRE_StructStencil stencil = nullptr;
  HYPRE_StructMatrix matrix = nullptr;
  HYPRE_StructVector residual = nullptr, correction = nullptr;
  HYPRE_StructSolver solver = nullptr;
  HYPRE_Int lower[D], upper[D];

  Hypre(MPI_Comm comm, const IndexBox<D>& box, const Index<D>& period) {
    static const bool initialised =
        HYPRE_Init() == 0;  // once per process; harmless beside PETSc's own use
    if (!initialised) throw std::runtime_error("hypre failed to start");
    for (int a = 0; a < D; ++a) {
      lower[a] = box.lower[a];
      upper[a] = box.upper[a] - 1;
    }
    check(HYPRE_StructGridCreate(comm, D, &grid), "make a grid");
    check(HYPRE_StructGridSetExtents(grid, lower, upper), "make a grid");
    HYPRE_Int periods[D];
    for (int a = 0; a < D; ++a) periods[a] = period[a];
    check(HYPRE_StructGridSetPeriodic(grid, periods), "make a grid");
    check(HYPRE_StructGridAssemble(grid), "make a grid");
    check(HYPRE_StructStencilCreate(D, D + 1, &stencil), "make a stencil");
    for (int entry = 0; entry <= D; ++entry) {
      HYPRE_Int offset[D] = {};
      if (entry > 0)
        offset[entry - 1] = -1;  // symmetric storage: the diagonal and the lower neighbours
      check(HYPRE_StructStencilSetElement(stencil, entry, offset), "make a stencil");
    }
    check(HYPRE_StructMatrixCreate(comm, grid, stencil, &matrix), "make a matrix");
    check(HYPRE_StructMatrixSetSymmetric(matrix, 1), "make a matrix");
    check(HYPRE_StructMatrixInitialize(matrix), "make a matrix");
    for (HYPRE_StructVector* vector : {&residual, &correction}) {
      check(HYPRE_StructVectorCreate(comm, grid, vector), "make a vector");
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
Pfmg<D>::Pfmg(MPI_Comm comm, const IndexBox<D>& owned, const Index<D>& period)
    : comm_(comm), owned_(owned), hypre_(std::make_unique<Hypre>(comm, owned, period)) {
  std::size_t count = 1;
  for (int a = 0; a < D; ++a) count *= static_cast<std::size_t>(owned.upper[a] - owned.lower[a]);
  buffer_.resize(count);
}

template <int D>
Pfmg<D>::~Pfmg() = default;

/// Calls body(run, values in the buffer) for the level's runs of cells with an unknown.
template <int D>
template <class Body>
void Pfmg<D>::for_each_run(const MultigridLevel<D>& level, Body&& body) {
  for (const auto& run : level.runs()) {
    std::ptrdiff_t at = 0;
    for (int a = D - 1; a >= 0; --a)
      at = at * (owned_.upper[a] - owned_.lower[a]) + run.first[a] - owned_.lower[a];
    body(run, buffer_.data() + at);
  }
}

template <int D>
void Pfmg<D>::build(const MultigridLevel<D>& level) {
  Hypre& h = *hypre_;
  double largest = 0.0;
  for (const auto& run : level.runs())
    for (int k = 0; k < run.cells; ++k)
      largest = std::max(largest, level.diagonal(run.at + k, run));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm_);
  // Cells without an unknown become rows of their own, of the size of the others.
  const double alone = std::max(largest, 1e-300);
  for (HYPRE_Int entry = 0; entry <= D; ++entry) {
    std::fill(buffer_.begin(), buffer_.end(), entry == 0 ? alone : 0.0);
    for_each_run(level, [&](const auto& run, double* values) {
      for (int k = 0; k < run.cells; ++k) {
        const auto u = static_cast<std::size_t>(run.at + k);
        const double diagonal = level.diagonal(run.at + k, run);
        if (entry > 0)
          values[k] = -level.coupling[static_cast<std::size_t>(entry - 1)][u];
        else if (diagonal > 0.0)
          values[k] = diagonal;
      }
    });
    check(HYPRE_StructMatrixSetBoxValues(h.matrix, h.lower, h.upper, 1, &entry, buffer_.data()),
          "fill a matrix");
  }
  check(HYPRE_StructMatrixAssemble(h.matrix), "assemble a matrix");
  if (h.solver) HYPRE_StructPFMGDestroy(h.solver);  // hypre has no other way to take a new matrix
  check(HYPRE_StructPFMGCreate(comm_, &h.solver), "make a solver");
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
void Pfmg<D>::apply(MultigridLevel<D>& level) {
  Hypre& h = *hypre_;
  std::fill(buffer_.begin(), buffer_.end(), 0.0);
  for_each_run(level, [&](const auto& run, double* values) {
    std::copy_n(level.right_side.data() + run.at, run.cells, values);
  });
  check(HYPRE_StructVectorSetBoxValues(h.residual, h.lower, h.upper, buffer_.data()),
        "fill a vector");
  HYPRE_StructPFMGSolve(h.solver, h.matrix, h.residual,
                        h.correction);  // one cycle: its "not converged" is no error
  HYPRE_ClearAllErrors();
  check(HYPRE_StructVectorGetBoxValues(h.correction, h.lower, h.upper, buffer_.data()),
        "read a vector");
  for_each_run(level, [&](const auto& run, const double* values) {
    std::copy_n(values, run.cells, level.solution.data() + run.at);
  });
}

template class Pfmg<2>;
template class Pfmg<3>;

}  // namespace mudlark

#include "soil/implicit_step.hpp"

#include <fmt/format.h>
#include <petscsnes.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "soil/implicit_points.hpp"

namespace mudlark {
namespace {

void check(PetscErrorCode code, const char* what) {
  if (code != 0) throw DivergenceError(fmt::format("PETSc failed to {} (error {})", what, code));
}

/// The step as PETSc's nonlinear solver sees it.
template <int D>
struct Step {
  const ImplicitProblem<D>& problem;
  Halo<D> halo;
  ImplicitUnknowns<D> unknowns;
  ImplicitFields<D> state, sums;
  ImplicitPoints<D> points;
  std::string failure;

  explicit Step(const ImplicitProblem<D>& given)
      : problem(given),
        halo(given.grid),
        unknowns(number_unknowns(given.grid, given.options.kernel, given.bodies, wet(given))),
        state(given.grid),
        sums(given.grid),
        points(given) {}

  static std::vector<bool> wet(const ImplicitProblem<D>& given) {
    std::vector<bool> all;
    for (const BodyConstants& body : given.constants) all.push_back(body.water_density > 0.0);
    return all;
  }
  /// Are the laws content with these displacements, on all ranks?
  bool evaluate(::Vec x, bool tangents) {
    state.load(problem.grid, halo, unknowns, x);
    const bool good = points.evaluate(state, tangents);
    return max_over_ranks(problem.grid, good ? 0.0 : 1.0) == 0.0;
  }
};

template <int D>
PetscErrorCode residual(SNES snes, ::Vec x, ::Vec f, void* context) {
  auto& step = *static_cast<Step<D>*>(context);
  if (!step.evaluate(x, false)) {
    VecSet(f, 0.0);
    return SNESSetFunctionDomainError(snes);
  }
  step.sums.clear();
  step.points.add_residual(step.state, step.sums);
  step.sums.store(step.problem.grid, step.halo, step.unknowns, f);
  return 0;
}

template <int D>
PetscErrorCode jacobian(SNES, ::Vec x, ::Mat matrix, ::Mat, void* context) {
  auto& step = *static_cast<Step<D>*>(context);
  step.evaluate(x, true);
  MatZeroEntries(matrix);
  step.points.add_jacobian(step.unknowns, matrix);
  MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY);
  return 0;
}

/// PETSc's objects of one step, destroyed whatever happens.
struct Solver {
  SNES snes = nullptr;
  ::Mat matrix = nullptr, pattern = nullptr;
  ::Vec x = nullptr, f = nullptr;
  ~Solver() {
    SNESDestroy(&snes);
    MatDestroy(&matrix);
    MatDestroy(&pattern);
    VecDestroy(&x);
    VecDestroy(&f);
  }
};

template <int D>
void make_matrix(Step<D>& step, Solver& solver) {
  const PetscInt owned = step.unknowns.owned;
  MPI_Comm comm = step.problem.grid.comm();
  check(MatCreate(comm, &solver.pattern), "make a matrix");
  MatSetSizes(solver.pattern, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE);
  MatSetType(solver.pattern, MATPREALLOCATOR);
  MatSetUp(solver.pattern);
  step.points.add_pattern(step.unknowns, solver.pattern);
  MatAssemblyBegin(solver.pattern, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(solver.pattern, MAT_FINAL_ASSEMBLY);
  check(MatCreate(comm, &solver.matrix), "make a matrix");
  MatSetSizes(solver.matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE);
  MatSetType(solver.matrix, MATAIJ);
  check(MatPreallocatorPreallocate(solver.pattern, PETSC_TRUE, solver.matrix), "size a matrix");
  MatCreateVecs(solver.matrix, &solver.x, &solver.f);
}

template <int D>
void make_solver(Step<D>& step, Solver& solver) {
  check(SNESCreate(step.problem.grid.comm(), &solver.snes), "make a solver");
  SNESSetType(solver.snes, SNESNEWTONLS);
  SNESSetFunction(solver.snes, solver.f, residual<D>, &step);
  SNESSetJacobian(solver.snes, solver.matrix, solver.matrix, jacobian<D>, &step);
  SNESSetTolerances(solver.snes, step.points.smallest_residual(), 1e-9, 1e-11, 25, 1000);
  KSP ksp = nullptr;
  PC pc = nullptr;
  SNESGetKSP(solver.snes, &ksp);
  KSPSetType(ksp, KSPPREONLY);
  KSPGetPC(ksp, &pc);
  PCSetType(pc, PCLU);
  PCFactorSetMatSolverType(pc, MATSOLVERMUMPS);
}

}  // namespace

template <int D>
ImplicitOutcome solve_implicit_step(const ImplicitProblem<D>& problem) {
  Step<D> step(problem);
  Solver solver;
  make_matrix(step, solver);
  make_solver(step, solver);
  VecSet(solver.x, 0.0);
  ImplicitOutcome outcome;
  check(SNESSolve(solver.snes, nullptr, solver.x), "solve an implicit step");
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  SNESGetConvergedReason(solver.snes, &reason);
  PetscInt iterations = 0;
  SNESGetIterationNumber(solver.snes, &iterations);
  outcome.iterations = static_cast<int>(iterations);
  if (reason < 0 || !step.evaluate(solver.x, false)) {
    outcome.problem = fmt::format("Newton's method did not converge ({}) in {} iterations",
                                  SNESConvergedReasons[reason], iterations);
    return outcome;
  }
  outcome.converged = true;
  step.points.finish(step.state, outcome);
  outcome.largest_step = max_over_ranks(problem.grid, outcome.largest_step);
  outcome.largest_way = max_over_ranks(problem.grid, outcome.largest_way);
  outcome.largest_change = max_over_ranks(problem.grid, outcome.largest_change);
  outcome.largest_strain = max_over_ranks(problem.grid, outcome.largest_strain);
  return outcome;
}

template ImplicitOutcome solve_implicit_step(const ImplicitProblem<2>&);
template ImplicitOutcome solve_implicit_step(const ImplicitProblem<3>&);

}  // namespace mudlark

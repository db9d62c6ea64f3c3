#include "soil/implicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "parallel/collective_error.hpp"
#include "soil/implicit_contact.hpp"
#include "soil/implicit_krylov.hpp"
#include "soil/implicit_matrix.hpp"
#include "soil/implicit_points.hpp"

namespace mudlark {
namespace {

/// More unknowns than these, all together and per layer of cells, go to Krylov iterations.
constexpr PetscInt largest_direct = 1500, largest_direct_layer = 30;
/// What a solution by iterations leaves of the residual; less is lost to what is not linear.
constexpr double forcing = 1e-4;
/// A preconditioner that needs more iterations than this is made anew for the present tangents.
constexpr PetscInt most_before_renewal = 60;
/// Passes of the contacts with rigid bodies; what they leave is taken up by the next step. One that
/// would change the forces of contacts on faces by less than this share is none: where points are
/// closer than faces, forces may be shared out among them in more than one way.
constexpr int most_passes = 12;
constexpr double smallest_change = 3e-5;
/// What a later pass must reach of the residual that it starts with.
constexpr double pass_tolerance = 1e-3;
constexpr PetscInt krylov_restart = 60, most_krylov_iterations = 240;

void check(PetscErrorCode code, const char* what) {
  if (code != 0) throw DivergenceError(fmt::format("PETSc failed to {} (error {})", what, code));
}

/// Does the direct solver lose? Not for small problems, nor for long and narrow ones, whose factors
/// stay as narrow.
template <int D>
bool wants_iterations(const ImplicitProblem<D>& problem, const ImplicitUnknowns<D>& unknowns) {
  if (problem.options.linear_solver != LinearSolver::automatic)
    return problem.options.linear_solver == LinearSolver::iterative;
  int longest = 1;
  for (int a = 0; a < D; ++a) longest = std::max(longest, problem.grid.cells()[a]);
  return problem.options.kernel == Kernel::composite && unknowns.total > largest_direct &&
         unknowns.total > largest_direct_layer * longest;
}

/// The step as PETSc's nonlinear solver sees it.
template <int D>
struct Step {
  const ImplicitProblem<D>& problem;
  Halo<D> halo;
  ImplicitUnknowns<D> unknowns;
  ImplicitFields<D> state, sums;
  ImplicitPoints<D> points;
  bool iterative;  ///< Krylov iterations rather than a direct solver
  ImplicitContact<D> contact;
  std::unique_ptr<ImplicitKrylov<D>> krylov;  ///< none: a direct solver
  std::string failure;                        ///< of a law in any trial, on this rank

  explicit Step(const ImplicitProblem<D>& given)
      : problem(given),
        halo(given.grid),
        unknowns(number_unknowns(given.sides.sides(), given.options.kernel, given.bodies,
                                 wet(given), ImplicitContact<D>::freedoms(given))),
        state(given.grid),
        sums(given.grid),
        points(given),
        iterative(wants_iterations(given, unknowns)),
        contact(given, unknowns) {}

  static std::vector<bool> wet(const ImplicitProblem<D>& given) {
    std::vector<bool> all;
    for (const BodyConstants& body : given.constants) all.push_back(body.water_density > 0.0);
    return all;
  }
  /// Are the laws content with these displacements, on all ranks?
  bool evaluate(::Vec x, bool tangents) {
    state.load(problem.sides, halo, unknowns, x);
    const bool good = points.evaluate(state, tangents);
    contact.evaluate(state, tangents);
    return max_over_ranks(problem.grid, good ? 0.0 : 1.0) == 0.0;
  }
};

/// Infinite where a law fails: the line search halves its step there.
template <int D>
PetscErrorCode residual(SNES, ::Vec x, ::Vec f, void* context) {
  auto& step = *static_cast<Step<D>*>(context);
  if (!step.evaluate(x, false)) {
    step.failure = step.points.failure();
    VecSet(f, std::numeric_limits<double>::infinity());
    return 0;
  }
  step.sums.clear();
  step.points.add_residual(step.state, step.sums);
  step.contact.add_residual(step.sums);
  if (step.problem.held_back)
    for (int d = 0; d < D; ++d)
      for_each(step.problem.grid.owned_faces(d), [&](const Index<D>& face) {
        step.sums.grains[d][face] -= (*step.problem.held_back)[d][face];
      });
  step.sums.store(step.problem.sides, step.halo, step.unknowns, f);
  return 0;
}

/// Iterations need not go below what Newton's method still has to gain.
void bound_iterations(SNES snes) {
  PetscInt done = 0;
  PetscReal absolute = 0.0, relative = 0.0, norm = 0.0;
  SNESGetIterationNumber(snes, &done);
  if (done > 0) return;
  SNESGetTolerances(snes, &absolute, &relative, nullptr, nullptr, nullptr);
  SNESGetFunctionNorm(snes, &norm);
  KSP ksp = nullptr;
  SNESGetKSP(snes, &ksp);
  KSPSetTolerances(ksp, forcing, 0.3 * std::max(absolute, relative * norm), PETSC_DEFAULT,
                   most_krylov_iterations);
}

PetscInt iterations_of_last_system(SNES snes) {
  KSP ksp = nullptr;
  PetscInt count = 0;
  SNESGetKSP(snes, &ksp);
  KSPGetIterationNumber(ksp, &count);
  return count;
}

template <int D>
PetscErrorCode jacobian(SNES snes, ::Vec x, ::Mat matrix, ::Mat, void* context) {
  auto& step = *static_cast<Step<D>*>(context);
  step.evaluate(x, true);
  if (step.krylov) {
    bound_iterations(snes);
    step.krylov->linearise(step.points.linear());
    if (!step.krylov->prepared() || iterations_of_last_system(snes) > most_before_renewal)
      step.krylov->prepare();
    return 0;
  }
  MatZeroEntries(matrix);
  add_jacobian(step.problem.grid, step.problem.options.kernel, step.unknowns, step.points.linear(),
               step.problem.dt, step.points.water_scale(), matrix);
  step.contact.add_to(matrix, step.unknowns);
  MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY);
  return 0;
}

template <int D>
PetscErrorCode multiply(::Mat matrix, ::Vec x, ::Vec y) {
  ImplicitKrylov<D>* krylov = nullptr;
  MatShellGetContext(matrix, &krylov);
  krylov->multiply(x, y);
  return 0;
}
template <int D>
PetscErrorCode precondition(PC pc, ::Vec r, ::Vec x) {
  ImplicitKrylov<D>* krylov = nullptr;
  PCShellGetContext(pc, &krylov);
  krylov->precondition(r, x);
  return 0;
}

/// PETSc's objects of one step, destroyed whatever happens.
struct Solver {
  SnesHandle snes;
  MatHandle matrix;
  VecHandle x, f;
};

template <int D>
void make_krylov(Step<D>& step, Solver& solver, KSP ksp) {
  KSPSetType(ksp, KSPFGMRES);
  KSPGMRESSetRestart(ksp, krylov_restart);
  PC pc = nullptr;
  KSPGetPC(ksp, &pc);
  PCSetType(pc, PCSHELL);
  PCShellSetContext(pc, step.krylov.get());
  PCShellSetApply(pc, precondition<D>);
  SNESSetMaxLinearSolveFailures(solver.snes, 3);
}

template <int D>
void make_solver(Step<D>& step, Solver& solver) {
  const ImplicitProblem<D>& problem = step.problem;
  const PetscInt owned = step.unknowns.owned;
  VecCreateMPI(problem.grid.comm(), owned, PETSC_DETERMINE, solver.x.put());
  VecDuplicate(solver.x, solver.f.put());
  check(SNESCreate(problem.grid.comm(), solver.snes.put()), "make a solver");
  SNESSetType(solver.snes, SNESNEWTONLS);
  SNESSetFunction(solver.snes, solver.f, residual<D>, &step);
  KSP ksp = nullptr;
  SNESGetKSP(solver.snes, &ksp);
  double relative = 1e-9;
  if (step.iterative) {
    relative = 1e-7;
    step.krylov = std::make_unique<ImplicitKrylov<D>>(
        problem.grid, step.unknowns, step.contact, solver.x, problem.dt, step.points.water_scale());
    MatCreateShell(problem.grid.comm(), owned, owned, PETSC_DETERMINE, PETSC_DETERMINE,
                   step.krylov.get(), solver.matrix.put());
    MatShellSetOperation(solver.matrix, MATOP_MULT, reinterpret_cast<void (*)(void)>(multiply<D>));
    make_krylov(step, solver, ksp);
  } else {
    make_matrix(problem.grid, problem.options.kernel, step.unknowns, solver.matrix);
    PC pc = nullptr;
    KSPSetType(ksp, KSPPREONLY);
    KSPGetPC(ksp, &pc);
    PCSetType(pc, PCLU);
    PCFactorSetMatSolverType(pc, MATSOLVERMUMPS);
  }
  SNESSetJacobian(solver.snes, solver.matrix, solver.matrix, jacobian<D>, &step);
  SNESSetTolerances(solver.snes, step.points.smallest_residual(), relative, 1e-11, 25, 1000);
  // For developers: PETSC_OPTIONS="-implicit_snes_monitor -implicit_ksp_monitor".
  SNESSetOptionsPrefix(solver.snes, "implicit_");
  SNESSetFromOptions(solver.snes);
}

/// Visits the forces on grains in a vector of this rank: f(component, face, force).
template <int D, class F>
void for_each_force(const Step<D>& step, ::Vec vector, F&& f) {
  const PetscScalar* values = nullptr;
  VecGetArrayRead(vector, &values);
  for (int d = 0; d < D; ++d)
    for_each(step.problem.grid.owned_faces(d), [&](const Index<D>& face) {
      const auto at = static_cast<std::size_t>(step.problem.grid.offset(face));
      const PetscInt number = step.unknowns.grains[static_cast<std::size_t>(d)][at];
      if (number >= 0) f(d, face, values[number - step.unknowns.first]);
    });
  VecRestoreArrayRead(vector, &values);
}

/// Why Newton's method stopped, and where: the point that a law failed at, or the face that is
/// furthest from balance.
template <int D>
std::string describe_failure(Step<D>& step, const Solver& solver, SNESConvergedReason reason) {
  const MPI_Comm comm = step.problem.grid.comm();
  PetscInt iterations = 0;
  SNESGetIterationNumber(solver.snes, &iterations);
  std::string text = fmt::format("Newton's method did not converge ({}) in {} iterations",
                                 SNESConvergedReasons[reason], iterations);
  if (const std::string point = first_text(comm, step.failure); !point.empty())
    return text + "; in one of its trials " + point;
  std::vector<double> bodies;
  residual<D>(nullptr, solver.x, solver.f, &step);
  load_bodies(step.problem.grid, step.unknowns, solver.f, bodies);
  PetscReal norm = 0.0;
  VecNorm(solver.f, NORM_2, &norm);
  text += step.contact.unheld(bodies, norm);
  double largest = 0.0;
  Vec<D> place;
  for_each_force(step, solver.f, [&](int d, const Index<D>& face, double value) {
    if (!(std::abs(value) > largest)) return;
    largest = std::abs(value);
    place = step.problem.grid.face_centre(d, face);
  });
  const bool here = largest > 0.0 && largest == max_over_ranks(step.problem.grid, largest);
  const Point3 x = to_point3(place);
  return text + first_text(comm, here ? fmt::format("; furthest from balance, by {:.3g} N, is the "
                                                    "soil at ({:.6g}, {:.6g}, {:.6g}) m",
                                                    largest, x[0], x[1], x[2])
                                      : std::string());
}

/// Size of forces on all unknowns [N]; solver.f is overwritten.
template <int D, class F>
double size_of(Step<D>& step, const Solver& solver, F&& add) {
  step.sums.clear();
  add(step.sums);
  step.sums.store(step.problem.sides, step.halo, step.unknowns, solver.f);
  PetscReal norm = 0.0;
  VecNorm(solver.f, NORM_2, &norm);
  return norm;
}
template <int D>
double size_of_contacts(Step<D>& step, const Solver& solver) {
  return size_of(step, solver, [&](ImplicitFields<D>& sums) { step.contact.add_residual(sums); });
}

/// Is it worth another pass of the contacts?
template <int D>
bool begin_another_pass(Step<D>& step, const Solver& solver) {
  if (!step.contact.any() || !step.contact.misses()) return false;
  const double all = size_of_contacts(step, solver);
  const double change =
      size_of(step, solver, [&](ImplicitFields<D>& sums) { step.contact.add_change(sums); });
  if (change <= smallest_change * all) return false;
  step.contact.begin_pass();
  return true;
}

/// Newton's method may end between contacts that stick and slip, where no way along its direction
/// is better. That is good enough where it leaves less than another pass would be worth.
template <int D>
bool ends_close(Step<D>& step, const Solver& solver, SNESConvergedReason reason) {
  if (reason >= 0) return true;
  if (!step.contact.any() ||
      (reason != SNES_DIVERGED_LINE_SEARCH && reason != SNES_DIVERGED_MAX_IT))
    return false;
  PetscReal left = 0.0;
  SNESGetFunctionNorm(solver.snes, &left);
  return step.evaluate(solver.x, false) && left <= smallest_change * size_of_contacts(step, solver);
}

/// Newton's method from where the last pass ended. Later passes need not go below what the first
/// one did.
template <int D>
SNESConvergedReason solve_once(const Step<D>& step, const Solver& solver,
                               ImplicitOutcome& outcome) {
  const bool first = outcome.iterations == 0;
  check(SNESSolve(solver.snes, nullptr, solver.x), "solve an implicit step");
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  SNESGetConvergedReason(solver.snes, &reason);
  PetscInt iterations = 0, linear_iterations = 0;
  SNESGetIterationNumber(solver.snes, &iterations);
  SNESGetLinearSolveIterations(solver.snes, &linear_iterations);
  outcome.iterations += static_cast<int>(iterations);
  outcome.linear_iterations += static_cast<int>(linear_iterations);
  if (first && step.contact.any()) {
    PetscReal absolute = 0.0, norm = 0.0;
    SNESGetTolerances(solver.snes, &absolute, nullptr, nullptr, nullptr, nullptr);
    SNESGetFunctionNorm(solver.snes, &norm);
    SNESSetTolerances(solver.snes, std::max(absolute, norm), pass_tolerance, PETSC_DEFAULT,
                      PETSC_DEFAULT, PETSC_DEFAULT);
  }
  return reason;
}

}  // namespace

template <int D>
ImplicitOutcome solve_implicit_step(const ImplicitProblem<D>& problem) {
  Step<D> step(problem);
  Solver solver;
  make_solver(step, solver);
  VecSet(solver.x, 0.0);
  ImplicitOutcome outcome;
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  for (int pass = 0; pass < most_passes; ++pass) {
    reason = solve_once(step, solver, outcome);
    if (!ends_close(step, solver, reason) || !step.evaluate(solver.x, false)) {
      outcome.problem = describe_failure(step, solver, reason);
      return outcome;
    }
    if (!begin_another_pass(step, solver)) break;
  }
  outcome.converged = true;
  outcome.accepted = !problem.accepts || problem.accepts(step.state);
  if (!outcome.accepted) return outcome;
  step.points.finish(step.state, outcome);
  step.contact.finish();
  outcome.largest_step = max_over_ranks(problem.grid, outcome.largest_step);
  outcome.largest_way = max_over_ranks(problem.grid, outcome.largest_way);
  outcome.largest_change = max_over_ranks(problem.grid, outcome.largest_change);
  outcome.largest_strain = max_over_ranks(problem.grid, outcome.largest_strain);
  if (step.contact.any())
    outcome.left_by_contacts = smallest_change * step.contact.largest_compression();
  return outcome;
}

template <int D>
void unbalanced_forces(const ImplicitProblem<D>& problem, FaceVector<D>& forces) {
  Step<D> step(problem);
  VecHandle x, f;
  VecCreateMPI(problem.grid.comm(), step.unknowns.owned, PETSC_DETERMINE, x.put());
  VecDuplicate(x, f.put());
  VecSet(x, 0.0);
  residual<D>(nullptr, x, f, &step);
  forces.fill(0.0);
  for_each_force(step, f,
                 [&](int d, const Index<D>& face, double value) { forces[d][face] = value; });
}

template ImplicitOutcome solve_implicit_step(const ImplicitProblem<2>&);
template ImplicitOutcome solve_implicit_step(const ImplicitProblem<3>&);
template void unbalanced_forces(const ImplicitProblem<2>&, FaceVector<2>&);
template void unbalanced_forces(const ImplicitProblem<3>&, FaceVector<3>&);

}  // namespace mudlark

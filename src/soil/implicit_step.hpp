#pragma once
/// One quasi-static step of soil and pore water, of any length.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grid/solid.hpp"
#include "materials/soil_model.hpp"
#include "soil/implicit_unknowns.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// What an implicit step works on; lives as long as the step.
template <int D>
struct ImplicitProblem {
  const Grid<D>& grid;
  const SoilOptions& options;
  const std::vector<BodyConstants>& constants;
  const std::vector<std::unique_ptr<SoilModel>>& laws;
  std::vector<SoilParticles<D>>& bodies;  ///< state at the start; at the end after `solve`
  const ImplicitSides<D>& sides;
  SurfacePressure<D> surface;   ///< at the end of the step
  double time = 0.0, dt = 0.0;  ///< start and length [s]
  /// Asked with the solution; when it says no, the points stay as they are.
  std::function<bool(const ImplicitFields<D>&)> accepts;
  /// Forces on the grains that are held back yet, on owned faces [N]; null: none.
  const FaceVector<D>* held_back = nullptr;
  /// Where they are at the start, with the velocity of given motion; null: none. Free ones get that
  /// of the step, and all of them the soil's force on them, after `solve`.
  std::vector<Solid>* solids = nullptr;
};

struct ImplicitOutcome {
  bool converged = false;
  bool accepted = false;
  std::string problem;            ///< why not
  int iterations = 0;             ///< of Newton's method
  int linear_iterations = 0;      ///< of the linear solver, all of Newton's together
  double largest_step = 0.0;      ///< way of a point [m]
  double largest_way = 0.0;       ///< of a point since its start [m]
  double left_by_contacts = 0.0;  ///< way that their passes leave open [m]
  double largest_change = 0.0;    ///< of a point's velocity against the last step [m/s]
  double largest_strain = 0.0;    ///< of a component of the displacement gradient [-]
};

/// Backward Euler without inertia: at the end of the step the stresses balance weight and loads,
/// and the pore water flows by Darcy's law (docs/methods/soil.md, implicit steps). Unknowns are the
/// displacements of grains and of water through faces and the rise of pore pressure in cells, with
/// the points' own splines: composite ones make the divergence of the former exactly a sum of the
/// latter, so nothing locks. Newton's method (PETSc's SNES with line search, tangents of the laws
/// by differences); linear systems by a direct solver (MUMPS) or by Krylov iterations
/// (ImplicitKrylov). On failure the points are as they were, and `problem` names the place.
/// Collective.
template <int D>
ImplicitOutcome solve_implicit_step(const ImplicitProblem<D>& problem);

/// What is out of balance on the grains at the start of the step [N], on owned faces. Collective.
template <int D>
void unbalanced_forces(const ImplicitProblem<D>& problem, FaceVector<D>& forces);

extern template ImplicitOutcome solve_implicit_step(const ImplicitProblem<2>&);
extern template ImplicitOutcome solve_implicit_step(const ImplicitProblem<3>&);
extern template void unbalanced_forces(const ImplicitProblem<2>&, FaceVector<2>&);
extern template void unbalanced_forces(const ImplicitProblem<3>&, FaceVector<3>&);

}  // namespace mudlark

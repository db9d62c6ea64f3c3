// ranks: 1 3
#include "numerics/pressure_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/loops.hpp"

namespace mudlark {
namespace {

constexpr double pi = std::numbers::pi;

template <int D>
Grid<D> box(std::array<int, 3> cells, std::array<double, 3> upper, Wall wall) {
  DomainOptions options;
  options.cells = cells;
  options.upper = upper;
  for (auto& axis : options.walls) axis = {wall, wall};
  return Grid<D>(options, MPI_COMM_WORLD);
}

template <int D>
void find_unknowns(const Grid<D>& grid, PressureSystem<D>& system) {
  const double* diagonal = system.diagonal.data();
  const auto unknown = [&](std::ptrdiff_t at) { return diagonal[at] > 0.0; };
  find_spans(grid, grid.owned(), unknown, system.unknowns);
}

/// -div(k grad p) with k given at faces; closed walls, or p = 0 half a cell beyond the last centre
/// if `open`.
template <int D, class Conductivity>
void assemble(const Grid<D>& grid, PressureSystem<D>& system, bool open, Conductivity&& k) {
  system.diagonal.fill(0.0);
  for (int axis = 0; axis < D; ++axis) {
    const double inverse = 1.0 / (grid.spacing()[axis] * grid.spacing()[axis]);
    for_each(bounding_faces(grid, axis), [&](const Index<D>& face) {
      const bool wall =
          !grid.periodic(axis) && (face[axis] == 0 || face[axis] == grid.cells()[axis]);
      const double coupling = k(grid.face_centre(axis, face)) * inverse;
      system.coupling[axis][face] = wall ? 0.0 : coupling;
      for (const Index<D>& cell : {face, face.shifted(axis, -1)})
        if (grid.owned().contains(cell))
          system.diagonal[cell] += wall ? (open ? 2.0 * coupling : 0.0) : coupling;
    });
  }
  system.constant_free = !open;
  find_unknowns(grid, system);
}

/// Error of the manufactured pressure prod sin(pi x_a) with k = 1 + sum x_a / 2 under p = 0 walls.
template <int D>
double manufactured_error(int cells) {
  const Grid<D> grid = box<D>({cells, cells, cells}, {1.0, 1.0, 1.0}, Wall::open);
  PressureSystem<D> system(grid);
  const auto k = [](const Vec<D>& x) {
    double sum = 1.0;
    for (int a = 0; a < D; ++a) sum += 0.5 * x[a];
    return sum;
  };
  const auto exact = [](const Vec<D>& x) {
    double product = 1.0;
    for (int a = 0; a < D; ++a) product *= std::sin(pi * x[a]);
    return product;
  };
  assemble(grid, system, true, k);
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const Vec<D> x = grid.cell_centre(cell);
    double gradients = 0.0;
    for (int a = 0; a < D; ++a) gradients += 0.5 * pi * exact(x) / std::tan(pi * x[a]);
    system.right_side[cell] = D * pi * pi * k(x) * exact(x) - gradients;
  });
  CellField<D> p(grid, "p", "Pa");
  PressureSolver<D> solver(grid);
  const SolveReport report = solver.solve(system, p, 1e-9);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(report.plain);
  EXPECT_LT(report.iterations, 25);
  double error = 0.0;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    error = std::max(error, std::abs(p[cell] - exact(grid.cell_centre(cell))));
  });
  return max_over_ranks(grid, error);
}

TEST(PressureSolver, SolvesAManufacturedPressureAtSecondOrder) {
  EXPECT_GT(std::log2(manufactured_error<2>(32) / manufactured_error<2>(64)), 1.9);
  EXPECT_GT(std::log2(manufactured_error<3>(12) / manufactured_error<3>(24)), 1.9);
}

/// Solves for a random-looking right side and returns the report.
template <int D>
SolveReport solve_rough(const Grid<D>& grid, bool open, double jump, double tolerance = 1e-10) {
  PressureSystem<D> system(grid);
  assemble(grid, system, open,
           [&](const Vec<D>& x) { return x[D - 1] > 0.37 * grid.upper()[D - 1] ? 1.0 : jump; });
  for_each(grid.owned(), [&](const Index<D>& cell) {
    double phase = 0.3;
    for (int a = 0; a < D; ++a) phase += (a + 1.7) * cell[a] * cell[a];
    system.right_side[cell] = std::sin(phase);
  });
  CellField<D> p(grid, "p", "Pa");
  PressureSolver<D> solver(grid);
  return solver.solve(system, p, tolerance);
}

TEST(PressureSolver, ConvergesOnThinColumns) {
  for (const bool open : {true, false}) {
    const SolveReport report =
        solve_rough<2>(box<2>({2, 835, 1}, {0.02, 8.35, 1.0}, Wall::open), open, 1.0, 1e-7);
    EXPECT_TRUE(report.converged);
    EXPECT_FALSE(report.plain);
    EXPECT_LT(report.iterations, 40);
  }
}

TEST(PressureSolver, ConvergesInPeriodicBoxesWhoseSizeIsNoPowerOfTwo) {
  for (const int cells : {30, 33, 50}) {
    const SolveReport report =
        solve_rough<2>(box<2>({cells, cells + 7, 1}, {1.0, 1.0, 1.0}, Wall::periodic), false, 1.0);
    EXPECT_TRUE(report.converged);
    EXPECT_FALSE(report.plain);
    EXPECT_LT(report.iterations, 75);
  }
}

TEST(PressureSolver, ConvergesFastInPeriodicBoxesOfPowersOfTwo) {
  const SolveReport flat =
      solve_rough<2>(box<2>({32, 64, 1}, {1.0, 2.0, 1.0}, Wall::periodic), false, 1.0);
  EXPECT_TRUE(flat.converged);
  EXPECT_LT(flat.iterations, 20);
  const SolveReport solid =
      solve_rough<3>(box<3>({16, 16, 8}, {1.0, 1.0, 1.0}, Wall::periodic), false, 1.0);
  EXPECT_TRUE(solid.converged);
  EXPECT_LT(solid.iterations, 20);
}

TEST(PressureSolver, ConvergesInAClosedBoxWithAJumpOfConductivity) {
  const SolveReport report =
      solve_rough<3>(box<3>({12, 18, 15}, {1.0, 1.0, 1.0}, Wall::slip), false, 1e-4, 1e-8);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(report.plain);
  EXPECT_LT(report.iterations, 40);
}

/// Water below a broken surface, with drops and bubbles: cells beside air see it half a cell away.
template <int D>
void expect_convergence_with_spray(const Grid<D>& grid) {
  PressureSystem<D> system(grid);
  const auto wet = [&](const Index<D>& cell) {
    if (!grid.global().contains(cell)) return false;
    const double level = grid.cells()[D - 1] * (0.6 + 0.1 * std::sin(0.7 * cell[0]));
    double phase = 0.3;
    for (int a = 0; a < D; ++a) phase += (a + 1.7) * cell[a] * cell[a];
    const bool odd = std::sin(phase) > 0.9;  // a drop, or a bubble
    return (cell[D - 1] < level) != odd;
  };
  assemble(grid, system, false, [](const Vec<D>&) { return 1.0; });
  const double inverse = 1.0 / (grid.spacing()[0] * grid.spacing()[0]);
  for (int axis = 0; axis < D; ++axis)
    for_each(bounding_faces(grid, axis), [&](const Index<D>& face) {
      const bool above = wet(face), below = wet(face.shifted(axis, -1));
      if (above && below) return;
      const bool wall = system.coupling[axis][face] == 0.0;
      system.coupling[axis][face] = 0.0;
      if (wall || above == below) return;
      const Index<D> cell = above ? face : face.shifted(axis, -1);
      if (grid.owned().contains(cell)) system.diagonal[cell] += inverse;
    });
  for_each(grid.owned(), [&](const Index<D>& cell) {
    if (!wet(cell)) system.diagonal[cell] = 0.0;
    system.right_side[cell] = wet(cell) ? std::sin(7.0 * cell[0] + 3.0 * cell[D - 1]) : 0.0;
  });
  system.constant_free = false;
  find_unknowns(grid, system);
  CellField<D> p(grid, "p", "Pa");
  PressureSolver<D> solver(grid);
  const SolveReport report = solver.solve(system, p, 1e-10);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(report.plain);
  EXPECT_LT(report.iterations, 25);
}

TEST(PressureSolver, ConvergesBelowABrokenSurface) {
  expect_convergence_with_spray(box<2>({96, 64, 1}, {1.5, 1.0, 1.0}, Wall::slip));
  expect_convergence_with_spray(box<3>({24, 16, 20}, {1.2, 0.8, 1.0}, Wall::slip));
}

TEST(PressureSolver, LeavesCellsWithoutUnknownAlone) {
  const Grid<2> grid = box<2>({16, 16, 1}, {1.0, 1.0, 1.0}, Wall::slip);
  PressureSystem<2> system(grid);
  assemble(grid, system, false, [](const Vec<2>&) { return 1.0; });
  CellField<2> p(grid, "p", "Pa");
  // Upper half: air. Its lower neighbours keep the coupling in their diagonal: p = 0 above them.
  for_each(grid.owned().grown(1), [&](const Index<2>& cell) {
    if (cell[1] >= 8) {
      system.diagonal[cell] = 0.0;
      p[cell] = 42.0;
    } else {
      system.right_side[cell] = 1.0;
    }
    if (cell[1] >= 8) system.coupling[0][cell] = system.coupling[1][cell] = 0.0;
  });
  system.constant_free = false;
  find_unknowns(grid, system);
  PressureSolver<2> solver(grid);
  EXPECT_TRUE(solver.solve(system, p, 1e-10).converged);
  // One-dimensional: p'' = -1 with p'(0) = 0 and p = 0 at the first air centre.
  for_each(grid.owned(), [&](const Index<2>& cell) {
    const double h = 1.0 / 16.0, z = (cell[1] + 0.5) * h, top = 8.5 * h;
    if (cell[1] >= 8)
      EXPECT_EQ(p[cell], 42.0);
    else
      EXPECT_NEAR(p[cell], 0.5 * (top * top - z * z), 0.5 * h * h);
  });
}

/// A slab of water across the box, p = 0 in the middle of the air cells beside it.
void assemble_slab(const Grid<2>& grid, int first, int last, PressureSystem<2>& system) {
  assemble(grid, system, false, [](const Vec<2>&) { return 1.0; });
  const auto wet = [&](const Index<2>& cell) { return cell[0] >= first && cell[0] < last; };
  for_each(bounding_faces(grid, 1), [&](const Index<2>& face) {
    if (!wet(face)) system.coupling[1][face] = 0.0;
  });
  for_each(bounding_faces(grid, 0), [&](const Index<2>& face) {
    if (!wet(face) || !wet(face.shifted(0, -1))) system.coupling[0][face] = 0.0;
  });
  for_each(grid.owned(), [&](const Index<2>& cell) {
    if (!wet(cell)) system.diagonal[cell] = 0.0;
    system.right_side[cell] = wet(cell) ? 1.0 : 0.0;
  });
  system.constant_free = false;
  find_unknowns(grid, system);
}

TEST(PressureSolver, RanksWithoutWaterTakePartAndWaterMovesBetweenRanks) {
  const Grid<2> grid = box<2>({96, 16, 1}, {6.0, 1.0, 1.0}, Wall::slip);
  PressureSystem<2> system(grid);
  CellField<2> p(grid, "p", "Pa");
  PressureSolver<2> solver(grid);
  for (const int first : {2, 2, 70, 40, 2}) {
    assemble_slab(grid, first, first + 20, system);
    p.fill(0.0);
    EXPECT_TRUE(solver.solve(system, p, 1e-9).converged);
    const double h = 6.0 / 96.0, from = (first - 0.5) * h, to = (first + 20.5) * h;
    for_each(grid.owned(), [&](const Index<2>& cell) {  // p'' = -1, exact with differences
      const double x = (cell[0] + 0.5) * h;
      const double exact = x > from && x < to ? 0.5 * (x - from) * (to - x) : 0.0;
      EXPECT_NEAR(p[cell], exact, 1e-8);
    });
  }
}

}  // namespace
}  // namespace mudlark

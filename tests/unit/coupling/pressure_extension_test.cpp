// ranks: 1 3
#include "coupling/pressure_extension.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudlark {
namespace {

constexpr double density = 1000.0, gravity = 9.81, water_level = 3.0;

/// 4 m (x 2 m) x 3.2 m of cells of 0.2 m (0.25 m in y); gravity may lean.
template <int D>
Grid<D> make_grid(Wall sides, double lean = 0.0) {
  DomainOptions domain;
  domain.dimension = D;
  if constexpr (D == 2) {
    domain.upper = {4.0, 3.2, 0.0};
    domain.cells = {20, 16, 1};
    domain.gravity = {lean, -gravity, 0.0};
    domain.walls = {{{sides, sides}, {Wall::slip, Wall::open}, {Wall::slip, Wall::slip}}};
  } else {
    domain.upper = {4.0, 2.0, 3.2};
    domain.cells = {20, 8, 16};
    domain.gravity = {lean, 0.0, -gravity};
    domain.walls = {{{sides, sides}, {sides, sides}, {Wall::slip, Wall::open}}};
  }
  return Grid<D>(domain, MPI_COMM_WORLD);
}

/// Water above a bed whose surface lies at `bed` (cells below are not open); the exact pressure in
/// water, nothing but rubbish elsewhere.
template <int D>
struct Scene {
  explicit Scene(const Grid<D>& grid)
      : open(grid, "open", "1"), wet(grid, "wet", "1"), pressure(grid, "pressure", "Pa", -777.0) {}
  CellField<D> open, wet, pressure;
};

template <int D, class Exact, class Bed, class Wet>
Scene<D> make_scene(const Grid<D>& grid, Exact exact, Bed bed, Wet wet) {
  Scene<D> scene(grid);
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const Vec<D> x = grid.cell_centre(cell);
    if (x[D - 1] < bed(x)) return;
    scene.open[cell] = 1.0;
    scene.wet[cell] = wet(x) ? 1.0 : 0.0;
    scene.pressure[cell] = wet(x) ? exact(x) : 0.0;
  });
  return scene;
}

template <int D, class Exact>
void expect_pressure(const Grid<D>& grid, const IndexBox<D>& box, const CellField<D>& pressure,
                     Exact exact) {
  for_each(box.intersected(grid.local()), [&](const Index<D>& cell) {
    EXPECT_NEAR(pressure[cell], exact(grid.cell_centre(cell)), 1e-9)
        << "rank " << grid.rank() << ", cell " << cell[0] << " " << cell[D - 1];
  });
}

template <int D>
void expect_hydrostatic(Wall sides) {
  const Grid<D> grid = make_grid<D>(sides);
  const auto exact = [](const Vec<D>& x) { return density * gravity * (water_level - x[D - 1]); };
  auto scene = make_scene(
      grid, exact, [](const Vec<D>&) { return 1.4; }, [](const Vec<D>&) { return true; });
  PressureExtension<D>(grid).extend(scene.open, scene.wet, density, grid.local(), scene.pressure);
  expect_pressure(grid, grid.local(), scene.pressure, exact);  // ghosts and behind walls as well
}

TEST(PressureExtension, ContinuesStandingWaterExactlyThroughAFlatBedAndBehindWalls) {
  for (const Wall sides : {Wall::slip, Wall::no_slip, Wall::periodic}) {
    expect_hydrostatic<2>(sides);
    expect_hydrostatic<3>(sides);
  }
}

template <int D>
void expect_exact_below_steps(double lean) {
  const Grid<D> grid = make_grid<D>(Wall::slip, lean);
  const auto exact = [lean](const Vec<D>& x) {
    return density * (gravity * (water_level - x[D - 1]) + lean * x[0]);
  };
  const auto bed = [](const Vec<D>& x) { return x[0] < 1.1 ? 2.4 : x[0] < 2.5 ? 0.7 : 1.6; };
  auto scene = make_scene(grid, exact, bed, [](const Vec<D>&) { return true; });
  PressureExtension<D>(grid).extend(scene.open, scene.wet, density, grid.local(), scene.pressure);
  expect_pressure(grid, grid.local(), scene.pressure, exact);
}

TEST(PressureExtension, IsExactBelowABedWithStepsAndUnderLeaningGravity) {
  expect_exact_below_steps<2>(0.0);
  expect_exact_below_steps<2>(2.0);
  expect_exact_below_steps<3>(2.0);
}

TEST(PressureExtension, FromADrySurfaceIsZeroEverywhere) {
  const Grid<2> grid = make_grid<2>(Wall::slip);
  const auto zero = [](const Vec<2>&) { return 0.0; };
  auto scene = make_scene(
      grid, zero, [](const Vec<2>&) { return 1.4; }, [](const Vec<2>&) { return false; });
  PressureExtension<2>(grid).extend(scene.open, scene.wet, density, grid.local(), scene.pressure);
  expect_pressure(grid, grid.local(), scene.pressure, zero);
}

TEST(PressureExtension, KeepsPuddleAndDryLandApartJustBelowTheSurface) {
  const Grid<2> grid = make_grid<2>(Wall::slip);
  const double bed = 1.4;
  const auto wet = [](const Vec<2>& x) { return x[0] < 2.0; };
  const auto exact = [](const Vec<2>& x) { return density * gravity * (water_level - x[1]); };
  auto scene = make_scene(
      grid, exact, [bed](const Vec<2>&) { return bed; }, wet);
  PressureExtension<2>(grid).extend(scene.open, scene.wet, density, grid.local(), scene.pressure);
  for_each(grid.owned(), [&](const Index<2>& cell) {
    const Vec<2> x = grid.cell_centre(cell);
    if (x[1] > bed || x[1] < bed - 0.2) return;  // the first layer: one source each
    EXPECT_NEAR(scene.pressure[cell], wet(x) ? exact(x) : 0.0, 1e-9);
  });
}

TEST(PressureExtension, LeavesCellsOutsideItsBoxAndOpenCellsAlone) {
  const Grid<2> grid = make_grid<2>(Wall::slip);
  const auto exact = [](const Vec<2>& x) { return density * gravity * (water_level - x[1]); };
  auto scene = make_scene(
      grid, exact, [](const Vec<2>&) { return 1.4; }, [](const Vec<2>&) { return true; });
  const CellField<2> before = scene.pressure.copy();
  const IndexBox<2> box{{{0, 3}}, {{20, 16}}};
  PressureExtension<2>(grid).extend(scene.open, scene.wet, density, box, scene.pressure);
  expect_pressure(grid, box.intersected(grid.global()), scene.pressure, exact);
  for_each(grid.owned(), [&](const Index<2>& cell) {
    if (cell[1] < 3 || scene.open[cell] > 0.0) {
      EXPECT_EQ(scene.pressure[cell], before[cell]);
    }
  });
}

TEST(PressureExtension, CanBeUsedAgainForAnotherSurface) {
  const Grid<2> grid = make_grid<2>(Wall::slip);
  const auto exact = [](const Vec<2>& x) { return density * gravity * (water_level - x[1]); };
  PressureExtension<2> extension(grid);
  for (const double bed : {1.4, 0.8, 2.2}) {
    auto scene = make_scene(
        grid, exact, [bed](const Vec<2>&) { return bed; }, [](const Vec<2>&) { return true; });
    extension.extend(scene.open, scene.wet, density, grid.local(), scene.pressure);
    expect_pressure(grid, grid.local(), scene.pressure, exact);
  }
}

}  // namespace
}  // namespace mudlark

// Pressure on the soil's surface: as a virtual stress, and by facets.
#include "soil/surface_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/soil/soil_setup.hpp"

namespace mudlark {
namespace {

using namespace soil_test;

/// p = constant + slope . x at cell centres, ghosts included.
template <int D>
CellField<D> linear_pressure(const Grid<D>& grid, double constant, const Vec<D>& slope) {
  CellField<D> pressure(grid, "pressure", "Pa");
  for_each(grid.local(), [&](const Index<D>& cell) {
    pressure[cell] = constant + dot(slope, grid.cell_centre(cell));
  });
  return pressure;
}

template <int D>
double largest_force(const NodeField<NodeSums, D>& nodes, double NodeSums::*force) {
  double largest = 0.0;
  for (const auto& field : nodes)
    for (std::size_t i = 0; i < field.size(); ++i)
      largest = std::max(largest, std::abs((field.data() + i)->*force));
  return largest;
}

/// Points with a free surface on every side, jittered; the stress balances the pressure around.
template <int D>
void expect_uniform_patch_at_rest(Kernel kernel, bool in_pores) {
  SCOPED_TRACE(name_of(kernel));
  const Grid<D> grid = make_grid<D>({8, 8, 8}, Wall::slip);
  SoilParticles<D> points = make_cloud(grid, cube<D>(2, 6), 2, 1.0);
  const double pressure = 4e5;
  const CellField<D> around = linear_pressure(grid, pressure, Vec<D>{});
  for (std::size_t p = 0; p < points.size(); ++p) {
    points.pore_pressure[p] = in_pores ? pressure : 0.0;
    set_tensor(points.stress, p, (in_pores ? 0.0 : -pressure) * SymTensor::identity());
  }
  auto nodes = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, saturated_sand(), kernel, Transfer::flip,
                 {&around, in_pores ? &around : nullptr}, nodes);
  // One point alone would push its nodes with V p / h.
  const double scale = pressure * grid.cell_volume() / grid.smallest_spacing();
  EXPECT_LT(largest_force(nodes, &NodeSums::mixture_force), 1e-13 * scale);
  EXPECT_LT(largest_force(nodes, &NodeSums::water_force), 1e-13 * scale);
}

TEST(VirtualStress, UniformPressureLeavesJitteredPointsAtRest) {
  for (const Kernel kernel : every_kernel)
    for (const bool in_pores : {false, true}) {
      expect_uniform_patch_at_rest<2>(kernel, in_pores);
      expect_uniform_patch_at_rest<3>(kernel, in_pores);
    }
}

template <int D>
void expect_buoyancy_alone(Kernel kernel) {
  SCOPED_TRACE(name_of(kernel));
  const Grid<D> grid = make_grid<D>({8, 8, 8}, Wall::slip);
  SoilParticles<D> points = make_cloud(grid, cube<D>(2, 6), 2, 1.0);
  Vec<D> slope{};
  slope[D - 1] = -9810.0;
  const double constant = 3e4;
  const CellField<D> around = linear_pressure(grid, constant, slope);
  for (std::size_t p = 0; p < points.size(); ++p) {
    points.pore_pressure[p] = constant + dot(slope, points.position_of(p));
    set_tensor(points.stress, p, SymTensor{});
  }
  auto nodes = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, saturated_sand(), kernel, Transfer::flip, {&around, &around}, nodes);
  const double scale = constant * grid.cell_volume() / grid.smallest_spacing();
  for (int a = 0; a < D; ++a)
    for_each(grid.local(), [&](const Index<D>& face) {
      const NodeSums& node = nodes[static_cast<std::size_t>(a)][face];
      const double weight = a == D - 1 ? 9810.0 * node.volume : 0.0;
      EXPECT_NEAR(node.mixture_force, weight, 1e-12 * scale);
      EXPECT_NEAR(node.water_force, weight, 1e-12 * scale);
    });
}

TEST(VirtualStress, HydrostaticPressureIsBuoyancyAndNothingElse) {
  for (const Kernel kernel : every_kernel) {
    expect_buoyancy_alone<2>(kernel);
    expect_buoyancy_alone<3>(kernel);
  }
}

TEST(VirtualStress, DrainedPoresFeelOnlyTheirOwnPressureGradient) {
  const Grid<2> grid = make_grid<2>({8, 8, 8}, Wall::slip);
  SoilParticles<2> points = make_cloud(grid, cube<2>(2, 6), 2, 1.0);
  for (std::size_t p = 0; p < points.size(); ++p) points.pore_pressure[p] = 0.0;
  const CellField<2> around = linear_pressure(grid, 4e5, Vec<2>{});
  auto nodes = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, saturated_sand(), Kernel::composite, Transfer::flip,
                 {&around, nullptr}, nodes);
  EXPECT_EQ(largest_force(nodes, &NodeSums::water_force), 0.0);
  EXPECT_GT(largest_force(nodes, &NodeSums::mixture_force), 1e3);
}

/// Forces of a surface pressure on stress-free points in both forms.
template <int D>
struct BothForms {
  NodeField<NodeSums, D> stress, facets;
};

template <int D>
BothForms<D> both_forms(const Grid<D>& grid, SoilParticles<D>& points, const CellField<D>& load) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    points.pore_pressure[p] = 0.0;
    points.volume[p] = points.start_volume[p];
    set_tensor(points.stress, p, SymTensor{});
  }
  BothForms<D> forms{make_nodes<NodeSums>(grid), make_nodes<NodeSums>(grid)};
  BodyConstants dry = saturated_sand();
  dry.water_density = 0.0;
  points_to_grid(grid, points, dry, Kernel::composite, Transfer::flip, {&load, nullptr},
                 forms.stress);
  CellField<D> occupied(grid, "occupied", "1");
  mark_occupied(grid, points, occupied);
  add_facet_forces(grid, occupied, {&load, nullptr}, grid.local(), forms.facets);
  return forms;
}

/// Sum of the mixture force of one axis over the faces where `where` holds.
template <int D, class Where>
double resultant(const Grid<D>& grid, const NodeField<NodeSums, D>& nodes, int axis, Where where) {
  double sum = 0.0;
  for_each(grid.local(), [&](const Index<D>& face) {
    if (where(face)) sum += nodes[static_cast<std::size_t>(axis)][face].mixture_force;
  });
  return sum;
}

template <int D>
void expect_flat_surface_agrees() {
  const Grid<D> grid = make_grid<D>({16, 12, 16}, Wall::slip);
  IndexBox<D> block = cube<D>(3, 9);
  SoilParticles<D> points = make_cloud(grid, block, 2, 0.0);
  Vec<D> slope{};
  for (int a = 0; a < D - 1; ++a) slope[a] = 300.0;
  const CellField<D> load = linear_pressure(grid, 5e3, slope);
  const BothForms<D> forms = both_forms(grid, points, load);
  // Vertical force above the block's middle, where only its top bears: - integral of p.
  double top = 0.0;
  for_each(block, [&](const Index<D>& cell) {
    if (cell[D - 1] == 8) top -= load[cell] * grid.cell_volume() / grid.spacing()[D - 1];
  });
  const auto upper = [](const Index<D>& face) { return face[D - 1] > 6; };
  EXPECT_NEAR(resultant(grid, forms.facets, D - 1, upper) / top, 1.0, 1e-12);
  EXPECT_NEAR(resultant(grid, forms.stress, D - 1, upper) / top, 1.0, 1e-12);
  // All around: buoyancy against the slope of the pressure.
  const auto all = [](const Index<D>&) { return true; };
  double volume = 0.0;
  for (const double v : points.volume) volume += v;
  EXPECT_NEAR(resultant(grid, forms.facets, 0, all) / (-300.0 * volume), 1.0, 1e-12);
  EXPECT_NEAR(resultant(grid, forms.stress, 0, all) / (-300.0 * volume), 1.0, 1e-12);
}

TEST(LoadForms, BearOnAFlatSurfaceWithTheSameForce) {
  expect_flat_surface_agrees<2>();
  expect_flat_surface_agrees<3>();
}

TEST(LoadForms, DifferOnASlopeByLessThanTheStepsOfTheFacets) {
  // Soil below a slope of 1 in 3 under a uniform pressure, seen through a window of whole steps.
  const Grid<2> grid = make_grid<2>({42, 30, 1}, Wall::slip);
  SoilParticles<2> points = make_cloud(grid, IndexBox<2>{{{3, 3}}, {{39, 27}}}, 4, 0.0), soil;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double x = (points.position[0][p] - grid.lower()[0]) / grid.spacing()[0];
    const double z = (points.position[1][p] - grid.lower()[1]) / grid.spacing()[1];
    if (z > 10.0 + x / 3.0) continue;
    const std::size_t q = soil.size();
    soil.resize(q + 1);
    soil.position[0][q] = points.position[0][p], soil.position[1][q] = points.position[1][p];
    soil.start_volume[q] = soil.volume[q] = points.start_volume[p];
    soil.grain_mass[q] = points.grain_mass[p];
  }
  const double pressure = 1e4;
  const CellField<2> load = linear_pressure(grid, pressure, Vec<2>{});
  const BothForms<2> forms = both_forms(grid, soil, load);
  const auto window = [](const Index<2>& face) {
    return face[0] >= 12 && face[0] < 30 && face[1] > 6;
  };
  const double down = -pressure * 18 * grid.spacing()[0];
  const double sideways = pressure * 6 * grid.spacing()[1];  // the surface's height over the window
  const double facets_down = resultant(grid, forms.facets, 1, window);
  const double stress_down = resultant(grid, forms.stress, 1, window);
  const double facets_side = resultant(grid, forms.facets, 0, window);
  const double stress_side = resultant(grid, forms.stress, 0, window);
  RecordProperty("facets_down", std::to_string(facets_down / down));
  RecordProperty("stress_down", std::to_string(stress_down / down));
  RecordProperty("facets_sideways", std::to_string(facets_side / sideways));
  RecordProperty("stress_sideways", std::to_string(stress_side / sideways));
  EXPECT_NEAR(facets_down / down, 1.0, 1e-12);
  EXPECT_NEAR(stress_down / down, 1.0, 1e-3);
  EXPECT_NEAR(facets_side / sideways, 1.0, 1e-12);
  EXPECT_NEAR(stress_side / sideways, 1.0, 1e-2);
  // Where the force acts differs: facets bunch the sideways force at the steps.
  double difference = 0.0, total = 0.0;
  for (int i = 12; i < 30; ++i) {
    const auto column = [i](const Index<2>& face) { return face[0] == i && face[1] > 6; };
    difference = std::max(difference, std::abs(resultant(grid, forms.facets, 0, column) -
                                               resultant(grid, forms.stress, 0, column)));
    total += resultant(grid, forms.stress, 0, column);
  }
  RecordProperty("largest_column_difference", std::to_string(18 * difference / total));
  EXPECT_GT(18 * difference / total, 0.5);
  EXPECT_LT(18 * difference / total, 3.0);
}

TEST(SurfaceLoads, AreThoseOfTheMomentWithWaterLinearBetweenTheEndsOfTheStepAndAddUp) {
  const Grid<2> grid = make_grid<2>({6, 6, 1}, Wall::slip);
  const Varying rising([](const Point3& x, double t) { return 100.0 * t * t + x[0]; }, "rising");
  SurfaceLoads<2> loads(grid, {{"rising", rising}, {"constant", Varying(7.0)}});
  FluidLoad<2> water(grid);
  water.pressure_begin.fill(10.0);
  water.pressure_end.fill(30.0);
  loads.begin_step(1.0, 2.0, &water, grid.local());
  const Index<2> cell{{2, 3}};
  const double x = grid.cell_centre(cell)[0];
  for (const double share : {0.0, 0.25, 1.0}) {
    const double t = 1.0 + 2.0 * share;
    const SurfacePressure<2> now = loads.at(t);
    EXPECT_NEAR((*now.traction)[cell], 100.0 * t * t + x + 7.0 + 10.0 + share * 20.0, 1e-9);
    ASSERT_NE(now.drained, nullptr);
    EXPECT_NEAR((*now.drained)[cell], 10.0 + share * 20.0, 1e-12);
  }
  water.outlet = PoreOutlet::at_zero_pressure;
  loads.begin_step(3.0, 1.0, &water, grid.local());
  EXPECT_EQ(loads.at(3.5).drained, nullptr);
  EXPECT_FALSE(loads.sealed());
  water.outlet = PoreOutlet::sealed;
  EXPECT_TRUE(loads.sealed());
}

/// A load that swings within an outer step, and is the same at both of its ends.
TEST(SurfaceLoads, ThatSwingWithinAStepAreFollowed) {
  const Grid<2> grid = make_grid<2>({6, 6, 1}, Wall::slip);
  Varying swinging([](const Point3&, double t) { return std::sin(t); }, "sin(t)");
  swinging.in_space = false;
  SurfaceLoads<2> loads(grid, {{"swinging", swinging, LoadedPhase::water}});
  loads.begin_step(0.0, 2.0 * std::acos(-1.0), nullptr, grid.local());
  const Index<2> cell{{2, 3}};
  for (const double t : {0.5, 2.0, 5.0}) {
    const SurfacePressure<2> now = loads.at(t);
    EXPECT_EQ((*now.traction)[cell], std::sin(t));
    EXPECT_EQ((*now.drained)[cell], std::sin(t));
  }
}

TEST(SurfaceLoads, WithNothingToBearGiveNothing) {
  const Grid<2> grid = make_grid<2>({6, 6, 1}, Wall::slip);
  SurfaceLoads<2> loads(grid, {});
  loads.begin_step(0.0, 1.0, nullptr, grid.local());
  EXPECT_EQ(loads.at(0.5).traction, nullptr);
}

}  // namespace
}  // namespace mudlark

// Transfers that take points a cell at a time give the sums of those that take them one by one.
#include <gtest/gtest.h>

#include "soil/redistribute.hpp"
#include "unit/soil/soil_setup.hpp"

namespace mudlark {
namespace {

using namespace soil_test;

/// How points lie in the arrays: in random order, sorted, or moved on since.
enum class Order { never_sorted, sorted, moved };

/// 2.5 points per cell and axis on average, so that cells hold unequal numbers.
template <int D>
SoilParticles<D> make_points(const Grid<D>& grid, Order order) {
  SoilParticles<D> points = make_cloud(grid, cube<D>(1, 5), 3, 1.4);
  points.resize(points.size() - 5);  // the last batch is not full
  if (order != Order::never_sorted) sort_by_cell(grid, points);
  if (order == Order::moved)
    for (int a = 0; a < D; ++a)
      for (std::size_t p = 0; p < points.size(); ++p)
        points.position[a][p] += 0.6 * grid.spacing()[a] * std::sin(static_cast<double>(p * p) + a);
  return points;
}

template <int D>
void expect_same_sums(const NodeField<NodeSums, D>& one, const NodeField<NodeSums, D>& other) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a) {
    std::array<double, node_sums> scale{};
    const auto* left = reinterpret_cast<const double*>(one[a].data());
    const auto* right = reinterpret_cast<const double*>(other[a].data());
    for (std::size_t i = 0; i < one[a].size() * node_sums; ++i)
      scale[i % node_sums] = std::max(scale[i % node_sums], std::abs(left[i]));
    for (std::size_t i = 0; i < one[a].size() * node_sums; ++i)
      ASSERT_NEAR(left[i], right[i], 1e-13 * scale[i % node_sums]) << "sum " << i % node_sums;
  }
}

template <int D>
void expect_same_scatter(Kernel kernel, Transfer transfer, Order order) {
  const Grid<D> grid = make_grid<D>({6, 6, 6}, Wall::slip);
  const SoilParticles<D> points = make_points(grid, order);
  CellField<D> traction(grid, "traction", "Pa"), drained(grid, "drained", "Pa");
  double value = 0.0;
  for_each(grid.local(), [&](const Index<D>& cell) {
    traction[cell] = 1e4 * std::sin(value), drained[cell] = 1e4 * std::cos(value);
    value += 1.7;
  });
  BodyConstants dry = saturated_sand();
  dry.water_density = 0.0;
  for (const BodyConstants& body : {saturated_sand(), dry})
    for (const SurfacePressure<D>& surface :
         {SurfacePressure<D>{}, SurfacePressure<D>{&traction, &drained}}) {
      auto by_cell = make_nodes<NodeSums>(grid), one_by_one = make_nodes<NodeSums>(grid);
      points_to_grid(grid, points, body, kernel, transfer, surface, by_cell);
      points_to_grid_one_by_one(grid, points, body, kernel, transfer, surface, one_by_one);
      expect_same_sums(one_by_one, by_cell);
    }
}

void expect_same_values(const std::vector<double>& one, const std::vector<double>& other,
                        double tolerance) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], other[i], tolerance);
}

template <int D>
void expect_same_gather(Kernel kernel, Transfer transfer, Order order) {
  const Grid<D> grid = make_grid<D>({6, 6, 6}, Wall::slip);
  auto nodes = make_nodes<NodeMotion>(grid);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (auto& field : nodes)
    for_each(grid.local(), [&](const Index<D>& face) {
      field[face] = {unit(generator), unit(generator), unit(generator), unit(generator),
                     unit(generator)};
    });
  for (const bool wet : {false, true}) {
    SoilParticles<D> by_cell = make_points(grid, order), one_by_one = by_cell;
    const PointUpdate update{0.9, 0.01, wet};
    const std::size_t middle = by_cell.size() / 2 + 1;  // two ranges, somewhere within a cell
    for (const PointRange range : {PointRange{0, middle}, PointRange{middle, by_cell.size()}}) {
      PointMotion motion, expected;
      grid_to_points(grid, nodes, kernel, transfer, update, range, by_cell, motion);
      grid_to_points_one_by_one(grid, nodes, kernel, transfer, update, range, one_by_one, expected);
      expect_same_values(expected.gradient, motion.gradient, 1e-14);
      expect_same_values(expected.flux_divergence, motion.flux_divergence, 1e-12);
      EXPECT_NEAR(motion.largest_speed, expected.largest_speed, 1e-13);
      EXPECT_EQ(motion.strays > 0, order == Order::moved);
    }
    std::vector<std::vector<double>> all;
    one_by_one.for_each_array([&](const std::vector<double>& array) { all.push_back(array); });
    std::size_t next = 0;
    by_cell.for_each_array(
        [&](const std::vector<double>& array) { expect_same_values(all[next++], array, 2e-12); });
  }
}

template <class F>
void for_every_mode(F&& f) {
  for (const Kernel kernel : {Kernel::quadratic, Kernel::composite})
    for (const Transfer transfer : every_transfer)
      for (const Order order : {Order::never_sorted, Order::sorted, Order::moved}) {
        SCOPED_TRACE(std::string(name_of(kernel)) +
                     (transfer == Transfer::apic ? " APIC " : " FLIP ") +
                     std::to_string(static_cast<int>(order)));
        f(kernel, transfer, order);
      }
}

TEST(CellTransfer, PointsToGridGivesTheSumsOfOneByOne) {
  for_every_mode([](Kernel kernel, Transfer transfer, Order order) {
    expect_same_scatter<2>(kernel, transfer, order);
    expect_same_scatter<3>(kernel, transfer, order);
  });
}

TEST(CellTransfer, GridToPointsGivesTheMotionOfOneByOne) {
  for_every_mode([](Kernel kernel, Transfer transfer, Order order) {
    expect_same_gather<2>(kernel, transfer, order);
    expect_same_gather<3>(kernel, transfer, order);
  });
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3
// Layers of several soils between height maps in space: volumes and stress from the start.
#include <gtest/gtest.h>

#include <functional>

#include "grid/height_map.hpp"
#include "soil/seeding.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

constexpr double width = 4.0, depth = 3.0, h = 0.25;
using Height = std::function<double(double, double)>;

Grid<3> box_grid() {
  return soil_runs::make_grid<3>({16, 12, 20}, h, "ssssso", 9.81, MPI_COMM_WORLD);
}

/// A ground whose heights stand on a lattice of 9 x 7 lines; what is bilinear, it is exactly.
Shape ground(const Height& height) {
  std::vector<double> x, y, heights;
  for (int i = 0; i < 9; ++i) x.push_back(width * i / 8.0);
  for (int j = 0; j < 7; ++j) y.push_back(depth * j / 6.0);
  for (const double along_y : y)
    for (const double along_x : x) heights.push_back(height(along_x, along_y));
  return Shape{HeightMapShape{std::make_shared<const HeightMap>(x, y, heights)}};
}

/// Rock, clay and sand, bottom up, between grounds.
SoilOptions layers(const std::array<Height, 3>& tops) {
  SoilOptions soil = soil_runs::make_soil(3, {}, {}, false);
  soil.bodies.assign(3, soil.bodies[0]);
  for (std::size_t b = 0; b < 3; ++b) {
    SoilBody& body = soil.bodies[b];
    body.name = std::string("layer ") + static_cast<char>('0' + b);
    body.porosity = 0.3 + 0.1 * static_cast<double>(b);
    body.points_per_cell = b == 1 ? 27 : 8;
    body.initial_stress = GeostaticStress{0.5};
    body.shape = ground(tops[b]);
    if (b > 0) body.shape = Shape{DifferenceShape{{body.shape, ground(tops[b - 1])}}};
  }
  return soil;
}

std::array<double, 3> volumes(const Grid<3>& grid, const SoilOptions& soil) {
  std::array<double, 3> all{};
  for (std::size_t b = 0; b < 3; ++b) {
    const auto points = seed_points(grid, soil.bodies[b], b, Transfer::flip);
    double sum = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) sum += points.volume[p];
    all[b] = sum_over_ranks(grid, sum);
  }
  return all;
}

/// Grounds that rise over a level of cell edges on one side as they fall under it on the other:
/// what the lattice of points has too much here it lacks there, and volumes are exact. (Slopes are
/// irrational so that no point lies on a ground.)
TEST(GroundLayers, OfGroundsThatAreOddAboutALevelHaveExactVolumes) {
  const double x0 = 0.5 * width, y0 = 0.5 * depth;
  const SoilOptions soil = layers(
      {[&](double x, double y) {
         return 1.0 + 0.1 * std::sqrt(3.0) * (x - x0) + 0.07 * std::sqrt(2.0) * (y - y0);
       },
       [&](double x, double y) { return 2.25 + 0.08 * std::sqrt(2.0) * (x - x0) * (y - y0); },
       [&](double x, double y) {
         return 3.75 + std::sqrt(2.0) * (x - x0) * (0.04 * (y - y0) - 0.1);
       }});
  const auto found = volumes(box_grid(), soil);
  const std::array<double, 3> exact{1.0 * width * depth, 1.25 * width * depth, 1.5 * width * depth};
  for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(found[b], exact[b], 1e-12 * exact[b]);
}

/// Hills of any form: lattice points err by half a spacing at most, column by column, and over many
/// columns by less than a tenth of it.
TEST(GroundLayers, OfHillsHaveTheVolumeBetweenThem) {
  const Height rock = [](double x, double y) {
    return 1.0 + 0.4 * std::sin(1.7 * x) * std::cos(1.3 * y);
  };
  const Height clay = [](double x, double y) { return 2.1 + 0.3 * std::cos(1.1 * x + 0.7 * y); };
  const Height sand = [](double x, double y) { return 3.3 + 0.2 * x - 0.35 * std::sin(y); };
  const auto found = volumes(box_grid(), layers({rock, clay, sand}));
  // Bilinear patches have the volume under the mean of their corners.
  std::array<double, 3> below{};
  const std::array<Height, 3> tops{rock, clay, sand};
  for (std::size_t b = 0; b < 3; ++b)
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 6; ++j)
        for (const int right : {0, 1})
          for (const int back : {0, 1})
            below[b] += 0.25 * 0.25 * tops[b](0.5 * (i + right), 0.5 * (j + back));
  for (std::size_t b = 0; b < 3; ++b) {
    const double exact = below[b] - (b > 0 ? below[b - 1] : 0.0);
    EXPECT_NEAR(found[b], exact, 0.1 * 0.5 * h * width * depth) << b;
  }
}

/// Each layer presses with its own weight; a stress that a layer gives itself stands beside it.
TEST(GroundLayers, PressOnEachOtherByTheirThickness) {
  const Grid<3> grid = box_grid();
  const std::array<Height, 3> tops{[](double x, double y) { return 1.0 + 0.2 * x - 0.1 * y; },
                                   [](double x, double y) { return 2.3 - 0.1 * x + 0.1 * y; },
                                   [](double x, double y) { return 3.4 + 0.15 * x + 0.05 * y; }};
  SoilOptions soil = layers(tops);
  StressField locked_in;
  locked_in.component[0] = Varying([](const Point3& x, double) { return -7e3 * x[0]; }, "xx");
  locked_in.component[2] = Varying([](const Point3& x, double) { return -1e4 * x[2]; }, "zz");
  soil.bodies[0].initial_stress = locked_in;
  std::vector<SoilParticles<3>> points;
  for (std::size_t b = 0; b < 3; ++b)
    points.push_back(seed_points(grid, soil.bodies[b], b, Transfer::flip));
  set_initial_stress(grid, soil, 0, points);
  const auto weight = [&](std::size_t b) {
    return (1.0 - soil.bodies[b].porosity) * soil.bodies[b].grain_density * 9.81;
  };
  for (std::size_t b = 0; b < 3; ++b)
    for (std::size_t p = 0; p < points[b].size(); ++p) {
      const Point3 place = to_point3(points[b].position_of(p));
      const SymTensor stress = get_tensor(points[b].stress, p);
      if (b == 0) {
        EXPECT_DOUBLE_EQ(stress.xx, -7e3 * place[0]);
        EXPECT_DOUBLE_EQ(stress.zz, -1e4 * place[2]);
        continue;
      }
      double exact = 0.0, from = place[2];
      for (std::size_t above = b; above < 3; ++above) {
        const double top = tops[above](place[0], place[1]);
        exact -= weight(above) * (top - from);
        from = top;
      }
      // Half a spacing of points at each of two edges.
      EXPECT_NEAR(stress.zz, exact, 0.5 * h / (b == 1 ? 3 : 2) * (weight(b) + weight(2)));
      EXPECT_NEAR(stress.xx, 0.5 * stress.zz, 1e-9 * std::abs(exact));
    }
}

}  // namespace
}  // namespace mudlark

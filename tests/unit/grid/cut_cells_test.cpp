// ranks: 1
#include "grid/cut_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "grid/cut_simplex.hpp"
#include "grid/halo.hpp"

namespace mudlark {
namespace {

template <int D>
Grid<D> unit_box(int cells, bool thin = false) {
  DomainOptions options;
  options.cells = {cells, D == 3 && !thin ? cells : D == 2 ? cells : 1, cells};
  options.upper = {1.0, D == 3 && thin ? 1.0 / cells : 1.0, 1.0};
  return Grid<D>(options, MPI_COMM_WORLD);
}

RigidPose turned(const Shape& shape, double angle, int dimension) {
  RigidPose pose(shape, {0.5, 0.5, 0.5}, dimension);
  if (dimension == 2) pose = RigidPose(shape, {0.5, 0.0, 0.5}, 2);
  pose.move({Eigen::Vector3d::Zero(), {0.0, -angle, 0.0}}, 1.0);
  return pose;
}

/// The unit box in `cells` and, upwards, `rows`.
template <int D>
Grid<D> flat_box(int cells, int rows) {
  DomainOptions options;
  options.cells = {cells, D == 3 ? cells : rows, rows};
  options.upper = {1.0, 1.0, 1.0};
  return Grid<D>(options, MPI_COMM_WORLD);
}

/// Closed volume, sum of the surface's normals, its size, and the volume by its middle heights.
struct Sums {
  double volume = 0.0, size = 0.0, from_surface = 0.0;
  std::array<double, 3> normal{};
};

template <int D>
Sums sums_of(const Grid<D>& grid, const CutCells<D>& cut) {
  Sums sums;
  for_each(grid.owned(), [&](const Index<D>& cell) {
    sums.volume += (1.0 - cut.volume()[cell]) * grid.cell_volume();
  });
  for (const CutCell<D>& one : cut.surface()) {
    sums.size += norm(one.area);
    sums.from_surface += one.middle[D - 1] * one.area[D - 1];
    for (int a = 0; a < D; ++a) sums.normal[static_cast<std::size_t>(a)] += one.area[a];
  }
  for (double* value : {&sums.volume, &sums.size, &sums.from_surface, &sums.normal[0],
                        &sums.normal[1], &sums.normal[2]})
    *value = sum_over_ranks(grid, *value);
  return sums;
}

template <int D>
Sums cut_out(const Grid<D>& grid, const RigidPose& pose) {
  CutCells<D> cut(grid);
  cut.find({pose});
  return sums_of(grid, cut);
}

template <int D>
Sums cut_out(const RigidPose& pose, int cells) {
  return cut_out<D>(unit_box<D>(cells), pose);
}

TEST(CutSimplex, ShareOfATetrahedronIsThatOfManySamples) {
  const std::array<double, 4> value{0.7, -0.4, 0.2, -0.9};
  const int n = 60;
  double inside = 0.0, all = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j)
      for (int k = 0; k < n - i - j; ++k) {
        const double a = (i + 0.25) / n, b = (j + 0.25) / n, c = (k + 0.25) / n;
        all += 1.0;
        if (value[0] * (1.0 - a - b - c) + value[1] * a + value[2] * b + value[3] * c > 0.0)
          inside += 1.0;
      }
  EXPECT_NEAR(positive_share(value), inside / all, 0.01);
  EXPECT_NEAR(positive_share(std::array{-0.7, 0.4, -0.2, 0.9}), 1.0 - positive_share(value), 1e-14);
}

TEST(CutCells, APlaneThroughCellsIsExact) {
  const Grid<2> grid = unit_box<2>(10);
  CutCells<2> cut(grid);
  // z < 0.23 + 0.4 x, all of its corners outside the domain.
  const Shape ground{BelowShape{{{-2.0, 0.23 - 0.8}, {3.0, 0.23 + 1.2}}}};
  cut.find({RigidPose(ground, {}, 2)});
  double worst = 0.0;
  for_each(grid.owned(), [&](const Index<2>& cell) {
    // Faces across x: the line's height at the face, clipped to the cell.
    const double x = 0.1 * cell[0], z = 0.1 * cell[1];
    const double open = std::clamp((z + 0.1 - (0.23 + 0.4 * x)) / 0.1, 0.0, 1.0);
    if (cut.volume()[cell] > 0.0 && cut.volume()[cell.shifted(0, -1)] > 0.0)
      worst = std::max(worst, std::abs(cut.aperture()[0][cell] - open));
  });
  EXPECT_LT(worst, 1e-12);
  double volume = 0.0;
  for_each(grid.owned(), [&](const Index<2>& cell) { volume += 0.01 * cut.volume()[cell]; });
  EXPECT_NEAR(sum_over_ranks(grid, volume), 1.0 - 0.43, 1e-12);
}

TEST(CutCells, ABoxOnTheGridLinesIsExactAndItsSurfaceLiesOnFaces) {
  const Grid<3> grid = unit_box<3>(8);
  CutCells<3> cut(grid);
  cut.find({RigidPose({BoxShape{{0.25, 0.25, 0.25}, {0.75, 0.625, 0.5}}}, {}, 3)});
  const Sums sums = sums_of(grid, cut);
  EXPECT_NEAR(sums.volume, 0.5 * 0.375 * 0.25, 1e-12);
  EXPECT_NEAR(sums.from_surface, sums.volume, 1e-12);
  for (const CutCell<3>& one : cut.surface()) EXPECT_EQ(cut.volume()[one.cell], 1.0);
}

/// Between grid lines, with its foot on the floor or a little below as with its foot far below;
/// also in cells that are much flatter than wide.
TEST(CutCells, ABoxThatStandsOnTheFloorHasNoSurfaceThere) {
  for (const int rows : {10, 40}) {
    const auto stand = [&](double foot) {
      const Grid<2> grid = flat_box<2>(10, rows);
      return cut_out<2>(grid, RigidPose({BoxShape{{0.27, -9.0, foot}, {0.78, 9.0, 0.5}}}, {}, 2));
    };
    const Sums below = stand(-0.7);
    for (const double foot : {0.0, -0.004}) {
      const Sums on = stand(foot);
      EXPECT_NEAR(std::abs(on.normal[1]), 0.51, 1e-12);
      EXPECT_NEAR(on.normal[0], 0.0, 1e-12);
      EXPECT_NEAR(on.volume, below.volume, 1e-12);
      EXPECT_NEAR(on.size, below.size, 1e-12);
    }
  }
}

/// Walls that stand upright or lean, round or flat, on the floor as with their foot far below.
TEST(CutCells, BodiesThatStandOnTheFloorAreThoseThatReachThroughIt) {
  const Grid<3> grid = flat_box<3>(8, 20);
  const auto expect_same = [&](const Shape& on, const Shape& below, double allowed) {
    const Sums one = cut_out<3>(grid, RigidPose(on, {}, 3));
    const Sums other = cut_out<3>(grid, RigidPose(below, {}, 3));
    EXPECT_NEAR(one.volume, other.volume, allowed * other.volume);
    EXPECT_NEAR(one.size, other.size, allowed * other.size);
    for (std::size_t a = 0; a < 3; ++a)
      EXPECT_NEAR(one.normal[a], other.normal[a], allowed * other.size);
  };
  const auto pier = [](double foot) {
    return Shape{CylinderShape{{0.5, 0.5, foot}, {0.5, 0.5, 0.61}, 0.23}};
  };
  expect_same(pier(0.0), pier(-1.0), 1e-12);
  const auto keel = [](double foot) {  // wider above, by 1:2
    PolygonShape shape;
    shape.corners = {
        {0.37 - 0.5 * foot, foot}, {0.64 + 0.5 * foot, foot}, {0.94, 0.6}, {0.07, 0.6}};
    return Shape{shape};
  };
  expect_same(keel(0.0), keel(-0.2), 1e-12);
}

TEST(CutCells, ATiltedBoxConvergesAtSecondOrderAndIsClosed) {
  const Shape box{BoxShape{{0.23, -9.0, 0.31}, {0.78, 9.0, 0.72}}};
  const auto error = [&](int cells) {
    double worst = 0.0;  // of several angles: where corners fall in a cell is chance
    for (const double angle : {0.3, 0.5, 0.9, 1.2}) {
      const Sums sums = cut_out<2>(turned(box, angle, 2), cells);
      for (const double component : sums.normal) EXPECT_NEAR(component, 0.0, 1e-12);
      worst = std::max(worst, std::abs(sums.volume - 0.55 * 0.41));
    }
    return worst;
  };
  const double coarse = error(20), fine = error(80);
  EXPECT_LT(coarse, 0.02 * 0.55 * 0.41);
  EXPECT_LT(fine, coarse / 10.0);
}

TEST(CutCells, ACircleAndASphereConvergeAtSecondOrder) {
  const Shape circle{SphereShape{{0.51, 0.0, 0.48}, 0.3, true}};
  const Shape ball{SphereShape{{0.51, 0.47, 0.48}, 0.3}};
  const double pi = std::numbers::pi;
  const auto flat = [&](int cells) {
    const Sums sums = cut_out<2>(RigidPose(circle, {}, 2), cells);
    EXPECT_NEAR(sums.size, 0.6 * pi, 0.6 * pi * 2.0 / cells / cells * 4.0);
    return std::abs(sums.volume - 0.09 * pi);
  };
  EXPECT_LT(flat(20), 0.005 * 0.09 * pi);
  EXPECT_LT(flat(80), flat(20) / 12.0);
  const auto solid = [&](int cells) {
    const Sums sums = cut_out<3>(RigidPose(ball, {}, 3), cells);
    for (const double component : sums.normal) EXPECT_NEAR(component, 0.0, 1e-12);
    EXPECT_NEAR(sums.from_surface, sums.volume, 0.01 * sums.volume);
    return std::abs(sums.volume - 0.036 * pi);
  };
  EXPECT_LT(solid(32), solid(8) / 12.0);
}

TEST(CutCells, OneCellThickInSpaceEqualsThePlane) {
  const Grid<3> thin = unit_box<3>(16, true);
  const Grid<2> flat = unit_box<2>(16);
  const double h = 1.0 / 16.0;
  CutCells<3> cut(thin);
  CutCells<2> plane(flat);
  cut.find({turned({BoxShape{{0.3, -1.0, 0.3}, {0.7, 2.0, 0.6}}}, 0.4, 3)});
  plane.find({turned({BoxShape{{0.3, -1.0, 0.3}, {0.7, 2.0, 0.6}}}, 0.4, 2)});
  const Sums space = sums_of(thin, cut), area = sums_of(flat, plane);
  EXPECT_NEAR(space.volume, area.volume * h, 1e-12);
  EXPECT_NEAR(space.from_surface, area.from_surface * h, 1e-12);
}

}  // namespace
}  // namespace mudlark

#include "grid/stretching.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "grid/space.hpp"

namespace mudlark {
namespace {

double largest_ratio(const std::vector<double>& faces) {
  double largest = 1.0;
  for (std::size_t i = 2; i < faces.size(); ++i) {
    const double a = faces[i] - faces[i - 1], b = faces[i - 1] - faces[i - 2];
    largest = std::max({largest, a / b, b / a});
  }
  return largest;
}

TEST(GradedFaces, AreThoseOfAUniformAxisWithoutRegions) {
  const auto faces = graded_faces(1.0, 3.0, 0.25, {});
  ASSERT_EQ(faces.size(), 9u);
  for (std::size_t i = 0; i < faces.size(); ++i)
    EXPECT_NEAR(faces[i], 1.0 + 0.25 * static_cast<double>(i), 1e-9);
}

TEST(GradedFaces, HaveTheWantedSizeInARegionAndGrowNoFasterThanAskedAway) {
  const auto faces =
      graded_faces(0.0, 20.0, 0.5, {{8.0, 10.0, 0.05, 1.1}, {14.0, 15.0, 0.1, 1.15}});
  EXPECT_EQ(faces.front(), 0.0);
  EXPECT_EQ(faces.back(), 20.0);
  for (const double end : {8.0, 10.0, 14.0, 15.0})
    EXPECT_TRUE(std::find(faces.begin(), faces.end(), end) != faces.end()) << end;
  for (std::size_t i = 1; i < faces.size(); ++i) {
    const double size = faces[i] - faces[i - 1];
    EXPECT_GT(size, 0.0);
    EXPECT_LE(size, 0.5 * (1.0 + 1e-9));
    const bool fine = faces[i - 1] >= 8.0 && faces[i] <= 10.0;
    EXPECT_NEAR(fine ? size : 0.05, 0.05, 1e-12);
  }
  EXPECT_LT(largest_ratio(faces), 1.16);
  const auto gentle = graded_faces(0.0, 20.0, 0.5, {{8.0, 10.0, 0.05, 1.1}});
  EXPECT_LT(largest_ratio(gentle), 1.105);
}

TEST(GradedFaces, GiveASlimRegionOneCell) {
  const auto faces = graded_faces(0.0, 1.0, 0.2, {{0.5, 0.51, 0.05, 1.2}});
  EXPECT_TRUE(std::find(faces.begin(), faces.end(), 0.51) != faces.end());
}

DomainOptions stretched_domain() {
  DomainOptions domain;
  domain.lower = {0.0, 0.0, 0.0};
  domain.upper = {4.0, 2.0, 0.0};
  domain.faces[0] = {0.0, 0.2, 0.5, 1.0, 2.0, 4.0};
  domain.cells = {5, 4, 1};
  return domain;
}

TEST(StretchedGrid, FindsCellsAndTheirSizesAndMirrorsThemBehindWalls) {
  const Grid<2> grid(stretched_domain(), MPI_COMM_SELF);
  EXPECT_TRUE(grid.stretched());
  EXPECT_TRUE(grid.stretched(0) && !grid.stretched(1));
  EXPECT_EQ(grid.cell_at(Vec<2>{{0.6, 0.6}}), (Index<2>{{2, 1}}));
  EXPECT_LT(grid.cell_at(Vec<2>{{-0.1, 0.6}})[0], 0);
  EXPECT_GE(grid.cell_at(Vec<2>{{4.1, 0.6}})[0], 5);
  EXPECT_DOUBLE_EQ(grid.width(0, 3), 1.0);
  EXPECT_DOUBLE_EQ(grid.gap(0, 3), 0.75);
  EXPECT_DOUBLE_EQ(grid.width(0, -1), 0.2);
  EXPECT_DOUBLE_EQ(grid.width(0, 5), 2.0);
  EXPECT_DOUBLE_EQ(grid.width(0, 6), 1.0);
  EXPECT_DOUBLE_EQ(grid.cell_centre(Index<2>{{4, 0}})[0], 3.0);
  EXPECT_DOUBLE_EQ(grid.face_centre(0, Index<2>{{5, 0}})[0], 4.0);
  EXPECT_DOUBLE_EQ(grid.smallest_spacing(), 0.2);
  EXPECT_EQ(grid.index_along(0, static_cast<std::ptrdiff_t>(grid.offset(Index<2>{{3, 2}}))), 3);
  EXPECT_EQ(grid.index_along(1, static_cast<std::ptrdiff_t>(grid.offset(Index<2>{{3, 2}}))), 2);
}

TEST(StretchedGrid, GivesCellsAndFacesTheirSharesOfTheMeanOnes) {
  const Grid<2> grid(stretched_domain(), MPI_COMM_SELF);
  const Space<2> space(grid);
  EXPECT_DOUBLE_EQ(space.volume[(Index<2>{{4, 1}})], 2.0 / 0.8);
  EXPECT_DOUBLE_EQ(space.aperture[0][(Index<2>{{4, 1}})], 1.0);
  EXPECT_DOUBLE_EQ(space.aperture[1][(Index<2>{{4, 1}})], 2.0 / 0.8);
  double all = 0.0;
  for_each(grid.owned(), [&](const Index<2>& cell) { all += space.volume[cell]; });
  EXPECT_NEAR(all * grid.cell_volume(), 8.0, 1e-12);
}

}  // namespace
}  // namespace mudlark

// ranks: 1 3 4
#include "grid/grid.hpp"

#include <gtest/gtest.h>

#include "grid/field.hpp"
#include "grid/halo.hpp"

namespace mudlark {
namespace {

DomainOptions tank() {
  DomainOptions options;
  options.lower = {-1.0, 2.0, 0.5};
  options.upper = {3.0, 5.0, 2.5};
  options.cells = {16, 12, 20};
  options.gravity = {0.0, 0.0, -9.81};
  return options;
}

TEST(Grid, MeasuresItsCellsAndCornersFromTheDomain) {
  const Grid<3> grid(tank(), MPI_COMM_WORLD);
  EXPECT_EQ(grid.spacing(), (Vec<3>{{0.25, 0.25, 0.1}}));
  EXPECT_DOUBLE_EQ(grid.cell_volume(), 0.25 * 0.25 * 0.1);
  EXPECT_DOUBLE_EQ(grid.smallest_spacing(), 0.1);
  for (int a = 0; a < 3; ++a)
    EXPECT_DOUBLE_EQ(grid.upper()[a], tank().upper[static_cast<std::size_t>(a)]);
}

TEST(Grid, PlacesFaceCOnTheLowerSideOfCellC) {
  const Grid<3> grid(tank(), MPI_COMM_WORLD);
  const Index<3> cell{{3, 0, 19}};
  const Vec<3> centre = grid.cell_centre(cell);
  EXPECT_DOUBLE_EQ(centre[0], -1.0 + 3.5 * 0.25);
  for (int a = 0; a < 3; ++a) {
    Vec<3> expected = centre;
    expected[a] -= 0.5 * grid.spacing()[a];
    for (int b = 0; b < 3; ++b)
      EXPECT_NEAR(grid.face_centre(a, cell)[b], expected[b], 1e-14) << a << " " << b;
  }
}

TEST(Grid, FindsTheCellOfAPositionInsideAndOutsideTheDomain) {
  const Grid<3> grid(tank(), MPI_COMM_WORLD);
  for_each(grid.owned(),
           [&](const Index<3>& cell) { ASSERT_EQ(grid.cell_at(grid.cell_centre(cell)), cell); });
  EXPECT_EQ(grid.cell_at({{-1.001, 2.1, 2.6}}), (Index<3>{{-1, 0, 21}}));
}

template <int D>
void expect_every_face_has_one_owner(const DomainOptions& options) {
  const Grid<D> grid(options, MPI_COMM_WORLD);
  for (int a = 0; a < D; ++a) {
    const IndexBox<D> faces = grid.global().extended(a, grid.periodic(a) ? 0 : 1);
    double all = 1.0;
    for (int b = 0; b < D; ++b) all *= faces.upper[b];
    double mine = 0.0;
    for_each(grid.owned_faces(a), [&](const Index<D>& face) { mine += faces.contains(face); });
    EXPECT_EQ(sum_over_ranks(grid, mine), all) << "axis " << a;
  }
}

TEST(Grid, OwnsEveryFaceOnceWithTheClosingFaceOfAWalledAxis) {
  DomainOptions options = tank();
  expect_every_face_has_one_owner<2>(options);
  expect_every_face_has_one_owner<3>(options);
  options.walls[1] = {Wall::periodic, Wall::periodic};
  expect_every_face_has_one_owner<2>(options);
  expect_every_face_has_one_owner<3>(options);
}

TEST(Grid, AndItsFieldsAgreeOnThePlaceOfEveryIndex) {
  const Grid<3> grid(tank(), MPI_COMM_WORLD);
  const CellField<3> field(grid, "number", "1");
  std::ptrdiff_t next = 0;
  for_each(grid.local(), [&](const Index<3>& index) {
    ASSERT_EQ(grid.offset(index), next);
    ASSERT_EQ(field.offset(index), static_cast<std::size_t>(next));
    ++next;
  });
  EXPECT_EQ(field.size(), static_cast<std::size_t>(next));
}

TEST(Reductions, ReachOverAllRanks) {
  const Grid<2> grid(tank(), MPI_COMM_WORLD);
  const double n = grid.ranks();
  EXPECT_EQ(sum_over_ranks(grid, grid.rank() + 1.0), n * (n + 1.0) / 2.0);
  EXPECT_EQ(max_over_ranks(grid, grid.rank()), n - 1.0);
  EXPECT_EQ(min_over_ranks(grid, grid.rank() - 5.0), -5.0);
}

TEST(Field, CopiesOnlyWhenAskedAndKeepsNameAndUnit) {
  const Grid<2> grid(tank(), MPI_COMM_WORLD);
  CellField<2> pressure(grid, "pressure", "Pa", 7.0);
  CellField<2> copy = pressure.copy();
  const Index<2> cell = grid.owned().lower;
  copy[cell] = 9.0;
  EXPECT_EQ(pressure[cell], 7.0);
  EXPECT_EQ(copy.name(), "pressure");
  EXPECT_EQ(copy.unit(), "Pa");
  pressure.swap(copy);
  EXPECT_EQ(pressure[cell], 9.0);
}

}  // namespace
}  // namespace mudlark

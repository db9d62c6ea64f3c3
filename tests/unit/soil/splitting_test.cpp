// ranks: 1 3 4
// Splitting keeps every sum, and does the same on any number of ranks.
#include "soil/splitting.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "soil/redistribute.hpp"
#include "soil/seeding.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using soil_runs::make_grid;
using soil_runs::noise;

constexpr double h = 0.1;

template <int D>
Grid<D> grid_on(MPI_Comm comm) {
  return make_grid<D>({16, D == 2 ? 12 : 5, 9}, h, D == 2 ? "ppss" : "ppssss", 0.0, comm);
}

/// Points of a body that fills the domain, with values of their own.
template <int D>
SoilParticles<D> uneven_points(const Grid<D>& grid) {
  SoilOptions options = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 9}, true);
  SoilBody& body = options.bodies[0];
  MohrCoulombOptions law{1e7, 0.3, 1e3, 0.5, 0.0};
  law.residual = MohrCoulombOptions::Residual{};
  body.law = law;
  SoilParticles<D> points = seed_points(grid, body, 0, Transfer::apic, true);
  for (std::size_t p = 0; p < points.size(); ++p) {
    int k = 0;
    for (int c = 0; c < 6; ++c) points.stress[c][p] = 1e3 * noise(points.id[p], ++k);
    for (int a = 0; a < D; ++a) {
      points.velocity[a][p] = noise(points.id[p], ++k);
      points.water_velocity[a][p] = noise(points.id[p], ++k);
    }
    for (int c = 0; c < D * D; ++c) points.affine[c][p] = noise(points.id[p], ++k);
    points.history[0][p] = noise(points.id[p], ++k);
    points.pore_pressure[p] = 1e3 * noise(points.id[p], ++k);
  }
  return points;
}

/// Stretches all points by a turned gradient, some more than others.
template <int D>
void stretch(SoilParticles<D>& points, double by) {
  std::vector<double> gradient(points.size() * D * D);
  const double c = std::cos(0.6), s = std::sin(0.6);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double more = by * (1.0 + 0.5 * noise(points.id[p], 99));
    const auto set = [&](int i, int j, double value) {
      gradient[static_cast<std::size_t>(i * D + j) * points.size() + p] = value;
    };
    set(0, 0, more * c * c), set(0, D - 1, more * c * s);
    set(D - 1, 0, more * c * s), set(D - 1, D - 1, more * s * s);
  }
  follow_extent(gradient, {0, points.size()}, points);
}

/// Everything that must not change, over all ranks.
template <int D>
std::vector<double> sums_of(const Grid<D>& grid, const SoilParticles<D>& points) {
  std::vector<double> mine(40, 0.0), all(40, 0.0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double m = points.grain_mass[p], v = points.volume[p];
    std::size_t k = 0;
    mine[k++] += m, mine[k++] += v, mine[k++] += points.start_volume[p];
    for (int a = 0; a < D; ++a) mine[k++] += m * points.velocity[a][p];
    for (int a = 1; a < D; ++a) mine[k++] += m * points.position[a][p];  // axis 0 is periodic
    for (int c = 0; c < 6; ++c) mine[k++] += v * points.stress[c][p];
    for (int c = 0; c < D * D; ++c) mine[k++] += m * points.affine[c][p];
    mine[k++] += m * points.history[0][p], mine[k++] += v * points.pore_pressure[p];
    if constexpr (D == 3)  // about x; about y the periodic seam gets in the way
      mine[k++] += m * (points.position[1][p] * points.velocity[2][p] -
                        points.position[2][p] * points.velocity[1][p]);
    for (int a = 0; a < D; ++a) mine[k++] += m * points.velocity[a][p] * points.velocity[a][p];
  }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM,
                grid.comm());
  return all;
}

template <int D>
void expect_kept_sums() {
  const Grid<D> grid = grid_on<D>(MPI_COMM_WORLD);
  SoilParticles<D> points = uneven_points(grid);
  const auto count = [&] {
    long long mine = static_cast<long long>(points.size()), all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_LONG_LONG, MPI_SUM, grid.comm());
    return all;
  };
  const long long before = count();
  stretch(points, 3.0);  // lengths of 1.25 to 2.75 cells
  const std::vector<double> old = sums_of(grid, points);
  EXPECT_EQ(split_stretched(grid, {1.5, 100}, points), 0.0);
  EXPECT_GT(count(), before + before / 2);
  EXPECT_LT(count(), 2 * before);
  const std::vector<double> now = sums_of(grid, points);
  for (std::size_t k = 0; k < old.size(); ++k)
    EXPECT_NEAR(now[k], old[k], 1e-12 * (std::abs(old[k]) + std::abs(old[0]))) << k;
  const SoilParticles<D> once = points;
  split_stretched(grid, {1.5, 100}, points);
  EXPECT_EQ(points.id, once.id) << "nothing is left to split";
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_TRUE(grid.owned().contains(grid.cell_at(points.position_of(p))));
}

TEST(Splitting, KeepsMassMomentumStressAndTheRestIn2D) { expect_kept_sums<2>(); }
TEST(Splitting, KeepsMassMomentumStressAndTheRestIn3D) { expect_kept_sums<3>(); }

/// Halves lie a quarter of the old length away, along it, and are half as long.
TEST(Splitting, PutsTheHalvesSideBySideAlongTheLongestDirection) {
  const Grid<2> grid = make_grid<2>({20, 20, 1}, h, "ssss");
  SoilParticles<2> points;
  points.carries_extent = true;
  points.resize(1);
  points.id[0] = 64;
  points.position[0][0] = 1.0, points.position[1][0] = 1.0;
  points.grain_mass[0] = 4.0, points.volume[0] = points.start_volume[0] = 0.01;
  set_extent(grid, 2, 0, points);
  const double c = std::cos(0.3), s = std::sin(0.3), grow = 3.0;
  follow_extent(std::vector<double>{grow * c * c, grow * c * s, grow * c * s, grow * s * s}, {0, 1},
                points);
  split_stretched(grid, {1.1, 100}, points);
  ASSERT_EQ(points.size(), 2u);
  const double quarter = 0.25 * 4.0 * 0.5 * h;
  for (const std::size_t p : {0u, 1u}) {
    const double side = points.position[0][p] > 1.0 ? 1.0 : -1.0;
    EXPECT_NEAR(points.position[0][p], 1.0 + side * quarter * c, 1e-14);
    EXPECT_NEAR(points.position[1][p], 1.0 + side * quarter * s, 1e-14);
    EXPECT_EQ(points.grain_mass[p], 2.0);
    const double along = points.extent[0][p] * c * c + 2.0 * points.extent[2][p] * c * s +
                         points.extent[1][p] * s * s;
    EXPECT_NEAR(std::sqrt(along), h, 1e-14);
    EXPECT_NEAR(std::sqrt(points.extent[0][p] + points.extent[1][p] - along), 0.5 * h, 1e-14);
  }
  EXPECT_NE(points.id[0], points.id[1]);
}

/// Simple shear and a turn: A = F diag(l^2) F^T.
TEST(Splitting, FollowsTheExtentThroughShearAndTurns) {
  const Grid<3> grid = make_grid<3>({4, 4, 4}, h, "ssssss");
  SoilParticles<3> points;
  points.carries_extent = true;
  points.resize(1);
  set_extent(grid, 2, 0, points);
  const double shear = 2.0, angle = 0.5 * std::numbers::pi;
  std::vector<double> gradient(9, 0.0);
  gradient[2] = shear;  // dv_x/dz
  follow_extent(gradient, {0, 1}, points);
  gradient.assign(9, 0.0);
  gradient[0] = gradient[4] = std::cos(angle) - 1.0;  // about z
  gradient[1] = -std::sin(angle), gradient[3] = std::sin(angle);
  follow_extent(gradient, {0, 1}, points);
  const double own = 0.25 * h * h;
  EXPECT_NEAR(points.extent[0][0], own, 1e-15);                          // xx, was yy
  EXPECT_NEAR(points.extent[1][0], own * (1.0 + shear * shear), 1e-15);  // yy, was xx
  EXPECT_NEAR(points.extent[2][0], own, 1e-15);
  EXPECT_NEAR(points.extent[4][0], own * shear, 1e-15);  // yz, was zx
  EXPECT_NEAR(points.extent[3][0], 0.0, 1e-15);
  EXPECT_NEAR(points.extent[5][0], 0.0, 1e-15);
}

/// Ids, places and values on these ranks are those on one.
TEST(Splitting, IsTheSameOnAnyNumberOfRanksAndGivesEveryPointItsOwnId) {
  const auto split = [](MPI_Comm comm) {
    const Grid<2> grid = grid_on<2>(comm);
    SoilParticles<2> points = uneven_points(grid);
    for (int i = 0; i < 4; ++i) {
      stretch(points, 0.8);
      split_stretched(grid, {1.2, 12}, points);  // some cells are full
    }
    return points;
  };
  const SoilParticles<2> alone = split(MPI_COMM_SELF), mine = split(MPI_COMM_WORLD);
  std::map<std::int64_t, std::size_t> place;
  for (std::size_t p = 0; p < alone.size(); ++p) place[alone.id[p]] = p;
  EXPECT_EQ(place.size(), alone.size());
  int count = static_cast<int>(mine.size()), all = 0;
  MPI_Allreduce(&count, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(all, static_cast<int>(alone.size()));
  EXPECT_GT(alone.size(), 3u * 16u * 12u * 4u);
  for (std::size_t p = 0; p < mine.size(); ++p) {
    ASSERT_TRUE(place.contains(mine.id[p]));
    const std::size_t q = place[mine.id[p]];
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(mine.position[a][p], alone.position[a][q], 1e-13);
    EXPECT_EQ(mine.grain_mass[p], alone.grain_mass[q]);
  }
}

TEST(Splitting, KeepsHalvesInsideClosedWalls) {
  const Grid<2> grid = make_grid<2>({4, 4, 1}, h, "ssss");
  SoilParticles<2> points;
  points.carries_extent = true;
  points.resize(1);
  points.position[0][0] = 0.02, points.position[1][0] = 0.2;
  points.grain_mass[0] = points.volume[0] = points.start_volume[0] = 1.0;
  set_extent(grid, 1, 0, points);
  follow_extent(std::vector<double>{2.0, 0.0, 0.0, 0.0}, {0, 1}, points);
  split_stretched(grid, {2.0, 100}, points);
  ASSERT_EQ(points.size(), 2u);
  for (const std::size_t p : {0u, 1u}) EXPECT_GT(points.position[0][p], 0.0);
  EXPECT_NEAR(points.position[0][0] + points.position[0][1], 0.04, 1e-15);
}

}  // namespace
}  // namespace mudlark

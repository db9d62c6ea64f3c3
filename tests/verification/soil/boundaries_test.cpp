// ranks: 1 3
// Grains at the sides of the domain, explicit steps: sides that move, absorb, hold in part.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

SoilBoundary grain_side(int axis, int side, GrainSide kind) {
  SoilBoundary boundary;
  boundary.name = std::to_string(axis) + std::to_string(side);
  boundary.axis = axis, boundary.side = side;
  boundary.for_grains = true;
  boundary.grains = kind;
  return boundary;
}

constexpr double young = 1e7, density = 0.6 * 2650.0;
constexpr double size = 1e-4;  ///< of the pushes [m]

/// Dry elastic soil without lateral contraction that fills the domain.
SoilOptions filled(int dimension) {
  SoilOptions options = make_soil(dimension, {-9, -9, -9}, {99, 9, 99}, false);
  options.bodies[0].law = LinearElasticOptions{young, 0.0};
  options.flip_fraction = 1.0;
  return options;
}

/// Smooth push: displacement that goes from 0 to `way` within `rise`.
Varying push(double way, double rise) {
  return Varying(
      [=](const Point3&, double t) {
        const double s = std::clamp(t / rise, 0.0, 1.0);
        return way * (s - std::sin(2.0 * std::numbers::pi * s) / (2.0 * std::numbers::pi));
      },
      "push");
}
double pushed_velocity(double rise, double t) {
  if (t < 0.0 || t > rise) return 0.0;
  return size / rise * (1.0 - std::cos(2.0 * std::numbers::pi * t / rise));
}

/// Largest difference of the velocities along an axis from a wave that a side at x = 0 sends.
template <int D>
double wave_error(const SoilSolver<D>& soil, int component, double rise, double speed,
                  double time) {
  double worst = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double exact = pushed_velocity(rise, time - points.position[0][p] / speed);
    worst = std::max(worst, std::abs(points.velocity[component][p] - exact));
  }
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return worst / (2.0 * size / rise);
}

/// Length of the pulses [m]: some 50 cells, so that the lumped masses hardly disperse them.
constexpr double pulse = 1.25;
double speed_of(int component) {
  return std::sqrt((component == 0 ? young : young / 2.0) / density);
}

/// A bar along x, 3 cells thick, whose lower side is pushed along a component.
template <int D>
SoilOptions pushed_bar(int component, bool velocity, const std::vector<SoilBoundary>& others) {
  SoilOptions options = filled(D);
  SoilBoundary side = grain_side(0, 0, GrainSide::moving);
  const auto u = static_cast<std::size_t>(component == D - 1 ? 2 : component);
  const double rise = pulse / speed_of(component);
  side.motion_is_displacement = !velocity;
  side.motion[u] =
      velocity
          ? Varying([=](const Point3&, double t) { return pushed_velocity(rise, t); }, "velocity")
          : push(size, rise);
  options.boundaries = others;
  options.boundaries.push_back(side);
  return options;
}
template <int D>
Grid<D> bar_grid(int cells) {
  return make_grid<D>({cells, 3, 3}, 2.0 / cells, D == 2 ? "sspp" : "sspppp", 0.0, MPI_COMM_WORLD);
}
template <int D>
void run_until(SoilSolver<D>& soil, double end, double courant = 0.4) {
  const int steps = static_cast<int>(std::ceil(end / (2.0 * courant * soil.stable_step())));
  double time = 0.0;
  run(soil, time, steps, end / steps);
}

// A side that is pushed sends the wave v(t - x/c), compression (c_p) or shear (c_s).
template <int D>
void expect_wave(int cells, int component, bool velocity, double tolerance) {
  const Grid<D> grid = bar_grid<D>(cells);
  SoilSolver<D> soil(grid, pushed_bar<D>(component, velocity, {}));
  soil.initialise();
  const double speed = speed_of(component), end = 1.5 / speed;
  run_until(soil, end);
  const double error = wave_error(soil, component, pulse / speed, speed, end);
  std::printf("%dD, component %d, %s: off by %.2f %% of the largest velocity\n", D, component,
              velocity ? "velocity" : "displacement", 100.0 * error);
  EXPECT_LT(error, tolerance);
}

TEST(MovingSide, SendsWavesOfCompressionAndShear) {
  expect_wave<2>(80, 0, false, 0.04);
  expect_wave<2>(80, 0, true, 0.04);
  expect_wave<2>(80, 1, false, 0.04);
  expect_wave<3>(30, 0, true, 0.25);  // coarse: the same to round-off, see below
}

// The other end of a bar is fixed: in the end the strain is uniform.
TEST(MovingSide, CompressesABarUniformly) {
  const Grid<2> grid = make_grid<2>({20, 3, 1}, 0.05, "sspp", 0.0, MPI_COMM_WORLD);
  SoilOptions options = filled(2);
  options.damping = 0.3;
  SoilBoundary side = grain_side(0, 1, GrainSide::moving);
  side.motion_is_displacement = true;
  side.motion[0] = push(-0.001, 0.05);  // a fiftieth of a cell
  options.boundaries.push_back(side);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  run_until(soil, 0.3);
  const auto& points = soil.points(0);
  const double stretch = 0.999, stress = young * std::log(stretch) / stretch;  // Kirchhoff over J
  double worst = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points.start[0][p] < 0.8)  // points beside the side keep a few percent of the way there
      worst = std::max(worst, std::abs(points.stress[0][p] / stress - 1.0));
    EXPECT_NEAR(points.stress[0][p], stress, -0.05 * stress);
    EXPECT_NEAR(points.position[0][p], stretch * points.start[0][p], 3e-6);
  }
  std::printf("stress off by %.3f %%\n", 100.0 * worst);
  EXPECT_LT(worst, 0.003);
  const SoilEnergy energy = soil.energy();
  const double exact = 0.5 * young * 1e-6 * 0.15;
  EXPECT_NEAR(energy.internal, exact, 0.01 * exact);
  EXPECT_NEAR(energy.external - energy.damping, exact, 0.01 * exact);
}

/// Share of a pulse's velocity that comes back from an absorbing far side.
template <int D>
double reflection(int cells, int component) {
  const Grid<D> grid = bar_grid<D>(cells);
  SoilSolver<D> soil(grid,
                     pushed_bar<D>(component, false, {grain_side(0, 1, GrainSide::absorbing)}));
  soil.initialise();
  const double speed = speed_of(component);
  run_until(soil, 3.4 / speed);  // it has left, or is on its way back
  double worst = 0.0;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p)
    worst = std::max(worst, std::abs(points.velocity[component][p]));
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return worst / (2.0 * size * speed / pulse);
}

TEST(AbsorbingSide, SwallowsPulsesOfCompressionAndShear) {
  const double compression = reflection<2>(80, 0), shear = reflection<2>(80, 1);
  std::printf("%.2f %% of compression and %.2f %% of shear come back\n", 100.0 * compression,
              100.0 * shear);
  EXPECT_LT(compression, 0.03);
  EXPECT_LT(shear, 0.03);
  EXPECT_NEAR(reflection<3>(30, 0), reflection<2>(30, 0), 1e-6);
  EXPECT_NEAR(reflection<3>(30, 1), reflection<2>(30, 1), 1e-6);
}

// Springs of 1 m of soil behind a bar of 2 m that is pushed by 1 mm: strain 1 mm / 3 m.
TEST(AbsorbingSide, SpringsStandForTheSoilBehind) {
  const Grid<2> grid = bar_grid<2>(20);
  SoilBoundary side = grain_side(0, 1, GrainSide::absorbing);
  side.absorber.thickness = 1.0;
  SoilSolver<2> soil(grid, pushed_bar<2>(0, false, {side}));
  soil.initialise();
  run_until(soil, 30.0 / speed_of(0));
  const auto& points = soil.points(0);
  const double exact = -young * size / 3.0;
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_NEAR(points.stress[0][p], exact,
                (points.start[0][p] < 1.7 ? 0.005 : 0.1) * std::abs(exact));
}

/// Wet soil under its own weight between sides of which some absorb.
template <int D>
SoilOptions resting() {
  SoilOptions options = make_soil(D, {-9, -9, -9}, {9, 9, 0.6}, true);
  options.bodies[0].initial_stress = GeostaticStress{};
  options.bodies[0].law = LinearElasticOptions{young, 0.3};
  options.boundaries.push_back(grain_side(0, 0, GrainSide::absorbing));
  options.boundaries.push_back(grain_side(0, 1, GrainSide::absorbing));
  options.boundaries.push_back(grain_side(D - 1, 0, GrainSide::absorbing));
  return options;
}
template <int D>
double disturbance(bool absorbing) {
  const Grid<D> grid =
      make_grid<D>({9, D == 2 ? 9 : 3, 9}, 0.1, D == 2 ? "ssso" : "ssssso", 9.81, MPI_COMM_WORLD);
  SoilOptions options = resting<D>();
  if (!absorbing) options.boundaries.clear();
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  run_until(soil, 0.05);
  double worst = 0.0;
  for (const double v : soil.points(0).velocity[D - 1]) worst = std::max(worst, std::abs(v));
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return worst;
}

// What rests between walls rests between absorbing sides.
TEST(AbsorbingSide, HoldsSoilUnderItsWeight) {
  EXPECT_LT(disturbance<2>(true), 1.5 * disturbance<2>(false) + 1e-9);
  EXPECT_LT(disturbance<3>(true), 1.5 * disturbance<3>(false) + 1e-9);
}

/// Positions of all points on this rank after soil slid over a floor for a while.
std::vector<double> slide(const char* walls, Wall floor, double friction,
                          const std::vector<SoilBoundary>& boundaries) {
  DomainOptions domain;
  domain.cells = {9, 6, 1};
  domain.upper = {0.9, 0.6, 0.0};
  domain.walls[0] = {Wall::slip, Wall::slip};
  if (walls[0] == 'p') domain.walls[0] = {Wall::periodic, Wall::periodic};
  domain.walls[1] = {floor, Wall::open};
  domain.wall_friction[1][0] = friction;
  domain.gravity = {4.0, -9.81, 0.0};
  const Grid<2> grid(domain, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {-9, -9, -9}, {9, 9, 0.4}, true);
  options.boundaries = boundaries;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  run_until(soil, 0.04);
  std::vector<double> positions;
  for (int a = 0; a < 2; ++a)
    positions.insert(positions.end(), soil.points(0).position[a].begin(),
                     soil.points(0).position[a].end());
  return positions;
}

// A boundary that covers a side is that side, and so are two that cover a half each.
TEST(PartOfASide, HoldsAsAWholeSideDoes) {
  for (const GrainSide kind : {GrainSide::fixed, GrainSide::friction, GrainSide::slip}) {
    SoilBoundary whole = grain_side(1, 0, kind);
    whole.friction = 0.3;
    SoilBoundary left = whole, right = whole;
    left.to[0] = right.from[0] = 0.4;
    const Wall wall = kind == GrainSide::fixed      ? Wall::no_slip
                      : kind == GrainSide::friction ? Wall::friction
                                                    : Wall::slip;
    const auto expected = slide("p", wall, 0.3, {});
    EXPECT_EQ(slide("p", Wall::open, 0.0, {whole}), expected);
    EXPECT_EQ(slide("p", Wall::open, 0.0, {left, right}), expected);
  }
}

// Soil leaves through the open part of a floor only.
TEST(PartOfASide, LetsGrainsOutWhereItIsOpen) {
  SoilBoundary hole = grain_side(1, 0, GrainSide::open);
  hole.from[0] = 0.3, hole.to[0] = 0.6;
  DomainOptions domain;
  domain.cells = {9, 9, 1};
  domain.upper = {0.9, 0.9, 0.0};
  domain.gravity = {0.0, -9.81, 0.0};
  const Grid<2> grid(domain, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {-9, -9, -9}, {9, 9, 0.4}, false);
  options.boundaries.push_back(hole);
  MohrCoulombOptions sand;
  sand.young_modulus = 1e6, sand.poisson_ratio = 0.3, sand.friction_angle = 0.5;
  options.bodies[0].law = sand;
  options.bodies[0].strain = StrainMeasure::jaumann;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double before = soil.totals().grain_mass;
  run_until(soil, 0.3);
  const auto totals = soil.totals();
  EXPECT_GT(totals.removed_grain_mass, 0.02 * before);
  EXPECT_NEAR(totals.removed_grain_mass + totals.grain_mass, before, 1e-12 * before);
  for (const double z : soil.points(0).position[1]) EXPECT_GT(z, -0.1);
}

}  // namespace
}  // namespace mudlark

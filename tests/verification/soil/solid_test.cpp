// ranks: 1 3
/// Rigid bodies in contact with soil: exact forces and motions.
#include "grid/solid.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

constexpr double infinity = std::numeric_limits<double>::infinity();

SolidOptions make_solid(const Shape& shape) {
  SolidOptions solid;
  solid.name = "body";
  solid.shape = shape;
  return solid;
}

Varying of_time(std::function<double(double)> f) {
  return Varying([f](const Point3&, double t) { return f(t); }, "f(t)");
}

// A plate that is pushed slowly into a confined elastic column: force = modulus times strain.
TEST(Solid, PressesAConfinedColumnWithItsModulusTimesTheStrain) {
  for (const double top : {1.0, 0.975}) {  // at faces of the grid, and between them
    const Grid<2> grid = make_grid<2>({4, 24, 1}, 0.05, "sssn", 0.0, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, top}, false);
    options.damping = 0.5;
    SolidOptions plate = make_solid({BoxShape{{-1, -infinity, top}, {2, infinity, 1.2}}});
    const double strain = 0.01;
    PrescribedSolid motion;
    motion.by_displacement = true;
    motion.translation[2] =
        of_time([&](double t) { return -strain * top * std::min(1.0, t / 0.4); });
    plate.motion = motion;
    options.solids.push_back(plate);
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    const double dt = soil.stable_step();
    double time = 0.0;
    run(soil, time, static_cast<int>(std::ceil(0.8 / dt)), dt);
    const Solid& body = soil.solids()[0];
    const double modulus = constrained_modulus(1e6, 0.3);
    const double exact = -modulus * std::log(1.0 - strain) / (1.0 - strain) * 0.2;
    std::printf("plate at %g: displacement %.6g, force %.6g, exact %.6g (%+.2f %%), moment %.3g\n",
                top, body.displacement()[2], body.force()[2], exact,
                100 * (body.force()[2] / exact - 1), body.moment()[1]);
    EXPECT_NEAR(body.displacement()[2], -strain * top, 1e-12);
    EXPECT_NEAR(body.force()[2], exact, 0.03 * exact);
    EXPECT_NEAR(body.force()[0], 0.0, 1e-9 * exact);
  }
}

// A block on tilted soil: it sticks below the angle of friction, and slides with g (sin a - mu cos
// a) above it.
/// A block on a slope of 25 degrees; `shaken`: on level ground in a frame with the acceleration
/// that is g sin 25 degrees along and what g cos lacks upwards.
void slide(double friction, bool shaken) {
  {
    DomainOptions domain;
    domain.dimension = 2;
    domain.cells = {80, 8, 1};
    domain.upper = {4.0, 0.4, 0.0};
    domain.walls = {{{Wall::slip, Wall::slip}, {Wall::no_slip, Wall::open}, {}}};
    const double angle = 25.0 / 180.0 * std::numbers::pi, g = 9.81;
    domain.gravity = {g * std::sin(angle), -g * std::cos(angle), 0.0};
    if (shaken) domain.gravity = {0.0, -g, 0.0};
    const Grid<2> grid(domain, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {0, -1, 0}, {4, 1, 0.1}, false);
    if (shaken)
      options.body_acceleration = {Varying(g * std::sin(angle)), Varying(0.0),
                                   Varying(g - g * std::cos(angle))};
    options.bodies[0].law = LinearElasticOptions{1e7, 0.3};
    SolidOptions block = make_solid({BoxShape{{0.5, -infinity, 0.1}, {1.1, infinity, 0.3}}});
    FreeSolid motion;
    motion.density = 2000.0;
    if (shaken) motion.acceleration = *options.body_acceleration;
    block.motion = motion;
    block.friction = friction;
    options.solids.push_back(block);
    options.damping = 0.5;
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    const double dt = soil.stable_step();
    double time = 0.0;
    run(soil, time, static_cast<int>(std::ceil(0.2 / dt)), dt);
    const Solid& body = soil.solids()[0];
    const double before = body.velocity()[0], begin = time;
    const double weight = body.mass() * g * std::cos(angle);
    double pressed = 0.0;
    int count = 0;
    for (; time < begin + 0.3; ++count, pressed += body.force()[2]) run(soil, time, 50, dt);
    const double exact = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
    const double found = (body.velocity()[0] - before) / (time - begin);
    std::printf(
        "friction %g: acceleration %.5f m/s2, exact %.5f; way %.2e m; force / weight %.5f, turn "
        "%.1e\n",
        friction, found, exact, body.displacement()[0], pressed / count / weight,
        body.rotation()[1]);
    EXPECT_NEAR(found, exact, 2e-3 * g);
    EXPECT_NEAR(pressed / count, weight, 1e-2 * weight);
  }
}

TEST(Solid, SlidesDownASlopeWithCoulombsFriction) {
  for (const double friction : {0.0, 0.3, 0.6, infinity}) slide(friction, false);
}

// What shakes the soil shakes the bodies on it.
TEST(Solid, SlidesInAnAcceleratedFrameAsOnASlope) {
  for (const double friction : {0.3, 0.6}) slide(friction, true);
}

// A rough disc rolls: two thirds of the acceleration of one that slides.
TEST(Solid, RollsDownASlopeAsADisc) {
  DomainOptions domain;
  domain.dimension = 2;
  domain.cells = {80, 20, 1};
  domain.upper = {4.0, 1.0, 0.0};
  domain.walls = {{{Wall::slip, Wall::slip}, {Wall::no_slip, Wall::open}, {}}};
  const double angle = 20.0 / 180.0 * std::numbers::pi, g = 9.81;
  domain.gravity = {g * std::sin(angle), -g * std::cos(angle), 0.0};
  const Grid<2> grid(domain, MPI_COMM_WORLD);
  SoilOptions options = make_soil(2, {0, -1, 0}, {4, 1, 0.1}, false);
  options.bodies[0].law = LinearElasticOptions{2e7, 0.3};
  options.bodies[0].points_per_cell = 9;
  options.damping = 0.3;
  SolidOptions disc = make_solid({SphereShape{{0.8, 0.0, 0.5}, 0.4, true}});
  FreeSolid motion;
  motion.density = 500.0;
  disc.motion = motion;
  disc.friction = infinity;
  options.solids.push_back(disc);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const double dt = soil.stable_step();
  double time = 0.0;
  run(soil, time, static_cast<int>(std::ceil(0.1 / dt)), dt);
  const Solid& body = soil.solids()[0];
  const double before = body.velocity()[0], begin = time;
  run(soil, time, static_cast<int>(std::ceil(0.4 / dt)), dt);
  const double found = (body.velocity()[0] - before) / (time - begin);
  const double exact = 2.0 / 3.0 * g * std::sin(angle);
  std::printf("disc: acceleration %.4f m/s2, exact %.4f; way %.4f m, turned way %.4f m\n", found,
              exact, body.displacement()[0], 0.4 * body.rotation()[1]);
  EXPECT_NEAR(found, exact, 0.05 * exact);
  EXPECT_NEAR(0.4 * body.rotation()[1], body.displacement()[0], 0.02 * body.displacement()[0]);
}

/// A body that hits a block of soil in free space, and what becomes of their momentum.
template <int D>
void collide(const Shape& shape, double friction, const char* walls, Transfer transfer,
             bool sharp = false) {
  const Grid<D> grid =
      make_grid<D>(D == 2 ? std::array<int, 3>{24, 24, 1} : std::array<int, 3>{16, 16, 20}, 0.05,
                   walls, 0.0, MPI_COMM_WORLD);
  SoilOptions options =
      make_soil(D, {0.2, D == 2 ? -1.0 : 0.2, 0.2}, {0.6, D == 2 ? 1.0 : 0.6, 0.5}, false);
  options.transfer = transfer;
  SolidOptions solid = make_solid(shape);
  solid.sharp_edges = sharp;
  FreeSolid motion;
  motion.density = 3000.0;
  motion.velocity = {1.0, 0.0, -3.0};
  motion.angular_velocity = {0.0, 2.0, 0.0};
  solid.motion = motion;
  solid.friction = friction;
  options.solids.push_back(solid);
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  const Solid& body = soil.solids()[0];
  const auto momentum = [&] {
    const auto mine = soil.totals().momentum;
    Eigen::Vector3d all = body.momentum();
    for (int a = 0; a < D; ++a) all[D == 2 && a == 1 ? 2 : a] += mine[a];
    return all;
  };
  const Eigen::Vector3d start = momentum();
  const double speed = body.velocity().norm();
  double time = 0.0;
  run(soil, time, 150, 0.5 * soil.stable_step());
  std::printf("%d-D collision: momentum off by %.2e, velocity %.3f %.3f %.3f, spin %.3f\n", D,
              (momentum() - start).norm() / start.norm(), body.velocity()[0], body.velocity()[1],
              body.velocity()[2], body.spin()[1]);
  // Not to round-off: faces lighter than 1e-12 of a full one carry no motion of their own.
  EXPECT_LT((momentum() - start).norm(), 1e-9 * start.norm());
  EXPECT_GT(std::abs(body.velocity()[2] + 3.0), 0.2);  // they have met
  EXPECT_LT(body.velocity().norm(), speed);
}

TEST(Solid, LosesToTheSoilExactlyTheMomentumThatTheSoilGains) {
  for (const Transfer transfer : {Transfer::flip, Transfer::apic}) {
    collide<2>({SphereShape{{0.4, 0.0, 0.61}, 0.1, true}}, 0.5, "oooo", transfer);
    collide<3>({SphereShape{{0.4, 0.42, 0.61}, 0.1}}, 0.5, "oooooo", transfer);
  }
  for (const bool sharp : {false, true})
    collide<2>({PolygonShape{{{0.3, 0.55}, {0.5, 0.52}, {0.4, 0.7}}}}, infinity, "oooo",
               Transfer::flip, sharp);
}

// Heavier than the soil under it or lighter: at rest the soil carries the weight.
TEST(Solid, RestsOnSoilWithItsWeight) {
  for (const double density : {100.0, 10000.0}) {
    const Grid<2> grid = make_grid<2>({20, 12, 1}, 0.05, "sssn", 9.81, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, 0.4}, false);
    options.damping = 0.7;
    SolidOptions block = make_solid({BoxShape{{0.31, -infinity, 0.4}, {0.63, infinity, 0.5}}});
    FreeSolid motion;
    motion.density = density;
    block.motion = motion;
    options.solids.push_back(block);
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    const double dt = soil.stable_step();
    double time = 0.0;
    run(soil, time, density > 1e3 ? 6000 : 2000, dt);
    const Solid& body = soil.solids()[0];
    const double weight = density * 0.032 * 9.81;
    std::printf(
        "block of %g kg/m3: force / weight %.6f, sinks %.3e m, turns %.1e, unbalanced %.1e\n",
        density, body.force()[2] / weight, -body.displacement()[2], body.rotation()[1],
        soil.statics()->unbalanced_force);
    EXPECT_NEAR(body.force()[2], weight, 1e-3 * weight);
    EXPECT_LT(soil.statics()->unbalanced_force, 1e-3);
    EXPECT_LT(std::abs(body.velocity()[2]), 1e-4);
  }
}

// A plate on saturated soil lets no water through: the load stays on the water. Its force is that
// of grains and water together.
TEST(Solid, SealsThePoresUnderIt) {
  for (const double top : {1.0, 0.975}) {
    const Grid<2> grid = make_grid<2>({4, 24, 1}, 0.05, "sssn", 0.0, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {0, -1, 0}, {1, 1, top}, true);
    options.bodies[0].intrinsic_permeability = 1e-9;  // would drain within a hundredth of a second
    options.damping = 0.3;
    SolidOptions plate = make_solid({BoxShape{{-1, -infinity, top}, {2, infinity, 1.2}}});
    PrescribedSolid motion;
    motion.by_displacement = true;
    const double strain = 1e-4;
    motion.translation[2] =
        of_time([&](double t) { return -strain * top * std::min(1.0, t / 0.05); });
    plate.motion = motion;
    options.solids.push_back(plate);
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    const double dt = soil.stable_step();
    double time = 0.0;
    run(soil, time, static_cast<int>(std::ceil(0.2 / dt)), dt);
    const double exact_pressure = 2e7 / 0.4 * strain;
    const double exact_force = 0.2 * (exact_pressure + strain * constrained_modulus(1e6, 0.3));
    const auto& points = soil.points(0);
    std::array<double, 3> mine{}, all{};
    for (std::size_t p = 0; p < points.size(); ++p) {
      mine[0] += points.pore_pressure[p], mine[1] += 1.0;
    }
    MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const double force = soil.solids()[0].force()[2];
    std::printf("sealed plate at %g: pressure %.1f Pa, exact %.1f; force %.2f N/m, exact %.2f\n",
                top, all[0] / all[1], exact_pressure, force, exact_force);
    EXPECT_NEAR(all[0] / all[1], exact_pressure, 0.03 * exact_pressure);
    EXPECT_NEAR(force, exact_force, 0.03 * exact_force);
  }
}

// A smooth strip footing on clay, eight cells per half width: (2 + pi) s_u over the width of the
// body, not of one that is wider by a cell. An edge within a cell is met to half a cell.
TEST(Solid, PressesClayOverItsOwnWidth) {
  for (const double half : {1.0, 0.9375}) {
    const Grid<2> grid = make_grid<2>({28, 16, 1}, 0.125, "ssns", 0.0, MPI_COMM_WORLD);
    SoilOptions options = make_soil(2, {0, -1, 0}, {3.5, 1, 1.75}, false);
    options.bodies[0].law = TrescaOptions{5e6, 0.49, 10e3};
    options.bodies[0].strain = StrainMeasure::jaumann;
    options.damping = 0.3;
    SolidOptions footing = make_solid({BoxShape{{-2, -infinity, 1.75}, {half, infinity, 2.0}}});
    footing.sharp_edges = true;
    PrescribedSolid motion;
    motion.translation[2] = Varying(-0.02);
    footing.motion = motion;
    options.solids.push_back(footing);
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    const double dt = soil.stable_step();
    double time = 0.0;
    run(soil, time, static_cast<int>(std::ceil(0.8 / dt)), dt);
    const double factor = soil.solids()[0].force()[2] / (10e3 * half);
    std::printf("footing of half width %g: N_c %.3f, exact 5.142 (%+.1f %%)\n", half, factor,
                100 * (factor / (2.0 + std::numbers::pi) - 1));
    const double tolerance = 0.03 + (half < 1.0 ? 0.0625 / half : 0.0);
    EXPECT_NEAR(factor, 2.0 + std::numbers::pi, tolerance * 5.142);
  }
}

// The same problem one cell thick in space.
TEST(Solid, DoesTheSameInSpaceAsInThePlane) {
  const auto footing = []<int D>(std::integral_constant<int, D>, bool sharp) {
    const Grid<D> grid =
        make_grid<D>(D == 2 ? std::array<int, 3>{16, 12, 1} : std::array<int, 3>{16, 1, 12}, 0.1,
                     D == 2 ? "ssns" : "ssssns", 9.81, MPI_COMM_WORLD);
    SoilOptions options =
        make_soil(D, {0, D == 2 ? -1.0 : 0.0, 0}, {1.6, D == 2 ? 1.0 : 0.1, 0.8}, false);
    options.bodies[0].points_per_cell = D == 2 ? 4 : 8;
    options.damping = 0.3;
    SolidOptions body = make_solid({BoxShape{{-1, -1, 0.8}, {0.5, 1, 1.0}}});
    if (D == 2) body.shape = {BoxShape{{-1, -infinity, 0.8}, {0.5, infinity, 1.0}}};
    PrescribedSolid motion;
    motion.translation[2] = Varying(-0.2);
    motion.rotation[1] = Varying(D == 2 ? 0.1 : -0.1);
    body.motion = motion;
    body.centre = Point3{0.0, 0.0, 0.8};
    body.friction = 0.4;
    body.adhesion = 100.0;
    body.sharp_edges = sharp;
    options.solids.push_back(body);
    SoilSolver<D> soil(grid, options);
    soil.initialise();
    double time = 0.0;
    run(soil, time, 100, 5e-4);
    const Solid& solid = soil.solids()[0];
    const double scale = D == 2 ? 1.0 : 10.0;
    return Eigen::Vector3d(scale * solid.force()[0], scale * solid.moment()[1],
                           scale * solid.force()[2]);
  };
  for (const bool sharp : {false, true}) {
    const Eigen::Vector3d plane = footing(std::integral_constant<int, 2>{}, sharp);
    const Eigen::Vector3d space = footing(std::integral_constant<int, 3>{}, sharp);
    std::printf("force in the plane %.9g %.9g %.9g, in space %.9g %.9g %.9g\n", plane[0], plane[1],
                plane[2], space[0], space[1], space[2]);
    EXPECT_GT(plane[2], 100.0);
    EXPECT_LT((plane - space).norm(), 1e-8 * plane.norm());
  }
}

}  // namespace
}  // namespace mudlark

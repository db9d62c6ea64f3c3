// ranks: 1 3
#include "flow/flow_gauges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "numerics/ghosts.hpp"
#include "numerics/plic.hpp"
#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

template <int D>
FlowSection<D> whole_section(int axis, double place) {
  FlowSection<D> section{axis, place, {}, {}};
  for (int a = 0; a < D; ++a) section.from[a] = -far_away, section.to[a] = far_away;
  return section;
}

/// Water in the cells with x below `place` [m^D].
template <int D>
double water_before(const FlowRun<D>& run, double place) {
  double sum = 0.0;
  for_each(run.grid.owned(), [&](const Index<D>& cell) {
    if (run.grid.cell_centre(cell)[0] < place) sum += run.flow.water_fraction()[cell];
  });
  return sum_over_ranks(run.grid, sum) * run.grid.cell_volume();
}

/// What passes a section in a breaking dam is what the tank loses before it, step by step, and the
/// parts of the section add up to it wherever they are cut.
template <int D>
void section_keeps_the_books(int cells) {
  FlowRun<D> run(tank<D>(cells), column_and_mound<D>());
  const double place = 0.2;
  FlowSection<D> whole = whole_section<D>(0, place + 0.3 * run.grid.spacing()[0]);
  FlowSection<D> low = whole, high = whole;
  low.to[D - 1] = high.from[D - 1] = 0.037;
  const double start = water_before(run, place);
  double passed = 0.0, in_parts = 0.0;
  for (int step = 0; step < 40; ++step) {
    run.step(run.flow.stable_step(run.medium));
    const auto through = [&](const FlowSection<D>& section) {
      return sum_over_ranks(run.grid, own_water_through(run.grid, run.flow.water_flux(), section));
    };
    passed += through(whole);
    in_parts += through(low) + through(high);
    ASSERT_NEAR(passed, start - water_before(run, place), 1e-14);
  }
  EXPECT_GT(passed, 0.01 * start);
  EXPECT_NEAR(in_parts, passed, 1e-14);
}

TEST(FlowGauges, ASectionCountsExactlyWhatTheTankLosesBeforeIt) {
  section_keeps_the_books<2>(10);
  section_keeps_the_books<3>(5);
}

/// A layer, air, a second layer, air, a third: every surface is found where it is, also inside
/// cells.
TEST(FlowGauges, EverySurfaceOverAPlaceIsFoundFromTheTopDown) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.113}),
                    water_box({-1.0, -1.0, 0.209}, {0.3, 1.0, 0.327})};
  const FlowRun<2> run(tank<2>(20), options);
  const auto left = surfaces_over(run.grid, run.flow.saturation(), Vec<2>{{0.1, 0.0}});
  ASSERT_EQ(left.size(), 3u);
  EXPECT_NEAR(left[0], 0.327, 1e-14);
  EXPECT_NEAR(left[1], 0.209, 1e-14);
  EXPECT_NEAR(left[2], 0.113, 1e-14);
  const auto right = surfaces_over(run.grid, run.flow.saturation(), Vec<2>{{0.6, 0.0}});
  ASSERT_EQ(right.size(), 1u);
  EXPECT_NEAR(right[0], 0.113, 1e-14);
}

/// Pressure sensors sit in walls, at the domain's very ends.
TEST(FlowGauges, PressureOnTheWallsIsThatBesideThem) {
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.31})};
  const FlowRun<2> run(tank<2>(10), options);
  for (const double x : {0.0, 0.3, 0.6})
    EXPECT_NEAR(run.flow.pressure_at(Vec<2>{{x, 0.11}}), 9810.0 * 0.2, 1e-8);
  EXPECT_EQ(run.flow.pressure_at(Vec<2>{{0.6, 0.5}}), 0.0);
  EXPECT_EQ(run.flow.pressure_at(Vec<2>{{0.7, 0.11}}), 0.0);
}

template <int D>
RunUpRange<D> everywhere(double thickness) {
  RunUpRange<D> range{{}, {}, thickness};
  for (int a = 0; a < D; ++a) range.from[a] = -far_away, range.to[a] = far_away;
  return range;
}

/// Stairs of porous ground with a film on a high step, a thinner one above it and a blob in the
/// air.
template <int D>
void run_up_on_stairs() {
  FlowOptions options;
  PorousGround step;
  step.drag = DragLaw::van_gent;
  step.grain_size = 0.02;
  for (const double x : {0.2, 0.3, 0.4, 0.5}) {
    step.shape.form = BoxShape{{x, -1.0, -1.0}, {1.0, 1.0, x - 0.1}};
    options.porous.push_back(step);
  }
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {0.3, 1.0, 0.15}),
                    water_box({0.3, 0.05, 0.2}, {0.38, 0.1, 0.2 + 0.012}),
                    water_box({0.4, -1.0, 0.3}, {0.5, 1.0, 0.3 + 0.004}),
                    water_box({0.5, -1.0, 0.45}, {0.6, 1.0, 0.49})};
  DomainOptions domain = tank<D>(20);
  if (D == 3) domain = flow_domain({60, 20, 50}, {0.6, 0.2, 0.5}, {0.0, 0.0, -9.81});
  const FlowRun<D> run(domain, options);
  const auto read = [&](const RunUpRange<D>& range) {
    return run_up(run.grid, run.flow.saturation(), run.medium, range);
  };
  const double first = 0.15;
  EXPECT_NEAR(read(everywhere<D>(0.01)), 0.2 + 0.012, 1e-13);
  EXPECT_NEAR(read(everywhere<D>(0.003)), 0.3 + 0.004, 1e-13);
  EXPECT_NEAR(read(everywhere<D>(0.03)), first, 1e-13);
  EXPECT_TRUE(std::isnan(read(everywhere<D>(0.3))));
  RunUpRange<D> part = everywhere<D>(0.01);
  part.to[0] = 0.25;
  EXPECT_NEAR(read(part), first, 1e-13);
  if constexpr (D == 3) {
    part = everywhere<D>(0.01);
    part.from[1] = 0.1;
    EXPECT_NEAR(read(part), first, 1e-13);
  }
}

TEST(FlowGauges, RunUpIsTheHighestWaterThatStandsThickEnoughOnTheGround) {
  run_up_on_stairs<2>();
  run_up_on_stairs<3>();
}

/// Still water on a beach that bodies cut out of the cells, beside a wall inside a column.
template <int D>
void run_up_on_a_beach() {
  constexpr double level = 0.2137;
  FlowOptions options;
  options.bodies = {water_box({-1.0, -1.0, -1.0}, {1.0, 1.0, level})};
  FlowSolid beach{"beach", {}, Point3{}, {}, false}, wall{"wall", {}, Point3{}, {}, false};
  const PolygonShape slope{{{0.1, -0.1}, {0.7, -0.1}, {0.7, 0.36}, {0.1, 0.0}}};
  beach.shape.form = slope;
  wall.shape.form = BoxShape{{-1.0, -1.0, -1.0}, {0.013, 1.0, 1.0}};
  options.solids = {beach, wall};
  const FlowRun<D> run(tank<D>(D == 2 ? 20 : 6), options);
  RunUpRange<D> range = everywhere<D>(0.001);
  const auto read = [&] { return run_up(run.grid, run.flow.saturation(), run.medium, range); };
  for (const double x : {0.01, 0.05, 0.15, 0.25, 0.35, 0.41}) {
    range.from[0] = x - 0.01, range.to[0] = x + 0.01;
    EXPECT_NEAR(read(), level, 2e-4) << "at x = " << x;
  }
}

TEST(FlowGauges, RunUpOnABodysSlopeIsGoodToAPartOfACell) {
  run_up_on_a_beach<2>();
  run_up_on_a_beach<3>();
}

/// A wedge of water, z < 0.1 m + x/2: in the inner cells PLIC has exactly its plane, so only the
/// two cells at the ends are not exact.
TEST(FlowGauges, PotentialEnergyOfAWedgeIsThatOfItsCentreOfMass) {
  for (const int cells : {10, 20, 40}) {
    const Grid<2> grid(tank<2>(cells), MPI_COMM_WORLD);
    CellField<2> water(grid, "water", "1");
    for_each(grid.owned(), [&](const Index<2>& cell) {
      const Vec<2> corner = grid.cell_centre(cell) - 0.5 * grid.spacing();
      water[cell] = volume_below(
          Plane<2>{Vec<2>{{-0.5, 1.0}}, (0.1 + 0.5 * corner[0] - corner[1]) / grid.spacing()[0]});
    });
    Ghosts<2>(grid).update(water);
    // integral of z: integral of (0.1 + x/2)^2 / 2 dx
    const double exact = 9810.0 * (std::pow(0.4, 3) - std::pow(0.1, 3)) / 3.0;
    const double h = grid.spacing()[0];
    // a cell has g rho h^2 of weight; its water's centre is known to a sixth of it at the least
    EXPECT_NEAR(potential_energy(grid, water, water, 1000.0), exact,
                1e-9 * exact + 2.0 * 9810.0 * h * h * h / 6.0);
  }
}

}  // namespace
}  // namespace mudlark

// ranks: 1
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

template <int D>
double worst_bound(const FlowRun<D>& run) {
  double worst = 0.0;
  for_each(run.grid.owned(), [&](const Index<D>& cell) {
    const double w = run.flow.water_fraction()[cell];
    worst = std::max({worst, -w, w - run.flow.porosity()[cell]});
  });
  return max_over_ranks(run.grid, worst);
}

template <int D>
void breaks_with_exact_volume(int cells_per_length, double end) {
  FlowRun<D> run(tank<D>(cells_per_length), column_and_mound<D>());
  const double start = run.flow.ledger().initial;
  EXPECT_NEAR(start, D == 2 ? 0.08 : 0.0088, 1e-12);
  double worst = 0.0, fastest = 0.0;
  while (run.time < end) {
    run.step(run.flow.stable_step(run.medium));
    worst = std::max(worst, worst_bound(run));
    fastest = std::max(fastest, run.flow.max_speed().speed);
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_NEAR(run.flow.ledger().present, start, 1e-12 * start);
  EXPECT_GT(fastest, 1.0);
  // Thin jets outrun a fall from the lid, but stay bounded.
  EXPECT_LT(fastest, 3.0 * std::sqrt(2.0 * 9.81 * 0.5));
}

TEST(DamBreak, KeepsItsVolumeAndItsBoundsThroughSplashesIn2D) {
  breaks_with_exact_volume<2>(10, 3.0);
}
TEST(DamBreak, KeepsItsVolumeAndItsBoundsThroughSplashesIn3D) {
  breaks_with_exact_volume<3>(5, 0.6);
}

/// Keeps a solver's state in memory.
struct MemoryArchive {
  bool saving = true;
  std::map<std::string, std::vector<double>> values;
  std::map<std::string, std::int64_t> integers;

  void number(const std::string& name, double& value) {
    if (saving) values[name] = {value};
    value = values.at(name)[0];
  }
  void integer(const std::string& name, std::int64_t& value) {
    if (saving) integers[name] = value;
    value = integers.at(name);
  }
  /// Owned cells only, as a checkpoint keeps them.
  void cells(const std::string& name, CellField<2>& field) {
    box(name, field, field.local().grown(-ghost_layers));
  }
  void faces(const std::string& name, FaceVector<2>& field) {
    for (int a = 0; a < 2; ++a)
      box(name + std::to_string(a), field[a], field[a].local().grown(-ghost_layers).extended(a, 1));
  }
  template <class AnyField>
  void box(const std::string& name, AnyField& field, const IndexBox<2>& box) {
    auto& stored = values[name];
    std::size_t k = 0;
    if (saving) stored.clear();
    for_each(box, [&](const Index<2>& i) {
      if (saving)
        stored.push_back(field[i]);
      else
        field[i] = stored.at(k++);
    });
  }
};

TEST(DamBreak, ContinuesFromItsArchiveBitForBit) {
  FlowRun<2> run(tank<2>(8), column_and_mound<2>()), other(tank<2>(8), column_and_mound<2>());
  for (int step = 0; step < 40; ++step) run.step(run.flow.stable_step(run.medium));
  MemoryArchive memory;
  run.flow.archive(memory);
  memory.saving = false;
  other.flow.archive(memory);
  for (int step = 0; step < 40; ++step) {
    const double dt = run.flow.stable_step(run.medium);
    ASSERT_EQ(dt, other.flow.stable_step(other.medium));
    run.step(dt);
    other.step(dt);
  }
  for_each(run.grid.owned(), [&](const Index<2>& cell) {
    ASSERT_EQ(run.flow.water_fraction()[cell], other.flow.water_fraction()[cell]);
    ASSERT_EQ(run.flow.pressure()[cell], other.flow.pressure()[cell]);
    ASSERT_EQ(run.flow.velocity()[0][cell], other.flow.velocity()[0][cell]);
  });
}

TEST(DamBreak, CountsTheWaterThatLeavesThroughAnOpenWall) {
  DomainOptions domain = tank<2>(8);
  domain.walls[0][1] = Wall::open;
  FlowOptions options = column_and_mound<2>();
  options.porous.clear();
  FlowRun<2> run(domain, options);
  while (run.time < 1.5) run.step(run.flow.stable_step(run.medium));
  const WaterLedger water = run.flow.ledger();
  EXPECT_GT(water.outflow, 0.7 * water.initial);
  EXPECT_NEAR(water.present + water.outflow, water.initial, 1e-12 * water.initial);
}

TEST(DamBreak, ATooLargeStepIsRefusedWithTheReason) {
  FlowRun<2> run(tank<2>(8), column_and_mound<2>());
  for (int step = 0; step < 20; ++step) run.step(run.flow.stable_step(run.medium));
  try {
    run.step(100.0 * run.flow.stable_step(run.medium));
    FAIL() << "the step was taken";
  } catch (const DivergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("too large"), std::string::npos);
  }
}

TEST(DamBreak, APressureThatIsNotFoundIsReportedWithItsPlace) {
  FlowOptions options = column_and_mound<2>();
  options.pressure_tolerance = 1e-25;  // far below round-off
  FlowRun<2> run(tank<2>(8), options);
  try {
    for (int step = 0; step < 5; ++step) run.step(run.flow.stable_step(run.medium));
    FAIL() << "the pressure was taken as found";
  } catch (const DivergenceError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("pressure could not be found"), std::string::npos) << text;
    EXPECT_NE(text.find(" at (x, z) = ("), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace mudlark

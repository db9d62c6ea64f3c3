#include "run/clock.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>

namespace mudlark {
namespace {

/// Keeps numbers as a checkpoint would.
struct Memory {
  bool reading = false;
  std::vector<double> numbers;
  std::vector<std::int64_t> integers;
  void number(const std::string&, double& value) {
    if (reading)
      value = numbers.front(), numbers.erase(numbers.begin());
    else
      numbers.push_back(value);
  }
  void integer(const std::string&, std::int64_t& value) {
    if (reading)
      value = integers.front(), integers.erase(integers.begin());
    else
      integers.push_back(value);
  }
};

TimeOptions until(double end) {
  TimeOptions options;
  options.end = end;
  return options;
}

/// All times that a run visits, with stable steps that vary.
std::vector<double> visited(Clock& clock, double stable, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> vary(0.5, 1.0);
  std::vector<double> times{clock.time()};
  while (!clock.finished() && times.size() < 200000) {
    const double limit = stable * vary(generator), dt = clock.choose_step(limit);
    EXPECT_GT(dt, 0.0);
    EXPECT_LE(dt, limit * (1 + 1e-9));
    clock.advance(dt);
    EXPECT_GT(clock.time(), times.back());
    times.push_back(clock.time());
  }
  return times;
}

TEST(Clock, StepsEndWhereWhatDrivesTheRunBends) {
  TimeOptions options = until(100.0);
  options.output_every = 30.0;
  Clock clock(options, {}, {0.0, 10.0, 10.5, 60.0 * (1.0 + 1e-15), 60.25, 200.0});
  const std::vector<double> times = visited(clock, 50.0);
  const std::set<double> all(times.begin(), times.end());
  for (const double t : {10.0, 10.5, 30.0, 60.0, 60.25, 90.0, 100.0})
    EXPECT_TRUE(all.count(t)) << t;
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i] - times[i - 1], 0.2);
}

TEST(Clock, VisitsEveryMultipleOfEveryPeriodAndEveryOutputTimeExactly) {
  TimeOptions options = until(2.0);
  options.output_every = 0.1;
  options.output_at = {0.123, 0.7, 1.999};
  Clock clock(options, {0.03});
  const std::vector<double> times = visited(clock, 0.0071);
  const std::set<double> all(times.begin(), times.end());
  for (const double t : options.output_at) EXPECT_TRUE(all.count(t)) << t;
  const auto near = [&](double t) {
    const auto next = all.lower_bound(t - 1e-9);
    return next != all.end() && std::abs(*next - t) < 1e-12;
  };
  for (int i = 0; i <= 20; ++i) EXPECT_TRUE(near(0.1 * i)) << i;
  for (int i = 0; i <= 66; ++i) EXPECT_TRUE(near(0.03 * i)) << i;
  EXPECT_EQ(times.back(), 2.0);
  EXPECT_EQ(clock.step(), static_cast<std::int64_t>(times.size() - 1));
}

TEST(Clock, TellsWhenOutputIsDueOnceForEachTime) {
  TimeOptions options = until(1.0);
  options.output_every = 0.1;
  options.output_at = {0.25, 0.3};  // 0.3 falls on a multiple
  Clock clock(options, {0.07});
  int outputs = clock.output_due() ? 1 : 0;
  while (!clock.finished()) {
    clock.advance(clock.choose_step(0.013));
    outputs += clock.output_due() ? 1 : 0;
  }
  EXPECT_EQ(outputs, 12);  // 0, 0.1 .. 1 and 0.25
}

TEST(Clock, NeverTakesAStepOfRoundOffBetweenTimesThatMeanTheSame) {
  // 3 * 0.1 is not 0.3 in floating point, and many other pairs differ in the last digit.
  for (const double period : {0.1, 0.01, 0.07, 0.3, 1.1, 1e-3})
    for (int count = 1; count <= 100; ++count) {
      const double written = std::stod(std::to_string(std::lround(1e6 * period * count))) / 1e6;
      TimeOptions at = until(2.0 * written), end = until(written);
      at.output_at = {written};
      for (const TimeOptions& options : {at, end}) {
        Clock clock(options, {period});
        while (!clock.finished()) {
          const double dt = clock.choose_step(period);
          ASSERT_GT(dt, 1e-3 * period) << period << " x " << count << " at " << clock.time();
          clock.advance(dt);
        }
      }
    }
}

TEST(Clock, TakesEqualStepsUpToTheNextEvent) {
  Clock clock(until(1.0), {});
  const double dt = clock.choose_step(0.3);
  EXPECT_DOUBLE_EQ(dt, 0.25);
  int steps = 0;
  while (!clock.finished()) clock.advance(clock.choose_step(0.3)), ++steps;
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(clock.time(), 1.0);
}

TEST(Clock, BoundsOrFixesTheStepAsTheCaseSays) {
  TimeOptions bounded = until(1.0), fixed = until(1.0);
  bounded.max_step = 0.05;
  fixed.step = 0.125;
  EXPECT_DOUBLE_EQ(Clock(bounded, {}).choose_step(0.3), 0.05);
  EXPECT_DOUBLE_EQ(Clock(bounded, {}).choose_step(0.01), 0.01);
  EXPECT_DOUBLE_EQ(Clock(fixed, {}).choose_step(0.001), 0.125);
}

TEST(Clock, GoesOnAfterACheckpointAsIfNothingHadHappened) {
  TimeOptions options = until(3.0);
  options.output_every = 0.1;
  Clock straight(options, {0.07}), first(options, {0.07}), second(options, {0.07});
  for (int i = 0; i < 137; ++i) {
    straight.advance(straight.choose_step(0.0171));
    first.advance(first.choose_step(0.0171));
  }
  Memory memory;
  first.archive(memory);
  memory.reading = true;
  second.archive(memory);
  EXPECT_EQ(second.step(), 137);
  while (!straight.finished()) {
    ASSERT_FALSE(second.finished());
    EXPECT_EQ(straight.choose_step(0.0171), second.choose_step(0.0171));
    EXPECT_EQ(straight.output_due(), second.output_due());
    straight.advance(straight.choose_step(0.0171));
    second.advance(second.choose_step(0.0171));
    ASSERT_EQ(straight.time(), second.time());
  }
  EXPECT_TRUE(second.finished());
}

TEST(Clock, KnowsMultiplesOfAPeriodDespiteRoundOff) {
  EXPECT_TRUE(Clock::due(0.1 + 0.2, 0.1));
  EXPECT_TRUE(Clock::due(1e6 * 0.1, 0.1));
  EXPECT_FALSE(Clock::due(0.1500001, 0.05));
  EXPECT_TRUE(Clock::due(0.1234, 0.0));
}

TEST(Clock, EndsStepsAtTheEndsOfStagesAndPassesOverWhatIsLeftOfOne) {
  TimeOptions options = until(3.0);
  options.stage_ends = {0.7, 1.9, 3.0};
  Clock clock(options, {});
  std::vector<double> ends;
  while (!clock.finished()) {
    if (clock.stage_over()) clock.begin_next_stage();
    clock.advance(clock.choose_step(0.13));
    if (clock.at_stage_end()) {
      ends.push_back(clock.time());
      EXPECT_TRUE(clock.output_due());
    }
  }
  EXPECT_EQ(ends, options.stage_ends);
  EXPECT_EQ(clock.stage(), 2u);
  Clock restful(options, {});
  restful.advance(restful.choose_step(0.13));
  restful.pass_to_stage_end();
  EXPECT_EQ(restful.time(), 0.7);
  EXPECT_TRUE(restful.stage_over());
  Memory memory;
  restful.archive(memory);
  Clock again(options, {});
  memory.reading = true;
  again.archive(memory);
  EXPECT_TRUE(again.stage_over());
  again.begin_next_stage();
  EXPECT_FALSE(again.stage_over());
  EXPECT_FALSE(again.in_last_stage());
}

TEST(Clock, WithoutStagesIsInTheOnlyOne) {
  Clock clock(until(1.0), {});
  EXPECT_TRUE(clock.in_last_stage());
  while (!clock.finished()) {
    EXPECT_FALSE(clock.stage_over());
    EXPECT_FALSE(clock.at_stage_end());
    clock.advance(clock.choose_step(0.3));
  }
}

}  // namespace
}  // namespace mudlark

#include "input/expression.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace mudlark {
namespace {

TEST(Expression, IsEvaluatedAtThePositionAndTimeGiven) {
  const Varying value = parse_expression("1000*9.81*(2-z) + x*y - sin(pi*t)");
  EXPECT_DOUBLE_EQ(value({2.0, 3.0, 0.5}, 0.5), 1000 * 9.81 * 1.5 + 6.0 - 1.0);
  EXPECT_FALSE(value.constant());
}

TEST(Expression, KnowsConditions) {
  const Varying ramp = parse_expression("t < 0.05 ? 0.5*(1-cos(pi*t/0.05)) : 1");
  EXPECT_NEAR(ramp({}, 0.025), 0.5, 1e-15);
  EXPECT_EQ(ramp({}, 7.0), 1.0);
}

TEST(Expression, CopiesDoNotDisturbEachOther) {
  const Varying first = parse_expression("x + t");
  const Varying second = first;
  EXPECT_EQ(first({1, 0, 0}, 2.0), 3.0);
  EXPECT_EQ(second({5, 0, 0}, 1.0), 6.0);
  EXPECT_EQ(first({1, 0, 0}, 2.0), 3.0);
}

TEST(Expression, KnowsWhatItVariesWith) {
  const Varying both = parse_expression("x*t"), place = parse_expression("x+z"),
                time = parse_expression("sin(t)"), neither = parse_expression("2*pi");
  EXPECT_TRUE(both.in_space && both.in_time);
  EXPECT_TRUE(place.in_space && !place.in_time);
  EXPECT_TRUE(!time.in_space && time.in_time);
  EXPECT_TRUE(!neither.in_space && !neither.in_time);
  const Varying table = interpolate_in_time({0.0, 1.0}, {0.0, 1.0}, "table");
  EXPECT_TRUE(!table.in_space && table.in_time);
  const Varying pulse =
      interpolate_in_time({0.0, 1.0, 2.0, 3.0, 5.0, 6.0}, {0.0, 0.0, 1.0, 2.0, 0.0, 0.0}, "pulse");
  EXPECT_EQ(pulse.bends, (std::vector<double>{1.0, 3.0, 5.0}));
}

TEST(Expression, WithoutVariablesIsAConstant) {
  EXPECT_TRUE(parse_expression("2*pi").constant());
  EXPECT_DOUBLE_EQ(parse_expression("2*pi")({}, 0), 2 * std::numbers::pi);
}

TEST(Expression, RefusesUnknownNamesUnbalancedBracketsAndSeveralResults) {
  EXPECT_THROW(parse_expression("2*q"), std::invalid_argument);
  EXPECT_THROW(parse_expression("(2*x"), std::invalid_argument);
  EXPECT_THROW(parse_expression("x, y"), std::invalid_argument);
  EXPECT_THROW(parse_expression(""), std::invalid_argument);
  EXPECT_THROW(parse_expression("1/0"), std::invalid_argument);
}

TEST(TableOfTimes, IsLinearBetweenAndLevelBeyond) {
  const Varying table = interpolate_in_time({1.0, 2.0, 4.0}, {0.0, 10.0, 30.0}, "table");
  EXPECT_EQ(table({}, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(table({}, 1.5), 5.0);
  EXPECT_DOUBLE_EQ(table({}, 2.0), 10.0);
  EXPECT_DOUBLE_EQ(table({}, 3.0), 20.0);
  EXPECT_EQ(table({}, 9.0), 30.0);
}

}  // namespace
}  // namespace mudlark

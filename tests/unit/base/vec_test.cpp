// ranks: 1
#include "base/vec.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mudlark {
namespace {

constexpr SymTensor distinct{1.0, 2.0, 3.0, 12.0, 23.0, 31.0};

TEST(SymTensor, BetweenGivesTheSixComponentsOfAThreeDimensionalProblem) {
  const double expected[3][3] = {{1.0, 12.0, 31.0}, {12.0, 2.0, 23.0}, {31.0, 23.0, 3.0}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_EQ(distinct.between<3>(row, column), expected[row][column]) << row << " " << column;
}

TEST(SymTensor, BetweenTakesTheSecondAxisOfAPlaneProblemAsZ) {
  EXPECT_EQ(distinct.between<2>(0, 0), 1.0);
  EXPECT_EQ(distinct.between<2>(1, 1), 3.0);
  EXPECT_EQ(distinct.between<2>(0, 1), 31.0);
  EXPECT_EQ(distinct.between<2>(1, 0), 31.0);
}

TEST(SymTensor, SumsAndScalesEveryComponentAndItsTraceIsTheSumOfTheNormalOnes) {
  const SymTensor sum = distinct + 2.0 * SymTensor{10.0, 20.0, 30.0, 40.0, 50.0, 60.0};
  EXPECT_EQ(sum, (SymTensor{21.0, 42.0, 63.0, 92.0, 123.0, 151.0}));
  EXPECT_EQ(distinct.trace(), 6.0);
  EXPECT_EQ(SymTensor::identity().trace(), 3.0);
}

TEST(Vec, AddsSubtractsScalesAndMeasuresItself) {
  const Vec<3> first{{1.0, 2.0, 2.0}}, second{{4.0, 0.0, -1.0}};
  EXPECT_EQ(first + second, (Vec<3>{{5.0, 2.0, 1.0}}));
  EXPECT_EQ(first - second, (Vec<3>{{-3.0, 2.0, 3.0}}));
  EXPECT_EQ(3.0 * first, (Vec<3>{{3.0, 6.0, 6.0}}));
  EXPECT_EQ(dot(first, second), 2.0);
  EXPECT_EQ(norm(first), 3.0);
}

TEST(Vec, PlaneProblemLiesInTheXZPlaneOfSpace) {
  EXPECT_EQ(to_point3(Vec<2>{{1.0, 2.0}}), (Point3{1.0, 0.0, 2.0}));
  EXPECT_EQ(to_point3(Vec<3>{{1.0, 2.0, 3.0}}), (Point3{1.0, 2.0, 3.0}));
}

TEST(ForEach, VisitsABoxWithTheFirstAxisFastest) {
  std::vector<Index<2>> plane;
  for_each(IndexBox<2>{{{-1, 4}}, {{1, 6}}}, [&](const Index<2>& i) { plane.push_back(i); });
  EXPECT_EQ(plane, (std::vector<Index<2>>{{{-1, 4}}, {{0, 4}}, {{-1, 5}}, {{0, 5}}}));

  std::vector<Index<3>> space;
  for_each(IndexBox<3>{{{0, 0, 0}}, {{2, 1, 2}}}, [&](const Index<3>& i) { space.push_back(i); });
  EXPECT_EQ(space, (std::vector<Index<3>>{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 0, 1}}, {{1, 0, 1}}}));
}

TEST(ForEach, DoesNothingInABoxThatIsEmptyAlongAnyAxis) {
  int visits = 0;
  for_each(IndexBox<3>{{{0, 0, 0}}, {{5, 0, 5}}}, [&](const Index<3>&) { ++visits; });
  for_each(IndexBox<2>{{{3, 0}}, {{1, 5}}}, [&](const Index<2>&) { ++visits; });
  EXPECT_EQ(visits, 0);
}

TEST(IndexBox, HoldsItsLowerCornerAndNotItsUpperOne) {
  const IndexBox<2> box{{{1, 2}}, {{4, 5}}};
  EXPECT_TRUE(box.contains({{1, 2}}));
  EXPECT_TRUE(box.contains({{3, 4}}));
  EXPECT_FALSE(box.contains({{4, 4}}));
  EXPECT_FALSE(box.contains({{3, 5}}));
  EXPECT_FALSE(box.contains({{0, 3}}));
}

TEST(IndexBox, GrowsOnAllSidesExtendsOnOneAndIntersects) {
  const IndexBox<2> box{{{1, 2}}, {{4, 5}}};
  EXPECT_EQ(box.grown(2), (IndexBox<2>{{{-1, 0}}, {{6, 7}}}));
  EXPECT_EQ(box.extended(1, 1), (IndexBox<2>{{{1, 2}}, {{4, 6}}}));
  EXPECT_EQ(box.intersected({{{3, -1}}, {{9, 4}}}), (IndexBox<2>{{{3, 2}}, {{4, 4}}}));
  EXPECT_TRUE(box.intersected({{{4, 2}}, {{9, 5}}}).empty());
  EXPECT_FALSE(box.empty());
}

TEST(Index, ShiftsAlongOneAxisOnly) {
  EXPECT_EQ((Index<3>{{1, 2, 3}}.shifted(1, -4)), (Index<3>{{1, -2, 3}}));
}

}  // namespace
}  // namespace mudlark
